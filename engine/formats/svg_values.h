// The values of single elements of a .svg file, with the places of their faults: transforms,
// lengths, and the viewports that <svg> and <symbol> open. Refers to the style and its document.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/svg_box.h"
#include "engine/formats/svg_matrix.h"
#include "engine/formats/svg_style.h"
#include "engine/formats/svg_value.h"
#include "engine/formats/xml_document.h"

namespace fjord::formats {

class SvgValues {
 public:
  explicit SvgValues(const SvgStyle& style) : style_(style), document_(style.document()) {}

  // By conditional attributes: no extension is known, and the language is English.
  bool Applies(const XmlElement& element) const;

  // `matrix` becomes that of what is inside the element.
  Result<> Transform(const XmlElement& element, const SvgViewport& view, SvgMatrix* matrix) const;

  // In pixels; false, and `value` as it was, where none is given, or `auto`.
  Result<bool> Length(const XmlElement& element, const char* name, SvgAxis axis,
                      const SvgViewport& view, double* value) const;
  // x and y.
  Result<> Position(const XmlElement& element, const SvgViewport& view, Vec2* at) const;

  SvgViewport OuterViewport(const XmlElement& element) const;
  // `view` and `matrix` become those of what is inside. `user` is the <use> whose target the
  // element is, null without one; `empty`: its size is nothing, and nothing in it is drawn.
  Result<> InnerViewport(const XmlElement& element, const XmlElement* user, SvgViewport* view,
                         SvgMatrix* matrix, bool* empty) const;

 private:
  Error Fail(const XmlElement& element, std::string message) const;
  Error Fail(const XmlElement& element, std::string_view attribute, const SvgFault& fault) const;
  Error Fail(const XmlElement& element, const char* name, const SvgProperty& property,
             const SvgFault& fault) const;
  Result<bool> Side(const XmlElement& element, const XmlElement* user, int axis,
                    const SvgViewport& view, double* value) const;
  Result<> ViewBox(const XmlElement& element, SvgViewBox* box) const;

  const SvgStyle& style_;
  const XmlDocument& document_;
};

}  // namespace fjord::formats
