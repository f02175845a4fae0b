// A scene that may break the engine: what is extreme about it, and what is known of its end.
//
// The worst a scene can do is to be silently wrong: numbers without a word of doubt that miss the
// known answer. To be refused for a reason, or to be reported as not settled, is honest.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace grainsweep::extremes {

enum class Outcome {
  right,           ///< numbers within the tolerance of every known answer
  refused,         ///< no numbers: bad input, or a failure by name
  not_settled,     ///< numbers, reported as those of a bed that is not at rest
  silently_wrong,  ///< numbers beyond a tolerance, or not finite, and no word of it
};

/// "right", "refused", "not settled", "SILENTLY WRONG".
const char* name_of(Outcome outcome);

/// A known answer beside what came out.
struct Answer {
  std::string what;        ///< "weight on the floor, relative"
  double error = 0.0;      ///< absolute, in the unit of `what`
  double tolerance = 0.0;  ///< largest error that is right
  std::string reason;      ///< of the tolerance

  bool is_right() const { return error <= tolerance; }  // false for NaN
};

/// What became of a scene.
struct Finding {
  std::string refusal = {};  ///< why there are no numbers; empty if there are
  std::string unrest = {};   ///< why the bed is not called settled; empty if it is
  bool finite = true;        ///< whether every number that left the engine is finite
  std::vector<Answer> answers = {};
};

struct Scene {
  std::string family;
  std::string name;
  std::string extreme;   ///< what is extreme, with numbers
  std::string accuracy;  ///< the preset, or what a step is solved to
  /// What is promised. Every scene that is known to come out right promises it; `not_settled`
  /// promises no more than honesty: anything but silently wrong. `silently_wrong` marks a known
  /// defect, which README names under its limits.
  Outcome expected = Outcome::right;
  std::function<Finding()> run;
};

Outcome outcome_of(const Finding& finding);

/// Whether the outcome is what the scene promises.
bool keeps_promise(const Scene& scene, Outcome outcome);

/// The answer that lies nearest to its tolerance or farthest beyond it; none if there are none.
const Answer* worst_answer(const Finding& finding);

}  // namespace grainsweep::extremes
