#include "engine/geometry/join_edges.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

namespace fjord {
namespace {

using Edges = std::vector<std::array<uint32_t, 2>>;
using Vertices = std::vector<uint32_t>;

TEST(JoinEdgesTest, InOrderTheyFormARing) {
  const auto chains = JoinEdges(Edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, 4);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(chains[0].vertices, (Vertices{0, 1, 2, 3}));
}

TEST(JoinEdgesTest, OrderAndDirectionDoNotMatter) {
  const auto chains = JoinEdges(Edges{{2, 3}, {1, 0}, {4, 3}, {1, 2}}, 5);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_FALSE(chains[0].closed);
  EXPECT_EQ(chains[0].vertices, (Vertices{0, 1, 2, 3, 4}));
}

TEST(JoinEdgesTest, WhereThreeMeetTheNextOfTheListGoesOn) {
  const auto chains = JoinEdges(Edges{{0, 1}, {1, 2}, {1, 3}}, 4);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].vertices, (Vertices{0, 1, 2}));
  EXPECT_EQ(chains[1].vertices, (Vertices{1, 3}));
  EXPECT_EQ(chains[1].first, 2u);
}

TEST(JoinEdgesTest, AnEdgeGivenTwiceCountsOnce) {
  const auto chains = JoinEdges(Edges{{0, 1}, {1, 0}, {0, 1}, {1, 2}}, 3);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].vertices, (Vertices{0, 1, 2}));
}

TEST(JoinEdgesTest, EveryEdgeComesOnceWhateverTheEdgesAre) {
  rc::check([] {
    const auto ends = *rc::gen::container<std::vector<std::pair<uint32_t, uint32_t>>>(
        rc::gen::pair(rc::gen::inRange(0u, 9u), rc::gen::inRange(0u, 9u)));
    Edges edges;
    std::set<std::pair<uint32_t, uint32_t>> given;
    for (const auto& [from, to] : ends) {
      edges.push_back({from, to});
      given.insert(std::minmax(from, to));
    }
    std::multiset<std::pair<uint32_t, uint32_t>> made;
    for (const Chain& chain : JoinEdges(edges, 9)) {
      RC_ASSERT(chain.vertices.size() >= (chain.closed ? 3u : 2u));
      for (size_t k = 0; k + 1 < chain.vertices.size(); ++k) {
        made.insert(std::minmax(chain.vertices[k], chain.vertices[k + 1]));
      }
      if (chain.closed) made.insert(std::minmax(chain.vertices.back(), chain.vertices.front()));
    }
    RC_ASSERT(std::vector(made.begin(), made.end()) == std::vector(given.begin(), given.end()));
  });
}

}  // namespace
}  // namespace fjord
