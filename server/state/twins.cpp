// Two processes under one worker id: machines that were made from one image, or a name given twice.
// The one that is alive stays. A process that has only died is told apart by its silence, or by the
// newer one knowing that it is over.
#include <algorithm>

#include "server/state/machine.h"

namespace fjord::server {
namespace {

constexpr int64_t kSayAgainMs = 60'000;

std::string Duration(int64_t ms) {
  const int64_t seconds = ms / 1000;
  if (seconds < 120) return std::to_string(seconds) + " s";
  if (seconds < 7200) return std::to_string(seconds / 60) + " min";
  return std::to_string(seconds / 3600) + " h";
}

std::string On(const std::string& host) { return host.empty() ? "" : " on " + host; }

}  // namespace

// None: the caller may have the name.
std::optional<Refusal> Machine::RefuseTwin(const JoinCall& call, Now now) {
  Worker* worker = roster_.FindWorker(call.worker);
  if (worker == nullptr || !worker->alive() || worker->session == call.session) return {};
  if (std::find(call.ended.begin(), call.ended.end(), worker->session) != call.ended.end()) {
    return {};
  }
  const Session& session = *roster_.FindSession(worker->session);
  const int64_t silent_ms = now.mono_ms - session.heard_ms;
  if (silent_ms >= call.waited_ms) {
    return Refusal{Code::kAborted, "worker_id: worker \"" + call.worker + "\"" + On(worker->host) +
                                       " was heard of " + Duration(silent_ms) +
                                       " ago; its name is free once it is silent for " +
                                       Duration(config_.term_ms)};
  }
  if (!worker->refused_ms || now.mono_ms - *worker->refused_ms >= kSayAgainMs) {
    worker->refused_ms = now.mono_ms;
    Say(false, "a second worker \"" + call.worker + "\"" + On(call.host) +
                   " is refused: the first" + On(worker->host) + " is alive");
  }
  return Refusal{Code::kExists, "worker_id: a worker \"" + call.worker + "\"" + On(worker->host) +
                                    " is alive, joined " +
                                    Duration(now.mono_ms - session.joined_ms) +
                                    " ago: give this one a name of its own with --id"};
}

}  // namespace fjord::server
