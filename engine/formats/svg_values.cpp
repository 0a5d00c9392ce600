#include "engine/formats/svg_values.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

constexpr std::array<SvgAxis, 2> kAxes = {SvgAxis::kX, SvgAxis::kY};

}  // namespace

Error SvgValues::Fail(const XmlElement& element, std::string message) const {
  return Invalid(std::move(message), document_.PlaceOf(element));
}

Error SvgValues::Fail(const XmlElement& element, std::string_view attribute,
                      const SvgFault& fault) const {
  return Invalid(fault.message, document_.PlaceIn(element, attribute, fault.offset));
}

Error SvgValues::Fail(const XmlElement& element, const char* name, const SvgProperty& property,
                      const SvgFault& fault) const {
  if (!property.attribute) {
    return Fail(element, std::string(name) + " in a style: " + fault.message);
  }
  return Fail(element, name, SvgFault{fault.offset + property.offset, fault.message});
}

bool SvgValues::Applies(const XmlElement& element) const {
  if (!document_.Attribute(element, "requiredExtensions").empty()) return false;
  const std::string_view languages = document_.Attribute(element, "systemLanguage");
  if (languages.empty()) return true;
  for (size_t at = 0; at < languages.size();) {
    const size_t end = std::min(languages.find(',', at), languages.size());
    const size_t first = languages.find_first_not_of(' ', at);
    if (first != languages.npos && languages.substr(first, 2) == "en") return true;
    at = end + 1;
  }
  return false;
}

Result<> SvgValues::Transform(const XmlElement& element, const SvgViewport& view,
                              SvgMatrix* matrix) const {
  for (const char* name : {"translate", "rotate", "scale", "offset", "offset-path", "d"}) {
    if (!style_.IsStyled(element)) break;
    const std::string value = style_.Find(element, name).value;
    if (value.empty() || value == "none") continue;
    return Fail(element, std::string(name) + " in a style is not read; write it as " +
                             (name[0] == 'd' ? "an attribute" : "a transform"));
  }
  const SvgProperty transform = style_.Find(element, "transform");
  if (!transform.given()) return Ok{};
  SvgMatrix own;
  if (const SvgFault fault = ParseTransform(transform.value, view, &own); !fault.ok()) {
    return Fail(element, "transform", transform, fault);
  }
  const std::string box = style_.Find(element, "transform-box").value;
  if (!box.empty() && box != "view-box") {
    return Fail(element, "a transform by the box " + text::Quoted(box) +
                             " is not read; apply transforms before saving");
  }
  const SvgProperty given = style_.Find(element, "transform-origin");
  Vec2 origin(0);
  if (given.given()) {
    if (const SvgFault fault = ParseOrigin(given.value, view, &origin); !fault.ok()) {
      return Fail(element, "transform-origin", given, fault);
    }
  }
  if (origin != Vec2(0)) own = Translation(origin) * own * Translation(origin * -1.);
  *matrix = *matrix * own;
  return Ok{};
}

Result<bool> SvgValues::Length(const XmlElement& element, const char* name, SvgAxis axis,
                               const SvgViewport& view, double* value) const {
  const SvgProperty property = style_.Find(element, name);
  if (!property.given() || property.value == "auto") return false;
  if (const SvgFault fault = ParseLength(property.value, view, axis, value); !fault.ok()) {
    return Fail(element, name, property, fault);
  }
  return true;
}

Result<> SvgValues::Position(const XmlElement& element, const SvgViewport& view, Vec2* at) const {
  if (auto x = Length(element, "x", SvgAxis::kX, view, &at->x); !x.ok()) return x.error();
  if (auto y = Length(element, "y", SvgAxis::kY, view, &at->y); !y.ok()) return y.error();
  return Ok{};
}

// Width (0) or height (1): that of the <use> counts before the element's own. False where it is not
// given.
Result<bool> SvgValues::Side(const XmlElement& element, const XmlElement* user, int axis,
                             const SvgViewport& view, double* value) const {
  const char* name = axis == 0 ? "width" : "height";
  for (const XmlElement* one : {user, &element}) {
    if (one == nullptr) continue;
    const Result<bool> given = Length(*one, name, kAxes[static_cast<size_t>(axis)], view, value);
    if (!given.ok()) return given;
    if (*given && *value < 0) return Fail(*one, std::string(name) + " is negative");
    if (*given) return true;
  }
  return false;
}

Result<> SvgValues::ViewBox(const XmlElement& element, SvgViewBox* box) const {
  const SvgFault fault = ParseViewBox(document_.Attribute(element, "viewBox"), box);
  return fault.ok() ? Result<>(Ok{}) : Fail(element, "viewBox", fault);
}

// What cannot be read makes the size unknown, which matters to none but per cents.
SvgViewport SvgValues::OuterViewport(const XmlElement& element) const {
  SvgViewBox box;
  if (!document_.Attribute(element, "viewBox").empty() && ViewBox(element, &box).ok()) {
    return {box.size, true};
  }
  SvgViewport view = {Vec2(0), true};
  for (int k = 0; k < 2; ++k) {
    const Result<bool> given = Side(element, nullptr, k, {}, &view.size[k]);
    view.known = view.known && given.ok() && *given;
  }
  return view;
}

Result<> SvgValues::InnerViewport(const XmlElement& element, const XmlElement* user,
                                  SvgViewport* view, SvgMatrix* matrix, bool* empty) const {
  Vec2 at(0);
  if (element.name == "svg") {
    if (auto ok = Position(element, *view, &at); !ok) return ok;
  }
  // Sides that are not given are the whole of what is around.
  SvgViewport own = *view;
  bool all = true;
  for (int k = 0; k < 2; ++k) {
    const Result<bool> given = Side(element, user, k, *view, &own.size[k]);
    if (!given.ok()) return given.error();
    *empty = *empty || (*given && own.size[k] == 0);
    all = all && *given;
  }
  own.known = all || view->known;
  SvgMatrix fit;
  if (!document_.Attribute(element, "viewBox").empty()) {
    SvgViewBox box;
    if (auto ok = ViewBox(element, &box); !ok) return ok;
    *empty = *empty || box.size.x == 0 || box.size.y == 0;
    if (*empty) return Ok{};
    if (!own.known) {
      return Fail(element, "a viewBox needs width and height, of its <" +
                               text::OneLine(element.name) + "> or the outer <svg>");
    }
    const std::string_view aspect = document_.Attribute(element, "preserveAspectRatio");
    const SvgFault fault = FitViewBox(box, own.size, aspect, &fit);
    if (!fault.ok()) return Fail(element, "preserveAspectRatio", fault);
    own.size = box.size;
  }
  *matrix = *matrix * Translation(at) * fit;
  *view = own;
  return Ok{};
}

}  // namespace fjord::formats
