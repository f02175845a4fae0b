// Which rules the points of a sweep break. Each value is named once, for the first point that
// breaks a rule with it, or for the one that asks for most. If other points with that value break
// no rule, or break it in another way, the message says which point it is about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "runner/sweep/assignments.hpp"
#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/sweep_definition.hpp"

namespace grainsweep {

class PointProblems {
 public:
  /// Both must outlive it; the diagnostics may grow meanwhile, but not shrink.
  PointProblems(const SweepDefinition& definition, Diagnostics& diagnostics)
      : definition_(definition), diagnostics_(diagnostics) {}

  /// Problems noted from here on are of this point of `block`, where its lists give the values
  /// `entries`, which must live until the next point begins.
  void begin_point(const Block& block, const std::vector<const Assignments*>& entries,
                   const InEffect& in_effect);

  /// Notes at `pointer` what the point breaks with `value`, or with a default if that is null. A
  /// problem with the same `key` is noted for the first point only, and for the first one of each
  /// block that has another message; a later point takes its place if more is `asked` of it.
  void note(const std::string& key, const std::string& pointer, const std::string& message,
            const Assignment* value, double asked = 0.0);

  /// Treats a problem with this key as noted already.
  void skip(const std::string& key) { said_.try_emplace(key); }

  /// What the lists of its block give the point: `box.width 5, shape "cube"`; empty without lists.
  std::string values_of_point() const;

  /// Adds to the messages which points they are about, once all points are through.
  void name_points();

 private:
  struct Said {
    std::vector<std::size_t> diagnostics = {};  ///< of the first point, by index
    const Block* block = nullptr;               ///< of the first point
    const void* holder = nullptr;               ///< the value, or its block: an address alone
    std::uint64_t first_point = 0, last_point = 0, points = 0;  ///< that break the rule
    bool differs = false;                                       ///< at another point
    std::string where = {};                                     ///< the point that is told
    double asked = 0.0;                                         ///< of that
  };

  std::string name_of_point() const;
  void tell_instead(Said& said, const std::string& message, double asked);
  bool has_said(const Said& said, const std::string& message) const;
  /// The key under which a message is noted: another one in a block where it differs.
  std::string key_in_block(const std::string& key, const std::string& message) const;

  const SweepDefinition& definition_;
  Diagnostics& diagnostics_;
  const Block* block_ = nullptr;
  std::vector<const Assignments*> entries_;
  std::uint64_t point_ = 0;                                     // counted from 1
  std::unordered_map<const void*, std::uint64_t> points_with_;  // a value, or of a block
  std::map<std::string, Said> said_;                            // by key
};

}  // namespace grainsweep
