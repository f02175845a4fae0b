#include "engine/exact/exact_rest.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/measure/touching.hpp"
#include "engine/saved_state.hpp"

namespace grainsweep {

namespace {

// A bed that still sinks comes nearer to rest: it is given up once the mean of its grains has
// hardly sunk, d, for so many rounds, and at the latest after six times as many.
constexpr int rounds_to_sink = 600;
constexpr double has_sunk = 1e-4;
constexpr double most_factorisations = 6.0 * rounds_to_sink;

/// What a round takes besides its factorisation, in multiplications for each grain: it goes through
/// all links up to seven times.
constexpr double of_a_grain_and_round = 4000.0;

// Products f s, m g d: slacks of loaded contacts are 1e-5 d at first, 1e-4 d where a bed that
// slides far is loosened, and at the end far below exact_overlap for all forces that hold a bed.
constexpr double first_product = 1e-5;
constexpr double loosest_product = 1e-4;
constexpr double last_product = 1e-14;
constexpr double least_coarse_product = 1e-5;  // where f32 says well enough where grains go
constexpr double nearly_balanced = 1e-8;       // of the largest force or weight; the rest is linear
constexpr double least_slack = 1e-9;
constexpr double stiff = 1e8;  // of contacts whose gaps are closed, m g / d

// Lengths, d. Pairs are listed if the two grains may come near each other before the next list is
// made.
constexpr double leash = 0.03;
constexpr double listed_gap = 2.0 * leash;
constexpr double long_way = 0.06, short_way = 0.006;

constexpr const char* not_in_time = "no state without motion was found in time";

/// A pair or wall within reach.
struct Link {
  std::int32_t a = 0, b = 0;  ///< as of ForceContact
  double mass = 1.0;          ///< of its lighter grain, which sets the scale of its force, m
  double gap = 0.0;           ///< d
  double slack = 0.0;         ///< what the gap should be, positive, d
  double force = 0.0;         ///< positive, m g
  double target = 0.0;        ///< of slack * force in this round
  double slack_step = 0.0, force_step = 0.0;

  std::pair<std::int32_t, std::int32_t> ends() const { return {a, b}; }
  double stiffness() const { return force / slack; }
};

/// How far a link can go before a positive value loses more than the share `loss`; at most 1.
double length_of(double value, double step, double loss) {
  return step < 0.0 ? std::min(1.0, -loss * value / step) : 1.0;
}

/// The length that all links but the first `cut_short` can go. `lengths` is reordered.
double length_of_all(std::vector<double>& lengths, std::size_t cut_short) {
  if (lengths.empty()) return 1.0;
  const auto at =
      lengths.begin() + static_cast<std::ptrdiff_t>(std::min(cut_short, lengths.size() - 1));
  std::nth_element(lengths.begin(), at, lengths.end());
  return *at;
}

class InteriorPoint {
 public:
  InteriorPoint(const ExecutionContext& context, const std::vector<ForceContact>& from,
                double asked_after, SphereBed& bed)
      : context_(context),
        bed_(bed),
        factors_(context.kernels, asked_after),
        drag_(bed.grains(), 1.0) {
    list_links();
    start_from(from);
  }

  ExactRest run(const ExactRestLimits& limits) {
    const double of_a_round =
        factors_.operations() + of_a_grain_and_round * static_cast<double>(grains());
    most_rounds_ = std::min(most_factorisations, limits.operations / of_a_round);
    const double usual = std::max(30.0, std::sqrt(static_cast<double>(grains())));  // rounds
    if (most_rounds_ < usual) return failed("it would take too long", {});
    height_ = mean_height();
    restore(limits.saved);
    ExactRest rest = search([&] { return limits.keep_going([this] { return saved(); }); });
    rest.rounds = rounds_;
    if (!rest.failure.empty()) return rest;
    keep_contacts();
    return certified(rest);
  }

 private:
  // ---- links ----

  std::size_t grains() const { return bed_.grains(); }
  double mass(std::size_t grain) const { return 1.0 / bed_.motion[grain].w; }
  const Wall& wall_of(const Link& link) const {
    return bed_.walls[static_cast<std::size_t>(link.b - bed_.wall_name(0))];
  }
  bool is_curved(const Link& link) const {
    return !bed_.is_grain(link.b) && wall_of(link).is_round();
  }
  /// Grains of narrow tubes may rest where contacts alone, without the curvature of both wall and
  /// pairs, would not hold them.
  bool is_narrow() const {
    constexpr double narrow = 3.5;  // d
    return bed_.box.is_tube && bed_.box.length < narrow;
  }
  /// Whether a pair's curvature counts: in other tubes once forces are nearly found, of which most
  /// do not hold a bed before.
  bool rolls(const Link& link) const {
    constexpr double nearly_found = 1e-8;  // product
    return bed_.box.is_tube && bed_.is_grain(link.b) && (is_narrow() || product_ < nearly_found);
  }

  /// All pairs and walls within reach of where the grains are now; those listed before stay as they
  /// are.
  void list_links() {
    std::vector<Link> before = std::move(links_);
    links_.clear();
    const Touching near = find_touching(bed_, listed_gap, context_.kernels);
    for (const TouchingPair& pair : near.pairs) add_link(pair.a, pair.b);
    for (const TouchingWall& wall : near.walls) {
      add_link(wall.grain, bed_.wall_name(static_cast<std::size_t>(wall.wall)));
    }
    const auto by_ends = [](const Link& p, const Link& q) { return p.ends() < q.ends(); };
    std::sort(links_.begin(), links_.end(), by_ends);
    std::size_t k = 0;
    for (Link& link : links_) {
      while (k < before.size() && by_ends(before[k], link)) ++k;
      if (k < before.size() && before[k].ends() == link.ends()) {
        link.slack = before[k].slack, link.force = before[k].force;
      }
    }
    listed_at_.assign(bed_.centres().begin(), bed_.centres().end());
    lay_out_springs();
    measure();
    for (Link& link : links_) {
      if (link.slack > 0.0) continue;
      link.slack = std::max(link.gap, least_slack);
      link.force = product_ * link.mass / link.slack;
    }
  }
  void add_link(std::int32_t a, std::int32_t b) {
    Link link;
    link.a = a, link.b = b;
    link.mass = mass(static_cast<std::size_t>(a));
    if (bed_.is_grain(b)) link.mass = std::min(link.mass, mass(static_cast<std::size_t>(b)));
    links_.push_back(link);
  }

  /// A spring for each link; then one across each round wall, whose normal turns as a grain slides
  /// along it.
  void lay_out_springs() {
    springs_.clear();
    for (const Link& link : links_) {
      springs_.push_back({link.a, bed_.is_grain(link.b) ? link.b : Spring::fixed});
    }
    for (const Link& link : links_) {
      if (is_curved(link)) springs_.push_back({link.a, Spring::fixed});
    }
    factors_.analyse(bed_.centres(), springs_);
  }

  /// Gaps and directions at the grains' places. A link's direction leads from its first grain to
  /// its second side: its gap opens as they part along it.
  void measure() {
    std::size_t across = links_.size();
    for (std::size_t k = 0; k < links_.size(); ++k) {
      measure_link(links_[k], springs_[k]);
      const Vector& along = springs_[k].along;
      if (is_curved(links_[k])) springs_[across++].along = {-along.y(), along.x(), 0.0};
    }
  }
  void measure_link(Link& link, Spring& spring) {
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    const Record<double>& p = bed_.position[a];
    if (bed_.is_grain(link.b)) {
      const Vector difference = nearest_difference(bed_, a, b);
      const double distance = difference.norm();
      spring.along = difference / distance;
      link.gap = distance - p.w - bed_.position[b].w;
    } else {
      const UnitVector normal = wall_of(link).normal(p.x, p.y, p.z);
      spring.along = {-normal.x, -normal.y, -normal.z};
      link.gap = wall_of(link).gap(p);
    }
  }

  /// Slacks and forces near those of a settled bed, with equal products: f - f0 = k (s - gap).
  void start_from(std::vector<ForceContact> from) {
    constexpr double per_gap = 1e3;  // k, m g / d
    const auto ends = [](const ForceContact& c) { return std::pair(c.a, c.b); };
    std::sort(from.begin(), from.end(),
              [&](const ForceContact& p, const ForceContact& q) { return ends(p) < ends(q); });
    std::size_t k = 0;
    for (Link& link : links_) {
      while (k < from.size() && ends(from[k]) < link.ends()) ++k;
      const bool pushed = k < from.size() && ends(from[k]) == link.ends();
      const double force = pushed ? from[k].force / link.mass : 0.0;
      const double half = (force - per_gap * std::max(link.gap, 0.0)) / 2.0;
      const double root = std::sqrt(half * half + per_gap * product_);
      link.slack = half > 0.0 ? product_ / (half + root) : (root - half) / per_gap;
      link.force = link.mass * product_ / link.slack;
    }
  }

  // ---- saving and going on ----

  /// Lists what the next round needs.
  template <class Archive>
  void transfer(Archive& archive) {
    archive.column(links_);
    archive.column(listed_at_);
    archive.column(bed_.position);
    archive.column(drag_before_);
    archive.value(product_);
    archive.value(drag_of_all_);
    archive.value(reached_);
    archive.value(full_steps_);
    archive.value(stuck_);
    archive.value(rounds_);
    archive.value(most_rounds_);
    archive.value(height_);
  }
  std::string saved() {
    StateWriter writer;
    transfer(writer);
    return sealed(grains(), writer.bytes());
  }
  /// The factors are laid out as they were, for where the grains were when the links were listed.
  void restore(std::string_view bytes) {
    const auto payload = unsealed(grains(), bytes);
    if (!payload) return;
    StateReader reader(*payload);
    transfer(reader);
    drag_ = drag_before_;
    const std::vector<Record<double>> position = bed_.position;
    std::copy(listed_at_.begin(), listed_at_.end(), bed_.position.begin());
    lay_out_springs();
    bed_.position = position;
    measure();
  }

  // ---- a round ----

  /// Round after round, until the bed is found or cannot be. Whatever is saved within a round is
  /// the bed as the round began.
  ExactRest search(const std::function<bool()>& keep_going) {
    while (!is_found()) {
      drag_before_ = drag_;
      if (!keep_going()) return failed("cancelled", {});
      if (rounds_ >= most_rounds_) return failed(not_in_time, {});
      if (has_diverged()) return failed("forces grow without bound", {});
      const bool is_held = factor_with_drag(keep_going);
      if (is_cancelled_) return failed("cancelled", {});
      ++rounds_;
      if (!is_held) return failed("the contacts do not hold the bed", {});
      find_step();
      take_step();
      adapt();
      if (!is_found() && is_time_to_look(rounds_) && !still_sinks(height_)) {
        return failed(not_in_time, {});
      }
    }
    return {};
  }

  bool is_found() const {
    return product_ <= last_product && reached_ > 0.9 && is_balanced_to(nearly_balanced);
  }
  /// Whether all grains are balanced to a share of the largest force or weight.
  bool is_balanced_to(double share) const {
    double scale = 1.0;
    for (const Link& link : links_) scale = std::max(scale, link.force);
    return largest(net_forces()) < share * scale;
  }

  static bool is_time_to_look(std::int64_t rounds) {
    return rounds > 0 && rounds % rounds_to_sink == 0;
  }
  /// Whether the bed has sunk since its grains were at `height`, which is set to the present one.
  bool still_sinks(double& height) const {
    const double before = std::exchange(height, mean_height());
    return before - height > has_sunk;
  }
  double mean_height() const {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < grains(); ++i) {
      sum += mass(i) * bed_.position[i].z;
      weight += mass(i);
    }
    return sum / weight;
  }

  /// No wedge multiplies the weight of a whole bed so often.
  bool has_diverged() const {
    constexpr double multiplied = 1e8;
    double weight = 0.0, most = 0.0;
    for (std::size_t i = 0; i < grains(); ++i) weight += mass(i);
    for (const Link& link : links_) most = std::max(most, link.force);
    return most > multiplied * weight;
  }

  /// Drag keeps a grain from moving far in a round: a force per way, in weights per d.
  bool factor_with_drag(const std::function<bool()>& keep_going) {
    const auto goes_on = [&] {
      is_cancelled_ = !keep_going();
      return !is_cancelled_;
    };
    for (std::size_t k = 0; k < links_.size(); ++k) springs_[k].stiffness = links_[k].stiffness();
    stiffen_across();
    for (int tries = 0; tries < 12; ++tries) {
      ground_.resize(grains());
      for (std::size_t i = 0; i < grains(); ++i) ground_[i] = drag_of_all_ * drag_[i] * mass(i);
      is_coarse_ =
          product_ >= least_coarse_product && factors_.factor<float>(springs_, ground_, goes_on);
      if (is_coarse_) return true;
      if (!is_cancelled_ && factors_.factor<double>(springs_, ground_, goes_on)) return true;
      if (is_cancelled_) return false;
      if (tries == 0) {
        leave_out_rolling();
      } else {
        for (double& drag : drag_) drag *= 30.0;
      }
    }
    return false;
  }
  /// A round wall of radius R turns a grain's force f by way / (R - r), r its radius, and holds it;
  /// a grain on another is turned by way / (r + r'), away from it.
  void stiffen_across() {
    std::size_t across = links_.size();
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const Link& link = links_[k];
      const double radius = bed_.position[static_cast<std::size_t>(link.a)].w;
      if (is_curved(link)) {
        const double off_axis = wall_of(link).radius - radius - link.gap;
        springs_[across++].stiffness = link.force / std::max(off_axis, least_slack);
      }
      springs_[k].across = 0.0;
      if (rolls(link)) {
        const double other = bed_.position[static_cast<std::size_t>(link.b)].w;
        springs_[k].across = -link.force / (radius + other + link.gap);
      }
    }
  }

  /// Pairs that roll off each other unheld would let forces grow without bound.
  void leave_out_rolling() {
    for (Spring& spring : springs_) spring.across = 0.0;
  }

  /// The step that a round aims at. Targets are changed, with the same factors, until the step is
  /// long: products that a longer step would bring far from the others are held back (Gondzio
  /// 1996).
  void find_step() {
    constexpr int corrections = 6;
    constexpr double longer = 0.3, far_off = 10.0, gain = 1.02;
    for (Link& link : links_) link.target = product_ * link.mass;
    double before = 0.0;
    for (int k = 0; k < corrections; ++k) {
      solve_for_targets();
      const auto [slack, force] = shortest_lengths();
      reached_ = std::min(slack, force);
      if (reached_ > 0.95 || reached_ < gain * before) break;
      before = reached_;
      for (Link& link : links_) {
        const double product = link.mass * product_;
        const double next = (link.slack + std::min(1.0, slack + longer) * link.slack_step) *
                            (link.force + std::min(1.0, force + longer) * link.force_step);
        link.target += std::clamp(next, product / far_off, product * far_off) - next;
        link.target = std::clamp(link.target, -far_off * product, far_off * product);
      }
    }
  }
  void solve_for_targets() {
    way_ = net_forces();
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const Link& link = links_[k];
      add_force(k,
                link.target / link.slack - link.force - link.stiffness() * (link.gap - link.slack),
                way_);
    }
    if (is_coarse_) {
      solve_coarsely();
    } else {
      factors_.solve<double>(way_);
    }
    for (std::size_t k = 0; k < links_.size(); ++k) {
      Link& link = links_[k];
      link.slack_step = opening(k) + link.gap - link.slack;
      link.force_step = (link.target - link.force * link.slack_step) / link.slack - link.force;
    }
  }
  /// With factors in f32, and once more for what they leave: a hundredth of a weight on a grain
  /// becomes a thousandth, and ways are wrong by some 1e-6 d.
  void solve_coarsely() {
    std::vector<Vector> left = way_;
    factors_.solve<float>(way_);
    take_forces_of_way(left);
    factors_.solve<float>(left);
    for (std::size_t i = 0; i < grains(); ++i) way_[i] += left[i];
  }
  /// Subtracts the forces of springs and ground, m g.
  void take_forces_of_way(std::vector<Vector>& from) const {
    for (std::size_t i = 0; i < grains(); ++i) from[i] -= ground_[i] * way_[i];
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      const Spring& spring = springs_[k];
      add_force(k, -spring.stiffness * opening(k), from);
      if (spring.across == 0.0) continue;
      const Vector apart = way_apart(spring);
      add(spring, spring.across * (apart - spring.along.dot(apart) * spring.along), from);
    }
  }
  /// Largest share of a positive value that a round may take away.
  double loss() const { return product_ < 1e-8 ? 0.99 : 0.9; }
  std::pair<double, double> shortest_lengths() {
    double slack = 1.0, force = 1.0;
    blocked_ = 0;
    for (const Link& link : links_) {
      const double s = length_of(link.slack, link.slack_step, loss());
      const double f = length_of(link.force, link.force_step, loss());
      slack = std::min(slack, s), force = std::min(force, f);
      blocked_ += std::min(s, f) < 0.85 ? 1 : 0;
    }
    return {slack, force};
  }

  /// One link must not stop a bed: some are cut short, and the rest of their step is left to later
  /// rounds.
  void take_step() {
    constexpr double cut_share = 0.05;
    const auto cut_short = static_cast<std::size_t>(cut_share * static_cast<double>(grains()));
    std::vector<double> lengths(links_.size());
    std::transform(links_.begin(), links_.end(), lengths.begin(), [&](const Link& link) {
      return length_of(link.slack, link.slack_step, loss());
    });
    const double of_slack = length_of_all(lengths, cut_short);
    std::transform(links_.begin(), links_.end(), lengths.begin(), [&](const Link& link) {
      return length_of(link.force, link.force_step, loss());
    });
    const double of_force = length_of_all(lengths, cut_short);
    move_grains(of_slack);
    measure();
    for (Link& link : links_) {
      const double product = link.mass * product_, kept = 1.0 - loss();
      link.slack = std::max({link.slack + of_slack * link.slack_step, link.gap, kept * link.slack});
      link.force = std::max(link.force + of_force * link.force_step, kept * link.force);
      link.force = std::clamp(link.force, 1e-3 * product / link.slack, 1e3 * product / link.slack);
    }
    taken_ = of_slack;
  }
  /// Moves grains by a share of the way that they want to go, no further than their leash.
  void move_grains(double share) {
    double furthest = 0.0;
    for (std::size_t i = 0; i < grains(); ++i) {
      Record<double>& p = bed_.position[i];
      const Vector listed = vector_of(listed_at_[i]);
      Vector from = vector_of(p) + share * way_[i] - listed;
      const double distance = from.norm();
      if (distance > leash) from *= leash / distance;
      furthest = std::max(furthest, distance);
      const Vector to = listed + from;
      p.x = to.x(), p.y = to.y(), p.z = to.z();
    }
    must_list_ = furthest > leash / 2.0;
  }

  void adapt() {
    constexpr double centred = 0.85, well_centred = 0.95, few_blocked = 0.004;
    // Largest drag of all grains alike: with a tenth of it large beds slide past where they would
    // rest.
    constexpr double most_drag = 1.0;
    for (std::size_t i = 0; i < grains(); ++i) {
      const double way = way_[i].norm();
      if (way > long_way / 2.0) {
        drag_[i] = std::min(3.0 * std::max(1.0, way / long_way) * drag_[i], 1e6);
      }
      if (way < short_way) drag_[i] = std::max(drag_[i] / 3.0, 1.0);
    }
    drag_of_all_ *= reached_ > 0.8 ? 0.5 : reached_ < 0.3 ? 1.5 : 1.0;
    drag_of_all_ = std::clamp(drag_of_all_, 1e-6, most_drag);
    full_steps_ = reached_ > centred ? full_steps_ + 1 : 0;
    // Where curvature holds grains they slide far for a slight force, and once products are small
    // rounding of stiff contacts drowns it: the bed has to balance while they are not small.
    constexpr double balanced = 0.01;
    const bool may_tighten = !is_narrow() || is_balanced_to(balanced);
    const bool few = static_cast<double>(blocked_) < few_blocked * static_cast<double>(grains());
    const bool gets_on = few && taken_ > 0.5;
    if (may_tighten && (reached_ > centred || gets_on)) {
      const double kept = full_steps_ < 2 ? 0.5 : reached_ > well_centred ? 0.05 : 0.2;
      product_ = std::max(last_product, kept * product_);
    }
    constexpr int most_stuck = 4;
    stuck_ = reached_ < 0.1 && !gets_on ? stuck_ + 1 : 0;
    if (stuck_ == most_stuck) product_ = std::min(4.0 * product_, loosest_product), stuck_ = 0;
    if (must_list_) list_links();
  }

  // ---- forces ----

  void add_force(std::size_t link, double force, std::vector<Vector>& to) const {
    add(springs_[link], -force * springs_[link].along, to);
  }
  /// Adds a force on the first end of a spring, and the opposite one on the other end.
  static void add(const Spring& spring, const Vector& force, std::vector<Vector>& to) {
    to[static_cast<std::size_t>(spring.a)] += force;
    if (spring.b != Spring::fixed) to[static_cast<std::size_t>(spring.b)] -= force;
  }
  /// Net force on every grain, its weight included, m g.
  std::vector<Vector> net_forces() const {
    std::vector<Vector> net(grains());
    for (std::size_t i = 0; i < grains(); ++i) net[i] = {0.0, 0.0, -mass(i)};
    for (std::size_t k = 0; k < links_.size(); ++k) add_force(k, links_[k].force, net);
    return net;
  }
  static double largest(const std::vector<Vector>& vectors) {
    double largest = 0.0;
    for (const Vector& vector : vectors) largest = std::max(largest, vector.norm());
    return largest;
  }
  /// How much the way of the grains opens a gap, d.
  double opening(std::size_t link) const {
    return springs_[link].along.dot(way_apart(springs_[link]));
  }
  /// Way of a spring's other end less that of its first, d.
  Vector way_apart(const Spring& spring) const {
    Vector apart = -way_[static_cast<std::size_t>(spring.a)];
    if (spring.b != Spring::fixed) apart += way_[static_cast<std::size_t>(spring.b)];
    return apart;
  }

  // ---- the end ----

  /// Keeps only links that push: their gaps are closed, and their forces solved for where the
  /// grains then are.
  void keep_contacts() {
    constexpr double pushes = 1e4;  // m g / d; gaps and contacts lie 1e8 and more apart
    std::erase_if(links_, [&](const Link& link) { return link.stiffness() <= pushes * link.mass; });
    lay_out_springs();
    close_gaps();
    solve_for_forces();
  }
  bool factor_contacts() {
    constexpr double held = 1e-13;
    for (std::size_t at = 0; at < links_.size(); ++at) springs_[at].stiffness = stiff;
    stiffen_across();
    ground_.assign(grains(), held * stiff);
    return factors_.factor<double>(springs_, ground_);
  }
  void close_gaps() {
    constexpr int newton_steps = 4;
    constexpr double closed = 5e-14;
    for (int k = 0; k < newton_steps; ++k) {
      measure();
      if (widest_gap() < closed || !factor_contacts()) return;
      way_.assign(grains(), Vector::Zero());
      for (std::size_t at = 0; at < links_.size(); ++at) {
        add_force(at, -stiff * links_[at].gap, way_);
      }
      factors_.solve<double>(way_);
      move_grains(1.0);
    }
  }
  /// Where curvature holds grains, too, it takes their last ways along; else they stay, and so do
  /// the factors.
  void solve_for_forces() {
    constexpr int refinements = 12;
    constexpr double balanced = 1e-12;
    const bool grains_move = springs_.size() > links_.size();
    for (int k = 0; k < refinements; ++k) {
      measure();
      way_ = net_forces();
      if (largest(way_) < balanced) return;
      if ((k == 0 || grains_move) && !factor_contacts()) return;
      factors_.solve<double>(way_);
      for (std::size_t at = 0; at < links_.size(); ++at) links_[at].force -= stiff * opening(at);
      if (grains_move) move_grains(1.0);
    }
  }
  /// Widest gap or deepest overlap, d.
  double widest_gap() const {
    double widest = 0.0;
    for (const Link& link : links_) widest = std::max(widest, std::abs(link.gap));
    return widest;
  }

  ExactRest certified(ExactRest rest) {
    const std::vector<Vector> net = net_forces();
    rest.imbalance = largest(net);
    for (std::size_t i = 0; i < net.size(); ++i) {
      const double of_weight = net[i].norm() / mass(i);
      rest.of_weight.mean += of_weight / static_cast<double>(net.size());
      rest.of_weight.max = std::max(rest.of_weight.max, of_weight);
    }
    double least = 1.0, overlap = 0.0;
    for (const Link& link : links_) {
      least = std::min(least, link.force);
      overlap += std::max(0.0, -link.gap);
      rest.contacts.push_back({link.a, link.b, link.force});
    }
    rest.overlap_mean = overlap / static_cast<double>(std::max<std::size_t>(links_.size(), 1));
    const Touching near = find_touching(bed_, least_slack, context_.kernels);
    for (const TouchingPair& pair : near.pairs) {
      rest.overlap_max = std::max(rest.overlap_max, -pair.gap);
    }
    for (const TouchingWall& wall : near.walls) {
      rest.overlap_max = std::max(rest.overlap_max, -wall.gap);
    }
    if (!(rest.imbalance <= exact_imbalance))
      return failed("forces leave more than 1e-10 m g", rest);
    if (!(rest.overlap_max <= exact_overlap))
      return failed("grains overlap by more than 1e-12 d", rest);
    if (!(least > 0.0)) return failed("a contact pulls", rest);
    return rest;
  }
  static ExactRest failed(const char* why, ExactRest rest) {
    rest.failure = why;
    return rest;
  }

  const ExecutionContext& context_;
  SphereBed& bed_;
  StiffnessFactors factors_;
  std::vector<Link> links_;      ///< by their ends
  std::vector<Spring> springs_;  ///< of each link; then those across round walls
  std::vector<Record<double>> listed_at_;
  std::vector<double> drag_;         ///< of each grain, over that of all
  std::vector<double> drag_before_;  ///< the same when the round began
  std::vector<double> ground_;       ///< memory of factor_with_drag
  std::vector<Vector> way_;          ///< way that grains want to go in this round, d
  double product_ = first_product;
  double drag_of_all_ = 1e-2;
  double reached_ = 0.0;     ///< share of a round's step that no link is in the way of
  double taken_ = 0.0;       ///< share that was taken
  std::size_t blocked_ = 0;  ///< links that can go less than most of the step
  int full_steps_ = 0, stuck_ = 0;
  int rounds_ = 0;            ///< that were made
  double most_rounds_ = 0.0;  ///< that may be
  double height_ = 0.0;       ///< of the grains' mean place when it was last looked at, d
  bool is_cancelled_ = false;
  bool is_coarse_ = false;  ///< whether the factors of this round are in f32
  bool must_list_ = false;
};

}  // namespace

ExactRest rest_exactly(const ExecutionContext& context, const std::vector<ForceContact>& from,
                       SphereBed& bed, const ExactRestLimits& limits) {
  return InteriorPoint(context, from, limits.asked_after, bed).run(limits);
}

}  // namespace grainsweep
