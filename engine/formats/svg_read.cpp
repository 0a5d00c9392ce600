// Reading .svg: what its elements draw becomes curves, with y turned up (docs/files.md).
#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "engine/formats/limits.h"
#include "engine/formats/readers.h"
#include "engine/formats/svg_path.h"
#include "engine/formats/svg_pen.h"
#include "engine/formats/svg_shapes.h"
#include "engine/formats/svg_style.h"
#include "engine/formats/svg_values.h"
#include "engine/formats/text.h"
#include "engine/formats/xml_document.h"

namespace fjord::formats {
namespace {

constexpr std::string_view kSpace = "http://www.w3.org/2000/svg";

// Shown, but no curves.
constexpr std::array<std::string_view, 3> kNoCurves = {"text", "image", "foreignObject"};
constexpr std::array<std::string_view, 5> kMoving = {"animate", "animateTransform", "animateMotion",
                                                     "animateColor", "set"};
constexpr std::array<std::string_view, 2> kCutting = {"clip-path", "mask"};
constexpr std::string_view kUnpainted = "a curve";

template <size_t n>
bool IsOneOf(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class SvgReader {
 public:
  explicit SvgReader(const XmlDocument& document)
      : document_(document), elements_(document.elements()), style_(document), values_(style_) {}

  Result<ShapeFile> Read() {
    const XmlElement& outer = elements_[0];
    if (!IsSvg(outer) || outer.name != "svg") return Fail(outer, "the outer element is no <svg>");
    for (const XmlElement& element : elements_) {
      if (!IsSvg(element) || element.name != "style") continue;
      const std::string_view type = document_.Attribute(element, "type");
      if (!type.empty() && type != "text/css") continue;
      if (auto ok = style_.AddSheet(element); !ok) return ok.error();
    }
    // The outer one keeps the coordinates of its content: its size on a page bends nothing.
    State state;
    state.view = values_.OuterViewport(outer);
    if (auto ok = Draw(0, state); !ok) return ok.error();
    if (!pen_.LeavesOut()) seen_.erase(kUnpainted);
    if (!pen_.Take(&shape_.curves)) return TooManyVertices(document_.PlaceOf(outer));
    if (shape_.curves.empty()) {
      return Fail(outer,
                  "nothing of the drawing is a curve of two points or more: paths, polylines, "
                  "polygons, lines, rectangles, circles and ellipses are, text is not");
    }
    AddNotes();
    return std::move(shape_);
  }

 private:
  // What holds for an element by those around it.
  struct State {
    SvgMatrix matrix;
    SvgViewport view;
    bool visible = true;
    bool filled = true, stroked = false;
    size_t depth = 0;
    const XmlElement* user = nullptr;  // the <use> whose target is drawn
  };

  Error Fail(const XmlElement& element, std::string message) const {
    return Invalid(std::move(message), document_.PlaceOf(element));
  }

  static bool IsSvg(const XmlElement& element) {
    return element.space.empty() || element.space == kSpace;
  }

  Result<> Draw(size_t index, State state) {
    const XmlElement& element = elements_[index];
    if (!IsSvg(element)) return Ok{};
    if (!using_.empty() && ++used_ > limits::kUsed) {
      return MakeError(ErrorCode::kLimit, "<use> draws more than 1,000,000 elements",
                       document_.PlaceOf(element));
    }
    if (style_.looks() > limits::kStyleLooks) {
      return MakeError(ErrorCode::kLimit, "too many rules of style sheets for too many elements",
                       document_.PlaceOf(element));
    }
    if (++state.depth > limits::kDepth) {
      return MakeError(ErrorCode::kLimit, "more than 64 elements within each other, <use> counted",
                       document_.PlaceOf(element));
    }
    if (style_.Find(element, "display").value == "none" || !values_.Applies(element) ||
        style_.Find(element, "opacity").value == "0") {
      return Ok{};
    }
    if (IsOneOf(element.name, kNoCurves) || IsOneOf(element.name, kMoving)) {
      seen_.emplace(element.name, index);
      return Ok{};
    }
    const std::string visibility = style_.Find(element, "visibility").value;
    if (visibility == "visible") state.visible = true;
    if (visibility == "hidden" || visibility == "collapse") state.visible = false;
    state.filled = Paints(element, "fill", state.filled);
    state.stroked = Paints(element, "stroke", state.stroked);
    const bool viewport = element.name == "svg" || (element.name == "symbol" && state.user);
    const bool group = element.name == "g" || element.name == "a" || element.name == "switch";
    const bool use = element.name == "use";
    if (!viewport && !group && !use && !IsSvgShape(element.name)) return Ok{};
    NoteCuts(index);
    if (auto ok = values_.Transform(element, state.view, &state.matrix); !ok) return ok;
    if (use) return DrawUse(element, state);
    if (viewport && state.depth > 1) {
      bool empty = false;
      if (auto ok = values_.InnerViewport(element, state.user, &state.view, &state.matrix, &empty);
          !ok) {
        return ok;
      }
      if (empty) return Ok{};
    }
    if (viewport || group) return DrawInside(index, state);
    return state.visible ? DrawShape(index, state) : Result<>(Ok{});
  }

  // Paint is inherited; none and transparent are no paint.
  bool Paints(const XmlElement& element, const char* property, bool around) const {
    const std::string value = style_.Find(element, property).value;
    if (value.empty() || value == "inherit") return around;
    return value != "none" && value != "transparent";
  }

  Result<> DrawInside(size_t index, State state) {
    const XmlElement& element = elements_[index];
    state.user = nullptr;
    for (size_t i = index + 1; i < element.end; i = elements_[i].end) {
      if (auto ok = Draw(i, state); !ok) return ok;
      // Of a switch only the first that applies is drawn.
      if (element.name == "switch" && IsSvg(elements_[i]) && values_.Applies(elements_[i])) break;
    }
    return Ok{};
  }

  Result<> DrawUse(const XmlElement& element, State state) {
    const bool old = document_.Attribute(element, "href").empty();
    const std::string_view reference = document_.Attribute(element, old ? "xlink:href" : "href");
    if (reference.empty() || reference[0] != '#') {
      return Fail(element, "<use> of " + text::Quoted(reference) +
                               " is not read; name an element of this file as href=\"#ID\"");
    }
    if (ids_.empty()) {
      for (size_t i = 0; i < elements_.size(); ++i) {
        const std::string_view id = document_.Attribute(elements_[i], "id");
        if (!id.empty()) ids_.emplace(id, i);
      }
    }
    const auto target = ids_.find(reference.substr(1));
    if (target == ids_.end()) {
      return Fail(element, "<use> of " + text::Quoted(reference) + ", which is no element's id");
    }
    if (std::find(using_.begin(), using_.end(), target->second) != using_.end() ||
        (&element > &elements_[target->second] &&
         static_cast<size_t>(&element - elements_.data()) < elements_[target->second].end)) {
      return Fail(element, "<use> of " + text::Quoted(reference) + " uses itself");
    }
    Vec2 at(0);
    if (auto ok = values_.Position(element, state.view, &at); !ok) return ok;
    state.matrix = state.matrix * Translation(at);
    state.user = &element;
    using_.push_back(target->second);
    auto ok = Draw(target->second, state);
    using_.pop_back();
    return ok;
  }

  Result<> DrawShape(size_t index, const State& state) {
    const XmlElement& element = elements_[index];
    for (size_t i = index + 1; i < element.end; i = elements_[i].end) {
      if (IsSvg(elements_[i]) && IsOneOf(elements_[i].name, kMoving)) {
        seen_.emplace(elements_[i].name, i);
      }
    }
    const size_t before = pen_.size();
    pen_.Start(state.matrix, state.filled || state.stroked);
    SvgFault fault;
    if (element.name == "path" || element.name == "polyline" || element.name == "polygon") {
      const char* attribute = element.name == "path" ? "d" : "points";
      const std::string_view data = document_.Attribute(element, attribute);
      fault = element.name == "path" ? DrawPath(data, &pen_)
                                     : DrawPoints(data, element.name == "polygon", &pen_);
      if (!fault.ok()) {
        return Invalid(fault.message, document_.PlaceIn(element, attribute, fault.offset));
      }
    } else {
      SvgNumbers numbers;
      for (const SvgNumberName& name : NumbersOf(element.name)) {
        double value = 0;
        const auto given = values_.Length(element, name.name, name.axis, state.view, &value);
        if (!given.ok()) return given.error();
        if (*given) numbers[name.name] = value;
      }
      if (std::string message = DrawSvgShape(element.name, numbers, &pen_); !message.empty()) {
        return Fail(element, std::move(message));
      }
    }
    if (!(state.filled || state.stroked) && pen_.size() > before) seen_.emplace(kUnpainted, index);
    if (pen_.beyond()) return Fail(element, "a point lies beyond 1e15 after its transforms");
    if (pen_.full()) return TooManyVertices(document_.PlaceOf(element));
    if (pen_.size() > limits::kCurves) {
      return MakeError(ErrorCode::kLimit, "more than 4,000,000 curves", document_.PlaceOf(element));
    }
    return Ok{};
  }

  void NoteCuts(size_t index) {
    for (const std::string_view name : kCutting) {
      const std::string_view value = document_.Attribute(elements_[index], name);
      const bool in_style =
          document_.Attribute(elements_[index], "style").find(name) != std::string_view::npos;
      if (in_style || (!value.empty() && value != "none")) seen_.emplace(name, index);
    }
  }

  // One for each kind of thing that is shown and yet is no curve, at the first of its kind.
  void AddNotes() {
    for (const auto& [name, index] : seen_) {
      std::string note;
      const bool plain = name == kUnpainted || IsOneOf(name, kCutting);
      note.append(plain ? "" : "<").append(name).append(plain ? "" : ">");
      if (name == kUnpainted) note += " with neither fill nor stroke is passed over";
      if (IsOneOf(name, kCutting)) note += " cuts nothing off: curves stay whole";
      if (IsOneOf(name, kMoving)) note += " moves nothing here";
      if (IsOneOf(name, kNoCurves)) note += " is passed over: it is no curve";
      shape_.notes.push_back({document_.PlaceOf(elements_[index]), std::move(note)});
    }
  }

  const XmlDocument& document_;
  const std::vector<XmlElement>& elements_;
  SvgStyle style_;
  const SvgValues values_;
  SvgPen pen_;
  std::map<std::string_view, size_t> ids_;
  std::map<std::string_view, size_t> seen_;  // what notes are about, and the first such element
  std::vector<size_t> using_;                // targets of <use>, outermost first
  size_t used_ = 0;                          // elements drawn for a <use>
  ShapeFile shape_;
};

}  // namespace

Result<ShapeFile> ReadSvg(std::string_view bytes, const std::string& name) {
  const Result<XmlDocument> document = XmlDocument::Read(bytes, name, "style");
  if (!document) return document.error();
  return SvgReader(*document).Read();
}

}  // namespace fjord::formats
