// What a picture costs: nanoseconds a micro-triangle, all in (made, drawn, shaded, quantised), and
// the frames of the demo with their PNG. One thread unless said; times are CPU time.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>

#include "engine/animation/inbetween.h"
#include "engine/base/fpenv.h"
#include "engine/base/simd.h"
#include "engine/render/frame_renderer.h"
#include "engine/scene/load.h"

namespace fjord {
namespace {

constexpr char kDemo[] = FJORD_SOURCE_DIR "/examples/taiwan-rising.scene";

// The lists that the frames name.
AssetSet& Assets() {
  static AssetSet assets;
  return assets;
}

v1::FrameScene Frame(const std::string& path, uint32_t number, const std::vector<Setting>& sets) {
  LoadResult loaded = LoadSceneFile(path, sets);
  FJORD_CHECK(loaded.ok(), loaded.errors.front().ToString());
  const auto animation = Animation::Make(std::move(loaded.loaded));
  FJORD_CHECK(animation.ok(), animation.error().ToString());
  Result<v1::FrameScene> frame = (*animation)->Inbetween(number, &Assets());
  FJORD_CHECK(frame.ok(), frame.error().ToString());
  return std::move(*frame);
}

v1::FrameScene DemoFrame(int samples) {
  return Frame(kDemo, 96,
               {{"output.width", "1920"},
                {"output.height", "1080"},
                {"output.samples", std::to_string(samples)}});
}

// Arguments: samples a pixel, SIMD level (index into SimdLevels()).
void MicroTriangles(benchmark::State& state) {
  const std::vector<std::string> levels = SimdLevels();
  const size_t level = std::min<size_t>(static_cast<size_t>(state.range(1)), levels.size() - 1);
  FJORD_CHECK(SetSimdLevel(levels[level]), levels[level]);
  const v1::FrameScene frame = DemoFrame(static_cast<int>(state.range(0)));
  uint64_t triangles = 0;
  for (auto _ : state) {
    const Result<RenderedFrame> rendered = RenderFrame(frame, {.threads = 1, .assets = &Assets()});
    FJORD_CHECK(rendered.ok(), rendered.error().message);
    triangles = rendered->stats.triangles;
  }
  state.SetLabel(levels[level]);
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["triangles_per_s"] = benchmark::Counter(
      static_cast<double>(triangles), benchmark::Counter::kIsIterationInvariantRate);
  FJORD_CHECK(SetSimdLevel("best"), "best");
}

void Levels(benchmark::internal::Benchmark* b) {
  const int count = static_cast<int>(SimdLevels().size());
  for (int level = count - 1; level >= 0; --level) b->Args({4, level});
  b->Args({1, count - 1});
}
BENCHMARK(MicroTriangles)->Apply(Levels)->Unit(benchmark::kMillisecond);

void Encode(const Picture& picture, const PictureInfo& info) {
  const Result<std::string> bytes = EncodePicture(picture, info);
  FJORD_CHECK(bytes.ok(), bytes.error().ToString());
  benchmark::DoNotOptimize(bytes->data());
}

// Opens the module of picture files, which costs a process a quarter of a second once.
void OpenEncoder() {
  Picture dot;
  dot.width = dot.height = 1;
  dot.bytes.resize(3 * BytesPerSample(dot.format));
  Encode(dot, {});
}

// The 1080p frame of the demo at 1-pixel fineness, PNG included.
void DemoFrame1080(benchmark::State& state) {
  const v1::FrameScene frame = DemoFrame(4);
  OpenEncoder();
  for (auto _ : state) {
    const Result<RenderedFrame> rendered = RenderFrame(frame, {.threads = 1, .assets = &Assets()});
    FJORD_CHECK(rendered.ok(), rendered.error().message);
    const Result<PictureInfo> info = DescribeFrame(frame);
    FJORD_CHECK(info.ok(), info.error().ToString());
    Encode(rendered->picture, *info);
  }
}
BENCHMARK(DemoFrame1080)->Unit(benchmark::kMillisecond);

void EncodePng1080(benchmark::State& state) {
  const Result<RenderedFrame> rendered =
      RenderFrame(DemoFrame(4), {.threads = 1, .assets = &Assets()});
  FJORD_CHECK(rendered.ok(), rendered.error().message);
  OpenEncoder();
  for (auto _ : state) Encode(rendered->picture, {});
}
BENCHMARK(EncodePng1080)->Unit(benchmark::kMillisecond);

// Frames a second of the demo as the user runs it. Argument: threads.
void DemoFrames(benchmark::State& state) {
  const v1::FrameScene frame = Frame(kDemo, 72, {});
  OpenEncoder();
  for (auto _ : state) {
    const Result<RenderedFrame> rendered =
        RenderFrame(frame, {.threads = static_cast<int>(state.range(0)), .assets = &Assets()});
    FJORD_CHECK(rendered.ok(), rendered.error().message);
    Encode(rendered->picture, {});
  }
  state.counters["frames_per_s"] =
      benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(DemoFrames)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

// Every 64x64 tile of the frame alone: together they make `times_whole` as many micro-triangles as
// the frame at once, which is what a tile alone makes against its share.
void TilesAlone(benchmark::State& state) {
  const v1::FrameScene frame = DemoFrame(4);
  const Result<RenderedFrame> whole = RenderFrame(frame, {.threads = 1, .assets = &Assets()});
  FJORD_CHECK(whole.ok(), whole.error().message);
  constexpr uint32_t kWidth = 1920, kHeight = 1080, kTile = 64;
  uint64_t triangles = 0;
  for (auto _ : state) {
    triangles = 0;
    for (uint32_t y = 0; y < kHeight; y += kTile) {
      for (uint32_t x = 0; x < kWidth; x += kTile) {
        const Result<RenderedFrame> tile =
            RenderTile(frame, x, y, kTile, std::min(kTile, kHeight - y),
                       {.threads = 1, .patch_size = 256, .assets = &Assets()});
        FJORD_CHECK(tile.ok(), tile.error().message);
        triangles += tile->stats.triangles;
      }
    }
  }
  state.counters["times_whole"] =
      static_cast<double>(triangles) / static_cast<double>(whole->stats.triangles);
}
BENCHMARK(TilesAlone)->Unit(benchmark::kMillisecond)->Iterations(1);

// The dense tile in the middle.
void OneTileAlone(benchmark::State& state) {
  const v1::FrameScene frame = DemoFrame(4);
  const Result<RenderedFrame> whole = RenderFrame(frame, {.threads = 1, .assets = &Assets()});
  FJORD_CHECK(whole.ok(), whole.error().message);
  uint64_t triangles = 0;
  for (auto _ : state) {
    const Result<RenderedFrame> tile =
        RenderTile(frame, 928, 508, 64, 64, {.threads = 1, .patch_size = 256, .assets = &Assets()});
    FJORD_CHECK(tile.ok(), tile.error().message);
    triangles = tile->stats.triangles;
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["whole_triangles"] = static_cast<double>(whole->stats.triangles);
}
BENCHMARK(OneTileAlone)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fjord

int main(int argc, char** argv) {
  fjord::SetFloatEnvironment();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
