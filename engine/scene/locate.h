// Where a field of a scene file stands, asked after the scene was loaded: what was found out about
// the scene later is reported at the place that its author can change.
#pragma once

#include <span>
#include <string>

#include "engine/scene/load.h"
#include "engine/scene/route.h"

namespace fjord {

// The field, or the nearest thing around it that was written; the --set that wrote it. Where the
// file cannot be read any more: the file alone. Reads the file again.
Place LocateField(const std::string& file, std::span<const Setting> settings, const Route& route);

}  // namespace fjord
