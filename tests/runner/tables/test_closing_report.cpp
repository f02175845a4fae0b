#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/tables/closing_report.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/sweep/sweep_files.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

std::vector<Row> sample_rows() {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0}) {
    const double phi = 0.64 - 0.2 / width, z = 6.1 - 3.0 / width;
    const std::string id = std::to_string(static_cast<int>(width));
    rows.push_back(settled_row("a" + id, width, phi - 0.001, z - 0.01));
    rows.push_back(settled_row("b" + id, width, phi + 0.001, z + 0.01));
  }
  rows.push_back(settled_row("p", 20, 0.639, 6.05, Boundary::periodic));
  rows.push_back(row_with_status("u", 10, PackingStatus::not_settled, "grains still move"));
  return rows;
}

Provenance reported_provenance() {
  Provenance provenance;
  provenance.sweeps = {{"a.json", ""}};
  provenance.sweep_name = "a";
  RunRecord run;
  run.ended = "end", run.wall_seconds = 3.25, run.threads = 2, run.isa = "avx2", run.packings = 8;
  provenance.runs = {run};
  return provenance;
}

std::string report_of(const Provenance& provenance, const std::vector<Row>& rows,
                      const std::string& folder) {
  return closing_report(provenance, rows, analyse(rows).families, {"./run.sh", folder});
}

TEST_CASE("a sweep with units says all again in them") {
  Provenance provenance = reported_provenance();
  provenance.units = Units{3.2, "mm", 2500.0};
  const std::string report = report_of(provenance, sample_rows(), "out/a");
  CHECK_THAT(report,
             Catch::Contains("\n"
                             "      C = 0.200 ± 0.015 d = 0.640 ± 0.048 mm,  ζ = C/φ_bulk = "
                             "0.313 ± 0.022 d = 1.000 ± 0.071 mm\n"
                             "      (χ²/dof 0.00, R² 1.000, 3 widths)\n"));
  CHECK_THAT(report, Catch::Contains("\n"
                                     "d = 3.2 mm, grains of 2500 kg/m³\n"
                                     "  W/mm             porosity ± error    kg/m³ ± error\n"
                                     "  12.8              0.4100 ± 0.0016         1475 ± 4\n"
                                     "  16                0.4000 ± 0.0016         1500 ± 4\n"
                                     "  32                0.3800 ± 0.0016         1550 ± 4\n"
                                     "  64 periodic       0.3610 ± 0.0023         1598 ± 6\n"));
}

TEST_CASE("the closing report as a whole") {
  CHECK(
      report_of(reported_provenance(), sample_rows(), "out/a") ==
      "a: 8 packings, 7 settled; left out of means and fits: 1 did not settle\n"
      "\n"
      "MSP\n"
      "  W/d                φ ± error       Z ± error  contacts/iso  overlap/d  packings\n"
      "  4            0.5900 ± 0.0016   5.350 ± 0.016        0.9998    8.0e-05         2\n"
      "  5            0.6000 ± 0.0016   5.500 ± 0.016        0.9998    8.0e-05         2\n"
      "  10           0.6200 ± 0.0016   5.800 ± 0.016        0.9998    8.0e-05    2 of 3\n"
      "  20 periodic  0.6390 ± 0.0023   6.050 ± 0.023        0.9998    8.0e-05         1\n"
      "  φ = φ_bulk - C/W:  φ_bulk = 0.6400 ± 0.0029 ± 0.0020 protocol; periodic 0.6390 ± 0.0023\n"
      "      C = 0.200 ± 0.015 d,  ζ = C/φ_bulk = 0.313 ± 0.022 d  (χ²/dof 0.00, R² 1.000, 3 "
      "widths)\n"
      "  Z = Z_bulk - C_Z/W:  Z_bulk = 6.100 ± 0.029 ± 0.036 protocol; periodic 6.050 ± 0.023\n"
      "      C_Z = 3.00 ± 0.15 d,  ζ = C_Z/Z_bulk = 0.492 ± 0.022 d  (χ²/dof 0.00, R² 1.000, 3 "
      "widths)\n"
      "\n"
      "Lengths in d, the mean diameter of the grains. φ: exact solid volume between 3 d above the "
      "floor and\n"
      "3 d below the surface. Z: neighbours per grain there with gap < 1e-04 d, walls not counted. "
      "±:\n"
      "standard error, wider where few packings tell it; what single packings scatter by is in "
      "groups.csv.\n"
      "contacts/iso: force-bearing contacts over the isostatic count, 1 at perfect rest.\n"
      "Only settled packings enter means and fits.\n"
      "Protocol: means of beds settled ever better lie within 0.0020 (φ) and 0.036 (Z).\n"
      "\n"
      "Not in the means:\n"
      "  u (MSP, W = 10): not settled\n"
      "      grains still move\n"
      "\n"
      "CPU time of all packings 6.00 s; last run 3.25 s for 8 packings on 2 threads, avx2\n"
      "Tables in out/a: packings.csv, groups.csv, fits.csv, profiles.csv, decays.csv and more;\n"
      "provenance.json says how they were made\n"
      "Next: ./run.sh export out/a --format vtp writes the grains for ParaView\n");
}

TEST_CASE("during a run the report proposes no other one") {
  std::vector<Row> rows = sample_rows();
  rows[0].outcome = {};
  const auto report_where = [&](bool is_worked_on) {
    return closing_report(reported_provenance(), rows, analyse(rows).families,
                          {"./run.sh", "out/a", true, is_worked_on});
  };
  CHECK_THAT(report_where(false), Catch::Contains("Next: ./run.sh run a.json --out out/a makes"));
  Provenance at_work = reported_provenance();
  at_work.runs[0].ended.clear();
  CHECK_THAT(report_of(at_work, rows, "out/a"), Catch::Contains("; the last run has not ended\n"));
  CHECK_THAT(report_where(true), !Catch::Contains("Next: ") &&
                                     Catch::EndsWith("A runner makes what is missing: ./run.sh "
                                                     "status out/a tells how far it is\n"));
}

TEST_CASE("a single packing is told as one") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 6)};
  CHECK_THAT(report_of(reported_provenance(), rows, "out/a"),
             Catch::StartsWith("a: 1 packing, 1 settled\n"));
}

TEST_CASE("of beds without grains the report says no more than where the tables are") {
  const std::vector<Row> rows = sample_rows();
  CHECK_THAT(closing_report(reported_provenance(), rows, analyse(rows).families,
                            {"./run.sh", "out/a", false}),
             Catch::EndsWith("provenance.json says how they were made\n"));
}

TEST_CASE("whether beds have grains is told by the first of them that can be read") {
  const TemporaryFolder folder;
  std::vector<Row> rows = {settled_row("a", 5, 0.6, 6), settled_row("b", 5, 0.6, 6)};
  CHECK_FALSE(has_grains(folder.path(), rows));  // none has a bed
  StoredBed bed;
  bed.state_hash = rows[0].outcome->result.state_hash;
  for (Row& row : rows) {
    bed.job = row.job.id;
    bed.grains.resize(row.job.id == "a" ? 0 : 3);
    add_stored_bed(folder.path(), bed, *row.outcome);
  }
  CHECK_FALSE(has_grains(folder.path(), rows));
  damage_bed(folder.path(), *rows[0].outcome, 30);
  CHECK(has_grains(folder.path(), rows));
}

TEST_CASE("what the protocol does to means is said to be unknown, or bounded in another table") {
  std::vector<Row> rows = sample_rows();
  for (Row& row : rows) row.job.accuracy = "custom";
  CHECK_THAT(
      report_of(reported_provenance(), rows, "out"),
      Catch::Contains("such packings was not measured.\n") && !Catch::Contains(" protocol;"));
  rows.push_back(settled_row("f", 5, 0.6, 5.5));
  rows.back().job.parameters = sample_parameters(5.0, Boundary::walls, 0.25);
  CHECK_THAT(report_of(reported_provenance(), rows, "out"),
             Catch::Contains("does to means: groups.csv.\n"));
}

TEST_CASE("a report of a stopped run says how to go on") {
  std::vector<Row> rows = sample_rows();
  rows[0].outcome.reset();
  const std::string text = report_of(reported_provenance(), rows, "out/a");
  CHECK_THAT(text, Catch::Contains("1 did not settle, 1 not made yet"));
  CHECK_THAT(text, Catch::Contains("Next: ./run.sh run a.json --out out/a makes what is missing"));
}

TEST_CASE("d is called what it is: a diameter, the unit of shapes or one chosen for sizes") {
  Row row = settled_row("a", 5, 0.6, 6);
  CHECK_THAT(report_of(reported_provenance(), {row}, "out"),
             Catch::Contains("Lengths in d, the mean diameter of the grains."));
  row.job.small_share = 0.25;
  CHECK_THAT(report_of(reported_provenance(), {row}, "out"),
             Catch::Contains("Lengths in d, the mean diameter of the large grains."));
  CHECK_THAT(report_of(reported_provenance(), {row, settled_row("b", 6, 0.6, 6)}, "out"),
             Catch::Contains("Lengths in d, the mean diameter of the large grains. φ: exact solid "
                             "volume between 3 d above the\nfloor"));
  row.job.shape = "cube";
  CHECK_THAT(report_of(reported_provenance(), {row}, "out"),
             Catch::Contains("Lengths in d, the unit in which shapes are written."));
  row.job.shape = "hull";
  CHECK_THAT(report_of(reported_provenance(), {row}, "out"),
             Catch::Contains("Lengths in d, the length of a hull that is its \"size\"."));
  row.job.parameters =
      R"({"box":{"width":5},"sizes":{"distribution":{"lognormal":{"sigma":0.1}}}})";
  CHECK_THAT(report_of(reported_provenance(), {row}, "out"),
             Catch::Contains("Lengths in d, the length chosen as 1 for sizes. φ"));
  CHECK_THAT(report_of(reported_provenance(), {row, settled_row("b", 6, 0.6, 6)}, "out"),
             Catch::Contains("Lengths in d, the length chosen as 1 for sizes, or the mean diameter "
                             "of the grains. φ"));
}

TEST_CASE("a report of too few widths says why there is no fit") {
  const std::string text = report_of(reported_provenance(), {settled_row("a", 5, 0.6, 6)}, "out/a");
  CHECK_THAT(text, Catch::Contains("Z_bulk - C_Z/W:  not determined: needs packings at 3 or more"));
}

TEST_CASE("a table with any walls says that there is no fit, wherever they stand in it") {
  const Row walled = settled_row("a", 5, 0.6, 5.5);
  const Row periodic = settled_row("b", 5, 0.62, 5.7, Boundary::periodic, 0.25);
  for (const std::vector<Row>& rows : {std::vector<Row>{walled, periodic}, {periodic, walled}}) {
    CHECK_THAT(report_of(reported_provenance(), rows, "out/a"),
               Catch::Contains("not determined: needs packings at 3 or more"));
  }
  CHECK_THAT(report_of(reported_provenance(), {periodic}, "out/a"),
             !Catch::Contains("not determined"));
}

TEST_CASE("a report of collected sweeps names no file to go on with") {
  Provenance collected = reported_provenance();
  collected.sweeps.push_back({"b.json", ""});
  CHECK_THAT(report_of(collected, {{sample_job("a", 5), std::nullopt}}, "out/a"),
             Catch::Contains("Next: ./run.sh run FILE --out out/a makes what is missing"));
}

/// What a sweep varies, and lines that its closing table must have: what they begin with, then what
/// they hold.
struct ReportedSweep {
  std::string what;
  std::string blocks;
  std::vector<std::string> lines;
  PackingStatus status = PackingStatus::settled;
};

const std::vector<ReportedSweep> reported_sweeps = {
    {"nothing", "", {"a", "  10  ", "  φ = φ_bulk - C/W and Z = Z_bulk"}},
    {"width",
     R"({ "grid": { "box.width": [5, 8, 12] } })",
     {"block 1", "  5  ", "  8  ", "  12  ", "      C = 0.", "      C_Z = "}},
    {"height",
     R"({ "label": "deep", "grid": { "fill.solid_height": [8, 10, 12.5] } })",
     {"deep", "  solid_height=8     10  ", "  solid_height=10    10  ",
      "  solid_height=12.5  10  "}},
    {"width at two heights",
     R"({ "grid": { "fill.solid_height": [8, 10], "box.width": [5, 8, 12] } })",
     {"block 1 solid_height=8", "block 1 solid_height=10", "  5  ", "  12  "}},
    {"spread",
     R"({ "grid": { "sizes.spread": [0, 0.1] } })",
     {"  spread=0    10  ", "  spread=0.1  10  "}},
    {"angle",
     R"({ "set": { "shape": "pinacoid" },
          "grid": { "shape.pinacoid.angle_deg": [45, 60] } })",
     {"  angle_deg=45  10  ", "  angle_deg=60  10  "}},
    {"parts of the accuracy, one of them as in the preset",
     R"({ "grid": { "accuracy.path_tolerance": [1e-4, 2e-4] } })",
     {" path_tolerance=1e-04", " path_tolerance=2e-04"}},
    {"presets and a part",
     R"({ "grid": { "accuracy.preset": ["fast", "accurate"], "accuracy.step": [0.1, 0.2] } })",
     {" accuracy=fast step=0.1", " accuracy=accurate step=0.2"}},
    {"several parts of accuracies",
     R"({ "grid": { "accuracy": ["fast", {"preset": "fast", "step": 0.1},
                                 {"preset": "fast", "creep_steps": 80}] } })",
     {" accuracy=fast", " accuracy=fast step=0.1", " accuracy=fast creep_steps=80"}},
    {"lists",
     R"({ "grid": { "measure.gap_tolerances": [[1e-4], [1e-4, 1e-3]] } })",
     {" gap_tolerances=[0.0001,0.001]"}},
    {"shapes",
     R"({ "set": { "box.width": 8, "box.y": "periodic" },
          "grid": { "shape": ["cube", "octahedron", {"prism": {"sides": 3}},
                              {"prism": {"sides": 5}}] } })",
     {" shape=cube", " shape=octahedron", " shape=prism sides=3", " shape=prism sides=5"}},
    {"presets",
     R"({ "grid": { "accuracy": ["fast", "balanced"] } })",
     {"  accuracy=fast      10  ", "  accuracy=balanced  10  "}},
    {"several at once",
     R"({ "grid": { "sizes.small_share": [0.1, 0.2], "fill.solid_height": [9, 10] } })",
     {" solid_height=9 small_share=0.1", " solid_height=10 small_share=0.2", "  10  "}},
    {"two labels",
     R"({ "label": "a", "set": { "sizes.spread": 0 } }, { "label": "b" })",
     {"a", "b", "  10  "}},
    {"walls and none",
     R"({ "label": "walls", "grid": { "box.width": [5, 8, 12] } },
        { "label": "bulk", "set": { "box.width": 20, "box.y": "periodic" } })",
     {"walls (periodic: bulk)", "  12  ", "  20 periodic  ", "  φ = φ_bulk - C/W:  φ_bulk = "}},
    {"walls and none, each with shares",
     R"({ "label": "walls", "grid": { "sizes.small_share": [0, 0.1] } },
        { "label": "open", "set": { "box.y": "periodic" },
          "grid": { "sizes.small_share": [0, 0.1] } })",
     {"walls (periodic: open)", "  small_share=0    10           ",
      "  small_share=0.1  10 periodic  "}},
    {"no walls at all",
     R"({ "set": { "box.y": "periodic" }, "grid": { "box.width": [5, 8, 12] } })",
     {"  5 periodic  ", "  12 periodic  "}},
    {"random points",
     R"({ "random": { "count": 100, "box.width": { "uniform": [5, 9] },
                      "sizes.small_share": { "uniform": [0.2, 0.4] } } })",
     {" small_share=0.", "  and 40 more, see groups.csv"}},
    {"random widths",
     R"({ "random": { "count": 100, "box.width": { "uniform": [5, 9] } } })",
     {"  and 40 more, see groups.csv", "      C = "}},
    {"everything unsettled",
     R"({ "grid": { "box.width": [5, 8, 12] } })",
     {"  5                          -               -             -          -    0 of 2",
      "  φ = φ_bulk - C/W:  not determined:",
      "      needs settled packings at 3 or more widths with otherwise equal parameters, has 0",
      "Not in the means:", "  and 1 more, see packings.csv"},
     PackingStatus::not_settled},
};

/// Rows of a sweep with outcomes that differ from replicate to replicate.
std::vector<Row> rows_of_sweep(const ReportedSweep& reported) {
  const SweepReading reading = reading_of(
      R"({ "name": "a", "replicates": 2, "base": { "box": { "length": 12, "width": 10 } })" +
      (reported.blocks.empty() ? "" : R"(, "sweep": [ )" + reported.blocks + " ]") + " }");
  CHECK(reading.errors.empty());
  std::vector<Row> rows = rows_of(reading.sweep);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double off = k % 2 == 0 ? 0.001 : -0.001, width = rows[k].job.box.width;
    rows[k].outcome = sample_outcome(rows[k].job.id, 0.64 - 0.3 / width + off, 6.0 + 5.0 * off);
    rows[k].outcome->result.status = reported.status;
    rows[k].outcome->result.small_share = rows[k].job.small_share;
  }
  return rows;
}

/// Columns of a line as a terminal shows it.
std::size_t columns_of(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
  }));
}

TEST_CASE("small grains that sank out of the slab are warned of, a few in a hundred are not") {
  const auto text_of = [](double slab_share) {
    std::vector<Row> rows = {settled_row("a", 5, 0.6, 6), settled_row("b", 5, 0.6, 6)};
    for (Row& row : rows) {
      row.job.small_share = 0.21;  // told by size the bed has less
      row.outcome->result.small_share = slab_share;
      row.outcome->result.small_share_of_bed = 0.2;
    }
    return report_of(reported_provenance(), rows, "out/a");
  };
  CHECK_THAT(text_of(0.05), Catch::Contains("Warning: small grains are not where") &&
                                Catch::Contains(", W = 5: 0.050 of the solid volume, in the whole "
                                                "bed 0.200\n"));
  CHECK_THAT(text_of(0.23), Catch::Contains("0.230 of the solid volume"));
  CHECK_THAT(text_of(0.19), !Catch::Contains("Warning"));
}

TEST_CASE("fine grains of a distribution that sank out of the slab are warned of, too") {
  const auto text_of = [](double slab_share) {
    std::vector<Row> rows = {settled_row("a", 5, 0.6, 6), settled_row("b", 5, 0.6, 6)};
    for (Row& row : rows) {
      row.job.parameters = R"({"sizes":{"distribution":{"by":"volume"}}})";
      const double scatter = row.job.id == "a" ? 1e-4 : -1e-4;
      row.outcome->result.sizes = {{0.2, 0.1, 0.1, slab_share + scatter}, {1, 1, 1, 1}};
    }
    return report_of(reported_provenance(), rows, "out/a");
  };
  CHECK_THAT(text_of(0.07),
             Catch::Contains("Warning: small grains are not where") &&
                 Catch::Contains(
                     ", W = 5: 0.070 by volume up to 0.2 d, in the whole bed 0.100 (sizes.csv)\n"));
  CHECK_THAT(text_of(0.095), !Catch::Contains("Warning"));
  CHECK_THAT(text_of(0.095), Catch::Contains(", decays.csv, sizes.csv and more;\n"));
}

TEST_CASE("beds that do not hold the share of small grains that was asked for are warned of") {
  const auto text_of = [](double share_of_bed) {
    std::vector<Row> rows = {settled_row("a", 5, 0.6, 6), settled_row("b", 5, 0.6, 6)};
    for (Row& row : rows) {
      row.job.small_share = 0.01;
      row.outcome->result.small_share = share_of_bed;
      row.outcome->result.small_share_of_bed = share_of_bed;
    }
    return report_of(reported_provenance(), rows, "out/a");
  };
  CHECK_THAT(text_of(0.0),
             Catch::Contains("Warning: beds hold another share of small grains") &&
                 Catch::Contains(", W = 5: 0.0000 of the solid volume, asked for 0.01\n"));
  CHECK_THAT(text_of(0.0112), Catch::Contains("0.0112 of the solid volume"));
  CHECK_THAT(text_of(0.0095), !Catch::Contains("Warning"));
}

TEST_CASE("the closing table of any sweep has a line per group, told apart, on 100 columns") {
  for (const ReportedSweep& reported : reported_sweeps) {
    INFO(reported.what);
    const std::vector<Row> rows = rows_of_sweep(reported);
    REQUIRE_FALSE(rows.empty());
    std::istringstream text(report_of(reported_provenance(), rows, "out/a"));
    std::vector<std::string> lines;
    std::size_t tabled = 0, left_out = 0;
    for (std::string line; std::getline(text, line);) {
      CHECK(columns_of(line) <= 100);
      const bool is_group = line.ends_with("         2") || line.ends_with(" 0 of 2");
      tabled += is_group ? 1 : 0;
      if (line.ends_with("more, see groups.csv")) left_out += std::stoul(line.substr(6));
      lines.push_back(line);
    }
    CHECK(2 * (tabled + left_out) == rows.size());
    for (const std::string& start : reported.lines) {
      INFO(start);
      CHECK(std::any_of(lines.begin(), lines.end(),
                        [&](const std::string& line) { return line.starts_with(start); }));
    }
  }
}

TEST_CASE("only the first reasons are listed") {
  std::vector<Row> rows;
  for (int i = 0; i < 9; ++i) {
    rows.push_back(row_with_status(std::string("u").append(std::to_string(i)), 5,
                                   PackingStatus::failed, "no room"));
  }
  const std::string text = report_of(reported_provenance(), rows, "out/a");
  CHECK_THAT(text, Catch::Contains("u4 (MSP") && !Catch::Contains("u5 (MSP"));
  CHECK_THAT(text, Catch::Contains("and 4 more, see packings.csv"));
}

}  // namespace
}  // namespace grainsweep
