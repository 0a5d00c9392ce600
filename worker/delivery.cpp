#include "worker/delivery.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace fjord::worker {
namespace {

constexpr size_t kMaxMade = 2;  // pictures on their way
constexpr int kMaxPuts = 3;     // of one picture, where the store loses what was put
constexpr uint64_t kMaxErrorBytes = 2'000;

}  // namespace

Delivery::Delivery(Session& session, HeldLeases& held, Blobs& blobs)
    : session_(session), held_(held), blobs_(blobs), thread_([this] { Run(); }) {}

bool Delivery::Hand(Made made) {
  {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, session_.stop_token(), [this] { return made_.size() < kMaxMade; });
    if (session_.stopping()) return false;
    made_.push_back(std::move(made));
  }
  wake_.notify_all();
  return true;
}

void Delivery::Run() {
  while (true) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, session_.stop_token(), [this] { return !made_.empty(); });
    if (session_.stopping()) return;
    const Made made = std::move(made_.front());
    made_.pop_front();
    lock.unlock();
    wake_.notify_all();
    Deliver(made);
    held_.Remove(made.lease);
  }
}

void Delivery::Deliver(const Made& made) {
  if (!made.unit.ok()) {
    ReportFailure(*made.lease, made.unit.error());
    return;
  }
  for (int puts = 0; puts < kMaxPuts; ++puts) {
    if (DeliverPicture(*made.lease, *made.unit)) return;
  }
}

void Delivery::ReportFailure(const Lease& lease, const Error& error) {
  v1::FailRequest request;
  request.set_session_id(session_.name());
  *request.mutable_attempt() = lease.grant.attempt();
  request.set_error(error.ToString().substr(0, kMaxErrorBytes));
  // A child that dies with nothing beside it: it is the frame, not the worker (F5).
  request.set_final(lease.grant.alone() && error.code == ErrorCode::kInternal);
  v1::FailResponse response;
  session_.Ask(
      Rpc::kFail, [&] { return session_.client().Fail(request); }, &response);
}

// False: the picture is not in the store.
bool Delivery::Put(Lease& lease, const RenderedUnit& unit) {
  struct Nothing {
  } nothing;
  const auto put = [&] {
    return Reply<Nothing>{blobs_.Put(unit.blob_digest, unit.picture, &lease.progress), {}};
  };
  return session_.Ask(Rpc::kPut, put, &nothing) == Session::Sent::kAnswered;
}

// False: the store has lost the picture, which must be put again.
bool Delivery::DeliverPicture(Lease& lease, const RenderedUnit& unit) {
  if (!Put(lease, unit)) return true;
  v1::CompleteRequest request;
  request.set_session_id(session_.name());
  *request.mutable_attempt() = lease.grant.attempt();
  v1::UnitResult& result = *request.add_result();
  *result.mutable_unit() = lease.grant.unit(0);
  result.set_pixel_digest(unit.pixel_digest);
  result.set_blob_digest(unit.blob_digest);
  result.set_triangles(unit.triangles);
  result.set_render_ms(unit.render_ms);
  v1::CompleteResponse response;
  const Session::Sent completed = session_.Ask(
      Rpc::kComplete, [&] { return session_.client().Complete(request); }, &response);
  if (completed != Session::Sent::kAnswered || response.outcome_size() == 0) return true;
  if (response.outcome(0) == v1::CompleteResponse::CONFLICT) {
    spdlog::error("frame {}: another worker made a different picture", lease.grant.unit(0).frame());
  }
  return response.outcome(0) != v1::CompleteResponse::MISSING_BLOB;
}

}  // namespace fjord::worker
