#include "engine/dynamics/dissection.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/exact/halves.hpp"

namespace grainsweep {

namespace {

constexpr std::size_t few_contacts = 32;  // not worth a plane

class Dissection {
 public:
  Dissection(const std::vector<ContactNode>& contacts, std::size_t grains)
      : contacts_(contacts), order_(contacts.size()), below_(grains, 0), above_(grains, 0) {
    std::iota(order_.begin(), order_.end(), 0);
    dissect(order_.begin(), order_.end());
  }
  std::vector<std::int32_t> take_order() { return std::move(order_); }

 private:
  using At = std::vector<std::int32_t>::iterator;

  const ContactNode& node(std::int32_t contact) const {
    return contacts_[static_cast<std::size_t>(contact)];
  }
  template <class Visit>
  void visit_grains(std::int32_t contact, Visit visit) const {
    for (const std::int32_t grain : {node(contact).a, node(contact).b}) {
      if (grain != ContactNode::no_grain) visit(static_cast<std::size_t>(grain));
    }
  }

  void dissect(At first, At last) {
    if (static_cast<std::size_t>(last - first) <= few_contacts) return;
    const At middle = halve(first, last, [&](std::int32_t contact, int axis) {
      return node(contact).place[static_cast<std::size_t>(axis)];
    });
    count_grains(first, middle, last);
    const At below_end =
        std::stable_partition(first, middle, [&](std::int32_t k) { return !parts(k, true); });
    const At above_end =
        std::stable_partition(middle, last, [&](std::int32_t k) { return !parts(k, false); });
    const At taken_out = std::rotate(below_end, middle, above_end);
    dissect(first, below_end);
    dissect(below_end, taken_out);
  }

  /// Contacts of each grain on both sides of the middle.
  void count_grains(At first, At middle, At last) {
    for (At at = first; at != last; ++at) {
      visit_grains(*at, [&](std::size_t grain) { below_[grain] = above_[grain] = 0; });
    }
    for (At at = first; at != middle; ++at) {
      visit_grains(*at, [&](std::size_t grain) { ++below_[grain]; });
    }
    for (At at = middle; at != last; ++at) {
      visit_grains(*at, [&](std::size_t grain) { ++above_[grain]; });
    }
  }
  /// Whether a contact has to go for the halves to share no grain: of a grain with contacts on both
  /// sides those of the side with fewer do.
  bool parts(std::int32_t contact, bool is_below) const {
    bool found = false;
    visit_grains(contact, [&](std::size_t grain) {
      const bool is_shared = below_[grain] > 0 && above_[grain] > 0;
      found = found || (is_shared && (below_[grain] <= above_[grain]) == is_below);
    });
    return found;
  }

  const std::vector<ContactNode>& contacts_;
  std::vector<std::int32_t> order_;
  std::vector<int> below_, above_;
};

}  // namespace

std::vector<std::int32_t> dissect(const std::vector<ContactNode>& contacts, std::size_t grains) {
  return Dissection(contacts, grains).take_order();
}

}  // namespace grainsweep
