#include "worker/worker.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <random>
#include <thread>

#include "engine/base/parallel.h"
#include "proto/fjord/protocol.h"
#include "worker/held.h"
#include "worker/retry.h"

namespace fjord::worker {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr size_t kAhead = 1;         // leases that wait while one renders
constexpr size_t kMaxMade = 2;       // pictures on their way
constexpr milliseconds kMargin{50};  // stops this long before a deadline
constexpr milliseconds kLongestWait{20'000};
constexpr milliseconds kFirstPause{50};
constexpr milliseconds kLongestPause{500};
constexpr uint64_t kMaxErrorBytes = 2'000;

std::string RandomName() {
  std::random_device device;
  char text[33];
  std::snprintf(text, sizeof text, "%08x%08x%08x%08x", device(), device(), device(), device());
  return text;
}

std::string HostName() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

// A finished try on its way to the coordinator.
struct Made {
  std::shared_ptr<Lease> lease;
  Result<RenderedUnit> unit;
};

class WorkerImpl : public Worker {
 public:
  explicit WorkerImpl(WorkerConfig config);
  ~WorkerImpl() override { Stop(); }
  void Stop() override;
  Result<> Wait() override;
  std::optional<Result<>> WaitFor(int milliseconds) override;

 private:
  // Whether the call was answered and the thread goes on.
  enum class Sent : uint8_t { kAnswered, kDropped, kStopped };

  void AcquireLoop();
  void RenderLoop();
  void DeliverLoop();
  void RenewLoop();
  void GuardLoop();
  void RenewOnce();
  void Deliver(const Made& made);
  bool DeliverPicture(const Lease& lease, const RenderedUnit& unit);
  bool JoinIfNeeded(uint64_t seen_joins);
  template <typename Response, typename Call>
  Sent Ask(Rpc rpc, Call call, Response* response);
  bool Pause(milliseconds length);
  void End(Result<> result);
  bool stopping() const { return stopping_.load(); }

  const WorkerConfig config_;
  const std::string session_ = RandomName();
  const std::unique_ptr<LeaseClient> leases_;
  const std::unique_ptr<Blobs> blobs_;
  const std::unique_ptr<UnitRenderer> renderer_;
  const std::unique_ptr<UnitRenderer> child_;  // null: none
  HeldLeases held_{kMargin};
  std::atomic<bool> stopping_{false};
  std::atomic<bool> draining_{false};

  std::mutex join_mutex_;  // one thread joins at a time
  std::atomic<uint64_t> joins_{0};
  std::atomic<int64_t> term_ms_{10'000};
  std::atomic<int64_t> renew_ms_{1'000};

  std::mutex mutex_;
  std::condition_variable wake_;
  // guarded by mutex_
  std::deque<Made> made_;
  bool renew_now_ = false;
  bool guard_now_ = false;
  std::optional<Result<>> ended_;
  bool stopped_ = false;

  std::vector<std::thread> threads_;
};

std::shared_ptr<grpc::Channel> Connect(const std::string& server) {
  grpc::ChannelArguments arguments;
  // A coordinator that comes back is found within seconds.
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 50);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 500);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  return grpc::CreateCustomChannel(server, grpc::InsecureChannelCredentials(), arguments);
}

WorkerConfig Complete(WorkerConfig config) {
  if (config.id.empty()) config.id = HostName() + "-" + std::to_string(getpid());
  const std::shared_ptr<grpc::Channel> channel = Connect(config.server);
  if (!config.make_leases) {
    config.make_leases = [channel] { return MakeGrpcLeaseClient(channel); };
  }
  if (!config.make_blobs) {
    config.make_blobs = [channel, dir = config.cache_dir, bytes = config.cache_bytes] {
      return MakeGrpcBlobs(channel, dir, bytes);
    };
  }
  if (!config.make_renderer) {
    config.make_renderer = [threads = config.threads](Blobs& blobs) {
      return MakeEngineRenderer(blobs, threads);
    };
  }
  return config;
}

WorkerImpl::WorkerImpl(WorkerConfig config)
    : config_(Complete(std::move(config))),
      leases_(config_.make_leases()),
      blobs_(config_.make_blobs()),
      renderer_(config_.make_renderer(*blobs_)),
      child_(config_.program.empty()
                 ? nullptr
                 : MakeChildRenderer(config_.program, config_.server, config_.threads)) {
  threads_.emplace_back([this] { AcquireLoop(); });
  threads_.emplace_back([this] { RenderLoop(); });
  threads_.emplace_back([this] { DeliverLoop(); });
  threads_.emplace_back([this] { RenewLoop(); });
  threads_.emplace_back([this] { GuardLoop(); });
}

bool WorkerImpl::Pause(milliseconds length) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, length, [this] { return stopping(); });
  return !stopping();
}

void WorkerImpl::End(Result<> result) {
  {
    const std::lock_guard lock(mutex_);
    if (!ended_) ended_ = std::move(result);
    stopping_ = true;
  }
  held_.Stop();
  leases_->Shutdown();
  blobs_->Shutdown();
  wake_.notify_all();
}

void WorkerImpl::Stop() {
  End({});
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(stopped_, true)) return;
  }
  for (std::thread& thread : threads_) thread.join();
  if (joins_ > 0) {
    v1::LeaveRequest request;
    request.set_session_id(session_);
    leases_->Leave(request);
  }
}

Result<> WorkerImpl::Wait() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [this] { return ended_.has_value(); });
  return *ended_;
}

std::optional<Result<>> WorkerImpl::WaitFor(int length) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, milliseconds(length), [this] { return ended_.has_value(); });
  return ended_;
}

// Asks until there is an answer, as the table in docs/wire.md says.
template <typename Response, typename Call>
WorkerImpl::Sent WorkerImpl::Ask(Rpc rpc, Call call, Response* response) {
  Backoff backoff(kFirstPause, kLongestPause, std::hash<std::string>{}(session_));
  bool said = false;
  while (!stopping()) {
    const uint64_t joins = joins_;
    Reply<Response> reply = call();
    const Act act = ActOn(rpc, reply.status.error_code());
    if (act == Act::kDone || act == Act::kNext) {
      *response = std::move(reply.value);
      if (said) spdlog::info("the coordinator at {} answers again", config_.server);
      return act == Act::kDone ? Sent::kAnswered : Sent::kDropped;
    }
    if (act == Act::kDrop) {
      spdlog::warn("given up: {}", reply.status.error_message());
      return Sent::kDropped;
    }
    if (act == Act::kStop) {
      End(MakeError(ErrorCode::kUnavailable,
                    "the coordinator at " + config_.server +
                        " refuses this worker: " + reply.status.error_message()));
      return Sent::kStopped;
    }
    if (act == Act::kJoinAgain) {
      if (!JoinIfNeeded(joins)) return Sent::kStopped;
      continue;
    }
    if (!stopping() && !std::exchange(said, true)) {
      spdlog::warn("the coordinator at {} does not answer ({}); trying again", config_.server,
                   reply.status.error_message());
    }
    if (!Pause(backoff.Next())) break;
  }
  return Sent::kStopped;
}

// False: stopped. Does nothing if another thread has joined since `seen_joins`.
bool WorkerImpl::JoinIfNeeded(uint64_t seen_joins) {
  const std::lock_guard lock(join_mutex_);
  if (joins_ != seen_joins) return true;
  v1::JoinRequest request;
  request.set_worker_id(config_.id);
  request.set_session_id(session_);
  request.set_host(HostName());
  request.set_version(kVersion);
  request.set_protocol(kProtocol);
  request.set_threads(
      static_cast<uint32_t>(config_.threads > 0 ? config_.threads : HardwareThreads()));
  for (const std::string& tag : config_.tags) request.add_tag(tag);
  Time sent;
  v1::JoinResponse response;
  const Sent answer = Ask(
      Rpc::kJoin,
      [&] {
        request.clear_holding();
        for (const std::shared_ptr<Lease>& lease : held_.All()) {
          v1::JoinRequest::Holding& holding = *request.add_holding();
          *holding.mutable_attempt() = lease->grant.attempt();
          *holding.mutable_unit() = lease->grant.unit();
        }
        sent = steady_clock::now();
        return leases_->Join(request);
      },
      &response);
  if (answer != Sent::kAnswered) return false;
  term_ms_ = response.term_ms();
  renew_ms_ = std::max<uint32_t>(response.renew_every_ms(), 1);
  std::vector<AttemptKey> adopted;
  for (const v1::Attempt& attempt : response.adopted()) {
    adopted.push_back(KeyOf(attempt));
    held_.Extend(attempt, sent, milliseconds(response.term_ms()));
  }
  for (const v1::JoinRequest::Holding& holding : request.holding()) {
    const AttemptKey key = KeyOf(holding.attempt());
    if (std::find(adopted.begin(), adopted.end(), key) == adopted.end()) {
      held_.Lose(holding.attempt());
    }
  }
  ++joins_;
  spdlog::info("joined {} as {} (epoch {}, {} of {} leases kept)", config_.server, config_.id,
               response.epoch(), adopted.size(), request.holding_size());
  wake_.notify_all();
  return true;
}

void WorkerImpl::AcquireLoop() {
  if (!JoinIfNeeded(0)) return;
  v1::AcquireRequest request;
  request.set_session_id(session_);
  request.set_want(1);
  uint64_t number = 0;
  while (held_.WaitForRoom(kAhead)) {
    request.set_request(++number);
    Time sent;
    v1::AcquireResponse response;
    const Sent answer = Ask(
        Rpc::kAcquire,
        [&] {
          request.set_wait_ms(
              static_cast<uint32_t>(std::min<int64_t>(kLongestWait.count(), term_ms_ / 3)));
          sent = steady_clock::now();
          return leases_->Acquire(request);
        },
        &response);
    if (answer == Sent::kStopped) return;
    if (response.grant_size() > 0) {
      held_.Add(response, sent);
      // The lease counts from when the call was sent, which may be a while ago.
      const std::lock_guard lock(mutex_);
      renew_now_ = steady_clock::now() - sent > milliseconds(renew_ms_);
      guard_now_ = true;
      wake_.notify_all();
    }
    if (response.drain()) {
      draining_ = true;
      while (!held_.empty() && Pause(milliseconds(renew_ms_))) {
      }
      if (!stopping()) {
        spdlog::info("drained: the coordinator gives this worker nothing more");
        End({});
      }
      return;
    }
  }
}

void WorkerImpl::RenderLoop() {
  while (const std::shared_ptr<Lease> lease = held_.Next()) {
    const v1::Unit& unit = lease->grant.unit(0);
    UnitRenderer& renderer = lease->grant.alone() && child_ != nullptr ? *child_ : *renderer_;
    const UnitOrder order{unit.scene_digest(), unit.frame(), unit.frame_key()};
    Backoff backoff(kFirstPause, kLongestPause, std::hash<std::string>{}(session_));
    Result<RenderedUnit> rendered = renderer.Render(order, lease->progress, lease->cancel);
    // That the coordinator is away for a moment is not the frame's failure.
    while (!rendered.ok() && rendered.error().code == ErrorCode::kUnavailable && !lease->cancel) {
      if (!Pause(backoff.Next())) break;
      rendered = renderer.Render(order, lease->progress, lease->cancel);
    }
    if (lease->cancel) {
      spdlog::info("frame {} was given up: its lease is lost", unit.frame());
      held_.Remove(lease);
      continue;
    }
    if (rendered.ok()) {
      spdlog::info("frame {} rendered in {} ms", unit.frame(), rendered->render_ms);
    } else {
      spdlog::warn("frame {}: {}", unit.frame(), rendered.error().ToString());
    }
    held_.MarkMade(lease);
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return stopping() || made_.size() < kMaxMade; });
    if (stopping()) return;
    made_.push_back({lease, std::move(rendered)});
    lock.unlock();
    wake_.notify_all();
  }
}

void WorkerImpl::DeliverLoop() {
  while (true) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return stopping() || !made_.empty(); });
    if (stopping()) return;
    const Made made = std::move(made_.front());
    made_.pop_front();
    lock.unlock();
    wake_.notify_all();
    Deliver(made);
    held_.Remove(made.lease);
  }
}

void WorkerImpl::Deliver(const Made& made) {
  const v1::Grant& grant = made.lease->grant;
  if (made.unit.ok()) {
    // The store may have lost what was put: then it is put again.
    for (int round = 0; round < 3; ++round) {
      if (DeliverPicture(*made.lease, *made.unit)) return;
    }
    return;
  }
  const Error& error = made.unit.error();
  v1::FailRequest request;
  request.set_session_id(session_);
  *request.mutable_attempt() = grant.attempt();
  request.set_error(error.ToString().substr(0, kMaxErrorBytes));
  // A child that dies with nothing beside it: it is the frame, not the worker (F5).
  request.set_final(grant.alone() && error.code == ErrorCode::kInternal);
  v1::FailResponse response;
  Ask(
      Rpc::kFail, [&] { return leases_->Fail(request); }, &response);
}

// False: put it again.
bool WorkerImpl::DeliverPicture(const Lease& lease, const RenderedUnit& unit) {
  struct Nothing {
  } nothing;
  const Sent put = Ask(
      Rpc::kPut,
      [&] {
        return Reply<Nothing>{blobs_->Put(unit.blob_digest, unit.picture,
                                          const_cast<std::atomic<uint64_t>*>(&lease.progress)),
                              {}};
      },
      &nothing);
  if (put != Sent::kAnswered) return true;
  v1::CompleteRequest request;
  request.set_session_id(session_);
  *request.mutable_attempt() = lease.grant.attempt();
  v1::UnitResult& result = *request.add_result();
  *result.mutable_unit() = lease.grant.unit(0);
  result.set_pixel_digest(unit.pixel_digest);
  result.set_blob_digest(unit.blob_digest);
  result.set_triangles(unit.triangles);
  result.set_render_ms(unit.render_ms);
  v1::CompleteResponse response;
  const Sent completed = Ask(
      Rpc::kComplete, [&] { return leases_->Complete(request); }, &response);
  if (completed != Sent::kAnswered || response.outcome_size() == 0) return true;
  if (response.outcome(0) == v1::CompleteResponse::CONFLICT) {
    spdlog::error("frame {}: another worker made a different picture", lease.grant.unit(0).frame());
  }
  return response.outcome(0) != v1::CompleteResponse::MISSING_BLOB;
}

void WorkerImpl::RenewLoop() {
  while (!stopping()) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, milliseconds(renew_ms_), [this] { return stopping() || renew_now_; });
    renew_now_ = false;
    lock.unlock();
    if (!stopping() && joins_ > 0) RenewOnce();
  }
}

// Once, whatever comes of it: the next renewal is due anyway.
void WorkerImpl::RenewOnce() {
  v1::RenewRequest request;
  request.set_session_id(session_);
  for (const std::shared_ptr<Lease>& lease : held_.All()) {
    v1::RenewRequest::Progress& entry = *request.add_progress();
    *entry.mutable_attempt() = lease->grant.attempt();
    entry.set_count(lease->progress.load(std::memory_order_relaxed));
  }
  const uint64_t joins = joins_;
  const Time sent = steady_clock::now();
  const Reply<v1::RenewResponse> reply = leases_->Renew(request);
  const Act act = ActOn(Rpc::kRenew, reply.status.error_code());
  if (act == Act::kJoinAgain) {
    JoinIfNeeded(joins);
  } else if (act == Act::kStop) {
    End(MakeError(ErrorCode::kUnavailable,
                  "the coordinator at " + config_.server +
                      " refuses this worker: " + reply.status.error_message()));
  }
  if (act != Act::kDone) return;
  for (const v1::RenewResponse::Verdict& verdict : reply.value.verdict()) {
    if (verdict.go_on()) {
      held_.Extend(verdict.attempt(), sent, milliseconds(verdict.term_ms()));
    } else {
      held_.Lose(verdict.attempt());
    }
  }
}

void WorkerImpl::GuardLoop() {
  while (!stopping()) {
    const std::optional<Time> next = held_.CancelOverdue(steady_clock::now());
    std::unique_lock lock(mutex_);
    const auto awake = [this] { return stopping() || guard_now_; };
    if (next) {
      wake_.wait_until(lock, *next, awake);
    } else {
      wake_.wait(lock, awake);
    }
    guard_now_ = false;
  }
}

}  // namespace

std::unique_ptr<Worker> Worker::Start(WorkerConfig config) {
  return std::make_unique<WorkerImpl>(std::move(config));
}

}  // namespace fjord::worker
