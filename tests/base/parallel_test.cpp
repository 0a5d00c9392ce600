#include "engine/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#include "engine/base/fpenv.h"

#if defined(__x86_64__)
#include <pmmintrin.h>
#endif

namespace fjord {
namespace {

TEST(ParallelTest, EveryIndexOnceAtEveryThreadCount) {
  for (const int threads : {0, 1, 2, 7, 64}) {
    for (const size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<std::atomic<int>> calls(count);
      ParallelFor(count, threads, [&](size_t i) { calls[i].fetch_add(1); });
      for (const auto& n : calls) EXPECT_EQ(n.load(), 1) << threads << ' ' << count;
    }
  }
}

TEST(ParallelTest, OneThreadIsTheCallers) {
  const auto caller = std::this_thread::get_id();
  std::vector<size_t> order;
  ParallelFor(5, 1, [&](size_t i) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(i);
  });
  EXPECT_EQ(order, (std::vector<size_t>{0, 1, 2, 3, 4}));
}

TEST(ParallelTest, Nests) {
  std::atomic<int> calls{0};
  ParallelFor(4, 2, [&](size_t) { ParallelFor(8, 3, [&](size_t) { calls.fetch_add(1); }); });
  EXPECT_EQ(calls.load(), 32);
}

// Seven threads are seven, however few cores there are: each waits until all have come.
TEST(ParallelTest, MoreThreadsThanCoresAreReal) {
  std::atomic<int> here{0};
  ParallelFor(7, 7, [&](size_t) {
    here.fetch_add(1);
    here.notify_all();
    for (int now = here.load(); now < 7; now = here.load()) here.wait(now);
  });
  EXPECT_EQ(here.load(), 7);
}

#if defined(__x86_64__)
TEST(ParallelTest, ThreadsKeepDenormalsWhateverTheCallerDid) {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  _MM_SET_ROUNDING_MODE(_MM_ROUND_UP);
  volatile double tiny = 0x1p-1074;
  volatile double third = 3;
  for (const int threads : {1, 3}) {
    std::vector<double> sums(16);
    std::vector<double> thirds(16);
    ParallelFor(16, threads, [&](size_t i) {
      sums[i] = tiny + tiny;
      thirds[i] = 1 / third;
    });
    for (const double sum : sums) EXPECT_EQ(sum, 0x1p-1073);
    for (const double x : thirds) EXPECT_EQ(x, 0x1.5555555555555p-2);
  }
  SetFloatEnvironment();
}
#endif

}  // namespace
}  // namespace fjord
