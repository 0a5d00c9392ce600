// Judging evidence, the order of frames, the lease table: each alone.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "server/state/judge.h"
#include "server/state/lease_table.h"
#include "server/state/order.h"

namespace fjord::server {
namespace {

// "A1 B1 A2": worker letter, picture digit.
std::vector<ResultRow> Evidence(const std::string& text) {
  std::vector<ResultRow> evidence;
  for (size_t i = 0; i + 1 < text.size(); i += 3) {
    ResultRow row;
    row.worker = text.substr(i, 1);
    row.pixel.bytes[0] = static_cast<uint8_t>(text[i + 1]);
    row.attempt = {1, i};
    evidence.push_back(row);
  }
  return evidence;
}

struct Case {
  const char* evidence;
  uint32_t required;
  Standing standing;
  uint32_t more;
  const char* liars;
};

TEST(JudgeTest, F3_JudgesByContentAlone) {
  const Case cases[] = {
      {"", 1, Standing::kOpen, 1, ""},
      {"", 2, Standing::kOpen, 2, ""},
      {"A1", 1, Standing::kDone, 0, ""},
      {"A1", 2, Standing::kOpen, 1, ""},
      {"A1 A1", 2, Standing::kDone, 0, ""},
      {"A1 B1", 2, Standing::kDone, 0, ""},
      {"A1 B2", 1, Standing::kDisputed, 1, ""},
      {"A1 B2 A1", 1, Standing::kDisputed, 1, ""},  // J1: one worker, one vote
      {"A1 B2 C1", 1, Standing::kDone, 0, "B"},
      {"A1 B2 C2", 1, Standing::kDone, 0, "A"},
      {"A1 B2 C3", 1, Standing::kNoMajority, 0, ""},
      {"A1 B1 C2 D2", 1, Standing::kNoMajority, 0, ""},
      {"A1 B1 C2 D1", 1, Standing::kDone, 0, "C"},
      {"A1 A2", 1, Standing::kOpen, 1, "A"},  // J5
      {"A1 A2 B1", 1, Standing::kDone, 0, "A"},
      {"A1 A2 B1 C2 D2", 1, Standing::kDone, 0, "AB"},
  };
  for (const Case& expected : cases) {
    SCOPED_TRACE(expected.evidence);
    const Verdict verdict = Judge(Evidence(expected.evidence), expected.required);
    EXPECT_EQ(verdict.standing, expected.standing);
    EXPECT_EQ(verdict.more, expected.more);
    std::string liars;
    for (const std::string& liar : verdict.liars) liars += liar;
    EXPECT_EQ(liars, expected.liars);
  }
}

RC_GTEST_PROP(JudgeTest, F3_OrderOfDeliveriesDoesNotMatter, ()) {
  const auto count = *rc::gen::inRange(0, 7);
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += static_cast<char>('A' + *rc::gen::inRange(0, 5));
    text += static_cast<char>('1' + *rc::gen::inRange(0, 3));
    text += ' ';
  }
  std::vector<ResultRow> evidence = Evidence(text);
  const Verdict before = Judge(evidence, 1);
  std::rotate(evidence.begin(), evidence.begin() + evidence.size() / 2, evidence.end());
  const Verdict after = Judge(evidence, 1);
  RC_ASSERT(before.standing == after.standing);
  RC_ASSERT(before.liars == after.liars);
}

TEST(OrderTest, F7_CoarseToFine) {
  EXPECT_EQ(CoarseToFine(1), (std::vector<uint32_t>{0}));
  EXPECT_EQ(CoarseToFine(2), (std::vector<uint32_t>{0, 1}));
  EXPECT_EQ(CoarseToFine(5), (std::vector<uint32_t>{0, 4, 2, 1, 3}));
  EXPECT_EQ(CoarseToFine(9), (std::vector<uint32_t>{0, 8, 4, 2, 6, 1, 3, 5, 7}));
}

TEST(OrderTest, F7_EveryPrefixIsSpreadOverTheTimeLine) {
  for (const uint32_t count : {1u, 2u, 3u, 7u, 96u, 1000u}) {
    const std::vector<uint32_t> order = CoarseToFine(count);
    std::vector<uint32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(sorted, all);
    for (size_t prefix = 3; prefix <= count; prefix *= 2) {
      std::vector<uint32_t> done(order.begin(), order.begin() + static_cast<long>(prefix));
      std::sort(done.begin(), done.end());
      uint32_t widest = 0;
      for (size_t i = 1; i < done.size(); ++i) widest = std::max(widest, done[i] - done[i - 1]);
      EXPECT_LE(widest, 4 * count / prefix + 2) << count << " frames, first " << prefix;
    }
  }
}

class LeaseTableTest : public testing::Test {
 protected:
  static Attempt Unit(uint8_t n) {
    Attempt unit;
    unit.key.bytes[0] = n;
    unit.frame = n;
    return unit;
  }
  void TearDown() override { EXPECT_EQ(table_.Audit(), std::vector<std::string>{}); }

  LeaseTable table_{7, 1000, 5000};
};

TEST_F(LeaseTableTest, F3_L1_AttemptIdsAreNeverReused) {
  const AttemptId first = table_.Grant("s", Unit(1), 0).id;
  table_.End(first);
  const AttemptId second = table_.Grant("s", Unit(1), 0).id;
  EXPECT_NE(first, second);
  EXPECT_EQ(second.epoch, 7u);
}

TEST_F(LeaseTableTest, F5_L3_RunsOutOneTermAfterTheLastRenewal) {
  const AttemptId id = table_.Grant("s", Unit(1), 0).id;
  EXPECT_EQ(table_.NextDue(), 1000);
  EXPECT_TRUE(table_.Renew(id, "s", 0, 600));
  EXPECT_TRUE(table_.DueBy(1599).empty());
  ASSERT_EQ(table_.DueBy(1600).size(), 1u);
  EXPECT_FALSE(table_.DueBy(1600)[0].stalled);
}

TEST_F(LeaseTableTest, F5_L3_StandingStillEndsAnAttemptThatHasBegun) {
  const AttemptId waiting = table_.Grant("s", Unit(1), 0).id;
  const AttemptId working = table_.Grant("s", Unit(2), 0).id;
  for (int64_t now = 0; now < 5000; now += 500) {
    ASSERT_TRUE(table_.Renew(waiting, "s", 0, now));
    ASSERT_TRUE(table_.Renew(working, "s", 3, now));
  }
  const auto due = table_.DueBy(5000);
  ASSERT_EQ(due.size(), 1u);
  EXPECT_EQ(due[0].id, working);
  EXPECT_TRUE(due[0].stalled);
}

TEST_F(LeaseTableTest, F3_L4_OnlyItsSessionRenewsAndEndedIsEnded) {
  const AttemptId id = table_.Grant("s", Unit(1), 0).id;
  EXPECT_FALSE(table_.Renew(id, "other", 1, 10));
  table_.End(id);
  EXPECT_FALSE(table_.Renew(id, "s", 1, 20));
}

TEST_F(LeaseTableTest, F4_L2_AdoptKeepsTheOldIdAndMovesBetweenSessions) {
  Attempt old = Unit(3);
  old.id = {5, 99};
  table_.Adopt("s", old, 0);
  EXPECT_TRUE(table_.Renew({5, 99}, "s", 1, 10));
  table_.Adopt("t", *table_.Find({5, 99}), 20);
  EXPECT_FALSE(table_.Renew({5, 99}, "s", 1, 30));
  EXPECT_EQ(table_.HeldBy("t"), (std::vector<AttemptId>{{5, 99}}));
  EXPECT_EQ(table_.CountHeldBy("s"), 0u);
}

}  // namespace
}  // namespace fjord::server
