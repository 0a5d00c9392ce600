// Every fractal method of the registry, by law, direction, variant and split: the streamed leaves
// as a set, and the welded shape by identity.
#include <algorithm>
#include <numeric>

#include "engine/base/exact_math.h"
#include "engine/fractal/registry.h"
#include "engine/geometry/primitives.h"
#include "tests/fractal/choices.h"
#include "tests/gate/probe.h"

namespace fjord::gate {
namespace {

// Hashes of leaves are added, so their order does not matter.
class LeafSet : public StreamSink {
 public:
  bool Wants(const Vec3&, const Vec3&, const Vec3&, const StreamReach&) override { return true; }

  bool ReadsPlaces() const override { return true; }

  void Take(const StreamBatch& batch) override {
    hashes_.clear();
    for (size_t i = 0; i < batch.vertices.size(); ++i) {
      const StreamVertex& v = batch.vertices[i];
      uint64_t hash = Mix64(v.id);
      for (const double x : {v.position.x, v.position.y, v.position.z, v.direction.x, v.direction.y,
                             v.direction.z}) {
        hash = Mix64(hash + std::bit_cast<uint64_t>(x));
      }
      hash = Mix64(hash + std::bit_cast<uint32_t>(v.stretch));
      const Weights& place = batch.places[i];
      for (const double x : {place.x, place.y, place.z}) {
        hash = Mix64(hash + std::bit_cast<uint64_t>(x));
      }
      hashes_.push_back(hash);
    }
    for (const Triangle& t : batch.triangles) {
      // The same triangle, whichever vertex leads; its orientation counts.
      const uint64_t h[3] = {hashes_[t[0]], hashes_[t[1]], hashes_[t[2]]};
      const int lead = h[0] < h[1] ? (h[0] < h[2] ? 0 : 2) : (h[1] < h[2] ? 1 : 2);
      Leaf(Mix64(Mix64(h[lead] + 3) + h[(lead + 1) % 3]) + h[(lead + 2) % 3]);
    }
    for (const auto& s : batch.segments) {
      Leaf(Mix64(hashes_[s[0]] + 5) + hashes_[s[1]]);
    }
  }

  Digest Finish() {
    Canon canon;
    canon.Add(count_);
    canon.Add(sum_);
    canon.Add(squares_);
    return canon.Finish();
  }
  uint64_t count() const { return count_; }

 private:
  void Leaf(uint64_t hash) {
    hash = Mix64(hash);
    ++count_;
    sum_ += hash;
    squares_ += Mix64(hash ^ 0x5851f42d4c957f2du);
  }

  std::vector<uint64_t> hashes_;
  uint64_t count_ = 0;
  uint64_t sum_ = 0;
  uint64_t squares_ = 0;
};

// Points in order of identity and content (direction FACE makes several points of one identity),
// faces by the contents of their points.
Digest DigestOf(const WeldedShape& shape) {
  const size_t count = shape.mesh.points.size();
  std::vector<uint64_t> content(count);
  for (size_t v = 0; v < count; ++v) {
    const Vec3& p = shape.mesh.points[v];
    const Vec3& d = shape.direction[v];
    uint64_t hash = Mix64(shape.identity[v].lo) ^ shape.identity[v].hi;
    for (const double x : {p.x, p.y, p.z, d.x, d.y, d.z}) {
      hash = Mix64(hash + std::bit_cast<uint64_t>(x));
    }
    content[v] = Mix64(hash + shape.level[v] * 2u + shape.coast[v]);
  }
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return shape.identity[a] != shape.identity[b] ? shape.identity[a] < shape.identity[b]
                                                  : content[a] < content[b];
  });
  Canon canon;
  for (const size_t v : order) {
    canon.Add(shape.identity[v].lo);
    canon.Add(shape.identity[v].hi);
    const Vec3& p = shape.mesh.points[v];
    const Vec3& d = shape.direction[v];
    for (const double x : {p.x, p.y, p.z, d.x, d.y, d.z}) canon.Add(x);
    canon.Add(shape.level[v], 1);
    canon.Add(shape.coast[v], 1);
  }
  // A face is one hash, whichever point leads: libstdc++ 12 compares vectors of wide integers
  // wrongly on big-endian machines (memcmp of as many bytes as there are elements).
  std::vector<uint64_t> faces;
  size_t at = 0;
  for (const uint32_t size : shape.mesh.face_size) {
    const uint32_t* corner = &shape.mesh.face_vertex[at];
    uint32_t lead = 0;
    for (uint32_t i = 1; i < size; ++i) {
      if (content[corner[i]] < content[corner[lead]]) lead = i;
    }
    uint64_t hash = size;
    for (uint32_t i = 0; i < size; ++i) hash = Mix64(hash + content[corner[(lead + i) % size]]);
    faces.push_back(hash);
    at += size;
  }
  std::sort(faces.begin(), faces.end());
  for (const uint64_t face : faces) canon.Add(face);
  return canon.Finish();
}

void Shuffle(std::vector<Triangle>& triangles) {
  for (size_t i = triangles.size(); i > 1; --i) {
    std::swap(triangles[i - 1], triangles[Mix64(i) % i]);
  }
}

CoarseShape MakeTriangles(bool solid, bool shuffle) {
  const Mesh mesh = solid ? MakeEllipsoid(Vec3(1, .8, .6), 5, 4).value()
                          : MakeGrid(Vec3(2, 1.5, 0), 3, 2).value();
  CoarseShape shape;
  shape.rest = mesh.points;
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    // Now: smaller than at rest, bent, and nothing in a plane.
    const Vec3& p = mesh.points[i];
    const auto k = static_cast<double>(i);
    shape.now.emplace_back(.75 * p.x + .03 * p.y, .7 * p.y, .8 * p.z + .2 * p.x * p.y);
    shape.colors.emplace_back(static_cast<float>(k * .03), .5f, static_cast<float>(1 - k * .02));
  }
  for (size_t f = 0; f < mesh.FaceCount(); ++f) {
    Triangle t = {mesh.face_vertex[3 * f], mesh.face_vertex[3 * f + 1],
                  mesh.face_vertex[3 * f + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    shape.triangles.push_back(t);
  }
  if (shuffle) Shuffle(shape.triangles);
  return shape;
}

CoarseShape MakeCurve(bool closed) {
  CoarseShape shape;
  shape.curve = true;
  shape.closed = closed;
  for (int i = 0; i < 9; ++i) {
    const double angle = .7 * i;
    const double radius = 1 + .2 * (i % 3);
    const Vec3 p(radius * exact::Cos(angle), radius * exact::Sin(angle), .1 * i);
    shape.rest.push_back(p);
    shape.now.emplace_back(.8 * p.x, .9 * p.y, p.z);
  }
  return shape;
}

struct Case {
  const MethodInfo* method;
  const char* shape_name;
  CoarseShape shape;
  MethodSettings settings;
  std::string name;
};

void Probe(const Case& c, const Options& options, Report& report) {
  if (!report.Wants(c.name)) return;
  const auto prepared = PrepareMethod(c.shape, c.settings);
  if (!prepared.ok()) {
    report.Fail(c.name, prepared.error().ToString());
    return;
  }
  LeafSet leaves;
  for (size_t root = 0; root < prepared.value()->RootCount(); ++root) {
    prepared.value()->Stream(root, leaves, options.patch == 0 ? 1024 : options.patch);
  }
  if (leaves.count() < 2 * c.shape.now.size()) report.Fail(c.name, "hardly anything was split");
  report.Item(c.name + "/streamed", leaves.Finish());
  const auto welded = prepared.value()->Weld(WeldLimits{});
  if (!welded.ok()) {
    report.Fail(c.name, welded.error().ToString());
    return;
  }
  report.Item(c.name + "/welded", DigestOf(welded.value()));
}

// Everything that the method's table offers, with every split.
void ProbeSettings(Case c, bool coast, const Options& options, Report& report) {
  const std::string base = "fractal/" + std::string(c.method->name) + '/' + c.shape_name;
  for (const test::Choice& choice : test::AllChoices(*c.method)) {
    for (const Split split : test::kSplits) {
      c.settings.own = choice.own;
      c.settings.split = split;
      test::SetKnob(*c.method, "uniforms", {.wholes = {c.method->name == "coast" ? 12u : 4u}},
                    &c.settings.own);
      test::SetKnob(*c.method, "coast", {.wholes = {coast ? 1u : 0u}}, &c.settings.own);
      c.name = base + (choice.name.empty() ? "" : "/") + choice.name + '/' +
               std::string(SplitName(split));
      Probe(c, options, report);
    }
  }
}

}  // namespace

void ProbeFractals(const Options& options, Report& report) {
  if (!report.Wants("fractal/") && !options.only.starts_with("fractal/")) return;
  for (const MethodInfo& method : FractalMethods()) {
    Case c;
    c.method = &method;
    c.settings.method = method.name;
    c.settings.seed = 1989;
    c.settings.max_level = 5;
    Fineness& fineness = c.settings.fineness;
    if (method.takes == Takes::kCurve) {
      fineness.epsilon = .05;
      for (const bool closed : {false, true}) {
        c.shape_name = closed ? "closed" : "open";
        c.shape = MakeCurve(closed);
        ProbeSettings(c, false, options, report);
      }
      continue;
    }
    // By pixels around an eye, so that levels differ from place to place.
    fineness.pixels = 20;
    fineness.focal = 400;
    fineness.near = .1;
    fineness.eye = Vec3(1.5, -1, .8);
    fineness.eye_radius = .2;
    for (const bool solid : {false, true}) {
      if (solid && method.name == "coast") continue;  // a solid has no border
      c.shape_name = solid ? "solid" : "sheet";
      c.shape = MakeTriangles(solid, options.shuffle);
      ProbeSettings(c, !solid, options, report);
    }
  }
}

}  // namespace fjord::gate
