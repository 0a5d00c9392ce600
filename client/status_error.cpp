// ErrorOfStatus of farm_client.h.
#include <grpcpp/grpcpp.h>

#include <string>

#include "client/farm_client.h"
#include "proto/fjord/protocol.h"

namespace fjord {
namespace {

Error OtherVersion(const std::string& server, const std::string& said) {
  return MakeError(ErrorCode::kUnavailable, server + " speaks another version than this fjord " +
                                                kVersion + " (protocol " + kProtocol +
                                                "): " + said + "; use programs of one version");
}

}  // namespace

Error ErrorOfStatus(const grpc::Status& status, const std::string& address) {
  const std::string& said = status.error_message();
  const std::string server = "the server at " + address;
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
      return MakeError(ErrorCode::kUnavailable,
                       "no Fjord server answers at " + address + " (" + said +
                           "); start one with `fjord farm`, or name another with --server or "
                           "$FJORD_SERVER");
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return MakeError(ErrorCode::kUnavailable,
                       server +
                           " did not answer in time; it may be overloaded or gone: try again, or "
                           "name another with --server");
    case grpc::StatusCode::UNIMPLEMENTED:
      return OtherVersion(server, said);
    case grpc::StatusCode::FAILED_PRECONDITION:
      if (said.find("protocol") != std::string::npos) return OtherVersion(server, said);
      return MakeError(ErrorCode::kInvalid, server + ": " + said);
    case grpc::StatusCode::NOT_FOUND:
      return MakeError(ErrorCode::kNotFound, server + ": " + said);
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::ALREADY_EXISTS:
    case grpc::StatusCode::OUT_OF_RANGE:
      return MakeError(ErrorCode::kInvalid, server + ": " + said);
    case grpc::StatusCode::DATA_LOSS:
      return MakeError(ErrorCode::kIo, server + ": " + said);
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return MakeError(ErrorCode::kLimit, server + ": " + said);
    case grpc::StatusCode::CANCELLED:
      return MakeError(ErrorCode::kCancelled, server + ": the call was ended: " + said);
    default:
      return MakeError(ErrorCode::kInternal, server + ": " + said + " (code " +
                                                 std::to_string(status.error_code()) + ")");
  }
}

}  // namespace fjord
