// Workers and their sessions. A worker is known by an id that outlives its processes; a session is
// one process. Single-threaded; time is passed in.
//
// R1 A worker has at most one session; a session belongs to one worker.
// R2 A session that is not heard from for its time to live is gone; the worker stays known.
// R3 Request numbers of a session only grow; the last answer is kept, so asking again is harmless.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/state/types.h"

namespace fjord::server {

struct Grant {
  AttemptId attempt;
  Digest scene;
  uint32_t frame = 0;
  Digest key;
  bool alone = false;
  uint32_t limit_ms = 0;  // 0: none
  JobId job = 0;          // whose frame it is, for people
  std::string job_name;
};

struct Worker {
  WorkerRow row;
  std::string host;
  std::string version;
  uint32_t threads = 0;
  std::vector<std::string> tags;
  std::string session;  // empty: gone
  int64_t gone_ms = 0;  // since when
  uint64_t frames_done = 0;
  uint64_t render_ms = 0;
  std::optional<int64_t> refused_ms;  // when the log last said that another was refused its name

  bool alive() const { return !session.empty(); }
  bool usable() const { return alive() && !row.draining && !row.quarantined; }
};

// A call that waits for work.
struct Parked {
  uint64_t request = 0;
  uint32_t want = 1;
  int64_t until_ms = 0;
  uint64_t arrival = 0;
};

struct Session {
  std::string id;
  std::string worker;
  int64_t joined_ms = 0;
  int64_t heard_ms = 0;
  uint64_t last_request = 0;
  std::vector<Grant> last_grants;
  std::optional<Parked> parked;
};

class Roster {
 public:
  Worker* FindWorker(const std::string& id);
  const Worker* FindWorker(const std::string& id) const;
  Session* FindSession(const std::string& id);
  const Session* FindSession(const std::string& id) const;

  Worker& AddWorker(WorkerRow row);  // or the one there is
  // R1: the worker must have no session.
  Session& Open(Worker& worker, const std::string& session, int64_t now_ms);
  void Close(const std::string& session, int64_t now_ms);
  // Forgets whoever is gone since then and bears no mark of a person or the judge.
  void ForgetGone(int64_t since_ms);
  // At a start, when nobody has joined yet.
  void AllGoneSince(int64_t now_ms);

  std::vector<std::string> SilentSince(int64_t before_ms) const;
  std::optional<int64_t> OldestHeard() const;
  size_t AliveCount() const { return sessions_.size(); }

  const std::map<std::string, Worker>& workers() const { return workers_; }
  const std::map<std::string, Session>& sessions() const { return sessions_; }
  std::map<std::string, Session>& sessions() { return sessions_; }

  std::vector<std::string> Audit() const;

 private:
  std::map<std::string, Worker> workers_;
  std::map<std::string, Session> sessions_;
};

}  // namespace fjord::server
