// What an element of an .svg file says of itself by its attributes or its `style` attribute.
#pragma once

#include <string>
#include <string_view>

#include "engine/formats/xml_scan.h"

namespace fjord::formats {

// The value of a property in small letters, without blanks around it and `!important`; empty where
// it is not given. A declaration in `style` wins over the attribute of the same name, a later one
// over an earlier one.
std::string StyleValue(const XmlTag& tag, std::string_view property);

// `style` itself declares the property.
bool StyleDeclares(const XmlTag& tag, std::string_view property);

}  // namespace fjord::formats
