#include "engine/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "engine/base/fpenv.h"

namespace fjord {

int HardwareThreads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void ParallelFor(size_t count, int threads, const std::function<void(size_t)>& body) {
  SetFloatEnvironment();
  if (count == 0) return;
  const int cores = HardwareThreads();
  if (threads <= 0) threads = cores;
  if (threads == 1 || count == 1) {
    for (size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // oneTBB keeps no more workers than cores unless told: more are asked for in tests of D4.
  std::optional<tbb::global_control> more;
  if (threads > cores) {
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
  }
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, count, 1),
        [&](const tbb::blocked_range<size_t>& range) {
          SetFloatEnvironment();
          for (size_t i = range.begin(); i != range.end(); ++i) body(i);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace fjord
