#include "worker/worker.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "engine/base/printable.h"
#include "worker/delivery.h"
#include "worker/held.h"
#include "worker/lease_loop.h"
#include "worker/renewal.h"
#include "worker/session.h"

namespace fjord::worker {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kMargin{50};  // stops this long before a deadline

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

// "frame 7 of job 3 (island)".
std::string NameOf(const v1::Grant& grant) {
  std::string name = "frame " + std::to_string(grant.unit(0).frame());
  if (!grant.job_id().empty()) name += " of job " + Printable(grant.job_id());
  if (!grant.job_name().empty()) name += " (" + Printable(grant.job_name()) + ")";
  return name;
}

Error OverLimit(uint32_t limit_ms) {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%g", limit_ms / 1000.);
  return MakeError(ErrorCode::kLimit, std::string("took longer than its ") + seconds +
                                          " s (--frame-limit); give it more time, or make less of "
                                          "it, as with a larger epsilon or pixels");
}

// Owns the connections, the renderers, the leases and the loops, and renders.
class WorkerImpl : public Worker {
 public:
  explicit WorkerImpl(WorkerConfig config);
  ~WorkerImpl() override { Stop(); }
  bool Stop() override;
  Result<> Wait() override { return session_.WaitForEnd(); }
  std::optional<Result<>> WaitFor(int length) override {
    return session_.WaitForEnd(milliseconds(length));
  }

 private:
  // What stops when the session ends, in the order in which it starts.
  struct Loops {
    explicit Loops(WorkerImpl& worker)
        : renewal(worker.session_, worker.held_),
          delivery(worker.session_, worker.held_, *worker.blobs_),
          leases(worker.session_, worker.held_, renewal, worker.config_.stay),
          rendering([this, &worker] { worker.RenderLoop(renewal, delivery); }) {}

    Renewal renewal;
    Delivery delivery;
    LeaseLoop leases;
    std::jthread rendering;
  };

  void RenderLoop(Renewal& renewal, Delivery& delivery);
  Result<RenderedUnit> Render(Lease& lease);

  const WorkerConfig config_;
  const std::unique_ptr<LeaseClient> leases_;
  const std::unique_ptr<Blobs> blobs_;
  const std::unique_ptr<UnitRenderer> renderer_;
  const std::unique_ptr<UnitRenderer> child_;  // null: none
  HeldLeases held_{kMargin};
  Session session_;
  // Whoever ends the session, nothing goes on waiting for leases, calls or bytes.
  const std::stop_callback<std::function<void()>> on_end_{session_.stop_token(), [this] {
                                                            held_.Stop();
                                                            leases_->Shutdown();
                                                            blobs_->Shutdown();
                                                          }};
  std::mutex stop_mutex_;
  // guarded by stop_mutex_
  std::optional<Loops> loops_;  // none: stopped
  bool left_ = false;
};

WorkerImpl::WorkerImpl(WorkerConfig config)
    : config_(Complete(std::move(config))),
      leases_(config_.make_leases()),
      blobs_(config_.make_blobs()),
      renderer_(config_.make_renderer(*blobs_)),
      child_(config_.program.empty()
                 ? nullptr
                 : MakeChildRenderer(config_.program, config_.server, config_.threads)),
      session_({config_.server, config_.id, config_.threads, config_.tags, config_.session,
                config_.ended},
               *leases_, held_) {
  loops_.emplace(*this);
}

bool WorkerImpl::Stop() {
  session_.End({});
  const std::lock_guard lock(stop_mutex_);
  if (!loops_) return left_;
  loops_.reset();
  if (!session_.has_joined()) return left_ = true;
  v1::LeaveRequest request;
  request.set_session_id(session_.name());
  return left_ = leases_->Leave(request).status.ok();
}

void WorkerImpl::RenderLoop(Renewal& renewal, Delivery& delivery) {
  while (const std::shared_ptr<Lease> lease = held_.Next()) {
    held_.Begin(lease, std::chrono::steady_clock::now());
    renewal.Look();
    Result<RenderedUnit> rendered = Render(*lease);
    const std::string frame = NameOf(lease->grant);
    if (lease->over && !rendered.ok()) rendered = OverLimit(lease->grant.limit_ms());
    if (lease->cancel && !lease->over) {
      spdlog::info("{} was given up: its lease is lost", frame);
      held_.Remove(lease);
      continue;
    }
    if (rendered.ok()) {
      spdlog::info("{} rendered in {} ms", frame, rendered->render_ms);
    } else {
      spdlog::warn("{}: {}", frame, Printable(rendered.error().ToString()));
    }
    held_.MarkMade(lease);
    if (!delivery.Hand({lease, std::move(rendered)})) return;
  }
}

Result<RenderedUnit> WorkerImpl::Render(Lease& lease) {
  const v1::Unit& unit = lease.grant.unit(0);
  UnitRenderer& renderer = lease.grant.alone() && child_ != nullptr ? *child_ : *renderer_;
  const UnitOrder order{unit.scene_digest(), unit.frame(), unit.frame_key()};
  Backoff backoff = session_.NewBackoff();
  Result<RenderedUnit> rendered = renderer.Render(order, lease.progress, lease.cancel);
  // That the coordinator is away for a moment is not the frame's failure.
  while (!rendered.ok() && rendered.error().code == ErrorCode::kUnavailable && !lease.cancel) {
    if (!session_.Pause(backoff.Next())) break;
    rendered = renderer.Render(order, lease.progress, lease.cancel);
  }
  return rendered;
}

}  // namespace

std::unique_ptr<Worker> Worker::Start(WorkerConfig config) {
  return std::make_unique<WorkerImpl>(std::move(config));
}

}  // namespace fjord::worker
