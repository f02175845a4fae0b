#include "engine/exact/vertex_cover.hpp"

#include <utility>

namespace grainsweep {

namespace {

constexpr std::int32_t none = -1;

std::size_t index(std::int32_t vertex) { return static_cast<std::size_t>(vertex); }

/// Edges of which no two meet.
class Matching {
 public:
  Matching(const Partners& partners, std::size_t right)
      : partners_(partners), of_left_(partners.size(), none), of_right_(right, none) {
    for (std::size_t vertex = 0; vertex < partners.size(); ++vertex) {
      seen_.assign(right, 0);
      extend(static_cast<std::int32_t>(vertex));
    }
  }

  /// A left vertex is taken unless a path from one without an edge, every second edge of it in the
  /// matching, leads to it; a right one if such a path does.
  VertexCover cover() {
    seen_.assign(of_right_.size(), 0);
    VertexCover taken{std::vector<std::uint8_t>(of_left_.size(), 1), {}};
    for (std::size_t vertex = 0; vertex < of_left_.size(); ++vertex) {
      if (of_left_[vertex] == none) reach(static_cast<std::int32_t>(vertex), taken.left);
    }
    taken.right = std::move(seen_);
    return taken;
  }

 private:
  /// Gives a left vertex an edge, others another one for it, if there is a way to (Kuhn 1955).
  bool extend(std::int32_t left) {
    for (const std::int32_t right : partners_[index(left)]) {
      if (std::exchange(seen_[index(right)], 1) != 0) continue;
      std::int32_t& other = of_right_[index(right)];
      if (other != none && !extend(other)) continue;
      other = left;
      of_left_[index(left)] = right;
      return true;
    }
    return false;
  }
  /// Every left vertex that has no edge or is reached is not taken.
  void reach(std::int32_t left, std::vector<std::uint8_t>& taken) {
    taken[index(left)] = 0;
    for (const std::int32_t right : partners_[index(left)]) {
      if (std::exchange(seen_[index(right)], 1) != 0) continue;
      reach(of_right_[index(right)], taken);  // if there were none, the matching could be extended
    }
  }

  const Partners& partners_;
  std::vector<std::int32_t> of_left_, of_right_;  ///< the partner of each vertex in the matching
  std::vector<std::uint8_t> seen_;                ///< right vertices on the paths so far
};

}  // namespace

VertexCover smallest_cover(const Partners& partners, std::size_t right) {
  return Matching(partners, right).cover();
}

}  // namespace grainsweep
