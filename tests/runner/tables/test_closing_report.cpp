#include <catch2/catch.hpp>

#include "runner/tables/closing_report.hpp"
#include "tests/runner/sample_rows.hpp"

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
  return closing_report(provenance, rows, analyse(rows).families, folder);
}

TEST_CASE("the closing report as a whole") {
  CHECK(report_of(reported_provenance(), sample_rows(), "out/a") ==
        "a: 8 packings, 7 settled; left out of means and fits: 1 did not settle\n"
        "\n"
        "MSP\n"
        "  W/d                       φ ± sd           Z ± sd contacts/iso   overlap/d  packings\n"
        "  4                0.5900 ± 0.0014    5.350 ± 0.014       0.9998     8.0e-05         2\n"
        "  5                0.6000 ± 0.0014    5.500 ± 0.014       0.9998     8.0e-05         2\n"
        "  10               0.6200 ± 0.0014    5.800 ± 0.014       0.9998     8.0e-05    2 of 3\n"
        "  20 periodic           0.6390 ± -        6.050 ± -       0.9998     8.0e-05         1\n"
        "  φ = φ_bulk - C/W:  φ_bulk = 0.6400 ± 0.0018; periodic 0.6390\n"
        "      C = 0.200 ± 0.009 d,  ζ = C/φ_bulk = 0.313 ± 0.014 d  (χ²/dof 0.00, R² 1.000, 3 "
        "widths)\n"
        "  Z = Z_bulk - C_Z/W:  Z_bulk = 6.100 ± 0.018; periodic 6.050\n"
        "      C_Z = 3.00 ± 0.09 d,  ζ = C_Z/Z_bulk = 0.492 ± 0.014 d  (χ²/dof 0.00, R² 1.000, 3 "
        "widths)\n"
        "\n"
        "Lengths in d, the mean diameter of the large grains. φ: exact solid volume between 3 d "
        "above\n"
        "the floor and 3 d below the surface. Z: neighbours per grain there with gap < 1e-04 d, "
        "walls not\n"
        "counted. ± in a row: standard deviation of the replicates; of a fitted value: its "
        "standard error.\n"
        "contacts/iso: force-bearing contacts over the isostatic count, 1 at perfect rest.\n"
        "Only settled packings enter means and fits.\n"
        "\n"
        "Not in the means:\n"
        "  u (MSP, W = 10): not_settled: grains still move\n"
        "\n"
        "CPU time of all packings 6.00 s; last run 3.25 s for 8 packings on 2 threads, avx2\n"
        "Tables in out/a: packings.csv, groups.csv, fits.csv, profiles.csv, decays.csv and more;\n"
        "provenance.json says how they were made\n"
        "Next: grainsweep export out/a --format vtp writes the grains for ParaView\n");
}

TEST_CASE("a report of a stopped run says how to go on") {
  std::vector<Row> rows = sample_rows();
  rows[0].outcome.reset();
  const std::string text = report_of(reported_provenance(), rows, "out/a");
  CHECK_THAT(text, Catch::Contains("1 did not settle, 1 not made yet"));
  CHECK_THAT(text,
             Catch::Contains("Next: grainsweep run a.json --out out/a makes what is missing"));
}

TEST_CASE("a report of too few widths says why there is no fit") {
  const std::string text = report_of(reported_provenance(), {settled_row("a", 5, 0.6, 6)}, "out/a");
  CHECK_THAT(text, Catch::Contains("φ_bulk - C/W:  not determined: needs settled packings at 3"));
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
