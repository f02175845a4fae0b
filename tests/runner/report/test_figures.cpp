#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "runner/report/figure.hpp"
#include "runner/report/figures.hpp"
#include "runner/report/plots.hpp"
#include "tests/runner/sample_rows.hpp"

using namespace grainsweep;

namespace {

/// Three replicates at three widths that lie on phi = 0.64 - 0.2 / W but for a scatter.
std::vector<Row> wall_rows() {
  std::vector<Row> rows;
  for (const double width : {4.0, 8.0, 16.0}) {
    for (const int replicate : {1, 2, 3}) {
      const double scatter = 1e-4 * (replicate - 2);
      Row row = settled_row(std::to_string(rows.size()), width, 0.64 - 0.2 / width + scatter, 6.0);
      row.job.replicate = replicate;
      static_cast<Curves&>(row.outcome->result) = sample_curves();
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

/// Three replicates with layers at both walls, to which a wave that they do not share is added.
std::vector<Row> layered_rows(double wave) {
  std::vector<Row> rows;
  std::mt19937_64 generator(1);
  std::normal_distribution<double> noise(0.0, 0.002);
  for (const char* id : {"a", "b", "c"}) {
    rows.push_back(settled_row(id, 10.0, 0.6, 6.0));
    Profile& profile = rows.back().outcome->result.profile_y;
    profile.bin_width = 0.1;
    for (int k = 0; k < 100; ++k) {
      const double y = std::min((k + 0.5) * 0.1, 10.0 - (k + 0.5) * 0.1);
      const double layers = 0.3 * std::exp(-y / 1.2) * std::cos(7.0 * y);
      profile.bins.push_back(
          {0.6 + layers + wave * std::sin(20.0 * y) + noise(generator), 0, 5, 0, 0, 0});
    }
  }
  return rows;
}

/// A packing whose sizes are a distribution.
Row graded_row(const std::string& id, std::vector<SizeRow> sizes) {
  Row row = settled_row(id, 5, 0.6, 6);
  row.job.label = id;
  row.job.parameters =
      R"({"box":{"width":5},"sizes":{"distribution":{"by":"volume","of":")" + id + R"("}}})";
  row.outcome->result.sizes = std::move(sizes);
  return row;
}

/// Points of two parameters at random, each with a value of its own.
std::vector<Row> random_rows() {
  std::vector<Row> rows;
  for (int k = 0; k < 20; ++k) {
    rows.push_back(settled_row(std::to_string(k), 3.00001 + 0.25 * k, 0.5 + 0.01 * k, 5.0,
                               Boundary::walls, 0.015625 * ((7 * k) % 20 + 1)));
  }
  return rows;
}

const Figure& figure_called(const std::vector<Figure>& figures, const std::string& name) {
  return *std::find_if(figures.begin(), figures.end(),
                       [&](const Figure& figure) { return figure.name == name; });
}

}  // namespace

TEST_CASE("text in a figure's commands cannot end its quotes or the line", "[report]") {
  CHECK(gnuplot_text("a'b`c`\n\"$(d)") == "'a''b`c` \"$(d)'");
}

TEST_CASE("keys have the columns that gnuplot finds room for, whatever the characters",
          "[report]") {
  const auto key_of = [](const std::string& title) {
    Figure figure;
    return Panels(figure, 1, {1.0}, {{"points ls 1", title}, {"points ls 2", "b"}}).key();
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(key_of(std::string(24, 'a')), "maxcols 3\n"));
  CHECK(has(key_of("φφφφφφφφφφφφφφφφφφφφφφφφ"), "maxcols 3\n"));  // two bytes each
  CHECK(has(key_of(std::string(25, 'a')), "maxcols 2\n"));
  CHECK(has(key_of(std::string(42, 'a')), std::string(42, 'a') + "'"));
  CHECK(has(key_of(std::string(43, 'a')), std::string(41, 'a') + "…'"));  // two of 43 have no room
}

TEST_CASE("long entries of a key keep their beginning and what tells them apart", "[report]") {
  const std::string begin = "glass beads with a coating of the second kind, batch ";
  const std::vector<KeyEntry> key = {{"points ls 1", begin + "7"}, {"points ls 2", begin + "8"}};
  Figure figure;
  CHECK_THAT(Panels(figure, 1, {1.0}, key).key(),
             Catch::Contains("'glass beads with a c… second kind, batch 7'") &&
                 Catch::Contains("'glass beads with a c… second kind, batch 8'"));
}

TEST_CASE("long entries of a key lose the end of their label before that of their values",
          "[report]") {
  const auto key_of = [](const std::string& a, const std::string& b) {
    Figure figure;
    return Panels(figure, 1, {1.0}, {{"points ls 1", a}, {"points ls 2", b}}).key();
  };
  CHECK_THAT(key_of("limestone 8/16, shape = prism, height = 0.5", "b"),
             Catch::Contains("'limestone 8/…, shape = prism, height = 0.5'"));
  // Labels that would then be alike stay whole.
  CHECK_THAT(key_of("limestone 8/16, shape = prism, height = 0.5",
                    "limestone 8/32, shape = prism, height = 0.5"),
             Catch::Contains("'limestone 8/16, shape = prism, height = 0…'"));
}

TEST_CASE("a figure grows with its key, so that its panels keep their height", "[report]") {
  const auto height_with = [](std::size_t entries) {
    Figure figure;
    const std::vector<KeyEntry> key(entries,
                                    {"points ls 1", std::string(30, 'a')});  // in two columns
    const Panels panels(figure, 1, {1.0}, key);
    return figure.height;
  };
  CHECK(height_with(4) == Figure{}.height);
  CHECK(height_with(13) == Figure{}.height + 5 * 20);
}

TEST_CASE("no two series have the same colour", "[report]") {
  std::set<std::string> colours;
  for (std::size_t k = 0; k < most_series; ++k) {
    const std::string style = series_style(k, k);
    colours.insert(style.substr(style.find('#'), 7));
  }
  CHECK(colours.size() == most_series);
}

TEST_CASE("axes reach to the ends of bars, but not of one beside which all others are nothing",
          "[report]") {
  using Ends = std::vector<double>;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(shown_ends({{6.0, 0.5}, {7.0, 0.25}, {5.0, none}}) == Ends{5.5, 6.5, 6.75, 7.25, 5.0, 5.0});
  CHECK(shown_ends({{6.0, 0.125}, {6.25, 0.125}, {8.0, 10.5}}) ==
        Ends{5.875, 6.125, 6.125, 6.375, 6.0, 10.0});  // the values span 2
  CHECK(shown_ends({{6.0, 0.5}}) == Ends{5.5, 6.5});
  CHECK(shown_ends({{6.0, 1.0}, {6.0, 2.0}}) == Ends{5.0, 7.0, 4.0, 8.0});  // alike, with bars
  CHECK(bars_text({{{6.0, none}}}).empty());
  CHECK(bars_text({{{6.0, 0.5}}}) == "; bars are standard errors");
  CHECK(bars_text({{{6.0, 0.1}, {6.1, 0.1}, {6.2, 5.0}}}, " at Z") ==
        "; bars at Z are standard errors, the longest of them cut at the frame");
}

TEST_CASE("a logarithmic axis shows all digits of its decades", "[report]") {
  CHECK(decade_tics_command("x", 0.95, 11.0) ==
        "set xtics (1, 2, '' 3 1, '' 4 1, 5, '' 6 1, '' 7 1, '' 8 1, '' 9 1, 10)\n");
}

TEST_CASE("series of kinds of contact have marks of their own", "[report]") {
  const std::vector<Row> rows = {mixture_row("a", 4), polyhedra_row("b", 5)};
  const Analysis analysis = analyse(rows);
  const std::vector<Figure> figures = figures_of(rows, analysis, {});
  const Figure& contacts = figure_called(figures, "contacts");
  CHECK(cell_in(contacts.tables[0].second, 1, "series") == "1");
  CHECK(cell_in(contacts.tables[0].second, 2, "series") == "2");
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(contacts.commands.find("pt " + std::to_string(mark_of(k)) + " title '") !=
          std::string::npos);
  }
}

TEST_CASE("of more series than a figure shows the others have no mark in it", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 14; ++k) {
    rows.push_back(polyhedra_row(std::to_string(k), 5));
    rows.back().job.label = "label " + std::to_string(k);
    rows.back().job.parameters = R"({"box":{"width":5},"kind":"of )" + std::to_string(k) + "\"}";
  }
  const Analysis analysis = analyse(rows);
  const std::vector<Figure> figures = figures_of(rows, analysis, {});
  const Figure& contacts = figure_called(figures, "contacts");
  CHECK(cell_in(contacts.tables[0].second, 12, "series") == "12");
  CHECK(cell_in(contacts.tables[0].second, 13, "series").empty());
  CHECK_THAT(contacts.caption, Catch::Contains("12 of 14 series are shown"));
  CHECK_THAT(figure_called(figures, "effort").commands, Catch::Contains("other series"));
  CHECK_THAT(figure_called(figures, "distributions").caption,
             Catch::Contains("6 of 14 groups are shown."));
}

TEST_CASE("of more series than marks the means draw the others in grey", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 14; ++k) {
    rows.push_back(settled_row(std::to_string(k), 5, k == 13 ? 0.9 : 0.6, 5.0));
    rows.back().job.label = "label " + std::to_string(k);
    rows.back().job.parameters = R"({"box":{"width":5},"kind":"of )" + std::to_string(k) + "\"}";
  }
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& means = figure_called(figures, "means");
  CHECK(cell_in(means.tables[0].second, 14, "series").empty());
  CHECK_THAT(
      means.commands,
      Catch::Contains("(strcol('series') eq '' ? (column('x')) : NaN)") &&
          Catch::Contains("NaN with points lc rgb '#bbbbbb' pt 7 ps 0.5 title 'other series'") &&
          Catch::Contains("set yrange [0.579:0.921]"));
  CHECK_THAT(means.caption,
             Catch::Contains("12 of 14 series have marks of their own, the others are grey."));
}

TEST_CASE("of a random design all points are drawn, over each of its numbers", "[report]") {
  const std::vector<Row> rows = random_rows();
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& figure = figure_called(figures, "parameters");
  const std::string& table = figure.tables.at(0).second;
  REQUIRE(cells_of_table(table).size() == 1 + 20);
  CHECK(cell_in(table, 2, "series") == "1");
  CHECK(cell_in(table, 2, "box.width") == "3.25001");
  CHECK(cell_in(table, 2, "sizes.small_share") == "0.125");
  CHECK(cell_in(table, 2, "solid_fraction") == "0.51");
  CHECK_THAT(figure.commands,
             Catch::Contains("set xlabel 'gap between the walls, W / d'") &&
                 Catch::Contains("set xlabel 'share of small grains in the solid volume'") &&
                 Catch::Contains("(column('sizes.small_share'))"));
  const Figure& means = figure_called(figures, "means");
  CHECK(cell_in(means.tables.at(0).second, 20, "series") == "1");
  CHECK_THAT(means.commands, !Catch::Contains("lw 0.8 dt 3"));  // what joins points of a series
  CHECK_THAT(means.caption, !Catch::Contains("No line"));
}

TEST_CASE("a series that lacks what is along the axis is not in the key of the means", "[report]") {
  std::vector<Row> rows;
  for (const char* sides : {"3", "5", "8", ""}) {
    rows.push_back(settled_row(std::string("n") + sides, 5, 0.6, 5.0));
    const bool is_cube = sides[0] == '\0';
    if (is_cube) rows.back().outcome->result.solid_fraction = 0.9;
    rows.back().job.label = is_cube ? "cubes" : "prisms";
    rows.back().job.parameters = R"({"shape":{)" +
                                 (is_cube ? std::string(R"("cube":{"edge":1)")
                                          : R"("prism":{"sides":)" + std::string(sides)) +
                                 "}}}";
  }
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& means = figure_called(figures, "means");
  CHECK_THAT(means.caption, Catch::Contains("No point for cubes: without shape.prism.sides."));
  CHECK_THAT(means.commands, Catch::Contains("ls 1 title 'prisms'") && !Catch::Contains("'cubes'"));
  CHECK_THAT(means.commands, Catch::Contains("set yrange [0.53:0.6"));  // 7 % of 1 about 0.6
}

TEST_CASE("a box beside tubes has its point although it has no diameter", "[report]") {
  std::vector<Row> rows;
  for (const double diameter : {4.0, 6.0, 8.0}) {
    rows.push_back(settled_row("t" + std::to_string(diameter), diameter, 0.6, 5.0));
    rows.back().job.box = tube_of(diameter);
    rows.back().job.label = "tubes";
    rows.back().job.parameters = R"({"tube":{"diameter":)" + std::to_string(diameter) + "}}";
  }
  rows.push_back(settled_row("b", 15, 0.6, 5.0, Boundary::periodic));
  rows.back().job.label = "bulk";
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& means = figure_called(figures, "means");
  CHECK(cell_in(means.tables[0].second, 4, "x") == "0");
  CHECK_THAT(means.caption, !Catch::Contains("No point for"));
  CHECK_THAT(means.commands, Catch::Contains("title 'bulk'"));
}

TEST_CASE("as many groups are drawn from the floor up as have distances drawn", "[report]") {
  const std::vector<Row> rows = random_rows();
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  for (const char* name : {"heights", "distributions"}) {
    CHECK_THAT(figure_called(figures, name).caption, Catch::Contains("6 of 20 groups are shown."));
  }
}

TEST_CASE("beside tubes the panel over the width says where those stand", "[report]") {
  std::vector<Row> rows = random_rows();
  rows.push_back(settled_row("t", 4, 0.55, 4.5));
  rows.back().job.box = tube_of(4.0);
  rows.back().job.parameters =
      R"({"accuracy":"balanced","shape":"sphere","sizes":{"small_share":0.0},"tube":{"diameter":4}})";
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& figure = figure_called(figures, "parameters");
  CHECK(cell_in(figure.tables.at(0).second, 21, "box.width") == "4");
  CHECK_THAT(
      figure.commands,
      Catch::Contains("set xlabel 'gap between the walls, W / d, and diameter of tubes, D / d'"));
}

TEST_CASE("widths above the means are short and do not overlap", "[report]") {
  const std::vector<Row> rows = random_rows();
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const std::string& commands = figure_called(figures, "means").commands;
  // a character takes 0.036 of 1 / 3.00001, so tics of five are at least 0.072 apart
  CHECK_THAT(commands, Catch::Contains("set x2tics ('7.75' 0.12903"));
  const std::size_t begin = commands.find("set x2tics ("), end = commands.find(')', begin);
  const std::string tics = commands.substr(begin, end - begin);
  CHECK(std::count(tics.begin(), tics.end(), ',') == 3);
  CHECK_THAT(tics, !Catch::Contains("0001'"));
}

TEST_CASE("bars over the height end where no solid fraction or coordination number can be",
          "[report]") {
  std::vector<Row> rows;
  for (const double phi : {0.25, 0.75}) {
    rows.push_back(settled_row(std::to_string(rows.size()), 5, 0.6, 6));
    rows.back().outcome->result.profile_z = {1.0, {{phi, 0, 10, 0, std::int64_t(80 * phi), 0}}};
  }
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const std::string& commands = figure_called(figures, "heights").commands;
  CHECK_THAT(commands, Catch::Contains("set yrange [0:1]\n"));
  CHECK_THAT(commands, !Catch::Contains("set yrange [-"));
}

TEST_CASE("densities of forces are drawn from the least to the largest that there is", "[report]") {
  std::vector<Row> rows = wall_rows();
  for (Row& row : rows) row.outcome->result.force_density = {0.5, {2.5, 0.25, 0, 0.125, 0}};
  const Analysis analysis = analyse(rows);
  const std::vector<Figure> figures = figures_of(rows, analysis, {});
  const std::string& commands = figure_called(figures, "distributions").commands;
  CHECK_THAT(commands,
             Catch::Contains("set xrange [0:2]\nset yrange [0.08333333333333333:3.75]\n"));
}

TEST_CASE("the axis of distances ends with the last curve, and the caption says why curves end",
          "[report]") {
  std::vector<Row> rows = wall_rows();
  const auto set_length = [&](std::size_t row, std::size_t bins) {
    rows[row].outcome->result.pair_correlation = {0.05, std::vector<double>(bins, 1.0)};
  };
  const auto drawn = [&] {
    return figure_called(figures_of(rows, analyse(rows), {}), "distributions");
  };
  for (std::size_t k = 0; k < rows.size(); ++k) set_length(k, k < 3 ? 40 : 50);
  CHECK_THAT(drawn().commands, Catch::Contains("set xrange [0:2.5]\nset xlabel 'distance"));
  CHECK_THAT(drawn().caption, Catch::Contains(" g ends at half a period"));
  for (std::size_t k = 0; k < rows.size(); ++k) set_length(k, k < 3 ? 40 : 100);
  CHECK_THAT(drawn().commands, Catch::Contains("set xrange [0:4]\nset xlabel 'distance"));
  CHECK_THAT(drawn().caption, Catch::Contains(" g ends at half a period"));
  for (std::size_t k = 0; k < 3; ++k) set_length(k, 100);
  CHECK_THAT(drawn().caption, !Catch::Contains(" g ends"));
}

TEST_CASE("a curve ends where a table has no value", "[report]") {
  CHECK_THAT(plot_part({"a.csv", "n", 1, "x", "y", "", "lines"}),
             Catch::Contains("(strcol('y') eq '' ? NaN : (column('y')))"));
}

TEST_CASE("the means over the width have the line of fits.csv and its residuals", "[report]") {
  const std::vector<Row> rows = wall_rows();
  const Analysis analysis = analyse(rows);
  const std::vector<Figure> figures = figures_of(rows, analysis, {});
  const Figure& means = figure_called(figures, "means");
  CHECK(means.not_drawn.empty());
  REQUIRE(means.tables.size() == 2);
  CHECK(cell_in(means.tables[0].second, 1, "x") == "0.25");
  CHECK(cell_in(means.tables[0].second, 1, "value") == "4");
  CHECK(std::stod(cell_in(means.tables[0].second, 1, "solid_fraction")) == Approx(0.59));
  CHECK(cells_of_table(means.tables[1].second).size() == 4);
  CHECK(means.commands.find("means-residuals.csv") != std::string::npos);
}

TEST_CASE("a line that does not hold is dashed, and the caption says so", "[report]") {
  std::vector<Row> rows = wall_rows();
  const auto means_of = [&] { return figure_called(figures_of(rows, analyse(rows), {}), "means"); };
  CHECK_THAT(means_of().caption, !Catch::Contains("does not hold"));
  CHECK_THAT(means_of().commands, !Catch::Contains(" lw 1 dt 2 notitle"));
  for (Row& row : rows) {
    if (row.job.box.width == 8.0) row.outcome->result.solid_fraction -= 0.02;
  }
  CHECK_THAT(means_of().caption,
             Catch::Contains(" Dashed, since the straight line does not hold: MSP (φ)."));
  CHECK_THAT(means_of().commands, Catch::Contains("with lines ls 1 lw 1 dt 2 notitle"));
}

TEST_CASE("a caption gives each line that is in doubt its own reason", "[report]") {
  std::vector<Row> rows = wall_rows();
  for (Row& row : rows) {
    row.job.box.width /= 2.0;
    row.outcome->result.coordination.front().between_grains += 1e-3 * row.job.replicate;
    if (row.job.box.width == 4.0) row.outcome->result.solid_fraction -= 0.02;
  }
  const std::string caption = figure_called(figures_of(rows, analyse(rows), {}), "means").caption;
  CHECK_THAT(caption, Catch::Contains(" Dashed, since the straight line does not hold: MSP (φ)."));
  CHECK_THAT(caption, Catch::Contains(" Dashed, since no line need hold in narrow containers"));
  CHECK_THAT(caption, Catch::Contains("ducts and tubes < 5 d): MSP (Z)."));
}

TEST_CASE("packings without walls have the colour of the line that they belong to", "[report]") {
  std::vector<Row> rows = wall_rows();
  const std::vector<Figure> alone = figures_of(rows, analyse(rows), {});
  CHECK_THAT(figure_called(alone, "means").commands, Catch::StartsWith("set multiplot"));
  CHECK_THAT(figure_called(alone, "means").caption, !Catch::Contains("Packings without walls"));
  rows.push_back(settled_row("p", 16, 0.64, 6.1, Boundary::periodic));
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  for (const char* name : {"means", "effort"}) {
    CHECK_THAT(figure_called(figures, name).commands, Catch::StartsWith(series_style(1, 0)));
  }
  CHECK_THAT(figure_called(figures, "means").caption,
             Catch::Contains(" Packings without walls along y stand at d / W = 0."));
}

TEST_CASE("captions speak of bars where there are any", "[report]") {
  const std::vector<Row> one = {settled_row("a", 4, 0.6, 5.0), settled_row("b", 5, 0.61, 5.1)};
  for (const Figure& figure : figures_of(one, analyse(one), {})) {
    CHECK_THAT(figure.caption, !Catch::Contains("bars"));
  }
}

TEST_CASE("beside a decay length stands where a damped cosine does not describe the layers",
          "[report]") {
  const auto caption_of = [](double wave) {
    const std::vector<Row> rows = layered_rows(wave);
    return figure_called(figures_of(rows, analyse(rows), {}), "profiles").caption;
  };
  CHECK_THAT(caption_of(0.0), Catch::Contains("λ = 1.") && !Catch::Contains("does not hold"));
  CHECK_THAT(caption_of(0.02),
             Catch::Contains("λ = 1.") &&
                 Catch::Contains("d, but the damped cosine does not hold: its misfit is "));
}

TEST_CASE("a reach beyond the middle is told as such and has no point", "[report]") {
  std::vector<Row> rows = layered_rows(0.0);  // 2.8 d
  for (Row& row : rows) {
    std::vector<ProfileBin>& bins = row.outcome->result.profile_y.bins;
    bins.erase(bins.begin() + 25, bins.end() - 25);
    row.job.box.width = 5.0;
  }
  CHECK_THAT(figure_called(figures_of(rows, analyse(rows), {}), "profiles").caption,
             Catch::Contains(" d, reach beyond the middle."));
  rows.push_back(settled_row("s", 5.0, 0.6, 6.0, Boundary::walls, 0.25));
  const Figure shares = figure_called(figures_of(rows, analyse(rows), {}), "small_grains");
  CHECK(cell_in(shares.tables.at(0).second, 1, "reach_large").empty());
}

TEST_CASE("the key of the layers has what is drawn", "[report]") {
  const auto profiles_of = [](const std::vector<Row>& rows) {
    return figure_called(figures_of(rows, analyse(rows), {}), "profiles");
  };
  std::vector<Row> rows = layered_rows(0.0);
  const Figure fitted = profiles_of(rows);
  CHECK_THAT(fitted.commands,
             Catch::Contains("title 'damped cosine'") && Catch::Contains("title 'φ'") &&
                 !Catch::Contains("title 'φ of large grains'") && !Catch::Contains("ls 3 lw 0.8"));
  CHECK_THAT(fitted.caption,
             Catch::Contains("bars at φ and Z are") && !Catch::Contains("The others"));
  for (Row& row : rows) row.outcome->result.profile_y.bins[9].small = 0.1;
  const Figure of_classes = profiles_of(rows);
  CHECK_THAT(of_classes.commands, Catch::Contains("title 'φ of large grains'") &&
                                      Catch::Contains("title 'φ of all grains'"));
  CHECK_THAT(of_classes.caption, Catch::Contains("bars at φ of large grains and Z are"));
  CHECK_THAT(of_classes.commands,
             Catch::Contains("with linespoints ls 1 lw 1.4 ps 0.3 notitle") &&  // also a bin alone
                 Catch::Contains("'Z, walls counted'"));
  rows.resize(1);
  CHECK_THAT(profiles_of(rows).commands, !Catch::Contains("damped cosine"));
  rows[0].job.box.y = Boundary::periodic;
  CHECK_THAT(profiles_of(rows).commands, !Catch::Contains("walls") && Catch::Contains("title 'Z'"));
  const std::vector<Row> many = random_rows();
  CHECK_THAT(profiles_of(many).caption,
             Catch::EndsWith(" 3 of 20 groups are shown. The others are in the folder's "
                             "profiles.csv."));
}

TEST_CASE("published profiles are drawn into the layers of their groups", "[report]") {
  std::vector<Row> rows = layered_rows(0.0);
  for (const double width : {20.0, 30.0, 40.0}) {
    rows.push_back(settled_row(std::to_string(rows.size()), width, 0.62, 6));
  }
  Reference reference;
  const double width = rows.front().job.box.width;
  const PublishedProfile porosity{"Mueller", "", {{0.5, 0.3}, {1.5, 0.45}}, {}};
  reference.families = {
      {{},
       {{"porosity", width, "", std::nullopt, "", {}, porosity},
        {"Z", width, "", std::nullopt, "", {}, PublishedProfile{"", "", {{2.5, 9.0}}, {}}}}}};
  const Analysis analysis = analyse(rows);
  const Figure figure =
      figure_called(figures_of(rows, analysis, compare_with(reference, analysis)), "profiles");
  REQUIRE(figure.tables.size() == 2);
  const auto& [name, table] = figure.tables[1];
  CHECK(name == "profiles-published.csv");
  CHECK(cell_in(table, 1, "value") == "0.7");
  CHECK(cell_in(table, 1, "name") == "Mueller");
  CHECK(cell_in(table, 2, "y") == "1.5");
  CHECK(cell_in(table, 3, "quantity") == "Z");
  CHECK(cell_in(table, 3, "value") == "9");
  CHECK(cell_in(table, 3, "panel") == "1");
  CHECK_THAT(figure.commands,
             Catch::Contains("title 'Mueller'") && Catch::Contains("title 'published'"));
  CHECK_THAT(figure.caption,
             Catch::Contains(" Published profiles stand over the distance from the wall.") &&
                 Catch::Contains(" 1 of 4 groups are shown."));
}

TEST_CASE("Z of layers has bars, and is left out where fewer than three packings tell it",
          "[report]") {
  std::vector<Row> rows = layered_rows(0.0);
  const auto drawn = [&] { return figure_called(figures_of(rows, analyse(rows), {}), "profiles"); };
  CHECK_THAT(drawn().caption, !Catch::Contains("left out"));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<ProfileBin>& bins = rows[k].outcome->result.profile_y.bins;
    bins[8].neighbours = 25 + static_cast<std::int64_t>(k);
    if (k > 1) bins[9].large_grains = 0;
  }
  const Figure figure = drawn();
  const std::string& table = figure.tables.at(0).second;
  CHECK(std::stod(cell_in(table, 9, "coordination")) == Approx(5.2));
  CHECK(std::stod(cell_in(table, 9, "coordination_error")) > 0.1);
  CHECK(std::stod(cell_in(table, 9, "coordination_with_walls_error")) > 0.1);
  CHECK(cell_in(table, 10, "coordination").empty());
  CHECK(cell_in(table, 10, "coordination_with_walls").empty());
  CHECK_THAT(figure.commands, Catch::Contains("with yerrorbars ls 1 lw 1.4 ps 0 notitle"));
  CHECK_THAT(figure.caption, Catch::Contains(" Z of bins with grains in fewer than 3 packings, "));
  rows.resize(2);
  CHECK(cell_in(drawn().tables.at(0).second, 10, "coordination") == "0");
  CHECK_THAT(drawn().caption, !Catch::Contains("left out"));
}

TEST_CASE("captions and titles tell rings about the axis of a tube from slices", "[report]") {
  const Row gap = mixture_row("a", 4);
  Row tube = gap, open = gap;
  tube.job.id = "b";
  tube.job.box = tube_of(4);
  open.job.id = "c";
  open.job.box.y = Boundary::periodic;
  tube.job.parameters = sample_mixture(5);
  open.job.parameters = sample_mixture(6);
  const auto title_and_caption = [](const std::vector<Row>& rows, const char* name) {
    const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
    const Figure& figure = figure_called(figures, name);
    return figure.title + ": " + figure.caption;
  };
  CHECK_THAT(title_and_caption({gap}, "components"),
             Catch::StartsWith("Components from wall to wall: ") &&
                 Catch::Contains("in slices parallel to the walls."));
  CHECK_THAT(title_and_caption({tube}, "components"),
             Catch::StartsWith("Components from the wall to the axis: ") &&
                 Catch::Contains("in rings about the axis."));
  CHECK_THAT(title_and_caption({gap, tube, open}, "components"),
             Catch::StartsWith("Components across the packing: ") &&
                 Catch::Contains("in slices parallel to the walls or rings about the axis or "
                                 "slices across y, where there is no wall."));
  CHECK_THAT(title_and_caption({tube}, "profiles"),
             Catch::StartsWith("Layers beside the wall: ") &&
                 Catch::Contains("is fitted up to the axis."));
  CHECK_THAT(title_and_caption({gap, tube}, "profiles"),
             Catch::StartsWith("Layers beside the walls: ") &&
                 Catch::Contains("is fitted from both walls, in tubes up to the axis."));
  CHECK_THAT(title_and_caption({open}, "profiles"),
             Catch::StartsWith("Slices across the box: ") && !Catch::Contains("is fitted"));
}

TEST_CASE("why families have no line is said once for all of them", "[report]") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0}) {
    for (const double small_share : {0.25, 0.5}) {
      Row row =
          settled_row(std::to_string(rows.size()), width, 0.6, 5.0, Boundary::walls, small_share);
      static_cast<Curves&>(row.outcome->result) = sample_curves();
      rows.push_back(std::move(row));
    }
  }
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const std::string& caption = figure_called(figures, "means").caption;
  CHECK_THAT(caption, Catch::Contains("small_share = 0.25; ") &&
                          Catch::Contains("small_share = 0.5: needs settled packings at 3"));
  CHECK(caption.find("needs") == caption.rfind("needs"));
}

TEST_CASE("figures without a meaning for the sweep are left out", "[report]") {
  const std::vector<Row> rows = wall_rows();
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const auto has = [&](const char* name) {
    return std::any_of(figures.begin(), figures.end(),
                       [&](const Figure& figure) { return figure.name == name; });
  };
  CHECK(has("profiles"));
  CHECK(has("heights"));
  CHECK(has("distributions"));
  CHECK(has("effort"));
  CHECK_FALSE(has("contacts"));
  CHECK_FALSE(has("grading"));
  CHECK_FALSE(has("small_grains"));
  CHECK_FALSE(has("published"));
}

TEST_CASE("sizes asked for and packed are drawn over the diameter, steps as steps", "[report]") {
  const std::vector<Row> rows = {graded_row("sieved", {{0.5, 0, 0, 0}, {2, 1, 1, 1}}),
                                 graded_row("two sizes", {{0.5, 0.25, 0.26, 0.125}, {2, 1, 1, 1}})};
  const Analysis analysis = analyse(rows);
  const std::vector<Figure> figures = figures_of(rows, analysis, {}, Units{4.0, "mm", {}});
  const Figure& grading = figure_called(figures, "grading");
  const std::string& table = grading.tables.at(0).second;
  REQUIRE(cells_of_table(table).size() == 1 + 2 + 4);
  CHECK(cell_in(table, 2, "asked") == "1");
  CHECK(cell_in(table, 3, "asked") == "0");
  CHECK(cell_in(table, 3, "packed").empty());
  CHECK(cell_in(table, 4, "asked") == "0.25");
  CHECK(cell_in(table, 4, "packed") == "0.26");
  CHECK(cell_in(table, 4, "slab") == "0.125");
  CHECK(cell_in(table, 4, "diameter_mm") == "2");
  CHECK(cell_in(table, 5, "asked") == "0.25");
  CHECK_THAT(grading.commands, Catch::Contains("set xlabel 'diameter / mm'") &&
                                   Catch::Contains("(column('diameter_mm'))") &&
                                   Catch::Contains("'share finer, by volume'") &&
                                   !Catch::Contains("logscale"));
  CHECK_THAT(grading.caption, Catch::Contains("sizes.csv"));
}

TEST_CASE("grains of a file have no grading, and no figure of it", "[report]") {
  std::vector<Row> rows = {graded_row("drawn", {{0.5, 0.25, 0.26, 0.125}, {2, 1, 1, 1}}),
                           graded_row("again", {})};
  rows[1].job.parameters = R"({"box":{"width":5},"fill":{"file":"0a"},)"
                           R"("sizes":{"distribution":{"by":"volume"}}})";
  const auto has_figure = [](const std::vector<Row>& some) {
    const std::vector<Figure> figures = figures_of(some, analyse(some), {});
    return std::any_of(figures.begin(), figures.end(),
                       [](const Figure& figure) { return figure.name == "grading"; });
  };
  CHECK_FALSE(has_figure({rows[1]}));
  CHECK(has_figure(rows));
}

TEST_CASE("diameters that span more than a decade lie on a logarithmic axis", "[report]") {
  const std::vector<Row> rows = {graded_row("wide", {{0.125, 0, 0, 0}, {2, 1, 1, 1}})};
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  CHECK_THAT(figure_called(figures, "grading").commands, Catch::Contains("set logscale x\n") &&
                                                             Catch::Contains("set xtics (") &&
                                                             Catch::Contains("'diameter / d'"));
}

TEST_CASE("published formulas are drawn beside the means, each once, where they hold", "[report]") {
  const std::vector<Row> rows = wall_rows();
  const Analysis analysis = analyse(rows);
  Reference reference;
  const auto formula = [](const std::string& quantity, const std::string& text) {
    return Published{quantity, 0, text, std::nullopt, "", PublishedFormula{text, text, 4, 8, {}}};
  };
  reference.families = {{{}, {formula("porosity", "0.36 + 0.2/W"), formula("phi", "0.5 + 0/W")}},
                        {{}, {formula("porosity", "0.36 + 0.2/W"), formula("phi", "0.64 + 0*D")}}};
  const auto comparisons = compare_with(reference, analysis);
  REQUIRE(comparisons.size() == 4);
  const std::vector<Figure> figures = figures_of(rows, analysis, comparisons);
  const Figure& means = figure_called(figures, "means");
  CHECK_THAT(means.caption, Catch::Contains(" Dashed: published formulas."));
  CHECK_THAT(means.commands, Catch::Contains("0.36 + 0.2/W") && Catch::Contains("0.5 + 0/W"));
  const auto table = std::find_if(means.tables.begin(), means.tables.end(), [](const auto& named) {
    return named.first == "means-published.csv";
  });
  REQUIRE(table != means.tables.end());
  const std::string& csv = table->second;
  CHECK(csv.starts_with("curve,x,value,name\n1,0.125,0.615,0.36 + 0.2/W\n"));  // phi at W = 8
  CHECK_THAT(csv, Catch::Contains("\n1,0.25,0.59") && Catch::Contains("\n2,0.125,0.5,0.5 + 0/W\n"));
  CHECK_THAT(csv, !Catch::Contains("\n3,"));
  CHECK(std::none_of(figures.begin(), figures.end(),
                     [](const Figure& figure) { return figure.name == "published"; }));
}

TEST_CASE("a published formula of a single width is a star", "[report]") {
  const std::vector<Row> rows = wall_rows();
  const Analysis analysis = analyse(rows);
  Reference reference;
  reference.families = {
      {{}, {{"phi", 0, "", std::nullopt, "", PublishedFormula{"0.6 + 0/W", "at 8", 7, 9, {}}}}}};
  const std::vector<Figure> figures = figures_of(rows, analysis, compare_with(reference, analysis));
  const Figure& means = figure_called(figures, "means");
  CHECK_THAT(means.commands, Catch::Contains("NaN with points lc rgb '#7a7a7a' lw 1.4 pt 3") &&
                                 Catch::Contains("title 'at 8'"));
  CHECK_THAT(means.caption, Catch::Contains(" Stars: published formulas at their only width."));
}

TEST_CASE("the files of all figures have the names by which they are removed", "[report]") {
  std::set<std::string> stems;
  const auto add = [&](const std::vector<Row>& rows, const Reference& reference) {
    const Analysis analysis = analyse(rows);
    for (const Figure& figure : figures_of(rows, analysis, compare_with(reference, analysis))) {
      stems.insert(figure.name);
      for (const auto& [file, table] : figure.tables) stems.insert(file.substr(0, file.find('.')));
    }
  };
  Reference reference;
  reference.families = {
      {{},
       {{"phi", 0, "", std::nullopt, "", PublishedFormula{"0.6 + 0/W", "a", 4, 16, {}}},
        {"phi_bulk", 0, "", Published::Range{0.6, 0.65, 0.0}, ""},
        {"phi", wall_rows().front().job.box.width, "", std::nullopt, "", std::nullopt,
         PublishedProfile{"b", "", {{0.5, 0.6}}, {}}}}}};
  add(wall_rows(), reference);
  add(random_rows(), {});
  add({mixture_row("a", 4), polyhedra_row("b", 5)}, {});
  add({settled_row("a", 4, 0.6, 5.0, Boundary::walls, 0.25),
       settled_row("b", 4, 0.6, 5.0, Boundary::walls, 0.5)},
      {});
  add({graded_row("c", {{1, 1, 1, 1}})}, {});
  CHECK(stems == std::set<std::string>(figure_names.begin(), figure_names.end()));
}

TEST_CASE("a published value is drawn at its distance in errors of both", "[report]") {
  Comparison comparison;
  comparison.family = "walls", comparison.title = "Z at W = 10 d";
  comparison.published.range = {6.0, 6.0, 0.03};
  comparison.measured.estimate = {6.1, 0.04};
  const Figure figure = published_figure({comparison});
  REQUIRE(figure.tables.size() == 1);
  const std::string& table = figure.tables[0].second;
  CHECK(std::stod(cell_in(table, 1, "errors")) == Approx(2.0));  // 0.1 / sqrt(0.03^2 + 0.04^2)
  CHECK(cell_in(table, 1, "row") == "1");
  CHECK(cell_in(table, 1, "quantity") == "Z at W = 10 d");
  CHECK(cell_in(table, 1, "family") == "walls");
}

TEST_CASE("however far a published value is, it is on the axis", "[report]") {
  Comparison below, above;
  below.published.range = {6.0, 6.0, 0.0}, above.published.range = {1.0, 1.0, 0.0};
  below.measured.estimate = {5.0, 0.1}, above.measured.estimate = {2.0, 0.01};
  CHECK_THAT(published_figure({below, above}).commands,
             Catch::Contains("set xrange [-13:130]") && Catch::Contains("-10, 30") &&
                 Catch::Contains(", 100)") &&
                 Catch::Contains("standard errors (logarithmic far from 0)'"));
  CHECK_THAT(published_figure({below}).commands,
             Catch::Contains("set xrange [-13:4.5]") && !Catch::Contains("nonlinear") &&
                 !Catch::Contains("logarithmic") && !Catch::Contains("set xtics ("));
}

TEST_CASE("of very many packings the figure of what they cost draws some, and says so",
          "[report]") {
  const std::vector<Row> rows(12000, settled_row("a", 4, 0.6, 5.0));
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& effort = figure_called(figures, "effort");
  CHECK(cells_of_table(effort.tables.at(0).second).size() == 1 + 5000);
  CHECK_THAT(effort.caption, Catch::Contains(" 5000 packings are drawn; all are in packings.csv."));
}

TEST_CASE("of very many groups figures along the axis draw some, and say so", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 5200; ++k) {  // two replicates at each of 2600 widths
    const double width = 4.0 + k / 2, scatter = k % 2 == 0 ? 1e-4 : -1e-4;
    rows.push_back(settled_row(std::to_string(k), width, 0.64 - 0.2 / width + scatter, 6.0,
                               Boundary::walls, k / 2 % 2 == 0 ? 0.1 : 0.2));
    rows.back().job.replicate = k % 2 + 1;
  }
  const Analysis analysis = analyse(rows);
  const std::vector<Figure> figures = figures_of(rows, analysis, {});
  const Figure& means = figure_called(figures, "means");
  CHECK(cells_of_table(means.tables.at(0).second).size() == 1 + 2500);
  CHECK_THAT(means.caption, Catch::Contains(" 2500 of 2600 groups are shown."));
  REQUIRE(means.tables.at(1).first == "means-residuals.csv");
  CHECK(cells_of_table(means.tables[1].second).size() == 1 + 2500);  // of phi: Z does not scatter
  CHECK(cell_in(means.tables[0].second, 1, "x") == "0.25");
  CHECK(cell_in(means.tables[0].second, 1250, "x") == cell(1.0 / 2602.0));
}

TEST_CASE("of very many random points figures over each number draw some, and say so", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 1300; ++k) {
    rows.push_back(settled_row(std::to_string(k), 4.0 + k, 0.6, 5.0, Boundary::walls,
                               (k * 7 % 1300 + 1) / 2048.0));
  }
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& parameters = figure_called(figures, "parameters");
  CHECK(cells_of_table(parameters.tables.at(0).second).size() == 1 + 1250);
  CHECK_THAT(parameters.caption, Catch::Contains(" 1250 of 1300 groups are shown."));
}

TEST_CASE("the panels of kinds of contact reach to the end of the highest error bar", "[report]") {
  std::vector<Row> rows = {polyhedra_row("a", 4), polyhedra_row("b", 4)};
  rows[0].job.replicate = 1, rows[1].job.replicate = 2;
  rows[0].outcome->result.shape_order->contact_share = {0.25, 0.0, 0.0};
  rows[1].outcome->result.shape_order->contact_share = {0.75, 0.0, 0.0};
  const Analysis analysis = analyse(rows);
  const std::vector<Figure> figures = figures_of(rows, analysis, {});
  const Spread& share = mean_of(analysis.groups[0], "contacts_simple");
  REQUIRE(share.error > 0.25);
  const std::string& commands = figure_called(figures, "contacts").commands;
  const std::size_t range = commands.rfind("set yrange [0:", commands.find("share of contacts"));
  CHECK(std::stod(commands.substr(range + 14)) == Approx(1.05 * (share.mean + share.error)));
}

TEST_CASE("curves of distances have the marks that the key shows", "[report]") {
  const std::vector<Row> rows = wall_rows();
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const std::string& commands = figure_called(figures, "distributions").commands;
  CHECK_THAT(commands, Catch::Contains("NaN with linespoints ls 1 title") &&
                           Catch::Contains("with linespoints ls 1 lw 1.3 ps 0.5 pi 4 notitle"));
}

TEST_CASE("where no grains press on each other the kinds of contact say so", "[report]") {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<Row> rows = {polyhedra_row("a", 4), polyhedra_row("b", 5)};
  for (Row& row : rows) row.outcome->result.shape_order->contact_share = {none, none, none};
  CHECK(figure_called(figures_of(rows, analyse(rows), {}), "contacts").not_drawn ==
        "no grains press on each other");
}

TEST_CASE("where nothing has settled each figure says so", "[report]") {
  const std::vector<Row> rows = {row_with_status("a", 4, PackingStatus::not_settled, "moves"),
                                 row_with_status("b", 5, PackingStatus::failed, "no room")};
  for (const Figure& figure : figures_of(rows, analyse(rows), {})) {
    if (figure.name != "effort") CHECK(figure.not_drawn == "no packing has settled");
  }
  const std::vector<Row> none;
  for (const Figure& figure : figures_of(none, analyse(none), {})) {
    CHECK_FALSE(figure.not_drawn.empty());
  }
}

TEST_CASE("kinds of contact are drawn for polyhedra", "[report]") {
  const std::vector<Row> rows = {polyhedra_row("a", 4), polyhedra_row("b", 5)};
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const std::string& table = figure_called(figures, "contacts").tables.at(0).second;
  CHECK(cell_in(table, 1, "contacts_simple") == "0.5");
  CHECK(cell_in(table, 1, "force_triple") == "0.5");
}

TEST_CASE("series of spheres take no place among the kinds of contact", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 14; ++k) {
    rows.push_back(settled_row("s" + std::to_string(k), 5, 0.6, 6.0));
    rows.back().job.label = "spheres " + std::to_string(k);
    rows.back().job.parameters = R"({"box":{"width":5},"kind":"of )" + std::to_string(k) + "\"}";
  }
  rows.push_back(polyhedra_row("p", 5));
  rows.back().job.label = "polyhedra";
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& figure = figure_called(figures, "contacts");
  REQUIRE(cells_of_table(figure.tables.at(0).second).size() == 2);
  CHECK(cell_in(figure.tables.at(0).second, 1, "series") == "1");
  CHECK_THAT(figure.caption, !Catch::Contains("are drawn"));
}

TEST_CASE("each component of a mixture has its curve from wall to wall", "[report]") {
  const std::vector<Row> rows = {mixture_row("a", 4), polyhedra_row("b", 5)};
  const std::vector<Figure> figures = figures_of(rows, analyse(rows), {});
  const Figure& figure = figure_called(figures, "components");
  const std::string& table = figure.tables.at(0).second;
  REQUIRE(cells_of_table(table).size() == 5);
  CHECK(cell_in(table, 1, "y") == "0.25");
  CHECK(cell_in(table, 1, "solid_fraction") == "0.25");
  CHECK(cell_in(table, 2, "coordination") == "5");
  CHECK(cell_in(table, 3, "component") == "2");
  CHECK(cell_in(table, 4, "coordination").empty());
  CHECK_THAT(figure.commands,
             Catch::Contains("NaN with linespoints ls 1 lw 1.4 ps 0.45 title 'cube'") &&
                 Catch::Contains("NaN with linespoints ls 2 lw 1.4 ps 0.45 title 'sphere'"));
  const std::vector<Row> others = {polyhedra_row("b", 5)};
  for (const Figure& other : figures_of(others, analyse(others), {})) {
    CHECK(other.name != "components");
  }
}
