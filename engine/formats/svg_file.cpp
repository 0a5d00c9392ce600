// .svg: paths, polylines, polygons and lines become curves, with the transforms of their groups; y
// is turned up. Written: one path a curve; a mesh as its edges.
#include <algorithm>
#include <array>

#include "engine/formats/limits.h"
#include "engine/formats/readers.h"
#include "engine/formats/svg_path.h"
#include "engine/formats/svg_style.h"
#include "engine/formats/text.h"
#include "engine/formats/xml_scan.h"
#include "engine/geometry/edges.h"

namespace fjord::formats {
namespace {

template <size_t n>
bool IsOneOf(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// What is inside is not drawn where it stands.
constexpr std::array<std::string_view, 7> kHidden = {"defs",    "clipPath", "mask",    "marker",
                                                     "pattern", "symbol",   "metadata"};
constexpr std::array<std::string_view, 4> kNotRead = {"rect", "circle", "ellipse", "use"};

class SvgReader {
 public:
  SvgReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), xml_(bytes) {}

  Result<ShapeFile> Read() {
    XmlTag tag;
    bool any = false;
    while (xml_.Next(&tag)) {
      if (!any && tag.name != "svg") return Fail(tag.offset, "the outer element is no <svg>");
      any = true;
      if (tag.opens) {
        if (auto ok = Open(tag); !ok) return ok.error();
      }
      if (tag.closes) {
        if (open_.empty()) return Fail(tag.offset, "an element is closed that was never opened");
        open_.pop_back();
      }
    }
    if (!xml_.fault().empty()) return Fail(xml_.fault_offset(), xml_.fault());
    if (!any) return Invalid("the file holds no <svg> element", {name_, 0, 0});
    if (!open_.empty()) {
      return Invalid("the file ends inside <" + std::string(open_.back().name.substr(0, 40)) +
                         ">; it is cut short",
                     {name_, 0, 0});
    }
    if (shape_.curves.empty()) {
      return Invalid("the file holds no path, polyline, polygon or line with two points or more",
                     {name_, 0, 0});
    }
    return std::move(shape_);
  }

 private:
  struct Level {
    std::string_view name;
    SvgMatrix matrix;
    bool hidden = false;  // with all that is inside
    bool visible = true;  // what is inside may say otherwise
  };

  // Line and column are worked out for the one message that needs them.
  Place At(size_t offset) const {
    const std::string_view before = bytes_.substr(0, offset);
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const size_t start = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
    return {name_, static_cast<int>(lines) + 1, static_cast<int>(offset - start) + 1};
  }
  Error Fail(size_t offset, std::string message) const {
    return Invalid(std::move(message), At(offset));
  }
  Error Fail(std::string_view value, const SvgFault& fault) const {
    return Fail(static_cast<size_t>(value.data() - bytes_.data()) + fault.offset, fault.message);
  }

  Result<> Open(const XmlTag& tag) {
    Level level;
    level.name = tag.name;
    if (!open_.empty()) {
      level.matrix = open_.back().matrix;
      level.hidden = open_.back().hidden;
      level.visible = open_.back().visible;
    }
    if (open_.size() >= limits::kDepth) {
      return MakeError(ErrorCode::kLimit, "more than 64 elements within each other",
                       At(tag.offset));
    }
    level.hidden =
        level.hidden || IsOneOf(tag.name, kHidden) || StyleValue(tag, "display") == "none";
    const std::string visibility = StyleValue(tag, "visibility");
    if (visibility == "visible") level.visible = true;
    if (visibility == "hidden" || visibility == "collapse") level.visible = false;
    if (auto ok = RefuseWhatBends(tag, level.hidden); !ok) return ok;
    if (!level.hidden) {
      const std::string_view text = tag.Find("transform");
      SvgMatrix own;
      if (const SvgFault fault = ParseTransform(text, &own); !fault.ok()) return Fail(text, fault);
      level.matrix = level.matrix * own;
    }
    open_.push_back(level);
    return level.hidden || !level.visible ? Result<>(Ok{}) : Draw(tag, level.matrix);
  }

  // What would put curves elsewhere, or hide them, in a way that is not read.
  Result<> RefuseWhatBends(const XmlTag& tag, bool hidden) const {
    if (tag.name == "style") {
      const size_t begin = std::min(tag.offset, bytes_.size());
      const std::string_view sheet = bytes_.substr(begin, bytes_.find("</", begin) - begin);
      for (const std::string_view word : {"display", "visibility", "transform"}) {
        if (sheet.find(word) == sheet.npos) continue;
        return Fail(begin, "a style sheet that sets " + std::string(word) +
                               " is not read; save with style attributes instead");
      }
    }
    if (hidden) return Ok{};
    if (!StyleValue(tag, "transform-origin").empty()) {
      return Fail(tag.offset, "transform-origin is not read; apply transforms before saving");
    }
    if (StyleDeclares(tag, "transform")) {
      return Fail(tag.offset, "a transform in style is not read; write it as an attribute");
    }
    if (tag.name != "svg" || open_.empty()) return Ok{};
    for (const std::string_view name : {"x", "y", "width", "height", "viewBox"}) {
      if (tag.Find(name).empty()) continue;
      return Fail(tag.offset, "an <svg> with " + std::string(name) +
                                  " inside another is not read; take its content out of it");
    }
    return Ok{};
  }

  Result<> Draw(const XmlTag& tag, const SvgMatrix& matrix) {
    std::vector<SvgCurve> curves;
    const size_t most = limits::kVertices - points_;
    std::string_view value;
    SvgFault fault;
    if (tag.name == "path") {
      value = tag.Find("d");
      fault = ParsePath(value, most, &curves);
    } else if (tag.name == "polyline" || tag.name == "polygon") {
      value = tag.Find("points");
      curves.emplace_back();
      fault = ParsePoints(value, most, &curves[0].points);
      curves[0].closed = tag.name == "polygon";
    } else if (tag.name == "line") {
      curves.emplace_back();
      curves[0].points.resize(2, Vec2(0));
      const std::array<std::string_view, 4> names = {"x1", "y1", "x2", "y2"};
      for (int i = 0; i < 4 && fault.ok(); ++i) {
        value = tag.Find(names[static_cast<size_t>(i)]);
        if (!value.empty()) fault = ParseLength(value, &curves[0].points[i / 2][i % 2]);
      }
    } else if (IsOneOf(tag.name, kNotRead)) {
      return Fail(tag.offset, "<" + std::string(tag.name) +
                                  "> is not read; turn objects into paths before saving");
    }
    if (!fault.ok()) return Fail(value, fault);
    for (SvgCurve& curve : curves) {
      if (auto ok = Add(curve, matrix, tag.offset); !ok) return ok;
    }
    return Ok{};
  }

  Result<> Add(SvgCurve& curve, const SvgMatrix& matrix, size_t offset) {
    if (curve.closed && curve.points.size() > 1 && curve.points.front() == curve.points.back()) {
      curve.points.pop_back();
    }
    curve.closed = curve.closed && curve.points.size() >= 3;
    if (curve.points.size() < 2) return Ok{};
    if (shape_.curves.size() >= limits::kCurves) {
      return MakeError(ErrorCode::kLimit, "more than 4,000,000 curves", At(offset));
    }
    points_ += curve.points.size();
    if (points_ > limits::kVertices) return TooManyVertices(At(offset));
    Polyline line;
    line.closed = curve.closed;
    line.points.reserve(curve.points.size());
    for (const Vec2& p : curve.points) {
      const Vec2 q = matrix(p);
      for (int k = 0; k < 2; ++k) {
        if (!(q[k] >= -limits::kCoordinate && q[k] <= limits::kCoordinate)) {
          return Fail(offset, "a point lies beyond 1e15 after its transforms");
        }
      }
      line.points.push_back({q.x, 0 - q.y, 0});
    }
    shape_.curves.push_back(std::move(line));
    return Ok{};
  }

  const std::string_view bytes_;
  const std::string& name_;
  XmlScan xml_;
  std::vector<Level> open_;
  size_t points_ = 0;
  ShapeFile shape_;
};

void AppendPoint(char command, const Vec3& p, std::string* out) {
  *out += command;
  text::Append(p.x, out);
  *out += ' ';
  text::Append(0 - p.y, out);
}

struct Box {
  Vec2 low{0}, high{0};
  bool empty = true;

  void Add(const Vec3& p) {
    const Vec2 q(p.x, 0 - p.y);
    for (int k = 0; k < 2; ++k) {
      low[k] = empty ? q[k] : std::min(low[k], q[k]);
      high[k] = empty ? q[k] : std::max(high[k], q[k]);
    }
    empty = false;
  }
};

std::string Escaped(std::string_view text) {
  std::string out;
  for (const char c : text::OneLine(text)) {
    // Two hyphens would end the comment.
    if (c == '-' && !out.empty() && out.back() == '-') out += ' ';
    out += c;
  }
  return out;
}

}  // namespace

Result<ShapeFile> ReadSvg(std::string_view bytes, const std::string& name) {
  return SvgReader(bytes, name).Read();
}

std::string WriteSvg(const ShapeFile& shape, const Comment& comment) {
  Box box;
  if (!shape.mesh.face_size.empty()) {
    for (const uint32_t v : shape.mesh.face_vertex) box.Add(shape.mesh.points[v]);
  }
  for (const Polyline& curve : shape.curves) {
    for (const Vec3& p : curve.points) box.Add(p);
  }
  const Vec2 size = box.high - box.low;
  const double extent = std::max(size.x, size.y) > 0 ? std::max(size.x, size.y) : 1;
  const double margin = extent / 50;

  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"";
  const std::array<double, 4> view = {box.low.x - margin, box.low.y - margin, size.x + 2 * margin,
                                      size.y + 2 * margin};
  for (size_t i = 0; i < view.size(); ++i) text::Append(view[i], &(i ? out += ' ' : out));
  out += "\">\n";
  for (const std::string& line : comment) out += "<!-- " + Escaped(line) + " -->\n";
  out += "<g fill=\"none\" stroke=\"black\" stroke-width=\"";
  text::Append(extent / 1000, &out);
  out += "\">\n";
  if (!shape.mesh.face_size.empty()) {
    out += "<path d=\"";
    const EdgeTable table(shape.mesh);
    for (const Edge& edge : table.edges()) {
      AppendPoint('M', shape.mesh.points[edge.a], &out);
      AppendPoint('L', shape.mesh.points[edge.b], &out);
      out += '\n';
    }
    out += "\"/>\n";
  }
  for (const Polyline& curve : shape.curves) {
    out += "<path d=\"";
    for (size_t k = 0; k < curve.points.size(); ++k) {
      AppendPoint(k == 0 ? 'M' : 'L', curve.points[k], &out);
      if (k % 8 == 7) out += '\n';
    }
    out += curve.closed ? "Z\"/>\n" : "\"/>\n";
  }
  return out + "</g>\n</svg>\n";
}

}  // namespace fjord::formats
