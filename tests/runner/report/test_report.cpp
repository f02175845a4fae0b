#include <cstdlib>
#include <filesystem>

#include <catch2/catch.hpp>

#include "runner/report/page.hpp"
#include "runner/report/report.hpp"
#include "runner/report/sections.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

using namespace grainsweep;

namespace {

const std::string evil = "</script><script>alert(\"1\")</script> 'q', \"c\" `touch here` $(x) %d";

std::vector<Row> evil_rows() {
  std::vector<Row> rows = {settled_row("a", 4, 0.6, 5.0), settled_row("b", 5, 0.61, 5.2),
                           row_with_status("c", 6, PackingStatus::not_settled, evil)};
  for (Row& row : rows) {
    row.job.label = evil;
    static_cast<Curves&>(row.outcome->result) = sample_curves();
  }
  return rows;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("labels, reasons and sweep files cannot become part of the page", "[report]") {
  const TemporaryFolder folder;
  const std::vector<Row> rows = evil_rows();
  Provenance provenance;
  provenance.sweep_name = evil;
  provenance.sweeps = {{evil, evil}};
  RunRecord run;
  run.started = run.command = run.host = evil;
  provenance.runs = {run};
  write_report(folder.path(), provenance, rows, analyse(rows));
  const std::string page = read_file(folder.path() + "/report.html");
  CHECK(count_of(page, "<script>") == 1);
  CHECK(count_of(page, "</script>") == 1);
  CHECK(count_of(page, "`touch here`") > 2);
  CHECK_FALSE(file_exists(folder.path() + "/figures/here"));
}

TEST_CASE("the page of a sweep without packings is whole", "[report]") {
  const TemporaryFolder folder;
  const std::vector<Row> rows;
  CHECK(write_report(folder.path(), {}, rows, analyse(rows)).empty());
  const std::string page = read_file(folder.path() + "/report.html");
  CHECK(page.find("Not determined: no packing has settled.") != std::string::npos);
  CHECK(page.find("</html>") != std::string::npos);
}

TEST_CASE("published values are kept for when they are no longer beside the sweep", "[report]") {
  const TemporaryFolder folder;
  const std::string sweep = folder.path() + "/s.json", out = folder.path() + "/out";
  const std::string beside = folder.path() + "/s.reference.json";
  std::filesystem::create_directory(out);
  const std::vector<Row> rows = {settled_row("a", 4, 0.6, 5.0), settled_row("b", 4, 0.61, 5.2)};
  Provenance provenance;
  provenance.sweeps = {{sweep, "{}"}};
  const auto report = [&] {
    return write_report(out, provenance, rows, analyse(rows), PageExtent::text);
  };
  replace_file(out + "/comparison.csv", "of an earlier version");
  CHECK(report() == std::vector<std::string>{"report.html has no published values: " + beside +
                                             " is not there; comparison.csv is left as it was"});
  CHECK(read_file(out + "/comparison.csv") == "of an earlier version");
  replace_file(beside, R"({"source": "a book", "families": [{"where": {}, "values": )"
                       R"([{"quantity": "phi", "width": 4, "value": 0.61}]}]})");
  CHECK(report().empty());
  CHECK(read_file(out + "/reference.json") == read_file(beside));
  const std::string compared = read_file(out + "/comparison.csv");
  std::filesystem::remove(beside);
  CHECK(report() ==
        std::vector<std::string>{"published values are those of the last run, kept in " + out +
                                 "/reference.json: " + beside + " is not there"});
  CHECK(read_file(out + "/comparison.csv") == compared);
  CHECK_THAT(read_file(out + "/report.html"), Catch::Contains("a book"));
}

TEST_CASE("packings that did not settle come first, with reason and remedy", "[report]") {
  const std::vector<Row> rows = {settled_row("aa", 4, 0.6, 5.0),
                                 row_with_status("bb", 5, PackingStatus::failed, "no room"),
                                 {sample_job("cc", 6), std::nullopt}};
  const std::string html = packings_section(rows, groups_of(rows));
  const std::size_t failed = html.find(">bb<"), pending = html.find(">cc<");
  CHECK(failed < pending);
  CHECK(pending < html.find(">aa<"));
  CHECK(html.find("no room") > failed);
  CHECK(html.find(remedy_of(rows[1])) > failed);
  CHECK(remedy_of(rows[0]).empty());
}

TEST_CASE("the page tells how the components of mixtures touch each other", "[report]") {
  const std::vector<Row> rows = {mixture_row("a", 4), mixture_row("b", 4), polyhedra_row("c", 5)};
  const std::vector<Group> groups = groups_of(rows);
  const std::string html = components_section(groups, "");
  CHECK(count_of(html, "<tr>") == 1 + 4);  // and the headings
  CHECK_THAT(html, Catch::Contains("over an area") && Catch::Contains("<td>0.500") &&
                       Catch::Contains("<td>1 cube</td><td>2 sphere</td>"));
  const std::vector<Row> others = {polyhedra_row("b", 5)};
  CHECK(components_section(groups_of(others), "").empty());
}

TEST_CASE("families with one width have one line together, not rows without a fit", "[report]") {
  std::vector<Row> rows;
  for (const double share : {0.1, 0.2, 0.3}) {
    rows.push_back(settled_row(std::to_string(rows.size()), 4, 0.6, 5.0, Boundary::walls, share));
  }
  const std::string alone = fits_section(analyse(rows).families);
  CHECK(alone ==
        "<p class=\"note\">No line for 3 families, each of whose packings have one W: a line "
        "needs 3 or more.</p>\n");
  rows.push_back(settled_row("b", 5, 0.6, 5.0, Boundary::walls, 0.3));
  const std::string html = fits_section(analyse(rows).families);
  CHECK_THAT(html, Catch::Contains("No line for 2 families"));
  CHECK(count_of(html, "<tr>") == 1 + 2);  // and the headings
  CHECK_THAT(html, Catch::Contains("has 2"));
  rows.erase(rows.begin());
  CHECK_THAT(fits_section(analyse(rows).families),
             Catch::Contains("No line for 1 family, whose packings have one W:"));
}

TEST_CASE("of many packings the page shows 2,000 and leads to all", "[report]") {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < most_packings + 5; ++k) {
    rows.push_back(settled_row(std::to_string(k), 4, 0.6, 5.0));
    rows.back().job.replicate = static_cast<int>(k) + 1;
  }
  const std::string html = packings_section(rows, groups_of(rows));
  CHECK(count_of(html, "<tr>") == most_packings + 1);
  CHECK(html.find("href=\"packings.csv\"") != std::string::npos);
}

TEST_CASE("of many parameter sets the page shows 2,000 and leads to all", "[report]") {
  const std::vector<Row> rows = {settled_row("a", 4, 0.6, 5.0)};
  std::vector<Group> groups = groups_of(rows);
  groups.resize(most_groups, groups[0]);
  CHECK(count_of(groups_section(groups), "<tr>") == most_groups + 1);
  CHECK_THAT(groups_section(groups), !Catch::Contains("The first"));
  groups.push_back(groups[0]);
  CHECK(count_of(groups_section(groups), "<tr>") == most_groups + 1);
  CHECK_THAT(
      groups_section(groups),
      Catch::Contains("The first 2000 of 2001 parameter sets; all are in <a href=\"groups.csv\""));
}

TEST_CASE("without gnuplot the page says so and has all the rest", "[report]") {
  const TemporaryFolder folder;
  const std::vector<Row> rows = evil_rows();
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const std::vector<std::string> missing = write_report(folder.path(), {}, rows, analyse(rows));
  setenv("PATH", path.c_str(), 1);
  REQUIRE(missing.size() == 1);
  CHECK(missing[0].find("gnuplot-nox") != std::string::npos);
  const std::string page = read_file(folder.path() + "/report.html");
  CHECK(page.find("gnuplot-nox") != std::string::npos);
  CHECK(page.find("<table id=\"packings\">") != std::string::npos);
  CHECK(file_exists(folder.path() + "/figures/means.csv"));
}

TEST_CASE("a figure scrolls sideways where it is too wide, as tables do", "[report]") {
  PageParts parts;
  parts.figures = {{Figure{.name = "means", .title = "M < N", .caption = ""}, "<svg/>"}};
  const std::string page = page_text(parts);
  CHECK_THAT(page, Catch::Contains("<div class=\"wide\" tabindex=\"0\" role=\"region\" "
                                   "aria-label=\"M &lt; N\">\n<img width=\"960\"") &&
                       Catch::Contains("\">\n</div>\n<figcaption>") &&
                       Catch::Contains("min-width: 48rem"));
}

TEST_CASE("a report that is removed leaves nothing", "[report]") {
  const TemporaryFolder folder;
  const std::vector<Row> rows = evil_rows();
  write_report(folder.path(), {}, rows, analyse(rows));
  remove_report(folder.path());
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("files that others keep beside the figures stay", "[report]") {
  const TemporaryFolder folder;
  const std::vector<Row> rows = evil_rows();
  write_report(folder.path(), {}, rows, analyse(rows));
  const std::string own = folder.path() + "/figures/my.svg";
  const std::string half = folder.path() + "/figures/means.csv.tmp.77";
  replace_file(own, "mine");
  replace_file(half, "half");
  write_report(folder.path(), {}, rows, analyse(rows));
  CHECK_FALSE(file_exists(half));
  remove_report(folder.path());
  CHECK(files_in(folder.path() + "/figures", "", "") == std::vector<std::string>{"my.svg"});
}
