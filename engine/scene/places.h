// Where every field of a scene's text stands: a tree beside the message, as small as it can be,
// since a scene may have a million points.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/route.h"

namespace fjord {

// Lines and columns from 1; 0 unknown.
struct TextPlace {
  int line = 0;
  int column = 0;
};

// Not for sharing between threads while it is filled.
class PlaceTree {
 public:
  static constexpr int kRoot = 0;

  // A field of the message at node `parent`; `index` as in RouteStep. Gives the field's node.
  int Add(int parent, const RouteStep& step, TextPlace place);
  // The place of the route, or of the nearest thing around it that was written.
  TextPlace Find(const Route& route) const;

 private:
  struct Node {
    int key = 0;  // the field's number, or less than 0 for a knob
    int index = -1;
    TextPlace place;
    int first_child = -1, last_child = -1, next = -1;
  };
  // Less than 0; 0 for a knob that was never added.
  int KeyOf(const RouteStep& step) const;

  std::vector<Node> nodes_{Node{}};
  std::map<std::string, int, std::less<>> knobs_;
};

}  // namespace fjord
