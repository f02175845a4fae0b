#include "bench/trade/tables.hpp"

#include <algorithm>
#include <cmath>

#include "runner/tables/csv.hpp"
#include "runner/text.hpp"

namespace grainsweep::bench {
namespace {

constexpr int solid_fraction_decimals = 5, coordination_decimals = 4, other_decimals = 3;

std::string table_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& text : cells) line += " " + text + " |";
  return line + "\n";
}

std::string table_head(const std::vector<std::string>& cells) {
  std::string line = table_row(cells) + "|";
  for (std::size_t k = 0; k < cells.size(); ++k) line += "---|";
  return line + "\n";
}

/// "1.20", "12.0", "120".
std::string short_number(double value) {
  return std::isnan(value) ? "-" : fixed(value, value < 10.0 ? 2 : value < 100.0 ? 1 : 0);
}

template <class Beds>
std::string settled_text(const Beds& beds) {
  return std::to_string(beds.settled) + " of " + std::to_string(beds.made);
}

/// Packings of a scene that are made, and all that are planned.
std::pair<int, int> progress_of(const Scene& scene) {
  int made = 0, planned = 0;
  for (const Setting& setting : scene.settings) {
    made += setting.made;
    planned += setting.planned;
  }
  return {made, planned};
}

double largest_error(const std::vector<Compared>& rows, MeanError Compared::*quantity) {
  double largest = 0.0;
  for (const Compared& row : rows) largest = std::max(largest, (row.*quantity).error);
  return largest;
}

std::string scene_heading(const SceneRows& compared) {
  const Setting& reference = compared.scene->settings.front();
  const Compared& own = compared.rows.front();
  const auto [made, planned] = progress_of(*compared.scene);
  std::string text = "**" + compared.scene->name + "**";
  if (made < planned) {
    text += ", not finished: " + std::to_string(made) + " of " + std::to_string(planned) +
            " packings are made";
  }
  text += ". Reference: `" + reference.name + "`, phi = " + fixed(own.own_solid_fraction.mean, 4) +
          ", Z = " + fixed(own.own_coordination.mean, 3) +
          ", <f^2> = " + fixed(own.own_force_square.mean, 3) + "; ";
  const bool are_paired = std::all_of(compared.rows.begin(), compared.rows.end(),
                                      [](const Compared& row) { return row.are_paired; });
  if (!are_paired) {
    text += "these are of " + std::to_string(own.own_solid_fraction.n) +
            " starts, and rows of fewer differ from them in their means, not start by start. ";
  }
  if (reference.is_exact()) text += settled_text(own) + " beds are certified. ";
  return text + "Largest standard errors of a row: " +
         fixed(largest_error(compared.rows, &Compared::solid_fraction), 5) + " in phi, " +
         fixed(largest_error(compared.rows, &Compared::coordination), 4) + " in Z.\n\n";
}

std::string setting_line(const Compared& row) {
  const Setting& setting = *row.setting;
  return table_row({(setting.preset.empty() ? setting.name : "**" + setting.name + "**"),
                    std::to_string(row.solid_fraction.n), settled_text(row),
                    short_number(row.cpu_seconds), short_number(row.relative_cost),
                    difference_text(row.solid_fraction, solid_fraction_decimals),
                    difference_text(row.coordination, coordination_decimals),
                    difference_text(row.lambda, other_decimals),
                    difference_text(row.force_square, other_decimals), fixed(row.contact_ratio, 4),
                    row.on_front ? "front" : ""});
}

std::string scene_table(const SceneRows& compared) {
  std::vector<Compared> rows = compared.rows;
  std::stable_sort(rows.begin(), rows.end(), [](const Compared& a, const Compared& b) {
    return a.cpu_seconds < b.cpu_seconds;
  });
  std::string text = scene_heading(compared);
  text += table_head({"accuracy", "starts", "settled", "CPU s", "/ `balanced`", "phi", "Z",
                      "lambda / d", "<f^2>", "contacts / isostatic", ""});
  for (const Compared& row : rows) text += setting_line(row);
  return text + "\n";
}

std::string bound_line(const Compared& row) {
  const ProtocolBias& bound = *row.setting->bound;
  const bool holds = std::abs(row.solid_fraction.mean) <= bound.solid_fraction &&
                     std::abs(row.coordination.mean) <= bound.coordination;
  return table_row(
      {"`" + row.setting->name + "`", difference_text(row.solid_fraction, solid_fraction_decimals),
       fixed(bound.solid_fraction, 4), difference_text(row.coordination, coordination_decimals),
       fixed(bound.coordination, 3), holds ? "yes" : "no"});
}

/// Empty without a preset that has bounds. The reference, whose own bound is of its limit, is none.
std::string bounds_table(const SceneRows& compared) {
  std::string lines;
  for (const Compared& row : compared.rows) {
    const Setting& setting = *row.setting;
    if (&setting == &compared.scene->settings.front() || setting.preset.empty()) continue;
    if (setting.bound) lines += bound_line(row);
  }
  if (lines.empty()) return "";
  return "Presets beside the bounds of their biases that `groups.csv` prints:\n\n" +
         table_head({"preset", "phi", "its bound", "Z", "its bound", "holds"}) + lines + "\n";
}

/// Empty where nothing is searched for exact rest.
std::string exact_table(const SceneRows& compared) {
  std::string lines;
  for (const ExactChange& change : exact_changes(*compared.scene)) {
    lines += table_row({"`" + change.begins->name + "`", settled_text(*change.exact),
                        std::to_string(change.solid_fraction.n),
                        difference_text(change.solid_fraction, solid_fraction_decimals),
                        difference_text(change.coordination, coordination_decimals)});
  }
  if (lines.empty()) return "";
  return "What the search for exact rest changes, against the same starts without it:\n\n" +
         table_head({"beds of", "certified", "starts", "phi", "Z"}) + lines + "\n";
}

std::string csv_row(const std::string& scene, const Compared& row) {
  const Setting& setting = *row.setting;
  const auto two = [](const MeanError& of) { return cell(of.mean) + "," + cell(of.error); };
  return cell(scene) + "," + cell(setting.name) + "," + cell(setting.preset) + "," +
         cell(row.solid_fraction.n) + "," + cell(row.made) + "," + cell(row.settled) + "," +
         cell(row.cpu_seconds) + "," + cell(row.relative_cost) + "," + two(row.solid_fraction) +
         "," + two(row.coordination) + "," + two(row.lambda) + "," + two(row.force_square) + "," +
         cell(row.contact_ratio) + "," + cell(row.on_front ? 1 : 0) + "\n";
}

}  // namespace

std::string difference_text(const MeanError& difference, int decimals) {
  if (std::isnan(difference.mean)) return "-";
  return (difference.mean < 0.0 ? "" : "+") + fixed(difference.mean, decimals) + " +- " +
         fixed(difference.error, decimals);
}

std::string trade_markdown(const SceneRows& compared) {
  return scene_table(compared) + bounds_table(compared) + exact_table(compared);
}

std::string trade_csv(const SceneRows& compared) {
  std::string text =
      "scene,accuracy,preset,starts,made,settled,cpu_seconds,relative_cost,solid_fraction,"
      "solid_fraction_error,coordination,coordination_error,lambda,lambda_error,force_square,"
      "force_square_error,contact_ratio,on_front\n";
  for (const Compared& row : compared.rows) text += csv_row(compared.scene->name, row);
  return text;
}

}  // namespace grainsweep::bench
