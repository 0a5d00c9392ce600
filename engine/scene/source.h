// A scene's text as it was read, for telling where a defect is: file:line:column in text form and
// JSON, the --set that wrote the value, or the file alone (the binary form).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/scene/places.h"
#include "engine/scene/route.h"

namespace fjord {

// Not for sharing between threads while it is filled.
struct SceneSource {
  enum class Form { kText, kJson, kBinary };
  Form form = Form::kText;
  std::string name;
  PlaceTree places;                                // text form and JSON
  std::vector<std::pair<Route, std::string>> set;  // route, "--set path=value"

  // The place of the field, or of the nearest thing around it that was written.
  Place Find(const Route& route) const;
};

// Collects defects of a scene, at most limits::kErrors, and gives them in the order of their
// places; and as many notes: what is no defect, but may not be what was meant.
class SceneErrors {
 public:
  SceneErrors(const v1::Scene* scene, const SceneSource* source) : scene_(scene), source_(source) {}

  // "file:line:column: error: objects[coast].fractal: message"; the path is of the route.
  // Nothing is added about a value that was refused: what follows from it is no defect of its own.
  void Add(const Route& route, const std::string& message, ErrorCode code = ErrorCode::kInvalid);
  // The same, and refuses the value at `route`; of a vector or colour, the whole.
  void Refuse(const Route& route, const std::string& message);
  bool Refused(const Route& route) const;
  bool RefusedWithin(const Route& route) const;
  void AddAt(Error error);
  void Note(const Route& route, const std::string& message);
  bool Full() const { return full_; }
  bool empty() const { return errors_.empty(); }
  Errors Take();
  // "file:line:column: note: objects[coast].shape.file: message", in the order they came.
  std::vector<std::string> TakeNotes() { return std::move(notes_); }

 private:
  const v1::Scene* scene_;
  const SceneSource* source_;
  Errors errors_;
  std::vector<std::string> notes_;
  bool full_ = false;
  std::vector<Route> refused_;
};

}  // namespace fjord
