// What is written reads back as the same shape, for every format and any shape (G52).
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "engine/formats/shape_file.h"

namespace fjord {
namespace {

double AnyNumber() {
  const int mantissa = *rc::gen::inRange(-2'000'000'000, 2'000'000'000);
  const int exponent = *rc::gen::inRange(-60, 18);
  double value = mantissa / 3.;
  for (int i = 0; i < exponent; ++i) value *= 2;
  for (int i = 0; i > exponent; --i) value /= 2;
  return value;
}

Vec3 AnyPoint(bool flat) { return {AnyNumber(), AnyNumber(), flat ? 0 : AnyNumber()}; }

Mesh AnyMesh() {
  Mesh mesh;
  const int points = *rc::gen::inRange(3, 40);
  for (int i = 0; i < points; ++i) mesh.points.push_back(AnyPoint(false));
  if (*rc::gen::arbitrary<bool>()) {
    const bool bytes = *rc::gen::arbitrary<bool>();
    const auto channel = [bytes] {
      return bytes ? static_cast<float>(*rc::gen::inRange(0, 256)) / 255.f
                   : static_cast<float>(*rc::gen::inRange(0, 1'000'000)) / 1e6f;
    };
    for (int i = 0; i < points; ++i) mesh.colors.push_back({channel(), channel(), channel()});
  }
  const int faces = *rc::gen::inRange(1, 30);
  for (int f = 0; f < faces; ++f) {
    const int corners = *rc::gen::inRange(3, *rc::gen::weightedElement<int>({{9, 6}, {1, 400}}));
    std::vector<uint32_t> face;
    for (int k = 0; k < corners; ++k) {
      face.push_back(static_cast<uint32_t>(*rc::gen::inRange(0, points)));
    }
    mesh.AddFace(face);
  }
  return mesh;
}

std::vector<Polyline> AnyCurves(int least, bool flat, bool closed_only) {
  std::vector<Polyline> curves;
  const int count = *rc::gen::inRange(least, 6);
  for (int i = 0; i < count; ++i) {
    Polyline curve;
    curve.closed = closed_only || *rc::gen::arbitrary<bool>();
    const int points = *rc::gen::inRange(curve.closed ? 3 : 2, 30);
    for (int k = 0; k < points; ++k) {
      curve.points.push_back(AnyPoint(flat));
      // A closed curve that comes home by itself would lose its last point in .svg.
      if (k > 0 && curve.points.back() == curve.points.front()) curve.points.back().x += 1;
    }
    curves.push_back(curve);
  }
  return curves;
}

ShapeFile WriteAndRead(const ShapeFile& shape, ShapeFormat format) {
  const auto text = WriteShape(shape, format, {"seed 7", "data 1 1 \\"});
  RC_ASSERT(text.ok());
  auto back = ReadShape(*text, "again");
  if (!back) RC_LOG() << back.error().ToString();
  RC_ASSERT(back.ok());
  // The same shape gives the same bytes.
  RC_ASSERT(WriteShape(*back, format, {"seed 7", "data 1 1 \\"}).value() == *text);
  return std::move(back).value();
}

void AssertSame(const Mesh& a, const Mesh& b) {
  RC_ASSERT(a.points == b.points);
  RC_ASSERT(a.face_size == b.face_size);
  RC_ASSERT(a.face_vertex == b.face_vertex);
}

void AssertSame(const std::vector<Polyline>& a, const std::vector<Polyline>& b) {
  RC_ASSERT(a.size() == b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    RC_ASSERT(a[i].points == b[i].points);
    RC_ASSERT(a[i].closed == b[i].closed);
  }
}

RC_GTEST_PROP(RoundTripTest, G52_MeshesInStd, ()) {
  const ShapeFile shape = {AnyMesh(), {}, {}, {}, {}};
  const ShapeFormat format = *rc::gen::element(ShapeFormat::kStd, ShapeFormat::kEpf);
  AssertSame(WriteAndRead(shape, format).mesh, shape.mesh);
}

RC_GTEST_PROP(RoundTripTest, G52_MeshesWithColoursAndCurvesInObjAndPly, ()) {
  ShapeFile shape;
  if (*rc::gen::arbitrary<bool>()) shape.mesh = AnyMesh();
  shape.curves = AnyCurves(shape.mesh.face_size.empty() ? 1 : 0, false, false);
  for (ShapeFormat format : {ShapeFormat::kObj, ShapeFormat::kPly}) {
    const ShapeFile back = WriteAndRead(shape, format);
    AssertSame(back.mesh, shape.mesh);
    RC_ASSERT(back.mesh.colors == shape.mesh.colors);
    AssertSame(back.curves, shape.curves);
  }
}

RC_GTEST_PROP(RoundTripTest, G52_CurvesInSvg, ()) {
  ShapeFile shape;
  shape.curves = AnyCurves(1, true, false);
  AssertSame(WriteAndRead(shape, ShapeFormat::kSvg).curves, shape.curves);
}

RC_GTEST_PROP(RoundTripTest, G52_ClosedCurvesInStdAreFaces, ()) {
  ShapeFile shape;
  shape.curves = AnyCurves(1, false, true);
  const ShapeFile back = WriteAndRead(shape, ShapeFormat::kStd);
  RC_ASSERT(back.mesh.FaceCount() == shape.curves.size());
  size_t corner = 0;
  for (size_t f = 0; f < shape.curves.size(); ++f) {
    for (const Vec3& p : shape.curves[f].points) {
      RC_ASSERT(back.mesh.points[back.mesh.face_vertex[corner++]] == p);
    }
  }
}

}  // namespace
}  // namespace fjord
