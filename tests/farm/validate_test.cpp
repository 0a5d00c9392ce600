// Every request message: the good pass, each field that is out of bounds is named; random bytes
// never more than objected to.
#include "server/validate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "engine/base/digest.h"
#include "proto/fjord/protocol.h"

namespace fjord::server {
namespace {

const std::string kDigest = Sha256Of("x").Hex();

std::string FieldOf(const Objection& objection) {
  return objection ? objection->message.substr(0, objection->message.find(':')) : "";
}

v1::SubmitRequest GoodSubmit() {
  v1::SubmitRequest request;
  request.set_protocol(kProtocol);
  request.set_request_id("r");
  request.set_scene_digest(kDigest);
  return request;
}

TEST(ValidateTest, F8_Submit) {
  EXPECT_EQ(Validate(GoodSubmit()), std::nullopt);
  const auto field = [](auto change) {
    v1::SubmitRequest request = GoodSubmit();
    change(request);
    return FieldOf(Validate(request));
  };
  EXPECT_EQ(field([](auto& r) { r.set_protocol(""); }), "protocol");
  EXPECT_EQ(field([](auto& r) { r.set_request_id(""); }), "request_id");
  EXPECT_EQ(field([](auto& r) { r.set_request_id(std::string(101, 'x')); }), "request_id");
  EXPECT_EQ(field([](auto& r) { r.set_name("a\x01"); }), "name");
  EXPECT_EQ(field([](auto& r) { r.set_scene_digest("ABC"); }), "scene_digest");
  EXPECT_EQ(field([](auto& r) { r.set_scene_digest(std::string(64, 'A')); }), "scene_digest");
  EXPECT_EQ(field([](auto& r) { r.set_first_frame(1'000'001); }), "first_frame");
  EXPECT_EQ(field([](auto& r) { r.set_first_frame(5), r.set_last_frame(4); }), "last_frame");
  EXPECT_EQ(field([](auto& r) { r.set_first_frame(5), r.add_span(); }), "span");
  EXPECT_EQ(field([](auto& r) {
              for (int i = 0; i < 10'001; ++i) r.add_span();
            }),
            "span");
  EXPECT_EQ(field([](auto& r) { r.set_frame_limit_ms(604'800'001); }), "frame_limit_ms");
  EXPECT_EQ(field([](auto& r) { r.set_priority(1001); }), "priority");
  EXPECT_EQ(field([](auto& r) { r.set_verify_share(1.5); }), "verify_share");
  EXPECT_EQ(field([](auto& r) { r.set_verify_share(std::numeric_limits<double>::quiet_NaN()); }),
            "verify_share");
  EXPECT_EQ(field([](auto& r) { r.set_after_job("one"); }), "after_job");
}

TEST(ValidateTest, F8_Leases) {
  v1::CompleteRequest complete;
  complete.set_session_id("s");
  EXPECT_EQ(FieldOf(Validate(complete)), "attempt.epoch");
  complete.mutable_attempt()->set_epoch(1);
  complete.mutable_attempt()->set_sequence(1);
  EXPECT_EQ(FieldOf(Validate(complete)), "result");
  v1::UnitResult& result = *complete.add_result();
  EXPECT_EQ(FieldOf(Validate(complete)), "unit.scene_digest");
  result.mutable_unit()->set_scene_digest(kDigest);
  EXPECT_EQ(FieldOf(Validate(complete)), "unit.frame");
  result.mutable_unit()->set_frame(1);
  result.mutable_unit()->set_frame_key(kDigest);
  result.set_pixel_digest(kDigest);
  EXPECT_EQ(FieldOf(Validate(complete)), "result.blob_digest");
  result.set_blob_digest(kDigest);
  EXPECT_EQ(Validate(complete), std::nullopt);
  result.mutable_unit()->mutable_tile();
  EXPECT_EQ(FieldOf(Validate(complete)), "unit.tile");
  v1::AcquireRequest acquire;
  acquire.set_session_id("s");
  EXPECT_EQ(FieldOf(Validate(acquire)), "request");
  acquire.set_request(1);
  EXPECT_EQ(FieldOf(Validate(acquire)), "want");
  acquire.set_want(17);
  EXPECT_EQ(FieldOf(Validate(acquire)), "want");
  acquire.set_want(16);
  acquire.set_wait_ms(60'001);
  EXPECT_EQ(FieldOf(Validate(acquire)), "wait_ms");
  v1::JoinRequest join;
  join.set_protocol(kProtocol);
  join.set_worker_id("w");
  join.set_session_id("s");
  EXPECT_EQ(Validate(join), std::nullopt);
  for (int i = 0; i < 65; ++i) join.add_holding();
  EXPECT_EQ(FieldOf(Validate(join)), "holding");
  v1::FailRequest fail;
  fail.set_session_id("s");
  fail.mutable_attempt()->set_epoch(1);
  fail.mutable_attempt()->set_sequence(1);
  fail.set_error(std::string(10'001, 'e'));
  EXPECT_EQ(FieldOf(Validate(fail)), "error");
}

TEST(ValidateTest, F8_Blobs) {
  v1::PutBlobRequest put;
  EXPECT_EQ(FieldOf(Validate(put, true)), "digest");
  put.set_digest(kDigest);
  put.set_size(kMaxBlob);
  EXPECT_EQ(Validate(put, true), std::nullopt);
  EXPECT_EQ(FieldOf(Validate(put, false)), "digest");
  put.set_size(kMaxBlob + 1);
  EXPECT_EQ(FieldOf(Validate(put, true)), "size");
  v1::MissingRequest missing;
  for (int i = 0; i <= kMaxMissing; ++i) missing.add_digest(kDigest);
  EXPECT_EQ(FieldOf(Validate(missing)), "digest");
}

TEST(ValidateTest, F8_JobIds) {
  EXPECT_EQ(ParseJobId("7"), 7u);
  EXPECT_EQ(ParseJobId("123456789012345678"), 123456789012345678u);
  for (const char* text : {"", "0", "07", "-1", "1 ", "x", "1234567890123456789"}) {
    EXPECT_EQ(ParseJobId(text), std::nullopt) << text;
  }
}

template <typename Request>
void ParseAndValidate(const std::string& bytes) {
  Request request;
  if (request.ParseFromString(bytes)) (void)Validate(request);
}

RC_GTEST_PROP(ValidateTest, F8_RandomBytesNeverHarm, (const std::string& bytes)) {
  ParseAndValidate<v1::SubmitRequest>(bytes);
  ParseAndValidate<v1::JoinRequest>(bytes);
  ParseAndValidate<v1::CompleteRequest>(bytes);
  ParseAndValidate<v1::RenewRequest>(bytes);
  ParseAndValidate<v1::FailRequest>(bytes);
  ParseAndValidate<v1::CommandRequest>(bytes);
  (void)ParseJobId(bytes);
}

}  // namespace
}  // namespace fjord::server
