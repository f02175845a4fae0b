#include "engine/rows/lever_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/rows/lanes.hpp"

namespace grainsweep {

namespace {

/// Lists the contacts by falling number of points, else in their order.
void sort_by_points(const ShapeContacts& found, std::vector<std::size_t>& order) {
  std::size_t most = 0;
  for (const ShapeContact& contact : found.contacts) most = std::max(most, contact.count);
  std::vector<std::size_t> place(most + 2, 0);  // place[k]: of the next one with most - k points
  for (const ShapeContact& contact : found.contacts) ++place[most - contact.count + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  order.resize(found.contacts.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[place[most - found.contacts[k].count]++] = k;
  }
}

/// Appends blocks of void contacts and hands out their lanes.
template <class Real>
class LeverBlocks {
 public:
  LeverBlocks(const PolyhedronBed& bed, LeverColumns<Real>& rows)
      : bed_(bed), rows_(rows), words_(bed.grains(), 0), open_(words_) {}

  /// Requires that no contact has more points than the one before it.
  BlockLane take(const ShapeContact& contact) {
    const std::int32_t b = bed_.is_grain(contact.b) ? contact.b : OpenBlocks::no_grain;
    const BlockLane at = open_.take(contact.a, b, [&] { return append_void_block(contact.count); });
    rows_.blocks[at.block].set_grains(at.lane, contact.a,
                                      bed_.is_grain(contact.b) ? contact.b : bed_.wall());
    return at;
  }

 private:
  std::size_t append_void_block(std::size_t points) {
    BodyBlock<Real> block{};
    block.first = static_cast<std::uint32_t>(rows_.points.size());
    block.points = static_cast<std::uint32_t>(points);
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      block.set_grains(lane, bed_.void_a(), bed_.void_b());
      block.normal_z[lane] = Real(1);
    }
    rows_.blocks.push_back(block);
    rows_.points.insert(rows_.points.end(), points, void_points());
    return rows_.blocks.size() - 1;
  }
  static BodyPoints<Real> void_points() {
    BodyPoints<Real> points{};
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      points.gap[lane] = points.reduced_mass[lane] = Real(1);
    }
    return points;
  }

  const PolyhedronBed& bed_;
  LeverColumns<Real>& rows_;
  std::vector<std::uint64_t> words_;
  OpenBlocks open_;
};

/// A row of a contact, before it is rounded and stored.
struct RowEntry {
  Vector lever_a, lever_b;

  /// A_kk of the row of two grains with these inverse masses.
  double diagonal(double inverse_masses) const {
    return inverse_masses + lever_a.squaredNorm() + lever_b.squaredNorm();
  }
};

/// The rows of one contact.
struct ContactRows {
  double inverse_masses = 0.0;  ///< 1/m_a + 1/m_b
  Vector normal;                ///< box frame
  std::vector<RowEntry> each;   ///< of each point
};

void add_side_b(const PolyhedronBed& bed, const ShapeContact& contact, const ContactPoint* points,
                ContactRows& rows) {
  const auto b = static_cast<std::size_t>(contact.b);
  const Vector& root = bed.root_inertia[b];
  for (std::size_t k = 0; k < contact.count; ++k) {
    const Vector torque = (points[k].position - contact.pose.centre).cross(contact.normal);
    rows.each[k].lever_b = (contact.pose.turn.transpose() * torque).cwiseQuotient(root);
  }
  rows.inverse_masses += bed.motion[b].w;
}

void set_rows(const PolyhedronBed& bed, const ShapeContact& contact, const ContactPoint* points,
              ContactRows& rows) {
  const auto a = static_cast<std::size_t>(contact.a);
  const Vector& root = bed.root_inertia[a];
  rows.inverse_masses = bed.motion[a].w;
  rows.normal = bed.pose(a).orientation * contact.normal;
  rows.each.assign(contact.count, {Vector::Zero(), Vector::Zero()});
  for (std::size_t k = 0; k < contact.count; ++k) {
    rows.each[k].lever_a = points[k].position.cross(contact.normal).cwiseQuotient(root);
  }
  if (bed.is_grain(contact.b)) add_side_b(bed, contact, points, rows);
}

template <class Real>
void store_row(const RowEntry& row, double inverse_masses, double gap, std::size_t lane,
               BodyPoints<Real>& points) {
  for (int axis = 0; axis < 3; ++axis) {
    points.lever_a[axis][lane] = static_cast<Real>(row.lever_a[axis]);
    points.lever_b[axis][lane] = static_cast<Real>(row.lever_b[axis]);
  }
  points.gap[lane] = static_cast<Real>(gap);
  points.reduced_mass[lane] = static_cast<Real>(1.0 / row.diagonal(inverse_masses));
}

template <class Real>
void store_normal(const Vector& normal, std::size_t lane, BodyBlock<Real>& block) {
  block.normal_x[lane] = static_cast<Real>(normal.x());
  block.normal_y[lane] = static_cast<Real>(normal.y());
  block.normal_z[lane] = static_cast<Real>(normal.z());
}

/// Calls visit(contact, point, impulse) for every point that pushed.
template <class Real, class Visit>
void visit_pushing(const ShapeContacts& found, const LeverPlaces& places,
                   const LeverColumns<Real>& rows, Visit visit) {
  for (std::size_t k = 0; k < places.first.size(); ++k) {
    const ShapeContact& contact = found.contacts[k];
    for (std::size_t j = 0; j < contact.count; ++j) {
      const auto impulse = static_cast<double>(rows.impulse[places.first[k] + j * block_width]);
      if (impulse > 0.0) visit(contact, found.points[contact.first + j], impulse);
    }
  }
}

std::size_t nearest_point(const ShapeContacts& found, const ShapeContact& contact,
                          const Vector& position) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t j = 0; j < contact.count; ++j) {
    const double squared = (found.points[contact.first + j].position - position).squaredNorm();
    best = squared < least ? j : best;
    least = std::min(least, squared);
  }
  return best;
}

}  // namespace

template <class Real>
void lay_out(const PolyhedronBed& bed, const ShapeContacts& found, double correction,
             LeverPlaces& places, LeverColumns<Real>& rows) {
  rows.blocks.clear();
  rows.points.clear();
  places.first.resize(found.contacts.size());
  LeverBlocks<Real> blocks(bed, rows);
  ContactRows own;
  sort_by_points(found, places.order);
  for (const std::size_t k : places.order) {
    const ShapeContact& contact = found.contacts[k];
    const ContactPoint* points = found.points.data() + contact.first;
    const auto at = blocks.take(contact);
    const std::size_t first = rows.blocks[at.block].first;
    places.first[k] = first * block_width + at.lane;
    set_rows(bed, contact, points, own);
    store_normal(own.normal, at.lane, rows.blocks[at.block]);
    for (std::size_t j = 0; j < contact.count; ++j) {
      const double gap = points[j].gap;
      store_row(own.each[j], own.inverse_masses, gap < 0.0 ? correction * gap : gap, at.lane,
                rows.points[first + j]);
    }
  }
  rows.shares.ranges.assign({{0, rows.blocks.size()}});
  rows.shares.parts.assign({{0, 0, 1, 0, 0}});
  rows.impulse.assign(rows.points.size() * block_width, Real(0));
  rows.extrapolated.assign(rows.impulse.size(), Real(0));
}

template <class Real>
void remember_impulses(const PolyhedronBed& bed, const ShapeContacts& found,
                       const LeverPlaces& places, const LeverColumns<Real>& rows,
                       CarriedPoints& carried) {
  std::vector<std::size_t>& begin = carried.begin;
  begin.assign(bed.grains() + 2, 0);
  std::size_t count = 0;
  visit_pushing(found, places, rows, [&](const ShapeContact& contact, const auto&, double) {
    ++begin[static_cast<std::size_t>(contact.a) + 2];
    ++count;
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  carried.points.resize(count);
  visit_pushing(found, places, rows,
                [&](const ShapeContact& contact, const ContactPoint& point, double impulse) {
                  carried.points[begin[static_cast<std::size_t>(contact.a) + 1]++] = {
                      contact.b, point.position, impulse};
                });
}

template <class Real>
void carry_impulses(const ShapeContacts& found, const CarriedPoints& carried,
                    const LeverPlaces& places, LeverColumns<Real>& rows) {
  for (std::size_t k = 0; k < found.contacts.size(); ++k) {
    const ShapeContact& contact = found.contacts[k];
    const auto a = static_cast<std::size_t>(contact.a);
    for (std::size_t i = carried.begin[a]; i < carried.begin[a + 1]; ++i) {
      const CarriedPoint& point = carried.points[i];
      if (point.other == contact.b) {
        const std::size_t j = nearest_point(found, contact, point.position);
        rows.impulse[places.first[k] + j * block_width] += static_cast<Real>(point.impulse);
      }
    }
  }
}

template void lay_out(const PolyhedronBed&, const ShapeContacts&, double, LeverPlaces&,
                      LeverColumns<float>&);
template void lay_out(const PolyhedronBed&, const ShapeContacts&, double, LeverPlaces&,
                      LeverColumns<double>&);
template void remember_impulses(const PolyhedronBed&, const ShapeContacts&, const LeverPlaces&,
                                const LeverColumns<float>&, CarriedPoints&);
template void remember_impulses(const PolyhedronBed&, const ShapeContacts&, const LeverPlaces&,
                                const LeverColumns<double>&, CarriedPoints&);
template void carry_impulses(const ShapeContacts&, const CarriedPoints&, const LeverPlaces&,
                             LeverColumns<float>&);
template void carry_impulses(const ShapeContacts&, const CarriedPoints&, const LeverPlaces&,
                             LeverColumns<double>&);

}  // namespace grainsweep
