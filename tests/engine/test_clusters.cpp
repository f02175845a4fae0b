#include <catch2/catch.hpp>

#include "engine/clusters.hpp"

namespace grainsweep {
namespace {

TEST_CASE("what is joined, over others too, has one root, that of what it was joined to") {
  Clusters clusters(6);
  clusters.join(0, 1);
  clusters.join(2, 3);
  clusters.join(1, 3);
  for (const std::size_t k : {0u, 1u, 2u, 3u}) CHECK(clusters.root(k) == 3);
  CHECK(clusters.root(4) == 4);
  clusters.join(4, 4);
  CHECK(clusters.root(4) == 4);
  clusters.join(0, 5);
  CHECK(clusters.root(2) == 5);
}

}  // namespace
}  // namespace grainsweep
