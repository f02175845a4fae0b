#include "engine/rows/polyhedron_contacts.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "engine/narrow/constraints.hpp"
#include "engine/rows/lanes.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

// A face is preferred to edges that part a pair by no more than this share of a step's free fall
// beyond it; with a smaller preference edges replace whole faces and the bed collapses.
constexpr double preferred_share = 0.5;
constexpr double min_preference = 1e-4;
constexpr double preferred_of_depth = 1.0;  // beyond its overlap

/// Lists the contacts by falling number of points, those with equally many in their order.
void sort_by_points(const ContactList& found, std::vector<std::size_t>& order) {
  std::size_t most = 0;
  for (const PolyhedronContact& contact : found.contacts) most = std::max(most, contact.count);
  std::vector<std::size_t> place(most + 2, 0);  // place[k]: of the next one with most - k points
  for (const PolyhedronContact& contact : found.contacts) ++place[most - contact.count + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  order.resize(found.contacts.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[place[most - found.contacts[k].count]++] = k;
  }
}

/// Appends blocks of void contacts to a part and hands out their lanes.
template <class Real>
class BodyBlocks {
 public:
  BodyBlocks(const PolyhedronBed& bed, std::size_t subdomain, std::vector<std::uint64_t>& words,
             ContactPart<Real>& part)
      : bed_(bed), subdomain_(subdomain), part_(part), open_(words) {}

  /// Requires that no contact has more points than the one before it.
  BlockLane take(const PolyhedronContact& contact) {
    const bool is_pair = bed_.is_grain(contact.b);
    const BlockLane at = open_.take(contact.a, is_pair ? contact.b : OpenBlocks::no_grain,
                                    [&] { return append_void_block(contact.count); });
    part_.blocks[at.block].set_grains(at.lane, contact.a,
                                      is_pair ? contact.b : bed_.wall(subdomain_));
    return at;
  }
  void close_all() { open_.close_all(); }

 private:
  std::size_t append_void_block(std::size_t points) {
    BodyBlock<Real> block{};
    block.first = static_cast<std::uint32_t>(part_.points.size());
    block.points = static_cast<std::uint32_t>(points);
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      block.set_grains(lane, bed_.void_a(subdomain_), bed_.void_b(subdomain_));
      block.normal_z[lane] = Real(1);
    }
    part_.blocks.push_back(block);
    part_.points.insert(part_.points.end(), points, void_points());
    return part_.blocks.size() - 1;
  }
  static BodyPoints<Real> void_points() {
    BodyPoints<Real> points{};
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      points.gap[lane] = points.reduced_mass[lane] = Real(1);
    }
    return points;
  }

  const PolyhedronBed& bed_;
  std::size_t subdomain_;
  ContactPart<Real>& part_;
  OpenBlocks open_;
};

/// The row of a point; of an overlap, the share that a step repairs counts.
template <class Real>
void store_row(const PolyhedronBed& bed, const PolyhedronContact& contact,
               const ContactPoint& point, double correction, std::size_t lane,
               BodyPoints<Real>& points) {
  const auto is_turned = [&](std::size_t i) { return bed.turns(i) && !bed.is_asleep(i); };
  const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
  Vector lever_a = Vector::Zero(), lever_b = Vector::Zero();
  double inverse_masses = bed.inverse_inertia(contact.a);
  if (is_turned(a)) {
    lever_a = point.position.cross(contact.normal).cwiseQuotient(bed.root_inertia[a]);
  }
  if (bed.is_grain(contact.b)) {
    inverse_masses += bed.inverse_inertia(contact.b);
    const Vector torque = (point.position - contact.pose.centre).cross(contact.normal);
    if (is_turned(b)) {
      lever_b = (contact.pose.turn.transpose() * torque).cwiseQuotient(bed.root_inertia[b]);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    points.lever_a[axis][lane] = static_cast<Real>(lever_a[axis]);
    points.lever_b[axis][lane] = static_cast<Real>(lever_b[axis]);
  }
  points.gap[lane] = static_cast<Real>(point.gap < 0.0 ? correction * point.gap : point.gap);
  points.reduced_mass[lane] =
      static_cast<Real>(1.0 / (inverse_masses + lever_a.squaredNorm() + lever_b.squaredNorm()));
}
template <class Real>
void store_normal(const Vector& normal, std::size_t lane, BodyBlock<Real>& block) {
  block.normal_x[lane] = static_cast<Real>(normal.x());
  block.normal_y[lane] = static_cast<Real>(normal.y());
  block.normal_z[lane] = static_cast<Real>(normal.z());
}

std::size_t nearest_point(const ContactList& found, const PolyhedronContact& contact,
                          const Vector& position) {
  double least = infinity;
  std::size_t best = 0;
  for (std::size_t j = 0; j < contact.count; ++j) {
    const double squared = (found.points[contact.first + j].position - position).squaredNorm();
    best = squared < least ? j : best;
    least = std::min(least, squared);
  }
  return best;
}

/// Rows of the contacts of a part, without impulses.
template <class Real>
void lay_out_part(const PolyhedronBed& bed, std::size_t subdomain, double correction,
                  std::vector<std::uint64_t>& words, ContactPart<Real>& part) {
  const ContactList& found = part.found;
  part.blocks.clear();
  part.points.clear();
  part.first.resize(found.contacts.size());
  BodyBlocks<Real> blocks(bed, subdomain, words, part);
  sort_by_points(found, part.order);
  for (const std::size_t k : part.order) {
    const PolyhedronContact& contact = found.contacts[k];
    const BlockLane at = blocks.take(contact);
    const std::size_t first = part.blocks[at.block].first;
    part.first[k] = first * block_width + at.lane;
    store_normal(bed.pose(static_cast<std::size_t>(contact.a)).orientation * contact.normal,
                 at.lane, part.blocks[at.block]);
    for (std::size_t j = 0; j < contact.count; ++j) {
      store_row(bed, contact, found.points[contact.first + j], correction, at.lane,
                part.points[first + j]);
    }
  }
  blocks.close_all();
  part.impulse.assign(part.points.size() * block_width, Real(0));
}

/// Gives each carried impulse to a point of the part's contacts.
template <class Real>
void carry_impulses(const ByGrain<CarriedPoint>& carried, ContactPart<Real>& part) {
  for (std::size_t k = 0; k < part.found.contacts.size(); ++k) {
    const PolyhedronContact& contact = part.found.contacts[k];
    for (const CarriedPoint& point : carried.of(contact.a)) {
      if (point.other != contact.b) continue;
      const std::size_t j = nearest_point(part.found, contact, point.position);
      part.impulse[part.first[k] + j * block_width] += static_cast<Real>(point.impulse);
    }
  }
}

/// Calls visit(part, k, force) for the contacts that bore a force in a step of length `dt`, part by
/// part.
template <class Real, class Visit>
void visit_bearing(const PolyhedronContacts<Real>& contacts, double dt, Visit visit) {
  for (std::size_t p = 0; p < contacts.found_parts; ++p) {
    const ContactPart<Real>& part = contacts.parts[p];
    for (std::size_t k = 0; k < part.found.contacts.size(); ++k) {
      double force = 0.0;
      for (std::size_t j = 0; j < part.found.contacts[k].count; ++j) {
        force += impulse_of(contacts, part, k, j) / (dt * dt);
      }
      if (force > least_force) visit(part, k, force);
    }
  }
}

std::array<float, 3> floats_of(const Vector& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Impulses of contacts times `factor`. Parts that are not neighbours name no grain in common.
template <class Real>
void collect_impulses(const PolyhedronBed& bed, const ParallelFor& loop, double factor,
                      const PolyhedronContacts<Real>& contacts, ByGrain<CarriedPoint>& carried) {
  const auto visit_all = [&](const auto& put) {
    visit_subdomains(contacts.found_parts, loop, [&](std::size_t p) {
      const ContactPart<Real>& part = contacts.parts[p];
      for (std::size_t k = 0; k < part.found.contacts.size(); ++k) {
        const PolyhedronContact& contact = part.found.contacts[k];
        for (std::size_t j = 0; j < contact.count; ++j) {
          const double impulse = factor * impulse_of(contacts, part, k, j);
          const Vector& place = part.found.points[contact.first + j].position;
          if (impulse > 0.0) put(contact.a, CarriedPoint{contact.b, place, impulse});
        }
      }
    });
  };
  collect(bed.grains(), visit_all, carried);
}

/// See Closure.
int by_turning(const PolyhedronBed& bed, const PolyhedronContact& contact) {
  if (!bed.is_grain(contact.b)) {
    // Corners at a round wall are named beyond the walls; they belong to grains that turn.
    if (bed.turns(static_cast<std::size_t>(contact.a))) return 0;
    return bed.walls[static_cast<std::size_t>(contact.b - bed.wall_name(0))].is_round() ? 1 : 0;
  }
  return contact.kind == AxisKind::ball_on_face   ? 2
         : contact.kind == AxisKind::ball_on_edge ? 1
                                                  : 0;
}

/// By how much a contact holds the turns of its grains, about their principal axes, as moments of
/// inertia.
struct Hold {
  Vector of_a = Vector::Zero(), of_b = Vector::Zero();
};

Vector about_axes_across(const Vector& normal) { return Vector::Ones() - normal.cwiseAbs2(); }

/// From the forces on its points, each times how far the point, or the centre of a sphere, lies
/// from the grain's centre along the normal.
template <class Real>
Hold hold_of(const PolyhedronContacts<Real>& contacts, const ContactPart<Real>& part, std::size_t k,
             const PolyhedronBed& bed) {
  const PolyhedronContact& c = part.found.contacts[k];
  double force = 0.0, arm_of_a = 0.0;
  for (std::size_t j = 0; j < c.count; ++j) {
    const double at_point = impulse_of(contacts, part, k, j);
    force += at_point;
    arm_of_a += at_point * part.found.points[c.first + j].position.dot(c.normal);
  }
  if (!(force > 0.0)) return {};
  const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
  const PairPose now = pair_pose(bed, a, b);  // a bed that was read back knows no older one
  const double arms = force * now.centre.dot(c.normal);
  const auto into_b = [&](const Vector& v) { return Vector(now.turn.transpose() * v); };
  const auto edge = [](const ConvexShape& shape, std::int32_t direction) {
    return shape.edge_directions[static_cast<std::size_t>(direction)];
  };
  switch (c.kind) {
    case AxisKind::face_of_a:
      return {arm_of_a * about_axes_across(c.normal), Vector::Zero()};
    case AxisKind::face_of_b:
      return {Vector::Zero(), (arms - arm_of_a) * about_axes_across(into_b(c.normal))};
    case AxisKind::edges:
      return {arm_of_a * (now.turn * edge(bed.shape(b), c.edges.of_b)).cwiseAbs2(),
              (arms - arm_of_a) * into_b(edge(bed.shape(a), c.edges.of_a)).cwiseAbs2()};
    case AxisKind::ball_on_face:
    case AxisKind::ball_on_edge:
      return {arms * about_axes_across(c.normal), arms * about_axes_across(into_b(c.normal))};
    default:
      return {};
  }
}

/// Adds a hold to the squares of root_inertia of grains that turn.
template <class Real>
void add_hold(const PolyhedronContacts<Real>& contacts, const ContactPart<Real>& part,
              std::size_t k, PolyhedronBed& bed) {
  const PolyhedronContact& c = part.found.contacts[k];
  if (!bed.is_grain(c.b)) return;
  const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
  const Hold hold = hold_of(contacts, part, k, bed);
  if (bed.turns(a)) bed.root_inertia[a] += hold.of_a.cwiseMax(0.0);
  if (bed.turns(b)) bed.root_inertia[b] += hold.of_b.cwiseMax(0.0);
}

template <class Change>
void visit_grains(const ParallelFor& loop, const PolyhedronBed& bed, const Change& change) {
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t, IndexRange grains) {
    for (std::size_t i = grains.first; i < grains.last; ++i) change(i);
  });
}

/// All contacts of a subdomain between the candidates. Returns what touch_pairs does.
template <class Real>
double touch_subdomain(const TouchSettings& settings, const Kernels& kernels,
                       const PolyhedronBed& bed, std::size_t subdomain,
                       PolyhedronContacts<Real>& contacts, NarrowColumns& columns,
                       ContactList& found) {
  const Subdomains& all = contacts.subdomains;
  const std::size_t begin = all.begin[subdomain], count = all.begin[subdomain + 1] - begin;
  found.clear();
  const std::span<PairMemory> memory(contacts.memory);
  const FarPairs far{contacts.travel.way, {contacts.far_until.data() + begin, count}};
  const double sunk =
      touch_pairs(settings, kernels, bed, {all.pairs.data() + begin, count}, far,
                  memory.empty() ? memory : memory.subspan(begin, count), columns, found);
  for (std::size_t k = 0; k < bed.walls.size(); ++k) {
    touch_wall(k, all.near_wall(k, subdomain), settings.margin, bed, found);
  }
  return sunk;
}

/// One column of rows out of those of all parts, which they leave empty.
template <class Real>
void join(const ParallelFor& loop, PolyhedronContacts<Real>& contacts,
          std::vector<std::size_t>& first_block) {
  first_block.assign(1, 0);
  std::vector<std::size_t> first_points(1, 0);
  for (std::size_t p = 0; p < contacts.found_parts; ++p) {
    first_block.push_back(first_block.back() + contacts.parts[p].blocks.size());
    first_points.push_back(first_points.back() + contacts.parts[p].points.size());
  }
  contacts.blocks.resize(first_block.back());
  contacts.points.resize(first_points.back());
  contacts.impulse.resize(first_points.back() * block_width);
  parallel_for(loop, contacts.found_parts, [&](std::size_t p) {
    ContactPart<Real>& part = contacts.parts[p];
    const std::size_t points = first_points[p];
    for (BodyBlock<Real>& block : part.blocks) block.first += static_cast<std::uint32_t>(points);
    for (std::size_t& first : part.first) first += points * block_width;
    std::copy(part.blocks.begin(), part.blocks.end(), contacts.blocks.data() + first_block[p]);
    std::copy(part.points.begin(), part.points.end(), contacts.points.data() + points);
    std::copy(part.impulse.begin(), part.impulse.end(),
              contacts.impulse.data() + points * block_width);
  });
}

/// Finds the contacts of all candidates. Returns what touch_pairs does.
template <class Real>
double touch_candidates(const TouchSettings& settings, const PolyhedronBed& bed,
                        const ExecutionContext& context, PolyhedronContacts<Real>& contacts) {
  add_travel(bed, context.loop, contacts.travel);
  contacts.found_parts = contacts.subdomains.count;
  contacts.parts.resize(std::max(contacts.parts.size(), contacts.found_parts));
  parallel_for(context.loop, contacts.found_parts, [&](std::size_t s) {
    ContactPart<Real>& part = contacts.parts[s];
    part.sunk =
        touch_subdomain(settings, context.kernels, bed, s, contacts, part.narrow, part.found);
  });
  double sunk = 0.0;
  for (std::size_t s = 0; s < contacts.found_parts; ++s) {
    sunk = std::max(sunk, contacts.parts[s].sunk);
  }
  return sunk;
}

/// Rows of the contacts found, with the impulses that they carry.
template <class Real>
void lay_out_found(double correction, const PolyhedronBed& bed, const ExecutionContext& context,
                   PolyhedronContacts<Real>& contacts) {
  contacts.open_blocks.assign(bed.grains(), 0);
  visit_subdomains(contacts.found_parts, context.loop, [&](std::size_t s) {
    lay_out_part(bed, s, correction, contacts.open_blocks, contacts.parts[s]);
    carry_impulses(contacts.carried, contacts.parts[s]);
  });
  std::vector<std::size_t> first_block;
  join(context.loop, contacts, first_block);
  share_out(contacts.subdomains, contacts.shares, [&](std::size_t s, auto& ranges) {
    ranges.push_back({first_block[s], first_block[s + 1] - first_block[s]});
  });
}

/// Grains `a` and `b` of each contact, and where it stands in its list; sorted.
using NamedPlaces = std::vector<std::array<std::int64_t, 3>>;

NamedPlaces named_places(const std::vector<ForceContact>& contacts) {
  NamedPlaces places;
  for (const ForceContact& c : contacts) {
    places.push_back({c.a, c.b, static_cast<std::int64_t>(places.size())});
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// Where a contact stands in the list of `places`; their end if it is not in it.
NamedPlaces::const_iterator place_of(const PolyhedronContact& c, const NamedPlaces& places) {
  const auto at = std::lower_bound(places.begin(), places.end(), NamedPlaces::value_type{c.a, c.b});
  return at != places.end() && (*at)[0] == c.a && (*at)[1] == c.b ? at : places.end();
}

/// Settings for contacts with a gap below `near`, d, with no preference of faces that would hide
/// the depth of an overlap.
TouchSettings as_deep_as_they_are(double near, double dt) {
  TouchSettings settings = touch_settings(near, dt * dt);
  settings.of_depth = 0.0;
  return settings;
}

}  // namespace

TouchSettings touch_settings(double near, double drop) {
  return {near, std::max(min_preference, preferred_share * drop), preferred_of_depth};
}

template <class Real>
void take_candidates(const PolyhedronBed& bed, const Candidates& candidates,
                     PolyhedronContacts<Real>& contacts, const ParallelFor& loop) {
  std::vector<GrainPair>& pairs = contacts.subdomains.pairs;
  PairMemoryColumns& before = contacts.listed_before;
  std::swap(pairs, before.pairs);
  divide_grains(bed, Polyhedron::subdomain_grains, candidates, loop, contacts.subdomains);
  divide_pairs(candidates.pairs, loop, contacts.subdomains);
  match_pairs(bed.grains(), pairs, loop, before);
  constexpr double unseen = -infinity;
  keep_memories(before, loop, unseen, contacts.far_until, contacts.spare_until);
  if (needs_memory(bed)) {
    keep_memories(before, loop, PairMemory{}, contacts.memory, contacts.spare_memory);
  }
}

template <class Real>
void hold_turning(const PolyhedronContacts<Real>& contacts, const ParallelFor& loop,
                  PolyhedronBed& bed) {
  visit_grains(loop, bed, [&](std::size_t i) { bed.root_inertia[i] = principal_moments(bed, i); });
  visit_subdomains(contacts.found_parts, loop, [&](std::size_t p) {
    const ContactPart<Real>& part = contacts.parts[p];
    for (std::size_t k = 0; k < part.found.contacts.size(); ++k) add_hold(contacts, part, k, bed);
  });
  visit_grains(loop, bed,
               [&](std::size_t i) { bed.root_inertia[i] = bed.root_inertia[i].cwiseSqrt(); });
}

void release_turning(const ParallelFor& loop, PolyhedronBed& bed) {
  visit_grains(loop, bed,
               [&](std::size_t i) { bed.root_inertia[i] = principal_moments(bed, i).cwiseSqrt(); });
}

template <class Real>
double find_contacts(const TouchSettings& settings, double correction, const PolyhedronBed& bed,
                     const ExecutionContext& context, PolyhedronContacts<Real>& contacts) {
  collect_impulses(bed, context.loop, 1.0, contacts, contacts.carried);
  const double sunk = touch_candidates(settings, bed, context, contacts);
  lay_out_found(correction, bed, context, contacts);
  return sunk;
}

template <class Real>
void lay_out_closed(double tolerance, const ExecutionContext& context, const PolyhedronBed& bed,
                    const Candidates& candidates, double dt, const PolyhedronContacts<Real>& from,
                    PolyhedronContacts<double>& closed) {
  collect_impulses(bed, context.loop, 1.0 / (dt * dt), from, closed.carried);
  forget_pairs(closed);  // they would depend on when the bed was balanced last
  take_candidates(bed, candidates, closed, context.loop);
  touch_candidates(as_deep_as_they_are(tolerance, dt), bed, context, closed);
  for (std::size_t p = 0; p < closed.found_parts; ++p) {
    for (ContactPoint& point : closed.parts[p].found.points) {
      point.gap = point.gap < tolerance ? 0.0 : open_gap;
    }
  }
  lay_out_found(1.0, bed, context, closed);
}

template <class Real>
std::vector<ForceContact> force_contacts(const PolyhedronBed& /*bed*/, double dt,
                                         const PolyhedronContacts<Real>& contacts) {
  std::vector<ForceContact> all;
  visit_bearing(contacts, dt, [&](const ContactPart<Real>& part, std::size_t k, double force) {
    const PolyhedronContact& c = part.found.contacts[k];
    all.push_back({c.a, c.b, force});
  });
  return all;
}

template <class Real>
std::vector<ForceLine> force_lines(const PolyhedronBed& bed,
                                   const PolyhedronContacts<Real>& contacts, double dt) {
  std::vector<ForceLine> all;
  visit_bearing(contacts, dt, [&](const ContactPart<Real>& part, std::size_t k, double force) {
    const PolyhedronContact& c = part.found.contacts[k];
    const ContactPoint* points = part.found.points.data() + c.first;
    Vector lever = Vector::Zero();
    for (std::size_t j = 0; j < c.count; ++j) {
      lever += impulse_of(contacts, part, k, j) / (dt * dt * force) * points[j].position;
    }
    const Quaternion turned = bed.pose(static_cast<std::size_t>(c.a)).orientation;
    const int constraints = constraints_of(points, c.count, closed_gap);
    all.push_back(
        {floats_of(turned * c.normal), floats_of(turned * lever), std::max(constraints, 1)});
  });
  return all;
}

template <class Real>
std::vector<ContactList> closed_contacts(PolyhedronBed& bed, const ExecutionContext& context,
                                         double dt, const PolyhedronContacts<Real>& contacts) {
  const NamedPlaces places = named_places(force_contacts(bed, dt, contacts));
  Candidates candidates;
  PolyhedronContacts<double> now;
  renew_candidates(closed_gap, 0.0, context, bed, candidates);
  take_candidates(bed, candidates, now, context.loop);
  add_travel(bed, context.loop, now.travel);
  std::vector<ContactList> lists(now.subdomains.count);
  parallel_for(context.loop, lists.size(), [&](std::size_t s) {
    NarrowColumns columns;
    touch_subdomain(as_deep_as_they_are(closed_gap, dt), context.kernels, bed, s, now, columns,
                    lists[s]);
    std::erase_if(lists[s].contacts,
                  [&](const PolyhedronContact& c) { return place_of(c, places) == places.end(); });
  });
  return lists;
}

template <class Real>
std::vector<Closure> closures(PolyhedronBed& bed, const ExecutionContext& context, double dt,
                              Candidates& candidates, PolyhedronContacts<Real>& contacts) {
  constexpr double search_margin = 0.05;  // d; as in the steps, so that candidates last
  const std::vector<ForceContact> bearing = force_contacts(bed, dt, contacts);
  const NamedPlaces places = named_places(bearing);
  if (renew_candidates(closed_gap, search_margin, context, bed, candidates)) {
    take_candidates(bed, candidates, contacts, context.loop);
  }
  add_travel(bed, context.loop, contacts.travel);
  std::vector<Closure> all(bearing.size(), {infinity, 0, 0});
  parallel_for(context.loop, contacts.subdomains.count, [&](std::size_t s) {
    NarrowColumns columns;
    ContactList now;
    touch_subdomain(as_deep_as_they_are(closed_gap, dt), context.kernels, bed, s, contacts, columns,
                    now);
    for (const PolyhedronContact& c : now.contacts) {
      const auto at = place_of(c, places);
      if (at == places.end()) continue;
      const ContactPoint* points = now.points.data() + c.first;
      all[static_cast<std::size_t>((*at)[2])] = {std::max(min_gap(points, c.count), c.parted),
                                                 constraints_of(points, c.count, closed_gap),
                                                 by_turning(bed, c)};
    }
  });
  return all;
}

template void take_candidates(const PolyhedronBed&, const Candidates&, PolyhedronContacts<float>&,
                              const ParallelFor&);
template void take_candidates(const PolyhedronBed&, const Candidates&, PolyhedronContacts<double>&,
                              const ParallelFor&);
template void hold_turning(const PolyhedronContacts<float>&, const ParallelFor&, PolyhedronBed&);
template void hold_turning(const PolyhedronContacts<double>&, const ParallelFor&, PolyhedronBed&);
template double find_contacts(const TouchSettings&, double, const PolyhedronBed&,
                              const ExecutionContext&, PolyhedronContacts<float>&);
template double find_contacts(const TouchSettings&, double, const PolyhedronBed&,
                              const ExecutionContext&, PolyhedronContacts<double>&);
template void lay_out_closed(double, const ExecutionContext&, const PolyhedronBed&,
                             const Candidates&, double, const PolyhedronContacts<float>&,
                             PolyhedronContacts<double>&);
template void lay_out_closed(double, const ExecutionContext&, const PolyhedronBed&,
                             const Candidates&, double, const PolyhedronContacts<double>&,
                             PolyhedronContacts<double>&);
template std::vector<ForceContact> force_contacts(const PolyhedronBed&, double,
                                                  const PolyhedronContacts<float>&);
template std::vector<ForceContact> force_contacts(const PolyhedronBed&, double,
                                                  const PolyhedronContacts<double>&);
template std::vector<ForceLine> force_lines(const PolyhedronBed&, const PolyhedronContacts<float>&,
                                            double);
template std::vector<ForceLine> force_lines(const PolyhedronBed&, const PolyhedronContacts<double>&,
                                            double);
template std::vector<Closure> closures(PolyhedronBed&, const ExecutionContext&, double, Candidates&,
                                       PolyhedronContacts<float>&);
template std::vector<Closure> closures(PolyhedronBed&, const ExecutionContext&, double, Candidates&,
                                       PolyhedronContacts<double>&);

template std::vector<ContactList> closed_contacts(PolyhedronBed&, const ExecutionContext&, double,
                                                  const PolyhedronContacts<float>&);
template std::vector<ContactList> closed_contacts(PolyhedronBed&, const ExecutionContext&, double,
                                                  const PolyhedronContacts<double>&);

}  // namespace grainsweep
