// Which grains of a bed of convex shapes touch, and where.
//
// The chain of a pair: candidates by circumscribed balls (kept while they last), balls, then for
// pinacoids the batch test of separating axes and its best axes measured anew in f64, for other
// shapes the pair's last parting axis, GJK and separating axes; at last the contact polygon, every
// point of it (engine/narrow/manifold.hpp). Walls touch with all vertices near them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/broad/candidates.hpp"
#include "engine/narrow/manifold.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Contact of grain a with grain b > a, or with the wall of that entry of the bed. Its points are
/// `points[first]` .. `points[first + count - 1]`.
struct ShapeContact {
  std::int32_t a = 0, b = 0;
  AxisKind kind = AxisKind::none;  ///< what gave the normal; none = a wall
  Vector normal = Vector::Zero();  ///< unit, from a to b, frame of a
  std::size_t first = 0, count = 0;
  PairPose pose;  ///< grain b as a sees it; not set for a wall
};

struct ShapeContacts {
  std::vector<ShapeContact> contacts;  ///< pairs in the order of the candidates, then the walls
  std::vector<ContactPoint> points;    ///< positions about the centre of a, frame of a
};

/// What a search remembers from step to step, and its working memory.
struct ShapeSearch {
  std::vector<Record<double>> balls;  ///< circumscribed: centre and radius, d
  Candidates candidates;
  std::vector<PairMemory> memory;   ///< of each candidate pair
  std::vector<GrainPair> close;     ///< pinacoids whose balls meet
  std::vector<PinacoidBlock> axes;  ///< what the batch test says of them
  ClipColumns clip;
  bool has_candidates = false;
};

/// How to search.
struct ShapeSearchSettings {
  TouchSettings touch;
  double reach = 0.0;  ///< candidates reach this much further than `touch.margin`, d
};

/// All contacts of the bed. Returns whether candidates were listed anew; the bed is wrapped then. A
/// periodic axis must be at least two largest circumscribed diameters and reaches long.
bool find_contacts(const ShapeSearchSettings& settings, const ExecutionContext& context,
                   PolyhedronBed& bed, ShapeSearch& search, ShapeContacts& found);

}  // namespace grainsweep
