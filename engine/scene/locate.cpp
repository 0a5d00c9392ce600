#include "engine/scene/locate.h"

#include "engine/formats/read_bytes.h"
#include "engine/scene/limits.h"
#include "engine/scene/parse.h"

namespace fjord {

Place LocateField(const std::string& file, std::span<const Setting> settings, const Route& route) {
  SceneSource source;
  source.name = file;
  v1::Scene scene;
  const Result<std::string> text = ReadBytes(file, limits::kSceneBytes);
  if (!text || !ParseScene(*text, &scene, &source).empty()) return {file, 0, 0};
  for (const Setting& setting : settings) {
    const Result<FieldPath> path = ParseFieldPath(setting.path);
    if (!path) continue;
    const Result<Route> set = FindRoute(scene, *path);
    if (set) source.set.emplace_back(*set, "--set " + setting.path + "=" + setting.value);
  }
  return source.Find(route);
}

}  // namespace fjord
