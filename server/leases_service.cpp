#include "server/leases_service.h"

#include "server/unary.h"

namespace fjord::server {
namespace {

AttemptId FromMessage(const v1::Attempt& attempt) { return {attempt.epoch(), attempt.sequence()}; }

void ToMessage(AttemptId id, v1::Attempt* attempt) {
  attempt->set_epoch(id.epoch);
  attempt->set_sequence(id.sequence);
}

// A call that waits for work. Answered once, by the actor.
class AcquireCall : public grpc::ServerUnaryReactor {
 public:
  AcquireCall(Coordinator& coordinator, const v1::AcquireRequest& request,
              v1::AcquireResponse* response)
      : coordinator_(coordinator),
        session_(request.session_id()),
        request_(request.request()),
        response_(response) {
    const bool taken = coordinator_.Post(
        [this, want = request.want(), wait = request.wait_ms()](Machine& machine, Now now) {
          const int64_t term = machine.config().term_ms;
          coordinator_.Park(session_, request_, this,
                            [this, term](const AcquireAnswer& answer) { Reply(answer, term); });
          machine.Acquire(session_, request_, want, wait, now);
        });
    if (!taken) Finish(BusyStatus());
  }
  // The caller is gone: whoever dies while it waits is given nothing. A cancel that comes with an
  // answer finds nobody waiting.
  void OnCancel() override {
    // `caller` is only compared: the call itself may be over by then.
    coordinator_.PostInner(
        [&coordinator = coordinator_, session = session_, caller = static_cast<const void*>(this)](
            Machine&, Now) { coordinator.Abandon(session, caller); });
  }
  void OnDone() override { delete this; }

 private:
  void Reply(const AcquireAnswer& answer, int64_t term_ms) {
    if (answer.refusal) return Finish(ToStatus(*answer.refusal));
    for (const Grant& grant : answer.grants) {
      v1::Grant& out = *response_->add_grant();
      ToMessage(grant.attempt, out.mutable_attempt());
      v1::Unit& unit = *out.add_unit();
      unit.set_scene_digest(grant.scene.Hex());
      unit.set_frame(grant.frame);
      unit.set_frame_key(grant.key.Hex());
      out.set_term_ms(static_cast<uint32_t>(term_ms));
      out.set_alone(grant.alone);
      out.set_limit_ms(grant.limit_ms);
      out.set_job_id(std::to_string(grant.job));
      out.set_job_name(grant.job_name);
    }
    response_->set_drain(answer.drain);
    Finish(grpc::Status::OK);
  }

  Coordinator& coordinator_;
  const std::string session_;
  const uint64_t request_;
  v1::AcquireResponse* const response_;
};

// True: refused and finished.
template <typename Request>
bool Refused(const Request& request, grpc::ServerUnaryReactor* reactor) {
  const Objection objection = Validate(request);
  if (objection) reactor->Finish(ToStatus(*objection));
  return objection.has_value();
}

}  // namespace

grpc::ServerUnaryReactor* LeasesService::Join(grpc::CallbackServerContext* context,
                                              const v1::JoinRequest* request,
                                              v1::JoinResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (Refused(*request, reactor)) return reactor;
  JoinCall call{request->worker_id(),
                request->session_id(),
                request->host(),
                request->version(),
                request->threads(),
                {request->tag().begin(), request->tag().end()},
                {},
                {request->ended().begin(), request->ended().end()},
                request->waited_ms()};
  for (const v1::JoinRequest::Holding& holding : request->holding()) {
    const v1::Unit& unit = holding.unit(0);
    call.holdings.push_back({FromMessage(holding.attempt()), *ParseDigest(unit.scene_digest()),
                             unit.frame(), *ParseDigest(unit.frame_key())});
  }
  AnswerAfterCommit(
      coordinator_, reactor, [call = std::move(call), response](Machine& machine, Now now) {
        Objection refusal;
        const auto answer = machine.Join(call, now);
        if (const auto* adopted = ValueOf(answer, refusal)) {
          response->set_epoch(machine.epoch());
          response->set_term_ms(static_cast<uint32_t>(machine.config().term_ms));
          response->set_renew_every_ms(static_cast<uint32_t>(machine.config().renew_ms));
          for (const AttemptId id : *adopted) ToMessage(id, response->add_adopted());
        }
        return refusal;
      });
  return reactor;
}

grpc::ServerUnaryReactor* LeasesService::Acquire(grpc::CallbackServerContext* context,
                                                 const v1::AcquireRequest* request,
                                                 v1::AcquireResponse* response) {
  if (const Objection objection = Validate(*request)) {
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    reactor->Finish(ToStatus(*objection));
    return reactor;
  }
  return new AcquireCall(coordinator_, *request, response);
}

grpc::ServerUnaryReactor* LeasesService::Renew(grpc::CallbackServerContext* context,
                                               const v1::RenewRequest* request,
                                               v1::RenewResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (Refused(*request, reactor)) return reactor;
  std::vector<Machine::Progress> progress;
  for (const auto& entry : request->progress()) {
    progress.push_back({FromMessage(entry.attempt()), entry.count()});
  }
  // Rests on nothing that is journalled: answered at once.
  const bool taken =
      coordinator_.Post([reactor, session = request->session_id(), progress = std::move(progress),
                         response](Machine& machine, Now now) {
        Objection refusal;
        const auto answer = machine.Renew(session, progress, now);
        if (const auto* renewed = ValueOf(answer, refusal)) {
          for (size_t i = 0; i < progress.size(); ++i) {
            v1::RenewResponse::Verdict& verdict = *response->add_verdict();
            ToMessage(progress[i].attempt, verdict.mutable_attempt());
            verdict.set_go_on(renewed->go_on[i]);
            verdict.set_term_ms(static_cast<uint32_t>(machine.config().term_ms));
          }
          response->set_drain(renewed->drain);
        }
        reactor->Finish(refusal ? ToStatus(*refusal) : grpc::Status::OK);
      });
  if (!taken) reactor->Finish(BusyStatus());
  return reactor;
}

grpc::ServerUnaryReactor* LeasesService::Complete(grpc::CallbackServerContext* context,
                                                  const v1::CompleteRequest* request,
                                                  v1::CompleteResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (Refused(*request, reactor)) return reactor;
  std::vector<Delivery> deliveries;
  for (const v1::UnitResult& result : request->result()) {
    Delivery delivery{FromMessage(request->attempt()),
                      *ParseDigest(result.unit().scene_digest()),
                      result.unit().frame(),
                      *ParseDigest(result.unit().frame_key()),
                      *ParseDigest(result.pixel_digest()),
                      *ParseDigest(result.blob_digest()),
                      result.triangles(),
                      result.render_ms()};
    deliveries.push_back(delivery);
  }
  AnswerAfterCommit(
      coordinator_, reactor,
      [this, session = request->session_id(), deliveries = std::move(deliveries), response](
          Machine& machine, Now now) mutable {
        Objection refusal;
        for (Delivery& delivery : deliveries) {
          const std::optional<uint64_t> size = blobs_.SizeOf(delivery.blob);
          delivery.blob_present = size.has_value();
          delivery.blob_bytes = size.value_or(0);
          const auto answer = machine.Complete(session, delivery, now);
          if (const Outcome* outcome = ValueOf(answer, refusal)) {
            response->add_outcome(static_cast<v1::CompleteResponse::Outcome>(*outcome));
          }
        }
        return refusal;
      });
  return reactor;
}

grpc::ServerUnaryReactor* LeasesService::Fail(grpc::CallbackServerContext* context,
                                              const v1::FailRequest* request,
                                              v1::FailResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (Refused(*request, reactor)) return reactor;
  AnswerAfterCommit(
      coordinator_, reactor,
      [session = request->session_id(), attempt = FromMessage(request->attempt()),
       error = request->error(), final = request->final(), response](Machine& machine, Now now) {
        Objection refusal;
        const auto answer = machine.Fail(session, attempt, error, final, now);
        if (const bool* accepted = ValueOf(answer, refusal)) {
          response->set_accepted(*accepted);
        }
        return refusal;
      });
  return reactor;
}

grpc::ServerUnaryReactor* LeasesService::Leave(grpc::CallbackServerContext* context,
                                               const v1::LeaveRequest* request,
                                               v1::LeaveResponse*) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (Refused(*request, reactor)) return reactor;
  AnswerAfterCommit(coordinator_, reactor,
                    [session = request->session_id()](Machine& machine, Now now) {
                      Objection refusal;
                      const auto answer = machine.Leave(session, now);
                      ValueOf(answer, refusal);
                      return refusal;
                    });
  return reactor;
}

}  // namespace fjord::server
