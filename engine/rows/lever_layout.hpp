// From contacts of convex shapes to rows with levers, and back to impulses of points.
//
// Contacts with many points come first, so that the contacts of a block have about the same number
// of them; no two lanes of a block share a grain.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/narrow/shape_contacts.hpp"
#include "engine/rows/lever_columns.hpp"

namespace grainsweep {

/// Where the impulses of contacts are: that of point j of contact k at
/// impulse[first[k] + j * block_width] of the rows.
struct LeverPlaces {
  std::vector<std::size_t> first;
  std::vector<std::size_t> order;  ///< contacts as they were laid out
};

/// An impulse of a point that pushed.
struct CarriedPoint {
  std::int32_t other = 0;            ///< the second side of its contact
  Vector position = Vector::Zero();  ///< about the centre of the first grain, its frame, d
  double impulse = 0.0;              ///< masses times d
};

/// Impulses of the last step, by the first grain of their contact.
struct CarriedPoints {
  std::vector<std::size_t> begin;  ///< where each grain's begin; one more at the end
  std::vector<CarriedPoint> points;
};

/// Rows of all contacts, without impulses. `correction`: share of an overlap that a step repairs.
template <class Real>
void lay_out(const PolyhedronBed& bed, const ShapeContacts& found, double correction,
             LeverPlaces& places, LeverColumns<Real>& rows);

/// Takes down the impulses of points that pushed.
template <class Real>
void remember_impulses(const PolyhedronBed& bed, const ShapeContacts& found,
                       const LeverPlaces& places, const LeverColumns<Real>& rows,
                       CarriedPoints& carried);

/// Gives each impulse to the nearest point of the contact between the same two, whatever its normal
/// is now; those of contacts that are no more are dropped.
template <class Real>
void carry_impulses(const ShapeContacts& found, const CarriedPoints& carried,
                    const LeverPlaces& places, LeverColumns<Real>& rows);

}  // namespace grainsweep
