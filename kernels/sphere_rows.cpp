// Solver sweeps over rows of frictionless sphere contacts, and the narrow phase that fills the
// rows.
#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

using grainsweep::Missed;
using grainsweep::Record;
using grainsweep::RowBlock;
using grainsweep::SweepRule;
using grainsweep::SweepSums;

/// One hardware batch of rows.
template <class Real>
struct Rows {
  const std::uint32_t* a;
  const std::uint32_t* b;
  Batch<Real> nx, ny, nz, gap, reduced_mass;
};

template <class Real>
inline Rows<Real> load_rows(const RowBlock<Real>& block, std::size_t lane) {
  return {block.offset_a + lane,          block.offset_b + lane,       load(block.normal_x + lane),
          load(block.normal_y + lane),    load(block.normal_z + lane), load(block.gap + lane),
          load(block.reduced_mass + lane)};
}

/// w / A: the gap after the relative motion u_b - u_a, times the reduced mass.
template <class Real>
inline Batch<Real> scaled_gap(const Rows<Real>& r, const Components<Real>& relative) {
  const Batch<Real> approach = r.nx * relative.x + r.ny * relative.y + r.nz * relative.z;
  return (r.gap + approach) * r.reduced_mass;
}

/// Impulses p along the normals, as vectors; the fourth component is 0.
template <class Real>
inline Components<Real> along_normals(const Rows<Real>& r, const Batch<Real>& p) {
  return {p * r.nx, p * r.ny, p * r.nz, Batch<Real>(Real(0))};
}

template <class Real>
void apply_impulses(const Record<Real>* free, std::size_t count, Record<Real>* accumulated,
                    Record<Real>* u) {
  constexpr std::size_t few = records_at_once<Real>;
  const std::size_t whole = count - count % few;
  for (std::size_t i = 0; i < whole; i += few) apply_to_records(free + i, accumulated + i, u + i);
  for (std::size_t i = whole; i < count; ++i) {
    const Record<Real> from = free[i], push = accumulated[i];
    u[i] = {from.x + from.w * push.x, from.y + from.w * push.y, from.z + from.w * push.z,
            from.w + from.w * push.w};
    accumulated[i] = {};
  }
}

/// The motion u of grains that take the push of a contact.
template <class Real>
inline Components<Real> pushed(const Components<Real>& u, const Components<Real>& push) {
  return {u.x + u.w * push.x, u.y + u.w * push.y, u.z + u.w * push.z, u.w};
}

template <class Real>
inline Components<Real> pushed_back(const Components<Real>& u, const Components<Real>& push) {
  return {u.x - u.w * push.x, u.y - u.w * push.y, u.z - u.w * push.z, u.w};
}

template <class Real>
inline Components<Real> difference(const Components<Real>& b, const Components<Real>& a) {
  return {b.x - a.x, b.y - a.y, b.z - a.z, b.w};
}

/// What impulses are counted from: nothing, or a column of impulses.
struct Nothing {};

template <class Real>
inline Batch<Real> least(Nothing, std::size_t) {
  return Batch<Real>(Real(0));
}
template <class Real>
inline Batch<Real> whole(const Batch<Real>& impulse, Nothing, std::size_t) {
  return impulse;
}
/// A change may take away the whole impulse that it is counted from, no more.
template <class Real>
inline Batch<Real> least(const Real* from, std::size_t at) {
  return Batch<Real>(Real(0)) - load(from + at);
}
template <class Real>
inline Batch<Real> whole(const Batch<Real>& impulse, const Real* from, std::size_t at) {
  return load(from + at) + impulse;
}

template <class Real, class From>
SweepSums<Real> any_sweep(const RowBlock<Real>* rows, std::size_t blocks, From from,
                          Record<Real>* u, Real* p, Real* y, SweepRule<Real> rule) {
  LaneMissed<Real> missed;
  LaneSums<Real> restart_test(Real(0));
  const Batch<Real> relaxation(rule.relaxation), carry(rule.momentum);
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const std::size_t at = block * block_width + lane;
      const Rows<Real> r = load_rows(rows[block], lane);
      const Components<Real> u_a = load_records(u, r.a), u_b = load_records(u, r.b);
      const Batch<Real> w = scaled_gap(r, difference(u_b, u_a));
      const Batch<Real> y_old = load(y + at), p_old = load(p + at);
      const Batch<Real> p_new = xsimd::max(least<Real>(from, at), y_old - w * relaxation);
      const Batch<Real> change = p_new - p_old, taken_back = y_old - p_new;
      const Components<Real> push = along_normals(r, p_new - y_old);
      missed.add(k, natural_residual(whole(y_old, from, at), w), whole(p_new, from, at), u_a.w,
                 u_b.w);
      restart_test.part[k] += taken_back * change;
      p_new.store_unaligned(p + at);
      (p_new + carry * change).store_unaligned(y + at);
      store_records(u, r.a, pushed_back(u_a, push));
      store_records(u, r.b, pushed(u_b, push));
    }
  }
  return {missed.sums(), restart_test.sum()};
}

template <class Real>
SweepSums<Real> gauss_seidel_sweep(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                                   Record<Real>* u, Real* p, Real* y, SweepRule<Real> rule) {
  return from == nullptr ? any_sweep(rows, blocks, Nothing{}, u, p, y, rule)
                         : any_sweep(rows, blocks, from, u, p, y, rule);
}
template <class Real>
void extrapolate(Real momentum, std::size_t count, Record<Real>* before, Record<Real>* u) {
  constexpr std::size_t numbers_of_record = 4;
  const Batch<Real> carry(momentum);
  Real* const last = &before->x;
  Real* const now = &u->x;
  const std::size_t numbers = count * numbers_of_record,
                    whole = numbers - numbers % batch_width<Real>;
  for (std::size_t i = 0; i < whole; i += batch_width<Real>) {
    const Batch<Real> here = load(now + i);
    (here + carry * (here - load(last + i))).store_unaligned(now + i);
    here.store_unaligned(last + i);
  }
  for (std::size_t i = whole; i < numbers; ++i) {
    const Real here = now[i];
    now[i] = here + momentum * (here - last[i]);
    last[i] = here;
  }
}

template <class Real>
void extrapolate_grains(Real momentum, const std::int32_t* grains, std::size_t count,
                        std::size_t records, Record<Real>* before, Record<Real>* u) {
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t first = records * static_cast<std::size_t>(grains[k]);
    for (std::size_t i = first; i < first + records; ++i) {
      const Record<Real> here = u[i], last = before[i];
      u[i] = {here.x + momentum * (here.x - last.x), here.y + momentum * (here.y - last.y),
              here.z + momentum * (here.z - last.z), here.w + momentum * (here.w - last.w)};
      before[i] = here;
    }
  }
}

template <class Real>
void accumulate_impulses(const RowBlock<Real>* rows, std::size_t blocks, const Real* p,
                         Record<Real>* accumulated) {
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const Rows<Real> r = load_rows(rows[block], lane);
      const Batch<Real> impulse = load(p + block * block_width + lane);
      push_records(accumulated, r.a, r.b, along_normals(r, impulse));
    }
  }
}

template <class Real, class From>
Missed<Real> any_residual(const RowBlock<Real>* rows, std::size_t blocks, From from,
                          const Record<Real>* u, const Real* p) {
  LaneMissed<Real> missed;
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const std::size_t at = block * block_width + lane;
      const Rows<Real> r = load_rows(rows[block], lane);
      const Components<Real> u_a = load_records(u, r.a), u_b = load_records(u, r.b);
      const Batch<Real> w = scaled_gap(r, difference(u_b, u_a));
      const Batch<Real> impulse = whole(load(p + at), from, at);
      missed.add(k, natural_residual(impulse, w), impulse, u_a.w, u_b.w);
    }
  }
  return missed.sums();
}

template <class Real>
Missed<Real> residual(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                      const Record<Real>* u, const Real* p) {
  return from == nullptr ? any_residual(rows, blocks, Nothing{}, u, p)
                         : any_residual(rows, blocks, from, u, p);
}
/// Two components of vectors.
template <class Real>
struct Planar {
  Batch<Real> x, y;
};

template <class Real>
inline Planar<Real> operator-(const Planar<Real>& v, const Planar<Real>& w) {
  return {v.x - w.x, v.y - w.y};
}
template <class Real>
inline Batch<Real> dot(const Planar<Real>& v, const Planar<Real>& w) {
  return v.x * w.x + v.y * w.y;
}
template <class Real>
inline Planar<Real> operator+(const Planar<Real>& v, const Planar<Real>& w) {
  return {v.x + w.x, v.y + w.y};
}
template <class Real>
inline Planar<Real> load_planar(const Real* from) {
  return {load(from), load(from + block_width)};
}
template <class Real>
inline Planar<Real> whole(const Planar<Real>& impulse, Nothing, std::size_t) {
  return impulse;
}
template <class Real>
inline Planar<Real> change_to(const Planar<Real>& impulse, Nothing, std::size_t) {
  return impulse;
}
template <class Real>
inline Planar<Real> whole(const Planar<Real>& impulse, const Real* from, std::size_t at) {
  return load_planar(from + at) + impulse;
}
template <class Real>
inline Planar<Real> change_to(const Planar<Real>& impulse, const Real* from, std::size_t at) {
  return impulse - load_planar(from + at);
}
template <class Real>
inline void store(const Planar<Real>& from, Real* to) {
  from.x.store_unaligned(to);
  from.y.store_unaligned(to + block_width);
}

/// One hardware batch of contacts with a round wall.
template <class Real>
struct RoundRows {
  const std::uint32_t* a;
  Planar<Real> centre;       ///< from the axis
  Batch<Real> mass, beyond;  ///< beyond: |centre|^2 less the squared radius of the circle
};

template <class Real>
inline RoundRows<Real> load_round_rows(const RowBlock<Real>* pair, std::size_t lane) {
  return {pair[0].offset_a + lane,
          {load(pair[0].gap + lane), load(pair[1].gap + lane)},
          load(pair[0].reduced_mass + lane),
          load(pair[1].reduced_mass + lane)};
}

/// The impulses that bring grains, which move by u with the impulses y, back into the circle, if a
/// share `relaxation` of the correction is taken. Only differences of the size of a motion are
/// subtracted.
template <class Real>
inline Planar<Real> round_impulse(const RoundRows<Real>& r, const Planar<Real>& u,
                                  const Planar<Real>& y, const Batch<Real>& relaxation) {
  const Batch<Real> zero(Real(0)), two(Real(2)), least(Real(1e-30));
  const Batch<Real> mass = r.mass * relaxation;
  const Planar<Real> v = {u.x - y.x / mass, u.y - y.y / mass};
  const Planar<Real> place = {r.centre.x + v.x, r.centre.y + v.y};
  const Batch<Real> distance = xsimd::sqrt(dot(place, place));
  const Batch<Real> radius = xsimd::sqrt(xsimd::max(zero, dot(r.centre, r.centre) - r.beyond));
  const Batch<Real> squares = r.beyond + two * dot(r.centre, v) + dot(v, v);
  const Batch<Real> outside = xsimd::max(zero, squares / xsimd::max(least, distance + radius));
  const Batch<Real> back = mass * outside / xsimd::max(least, distance);
  return {zero - back * place.x, zero - back * place.y};
}

template <class Real>
inline Batch<Real> round_missed(const RoundRows<Real>& r, const Planar<Real>& u,
                                const Planar<Real>& y) {
  const Planar<Real> miss = y - round_impulse(r, u, y, Batch<Real>(Real(1)));
  return xsimd::sqrt(dot(miss, miss));
}

template <class Real, class From>
SweepSums<Real> any_round_sweep(const RowBlock<Real>* rows, std::size_t blocks, From from,
                                Record<Real>* u, Real* p, Real* y, SweepRule<Real> rule) {
  LaneMissed<Real> missed;
  LaneSums<Real> restart_test(Real(0));
  const Batch<Real> zero(Real(0)), relaxation(rule.relaxation), carry(rule.momentum);
  for (std::size_t block = 0; block < blocks; block += 2) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const std::size_t at = block * block_width + lane;
      const RoundRows<Real> r = load_round_rows(rows + block, lane);
      const Components<Real> u_a = load_records(u, r.a);
      const Planar<Real> y_old = load_planar(y + at), p_old = load_planar(p + at);
      const Planar<Real> y_whole = whole(y_old, from, at);
      const Planar<Real> p_whole = round_impulse(r, {u_a.x, u_a.y}, y_whole, relaxation);
      const Planar<Real> p_new = change_to(p_whole, from, at);
      const Planar<Real> change = p_new - p_old, push = p_new - y_old;
      missed.add(k, round_missed(r, {u_a.x, u_a.y}, y_whole), dot(p_whole, p_whole), u_a.w, zero);
      restart_test.part[k] -= dot(push, change);
      store(p_new, p + at);
      store<Real>({p_new.x + carry * change.x, p_new.y + carry * change.y}, y + at);
      store_records(u, r.a, pushed(u_a, {push.x, push.y, zero, zero}));
    }
  }
  return {missed.sums(), restart_test.sum()};
}

template <class Real>
SweepSums<Real> round_sweep(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                            Record<Real>* u, Real* p, Real* y, SweepRule<Real> rule) {
  return from == nullptr ? any_round_sweep(rows, blocks, Nothing{}, u, p, y, rule)
                         : any_round_sweep(rows, blocks, from, u, p, y, rule);
}
template <class Real, class From>
Missed<Real> any_round_residual(const RowBlock<Real>* rows, std::size_t blocks, From from,
                                const Record<Real>* u, const Real* p) {
  LaneMissed<Real> missed;
  const Batch<Real> zero(Real(0));
  for (std::size_t block = 0; block < blocks; block += 2) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const std::size_t at = block * block_width + lane;
      const RoundRows<Real> r = load_round_rows(rows + block, lane);
      const Components<Real> u_a = load_records(u, r.a);
      const Planar<Real> impulse = whole(load_planar(p + at), from, at);
      missed.add(k, round_missed(r, {u_a.x, u_a.y}, impulse), dot(impulse, impulse), u_a.w, zero);
    }
  }
  return missed.sums();
}

template <class Real>
Missed<Real> round_residual(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                            const Record<Real>* u, const Real* p) {
  return from == nullptr ? any_round_residual(rows, blocks, Nothing{}, u, p)
                         : any_round_residual(rows, blocks, from, u, p);
}
constexpr double far_apart = 1e300;

template <class Real>
double sphere_gaps(RowBlock<Real>* rows, std::size_t blocks, const Record<double>* positions,
                   double period_x, double period_y, double correction) {
  const double inverse_x = inverse_of(period_x), inverse_y = inverse_of(period_y);
  const Batch<double> repair(correction), zero(0.0), one(1.0), share(grainsweep::sunk_share);
  LaneSums<double> sunk(-far_apart);
  for (std::size_t block = 0; block < blocks; ++block) {
    RowBlock<Real>& r = rows[block];
    for (std::size_t k = 0; k < batches<double>; ++k) {
      const std::size_t lane = k * batch_width<double>;
      const Components<double> a = load_records<sizeof(Record<Real>)>(positions, r.offset_a + lane);
      const Components<double> b = load_records<sizeof(Record<Real>)>(positions, r.offset_b + lane);
      const Batch<double> x = nearest_image(b.x - a.x, period_x, inverse_x);
      const Batch<double> y = nearest_image(b.y - a.y, period_y, inverse_y);
      const Batch<double> z = b.z - a.z;
      const Batch<double> distance = xsimd::sqrt(x * x + y * y + z * z);
      const Batch<double> touching = a.w + b.w, gap = distance - touching;
      sunk.part[k] = xsimd::max(sunk.part[k], share * touching - distance);
      const auto apart = distance > zero;  // coinciding centres part upwards
      const Batch<double> length = xsimd::select(apart, distance, one);
      store_rounded(x / length, r.normal_x + lane);
      store_rounded(y / length, r.normal_y + lane);
      store_rounded(xsimd::select(apart, z, one) / length, r.normal_z + lane);
      store_rounded(xsimd::max(gap, zero) + repair * xsimd::min(gap, zero), r.gap + lane);
    }
  }
  return sunk.max();
}

template <class Real>
constexpr grainsweep::RowKernels<Real> table() {
  return {apply_impulses<Real>, gauss_seidel_sweep<Real>, round_sweep<Real>,
          extrapolate<Real>,    extrapolate_grains<Real>, accumulate_impulses<Real>,
          residual<Real>,       round_residual<Real>,     sphere_gaps<Real>};
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {
extern const RowKernels<float> row_kernels_f32 = table<float>();
extern const RowKernels<double> row_kernels_f64 = table<double>();
}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
