// The fewest vertices of a bipartite graph that include an end of each of its edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grainsweep {

/// The edges of a graph between left vertices 0, 1, 2 .. and right ones: the partners of each left
/// one.
using Partners = std::vector<std::vector<std::int32_t>>;

/// 1 for each vertex that is taken, 0 for others.
struct VertexCover {
  std::vector<std::uint8_t> left, right;
};

/// It has as many vertices as the largest set of edges of which no two meet (Koenig 1931). If there
/// are several such covers, it is the same one every time. `right`: number of right vertices.
VertexCover smallest_cover(const Partners& partners, std::size_t right);

}  // namespace grainsweep
