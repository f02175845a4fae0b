#include "engine/exact/elimination.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/exact/vertex_cover.hpp"
#include "engine/rows/contacts.hpp"

namespace grainsweep {

namespace {

constexpr std::size_t few_grains = 12;  // not worth a plane

class TreeDissection {
 public:
  TreeDissection(std::span<const Record<double>> centres, const std::vector<GrainPair>& pairs)
      : centres_(centres), part_(centres.size(), 0), number_(centres.size(), none) {
    const auto visit_partners = [&](const auto& put) {
      for (const GrainPair pair : pairs) put(pair.a, pair.b), put(pair.b, pair.a);
    };
    collect(centres.size(), visit_partners, neighbours_);
    std::vector<std::int32_t> all(centres.size());
    std::iota(all.begin(), all.end(), 0);
    dissect(all.begin(), all.end());
    number_grains();
    for (EliminationNode& node : tree_.nodes) find_border(node);
  }
  EliminationTree take_tree() { return std::move(tree_); }

 private:
  using At = std::vector<std::int32_t>::iterator;
  static constexpr std::int32_t none = -1;

  /// Adds the nodes of some grains; returns the last one.
  std::int32_t dissect(At first, At last) {
    EliminationNode node;
    if (static_cast<std::size_t>(last - first) <= few_grains) {
      node.grains.assign(first, last);
    } else {
      const Halving halving = best_halving(first, last);
      std::copy(halving.order.begin(), halving.order.end(), first);
      const auto [parting, end] = part(first, first + halving.middle, last, halving.parting_grains);
      node.grains.assign(end, last);
      node.children = {dissect(first, parting), dissect(parting, end)};
    }
    tree_.nodes.push_back(std::move(node));
    return static_cast<std::int32_t>(tree_.nodes.size()) - 1;
  }

  double coordinate(std::int32_t grain, int axis) const {
    const Record<double>& p = centres_[static_cast<std::size_t>(grain)];
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }

  struct Halving {
    std::vector<std::int32_t> order;  ///< the first half, then the second
    std::ptrdiff_t middle = 0;        ///< where that begins
    std::vector<std::int32_t> parting_grains;
  };
  /// Along the axis that leaves the fewest grains to part the halves, the first of several.
  Halving best_halving(At first, At last) {
    Halving best;
    for (int axis = 0; axis < 3; ++axis) {
      const At middle = halve_along(axis, first, last);
      std::vector<std::int32_t> parting = cover(first, middle, last);
      if (axis == 0 || parting.size() < best.parting_grains.size()) {
        best = {{first, last}, middle - first, std::move(parting)};
      }
    }
    return best;
  }

  /// Sorts grains by their coordinate along an axis, those with the same by their number. Returns
  /// where the second half begins, which is larger by one if the number is odd.
  At halve_along(int axis, At first, At last) const {
    std::sort(first, last, [&](std::int32_t p, std::int32_t q) {
      return std::pair(coordinate(p, axis), p) < std::pair(coordinate(q, axis), q);
    });
    return first + (last - first) / 2;
  }

  /// Puts the parting grains behind all others. Returns where the rest of the second half begins,
  /// and its end.
  std::pair<At, At> part(At first, At middle, At last, const std::vector<std::int32_t>& grains) {
    const std::int32_t parting = ++parts_;
    for (const std::int32_t grain : grains) part_of(grain) = parting;
    const auto stays = [&](std::int32_t grain) { return part_of(grain) != parting; };
    const At begin = std::stable_partition(first, middle, stays);
    const At end = std::stable_partition(middle, last, stays);
    return {begin, std::rotate(begin, middle, end)};
  }
  /// The fewest grains that have one of every two neighbours in different halves.
  std::vector<std::int32_t> cover(At first, At middle, At last) {
    const std::int32_t above = ++parts_;
    std::for_each(first, middle, [&](std::int32_t grain) { part_of(grain) = none; });
    std::for_each(middle, last, [&](std::int32_t grain) { part_of(grain) = above; });
    Partners partners;
    std::vector<std::int32_t> below_grains, above_grains;
    for (At at = first; at != middle; ++at) {
      std::vector<std::int32_t> own;
      for (const std::int32_t partner : neighbours_.of(*at)) {
        if (part_of(partner) != above) continue;
        std::int32_t& number = number_[static_cast<std::size_t>(partner)];
        if (number == none) {
          number = static_cast<std::int32_t>(above_grains.size());
          above_grains.push_back(partner);
        }
        own.push_back(number);
      }
      if (own.empty()) continue;
      below_grains.push_back(*at);
      partners.push_back(std::move(own));
    }
    for (const std::int32_t grain : above_grains) number_[static_cast<std::size_t>(grain)] = none;
    const VertexCover taken = smallest_cover(partners, above_grains.size());
    std::vector<std::int32_t> grains;
    const auto take = [&](const std::vector<std::int32_t>& side, const auto& flags) {
      for (std::size_t k = 0; k < side.size(); ++k) {
        if (flags[k] != 0) grains.push_back(side[k]);
      }
    };
    take(below_grains, taken.left);
    take(above_grains, taken.right);
    return grains;
  }
  std::int32_t& part_of(std::int32_t grain) { return part_[static_cast<std::size_t>(grain)]; }

  void number_grains() {
    tree_.place.resize(centres_.size());
    tree_.node_of.resize(centres_.size());
    std::int32_t place = 0;
    for (std::size_t k = 0; k < tree_.nodes.size(); ++k) {
      for (const std::int32_t grain : tree_.nodes[k].grains) {
        tree_.place[static_cast<std::size_t>(grain)] = place++;
        tree_.node_of[static_cast<std::size_t>(grain)] = static_cast<std::int32_t>(k);
      }
    }
    eliminated_ = 0;
  }

  /// Of the next node.
  void find_border(EliminationNode& node) {
    eliminated_ += static_cast<std::int32_t>(node.grains.size());
    const auto place = [&](std::int32_t grain) {
      return tree_.place[static_cast<std::size_t>(grain)];
    };
    const auto add = [&](std::span<const std::int32_t> grains) {
      std::copy_if(grains.begin(), grains.end(), std::back_inserter(node.border),
                   [&](std::int32_t grain) { return place(grain) >= eliminated_; });
    };
    for (const std::int32_t grain : node.grains) add(neighbours_.of(grain));
    for (const std::int32_t child : node.children) {
      if (child != EliminationNode::none) add(tree_.nodes[static_cast<std::size_t>(child)].border);
    }
    std::sort(node.border.begin(), node.border.end(),
              [&](std::int32_t p, std::int32_t q) { return place(p) < place(q); });
    node.border.erase(std::unique(node.border.begin(), node.border.end()), node.border.end());
  }

  std::span<const Record<double>> centres_;
  ByGrain<std::int32_t> neighbours_;
  std::vector<std::int32_t> part_;  ///< of each grain, the one it was last sorted into
  std::int32_t parts_ = 0;
  std::vector<std::int32_t> number_;  ///< of each grain among those that touch the half at work
  std::int32_t eliminated_ = 0;       ///< grains up to a node
  EliminationTree tree_;
};

}  // namespace

EliminationTree dissect(std::span<const Record<double>> centres,
                        const std::vector<GrainPair>& pairs) {
  return TreeDissection(centres, pairs).take_tree();
}

}  // namespace grainsweep
