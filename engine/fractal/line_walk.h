// Walks the tree that grows from one edge of a line: what "curve" and "coast" share. A node is
// replaced by its children, in order along the line, until it is small enough to be a leaf. Halving
// is the case of two children. A generator (G8) has more, and each of its children may lie on the
// other side or be travelled backwards (G18): that is a matter of the node, the walk only keeps the
// order.
//
// A node has level(). A visitor, which belongs to one walk and one thread, has
//   Measure(node)             how large it is; the answer has Splits() and IsLarge()
//   IsWanted(node)            false: nothing that grows from it is needed
//   Divide(node, size, tree)  pushes the children to the tree, THE LAST ONE FIRST; may emit
//                             elements of its own; false ends the walk
//   Take(node)                a leaf, in order along the line; false ends the walk
//
// W1 Depth first: memory follows depth times children.
// W2 The root and every large node are asked for before they are divided or taken.
#pragma once

#include <vector>

#include "engine/fractal/method.h"

namespace fjord {

// Nodes that wait, the next one last.
template <typename Node>
using LineTree = std::vector<Node>;

// False: the visitor ended the walk.
template <typename Node, typename Visitor>
bool WalkLine(const Node& root, Visitor& visitor, StreamStats* stats) {
  LineTree<Node> tree{root};
  while (!tree.empty()) {
    const Node node = tree.back();
    tree.pop_back();
    const auto size = visitor.Measure(node);
    if ((node.level() == 0 || size.IsLarge()) && !visitor.IsWanted(node)) {
      ++stats->culled;
      continue;
    }
    if (!size.Splits()) {
      ++stats->triangles;
      stats->depth = node.level() > stats->depth ? node.level() : stats->depth;
      if (!visitor.Take(node)) {
        return false;
      }
      continue;
    }
    const size_t waiting = tree.size();
    if (!visitor.Divide(node, size, &tree)) {
      return false;
    }
    stats->midpoints += tree.size() - waiting - 1;
  }
  return true;
}

}  // namespace fjord
