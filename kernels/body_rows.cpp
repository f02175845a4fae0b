// Solver sweeps over contacts of polyhedra. The motion of both grains is loaded once for all
// points of a contact, and their impulses are joined before they are stored.
#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

using grainsweep::BodyBlock;
using grainsweep::BodyPoints;
using grainsweep::BodyRows;
using grainsweep::Missed;
using grainsweep::Record;
using grainsweep::SweepRule;
using grainsweep::SweepSums;

/// to += k v.
template <class Real>
inline void add(const Batch<Real>& k, const Vectors<Real>& v, Vectors<Real>& to) {
  to.x += k * v.x;
  to.y += k * v.y;
  to.z += k * v.z;
}

/// One hardware batch of contacts.
template <class Real>
struct Contacts {
  const std::uint32_t* a;
  const std::uint32_t* b;
  Vectors<Real> normal;
};

template <class Real>
inline Contacts<Real> load_contacts(const BodyBlock<Real>& block, std::size_t lane) {
  return {block.offset_a + lane,
          block.offset_b + lane,
          {load(block.normal_x + lane), load(block.normal_y + lane), load(block.normal_z + lane)}};
}

/// One point of each.
template <class Real>
struct Points {
  Vectors<Real> lever_a, lever_b;
  Batch<Real> gap;
};

template <class Real>
inline Vectors<Real> load_vectors(const Real (&from)[3][block_width], std::size_t lane) {
  return {load(from[0] + lane), load(from[1] + lane), load(from[2] + lane)};
}
template <class Real>
inline Points<Real> load_points(const BodyPoints<Real>& points, std::size_t lane) {
  return {load_vectors(points.lever_a, lane), load_vectors(points.lever_b, lane),
          load(points.gap + lane)};
}

/// Both records of the grains on one side of a batch of contacts: displacements, then turns. Number
/// types for which the instruction set can do better have their own functions of these names.
template <class Real>
using Side = TwoRecords<Components<Real>>;

template <class Real>
inline Side<Real> load_both(const Record<Real>* u, const std::uint32_t* offset) {
  return {load_records(u, offset), load_records(u + 1, offset)};
}
template <class Real>
inline void add_both(Record<Real>* base, const std::uint32_t* offset, const Side<Real>& side) {
  add_records(base, offset, side.first);
  add_records(base + 1, offset, side.second);
}

/// The part of their grains' motion that the points of a contact share.
template <class Real>
struct Motion {
  Batch<Real> approach;  ///< n . (v_b - v_a)
  Vectors<Real> turn_a, turn_b;
};

template <class Real>
inline Motion<Real> motion_of(const Vectors<Real>& normal, const Side<Real>& a,
                              const Side<Real>& b) {
  return {dot(normal, {b.first.x - a.first.x, b.first.y - a.first.y, b.first.z - a.first.z}),
          {a.second.x, a.second.y, a.second.z},
          {b.second.x, b.second.y, b.second.z}};
}

/// The gap after the motion.
template <class Real>
inline Batch<Real> gap_after(const Points<Real>& r, const Motion<Real>& m) {
  return r.gap + (m.approach + (dot(r.lever_b, m.turn_b) - dot(r.lever_a, m.turn_a)));
}

/// What the points of a contact add up to.
template <class Real>
struct Push {
  Batch<Real> normal = Batch<Real>(Real(0));
  Vectors<Real> turn_a{normal, normal, normal}, turn_b{normal, normal, normal};

  void add_point(const Points<Real>& r, const Batch<Real>& p) {
    normal += p;
    add(p, r.lever_a, turn_a);
    add(p, r.lever_b, turn_b);
  }
};

template <class Real>
inline void store_push(const Contacts<Real>& c, const Push<Real>& push, Record<Real>* accumulated) {
  const Batch<Real> zero(Real(0)), x = push.normal * c.normal.x, y = push.normal * c.normal.y,
                                   z = push.normal * c.normal.z;
  const Vectors<Real>&a = push.turn_a, &b = push.turn_b;
  add_both(
      accumulated, c.a,
      Side<Real>{{zero - x, zero - y, zero - z, zero}, {zero - a.x, zero - a.y, zero - a.z, zero}});
  add_both(accumulated, c.b, Side<Real>{{x, y, z, zero}, {b.x, b.y, b.z, zero}});
}

/// Calls visit(contacts, block, lane, k) for every hardware batch k of every block.
template <class Real, class Visit>
inline void visit_contacts(BodyRows<Real> rows, std::size_t blocks, Visit visit) {
  for (std::size_t at = 0; at < blocks; ++at) {
    const BodyBlock<Real>& block = rows.blocks[at];
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      visit(load_contacts(block, lane), block, lane, k);
    }
  }
}

template <class Real>
inline void store_side(Record<Real>* u, const std::uint32_t* offset, const Side<Real>& side) {
  store_records(u, offset, side.first);
  store_records(u + 1, offset, side.second);
}
/// An impulse p along the normal, of either sign.
template <class Real>
inline void push_side(const Batch<Real>& p, const Vectors<Real>& normal, const Vectors<Real>& lever,
                      Side<Real>& side) {
  side.first.x += side.first.w * (p * normal.x);
  side.first.y += side.first.w * (p * normal.y);
  side.first.z += side.first.w * (p * normal.z);
  side.second.x += side.second.w * (p * lever.x);
  side.second.y += side.second.w * (p * lever.y);
  side.second.z += side.second.w * (p * lever.z);
}

/// The residual of a point's row before it is solved, as an impulse, and its impulse after.
template <class Real>
struct Solved {
  Batch<Real> missed, impulse;
};

/// Solves the row of a point that has the impulse `before`: moves both of its grains by the change.
template <class Real>
inline Solved<Real> solve_point(const BodyPoints<Real>& points, std::size_t lane,
                                const Vectors<Real>& normal, const Batch<Real>& before,
                                const Batch<Real>& relaxation, Side<Real>& a, Side<Real>& b) {
  const Batch<Real> zero(Real(0));
  const Points<Real> r = load_points(points, lane);
  const Batch<Real> w = gap_after(r, motion_of(normal, a, b)) * load(points.reduced_mass + lane);
  const Batch<Real> after = xsimd::max(zero, before - w * relaxation), given = after - before;
  push_side(zero - given, normal, r.lever_a, a);
  push_side(given, normal, r.lever_b, b);
  return {w, after};
}

template <class Real>
SweepSums<Real> gauss_seidel_sweep(BodyRows<Real> rows, std::size_t blocks, Record<Real>* u,
                                   Real* p, Real* y, SweepRule<Real> rule) {
  LaneMissed<Real> missed;
  LaneSums<Real> restart_test(Real(0));
  const Batch<Real> relaxation(rule.relaxation), carry(rule.momentum);
  visit_contacts(rows, blocks, [&](const auto& c, const auto& block, auto lane, auto k) {
    Side<Real> a = load_both(u, c.a), b = load_both(u, c.b);
    const bool goes_back = block.points > grainsweep::most_points_swept_once;
    const std::size_t end = block.first + block.points;
    const auto leave = [&](const Batch<Real>& before, const Batch<Real>& p_new, std::size_t at) {
      const Batch<Real> change = p_new - load(p + at);
      restart_test.part[k] += (before - p_new) * change;
      p_new.store_unaligned(p + at);
      (p_new + carry * change).store_unaligned(y + at);
    };
    for (std::size_t i = block.first; i < end; ++i) {
      const std::size_t at = i * block_width + lane;
      const Batch<Real> before = load(y + at);
      const Solved<Real> now =
          solve_point(rows.points[i], lane, c.normal, before, relaxation, a, b);
      missed.add(k, natural_residual(before, now.missed), now.impulse, a.first.w, b.first.w);
      if (goes_back) {
        restart_test.part[k] += (before - now.impulse) * (now.impulse - load(p + at));
        now.impulse.store_unaligned(y + at);
      } else {
        leave(before, now.impulse, at);
      }
    }
    for (std::size_t i = end; goes_back && i-- > block.first;) {
      const std::size_t at = i * block_width + lane;
      const Batch<Real> before = load(y + at);
      leave(before, solve_point(rows.points[i], lane, c.normal, before, relaxation, a, b).impulse,
            at);
    }
    store_side(u, c.a, a);
    store_side(u, c.b, b);
  });
  return {missed.sums(), restart_test.sum()};
}

template <class Real>
void accumulate_impulses(BodyRows<Real> rows, std::size_t blocks, const Real* p,
                         Record<Real>* accumulated) {
  visit_contacts(rows, blocks, [&](const auto& c, const auto& block, auto lane, auto) {
    Push<Real> push;
    for (std::size_t i = block.first; i < block.first + block.points; ++i) {
      push.add_point(load_points(rows.points[i], lane), load(p + i * block_width + lane));
    }
    store_push(c, push, accumulated);
  });
}

template <class Real>
Missed<Real> residual(BodyRows<Real> rows, std::size_t blocks, const Record<Real>* u,
                      const Real* p) {
  LaneMissed<Real> missed;
  visit_contacts(rows, blocks, [&](const auto& c, const auto& block, auto lane, auto k) {
    const Side<Real> a = load_both(u, c.a), b = load_both(u, c.b);
    const Motion<Real> m = motion_of(c.normal, a, b);
    for (std::size_t i = block.first; i < block.first + block.points; ++i) {
      const BodyPoints<Real>& points = rows.points[i];
      const Batch<Real> w =
          gap_after(load_points(points, lane), m) * load(points.reduced_mass + lane);
      const Batch<Real> impulse = load(p + i * block_width + lane);
      missed.add(k, natural_residual(impulse, w), impulse, a.first.w, b.first.w);
    }
  });
  return missed.sums();
}

template <class Real>
void move_gaps(BodyRows<Real> rows, std::size_t blocks, const Record<Real>* u, Real correction,
               BodyPoints<Real>* moved) {
  const Batch<Real> zero(Real(0)), share(correction);
  visit_contacts(rows, blocks, [&](const auto& c, const auto& block, auto lane, auto) {
    const Motion<Real> m = motion_of(c.normal, load_both(u, c.a), load_both(u, c.b));
    for (std::size_t i = block.first; i < block.first + block.points; ++i) {
      Points<Real> r = load_points(rows.points[i], lane);
      r.gap = xsimd::select(r.gap < zero, r.gap / share, r.gap);
      const Batch<Real> gap = gap_after(r, m);
      xsimd::select(gap < zero, share * gap, gap).store_unaligned(moved[i].gap + lane);
    }
  });
}

template <class Real>
constexpr grainsweep::BodyKernels<Real> table() {
  return {gauss_seidel_sweep<Real>, accumulate_impulses<Real>, residual<Real>, move_gaps<Real>};
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {
extern const BodyKernels<float> body_kernels_f32 = table<float>();
extern const BodyKernels<double> body_kernels_f64 = table<double>();
}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
