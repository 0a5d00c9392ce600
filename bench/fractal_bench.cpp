// Speed of the fractal methods alone: nanoseconds per midpoint and per leaf in the streaming form,
// of every method of the registry with its defaults; of surface also by SIMD level, shape and patch
// size, and of the welded form. CPU time of one thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "engine/base/check.h"
#include "engine/base/fpenv.h"
#include "engine/base/simd.h"
#include "engine/formats/shape_file.h"
#include "engine/fractal/midpoint_knobs.h"
#include "engine/fractal/registry.h"
#include "engine/fractal/surface.h"
#include "engine/geometry/triangulate.h"

namespace fjord {
namespace {

class CountSink final : public StreamSink {
 public:
  bool Wants(const Vec3&, const Vec3&, const Vec3&, const StreamReach&) override { return true; }
  void Take(const StreamBatch& batch) override {
    benchmark::DoNotOptimize(batch.vertices.data());
    benchmark::DoNotOptimize(batch.triangles.data());
  }
};

CoarseShape Quad() {
  CoarseShape shape;
  shape.now = shape.rest = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  shape.triangles = {{0, 1, 2}, {0, 2, 3}};
  return shape;
}

CoarseShape TaiwanRelief() {
  std::ifstream file(std::string(FJORD_SOURCE_DIR) + "/examples/data/taiwan_relief.std");
  std::string word;
  while (file >> word && word != "data") {
  }
  size_t points = 0, faces = 0;
  file >> points >> faces;
  Mesh mesh;
  mesh.points.resize(points);
  for (Vec3& p : mesh.points) file >> p.x >> p.y >> p.z;
  for (size_t f = 0; f < faces; ++f) {
    size_t size = 0;
    file >> size;
    std::vector<uint32_t> corners(size);
    for (uint32_t& corner : corners) {
      file >> corner;
      --corner;
    }
    mesh.AddFace(corners);
  }
  FJORD_CHECK(file && points > 0, points);
  CoarseShape shape;
  shape.now = shape.rest = mesh.points;
  shape.triangles = Triangulate(mesh);
  return shape;
}

CoarseShape Ring() {
  CoarseShape shape;
  shape.curve = shape.closed = true;
  shape.now = shape.rest = {{1, 0, 0}, {.5, .8, 0}, {-.5, .9, 0}, {-1, 0, 0}, {0, -1, 0}};
  return shape;
}

struct Case {
  std::string name;
  CoarseShape shape;
  MethodSettings settings;
};

std::vector<Case> SurfaceCases() {
  FractalSettings settings;
  settings.increments = Increments::kEven;
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const CoarseShape& shape,
                       const FractalSettings& chosen) {
    const FractalSettings all = ResolveSettings(*FindFractalMethod("surface"), chosen);
    cases.push_back({name, shape, {all, all}});
  };
  settings.fineness.epsilon = .006;
  add("quad", Quad(), settings);
  settings.fineness.epsilon = .0066;
  const CoarseShape taiwan = TaiwanRelief();
  add("taiwan", taiwan, settings);
  FractalSettings one = settings;
  one.fineness = {0, 1, 2000, .01, Vec3(0, -6, 4), 0};
  add("taiwan_pixels", taiwan, one);
  one = settings;
  one.coast = true;
  add("taiwan_coast", taiwan, one);
  one = settings;
  one.variant = Variant::kPerturbed;
  add("taiwan_perturbed", taiwan, one);
  one = settings;
  one.increments = Increments::kMidpoint;
  add("taiwan_midpoint", taiwan, one);
  return cases;
}

// Every method as its table has it.
std::vector<Case> MethodCases() {
  std::vector<Case> cases;
  for (const MethodInfo& method : FractalMethods()) {
    const bool line = method.takes == Takes::kCurve;
    Case one{std::string(method.name), line ? Ring() : Quad(), {}};
    if (method.takes == Takes::kFaces) {
      one.shape.triangles.clear();
      one.shape.face_size = {4};
      one.shape.face_vertex = {0, 1, 2, 3};
    }
    one.settings.method = method.name;
    one.settings.own = method.knobs.defaults();
    one.settings.fineness.epsilon = line ? 1e-5 : .006;
    cases.push_back(std::move(one));
  }
  return cases;
}

std::unique_ptr<PreparedFractal> PrepareCase(const Case& one) {
  auto prepared = PrepareMethod(one.shape, one.settings);
  FJORD_CHECK(prepared.ok(), prepared.error().message);
  return std::move(*prepared);
}

void Report(benchmark::State& state, double midpoints, double leaves) {
  const auto flags = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["s_per_midpoint"] = benchmark::Counter(midpoints, flags);
  state.counters["s_per_leaf"] = benchmark::Counter(leaves, flags);
  state.counters["leaves"] = leaves;
}

void Stream(benchmark::State& state, const Case& one, const std::string& level, size_t patch) {
  FJORD_CHECK(SetSimdLevel(level), level);
  const auto prepared = PrepareCase(one);
  CountSink sink;
  StreamStats all;
  for (auto _ : state) {
    all = {};
    for (size_t root = 0; root < prepared->RootCount(); ++root) {
      const StreamStats stats = prepared->Stream(root, sink, patch);
      all.midpoints += stats.midpoints;
      all.triangles += stats.triangles;
    }
  }
  Report(state, static_cast<double>(all.midpoints), static_cast<double>(all.triangles));
  FJORD_CHECK(SetSimdLevel("best"));
}

// The welded shape, and as a binary PLY file in memory.
void Weld(benchmark::State& state, const Case& one, bool write) {
  const auto prepared = PrepareCase(one);
  size_t points = 0, leaves = 0;
  for (auto _ : state) {
    auto welded = prepared->Weld({.details = !write});
    FJORD_CHECK(welded.ok());
    points = welded->mesh.points.size();
    leaves = welded->mesh.FaceCount();
    if (!write) continue;
    ShapeFile shape;
    shape.mesh = std::move(welded->mesh);
    benchmark::DoNotOptimize(WriteShape(shape, ShapeFormat::kPly, {}));
  }
  Report(state, static_cast<double>(points), static_cast<double>(leaves));
}

void AddStream(const Case& one, const std::string& kind, const std::string& level, size_t patch) {
  const auto least = [](const std::vector<double>& v) {
    return *std::min_element(v.begin(), v.end());
  };
  benchmark::RegisterBenchmark(
      (kind + "/" + one.name + "/" + level + "/" + std::to_string(patch)).c_str(),
      [&one, level, patch](benchmark::State& state) { Stream(state, one, level, patch); })
      ->Unit(benchmark::kMillisecond)
      ->ComputeStatistics("min", least);
}

void Register() {
  static const std::vector<Case> kSurface = SurfaceCases();
  static const std::vector<Case> kMethods = MethodCases();
  const std::string best = SimdLevels().back();
  for (const Case& one : kMethods) AddStream(one, "method", best, 2048);
  for (const Case& one : kSurface) {
    for (const std::string& level : SimdLevels()) AddStream(one, "stream", level, 2048);
    for (const size_t patch : {256, 512, 1024, 4096}) AddStream(one, "stream", best, patch);
    for (const bool write : {false, true}) {
      benchmark::RegisterBenchmark(
          ((write ? "weld_ply/" : "weld/") + one.name).c_str(),
          [&one, write](benchmark::State& state) { Weld(state, one, write); })
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace
}  // namespace fjord

int main(int argc, char** argv) {
  fjord::SetFloatEnvironment();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  fjord::Register();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
