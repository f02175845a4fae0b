// The figures of a sweep, drawn from the same numbers as its tables.
#pragma once

#include <array>
#include <vector>

#include "runner/compare/comparison.hpp"
#include "runner/report/axes.hpp"
#include "runner/report/figure.hpp"
#include "runner/tables/families.hpp"

namespace grainsweep {

/// What the files of figures begin with.
inline constexpr std::array figure_names = {
    "parameters",         "means",         "means-residuals", "means-published", "profiles",
    "profiles-published", "heights",       "grading",         "small_grains",    "components",
    "contacts",           "distributions", "effort",          "published"};

/// Solid fraction, porosity and coordination number along the axis, with fits and their residuals,
/// and published formulas of them.
Figure means_figure(const Axes& axes, const std::vector<Family>& families,
                    const std::vector<Comparison>& comparisons);

/// Solid fraction and coordination number over each number that a random design varies.
Figure parameters_figure(const Axes& axes);

/// Solid fraction and coordination number across the gap, beside each other, with the damped
/// cosine that was fitted, and published profiles, whose groups it shows if there are any.
Figure profiles_figure(const Axes& axes, const std::vector<Comparison>& comparisons);

/// Solid fraction and coordination number from the floor to the surface.
Figure heights_figure(const Axes& axes);

/// Whether any settled packing has a distribution of sizes.
bool has_grading(const Axes& axes);

/// The share of the grains that is finer than each diameter: asked for, packed, and in the measured
/// slab.
Figure grading_figure(const Axes& axes);

/// How far the walls reach and what they cost, against the share of small grains.
Figure small_share_figure(const std::vector<Family>& families, const std::string& folder);

/// Pair correlation and the distribution of contact forces.
Figure distributions_figure(const Axes& axes);

/// Solid fraction and coordination number of the components of mixtures, across the gap.
Figure components_figure(const Axes& axes);

/// Kinds of contact between polyhedra along the axis, and the force they carry.
Figure contacts_figure(const Axes& axes);

/// What each packing cost and how near to rest it came.
Figure effort_figure(const Axes& axes, const std::vector<Row>& rows);

/// Measured less published values, in standard errors.
Figure published_figure(const std::vector<Comparison>& comparisons);

/// The figures that have a meaning for this sweep.
std::vector<Figure> figures_of(const std::vector<Row>& rows, const Analysis& analysis,
                               const std::vector<Comparison>& comparisons,
                               const GivenUnits& units = {});

}  // namespace grainsweep
