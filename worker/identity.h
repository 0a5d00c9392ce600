// Who a worker is: a name that is the same after a restart, though several workers share a machine,
// and the sessions that its processes had.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fjord::worker {

// HOST-N with the smallest N that no living process of this user holds. The name is held, by a lock
// in the user's runtime folder, until the process ends.
std::string TakeWorkerId();

// Random: a restarted worker is another session.
std::string NewSessionName();

// What this machine remembers of the processes of one worker: the sessions under which they joined.
// Whoever holds the note's lock knows that these are over, even after kill -9, so a worker that is
// started again need not wait until the coordinator misses the one before.
class SessionNote {
 public:
  // Adds `session`. Null where another living process of this worker holds the note, or it cannot
  // be written: then nothing is known.
  static std::unique_ptr<SessionNote> Take(const std::string& id, const std::string& server,
                                           const std::string& session);
  ~SessionNote();
  SessionNote(const SessionNote&) = delete;
  SessionNote& operator=(const SessionNote&) = delete;

  const std::vector<std::string>& ended() const { return ended_; }
  // The coordinator has heard that this session is over, too.
  void Forget();

 private:
  SessionNote(std::string path, int file) : path_(std::move(path)), file_(file) {}

  const std::string path_;
  const int file_;
  std::vector<std::string> ended_;
};

}  // namespace fjord::worker
