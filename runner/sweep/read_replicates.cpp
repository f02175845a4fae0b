#include "runner/sweep/read_replicates.hpp"

#include "engine/interval.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

/// `key` of the requested errors, 0 if it is not there.
double read_wish(const Json& until, const char* key, const std::string& pointer,
                 Diagnostics& diagnostics) {
  constexpr Interval errors{0.0, 1.0, true};
  const auto found = until.find(key);
  if (found == until.end()) return 0.0;
  if (found->is_number() && errors.holds(found->get<double>())) return found->get<double>();
  diagnostics.push_back(
      {child_pointer(pointer, key),
       "must be the largest error to live with, in " + errors.text() + ", is " + describe(*found)});
  return errors.high;
}

/// The requested errors of a fit: of its bulk values and slopes.
FitWish read_fit_wish(const Json& fit, const std::string& pointer, Diagnostics& diagnostics) {
  if (!fit.is_object() || fit.empty()) {
    diagnostics.push_back(
        {pointer, R"(must say which error is small enough, e.g. "fit": { "phi_bulk": 0.004 })"});
    return {};
  }
  refuse_unknown_keys(fit, pointer, {"phi_bulk", "C", "Z_bulk", "C_Z"}, diagnostics);
  const auto wish = [&](const char* key) { return read_wish(fit, key, pointer, diagnostics); };
  return {wish("phi_bulk"), wish("C"), wish("Z_bulk"), wish("C_Z")};
}

/// Reads which errors are small enough: of means, or of a fit.
void read_until(const Json& until, const std::string& pointer, Replicates& replicates,
                Diagnostics& diagnostics) {
  if (until.contains("porosity")) {
    diagnostics.push_back(
        {child_pointer(pointer, "porosity"),
         "porosity is 1 - solid_fraction and has its error: ask for solid_fraction", Anchor::key});
    return;
  }
  refuse_unknown_keys(until, pointer, {"solid_fraction", "coordination", "fit"}, diagnostics);
  replicates.wish = {read_wish(until, "solid_fraction", pointer, diagnostics),
                     read_wish(until, "coordination", pointer, diagnostics)};
  const auto fit = until.find("fit");
  if (fit == until.end()) return;
  const std::string place = child_pointer(pointer, "fit");
  replicates.fit_wish = read_fit_wish(*fit, place, diagnostics);
  if (replicates.wish.is_given()) {
    diagnostics.push_back({place, "stands beside wishes for means; keep one: means, or a fit"});
  }
}

Replicates read_growing(const Json& value, const std::string& pointer, Diagnostics& diagnostics) {
  Replicates replicates{usual_most_replicates, {}, {}, child_pointer(pointer, "until")};
  refuse_unknown_keys(value, pointer, {"until", "most"}, diagnostics);
  const std::string& until_pointer = replicates.wish_pointer;
  const auto until = value.find("until");
  if (until == value.end() || !until->is_object() || until->empty()) {
    diagnostics.push_back(
        {until == value.end() ? pointer : until_pointer,
         R"(must say which error is small enough, e.g. "until": { "solid_fraction": 0.001 })"});
  } else {
    read_until(*until, until_pointer, replicates, diagnostics);
  }
  const auto most = value.find("most");
  if (most == value.end()) return replicates;
  const auto count =
      whole_number_in(*most, 2, most_replicates, child_pointer(pointer, "most"), diagnostics);
  replicates.most = static_cast<int>(count.value_or(replicates.most));
  return replicates;
}

}  // namespace

Replicates read_replicates(const Json& object, const std::string& pointer,
                           const Replicates& otherwise, Diagnostics& diagnostics) {
  const auto found = object.find("replicates");
  if (found == object.end()) return otherwise;
  const std::string place = child_pointer(pointer, "replicates");
  if (found->is_object()) return read_growing(*found, place, diagnostics);
  const auto count = whole_number_in(*found, 1, most_replicates, place, diagnostics);
  return count ? Replicates{static_cast<int>(*count)} : otherwise;
}

}  // namespace grainsweep
