// What to call single packings and parameter sets where they are listed one by one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runner/tables/families.hpp"

namespace grainsweep {

class PackingNames {
 public:
  /// Names packings by their labels and the widths of their containers only.
  PackingNames() = default;
  /// Names them also by what tells their families from others of the same labels.
  explicit PackingNames(const std::vector<Family>& families);

  /// "lognormal sigma=0.1": of a family; empty if nothing tells it from others.
  std::string family_of(const JobFacts& job) const;
  /// "lognormal sigma=0.1, W = 8 periodic": of a parameter set.
  std::string set_of(const JobFacts& job) const;

 private:
  std::map<std::string, std::string> distinctions_;  ///< by the parameters of a packing
};

/// The names of a sweep's packings.
PackingNames names_in(const Sweep& sweep);

}  // namespace grainsweep
