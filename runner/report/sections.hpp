// The parts of the page that are tables and lists, as HTML.
#pragma once

#include <string>
#include <vector>

#include "runner/compare/comparison.hpp"
#include "runner/report/axes.hpp"
#include "runner/tables/families.hpp"
#include "runner/tables/provenance.hpp"

namespace grainsweep {

/// At most so many packings and parameter sets stand in the page; packings.csv and groups.csv have
/// all.
inline constexpr std::size_t most_packings = 2000, most_groups = 2000;

/// How many packings there are and what became of them, in a sentence.
std::string summary_section(const std::vector<Row>& rows, const GivenUnits& units = {});

/// Means and standard errors of every parameter set.
std::string groups_section(const std::vector<Group>& groups, const GivenUnits& units = {});

/// At most so many mixtures stand in the page; components.csv has all.
inline constexpr std::size_t most_mixtures_of_page = 50;

/// Means of the components of mixtures, and how they touch each other; empty without any. Curves
/// are read from `folder`, as for GroupWithCurves. Throws FileError.
std::string components_section(const std::vector<Group>& groups, const std::string& folder);

/// The wall effect of every family, or why it is not determined; those of one width are counted
/// only. Empty without walls.
std::string fits_section(const std::vector<Family>& families, const GivenUnits& units = {});

/// Published values beside the measured ones, with both definitions; empty without any.
std::string published_section(const std::string& source,
                              const std::vector<Comparison>& comparisons);

/// A packing per row, those that did not settle first, with the reason and what to do about it.
std::string packings_section(const std::vector<Row>& rows, const std::vector<Group>& groups,
                             const GivenUnits& units = {});

/// What to do about a packing that did not settle; empty if it did.
std::string remedy_of(const Row& row);

/// Version, compiler, runs and machines, the sweep files verbatim, how to cite.
std::string provenance_section(const Provenance& provenance);

}  // namespace grainsweep
