#include <cmath>

#include <catch2/catch.hpp>

#include "runner/report/axes.hpp"
#include "runner/report/plots.hpp"
#include "tests/runner/sample_rows.hpp"

using namespace grainsweep;

namespace {

Row row_at(const std::string& id, double width, double small_share, Boundary y = Boundary::walls) {
  return settled_row(id, width, 0.6, 5.5, y, small_share);
}

Row shaped_row(const std::string& id, double width, const std::string& shape,
               const std::string& parameters) {
  Row row = row_at(id, width, 0.0);
  row.job.shape = shape;
  row.job.parameters =
      R"({"box":{"width":)" + std::to_string(width) + R"(},"shape":)" + parameters + "}";
  return row;
}

std::vector<std::string> names_of(const Axes& axes) {
  std::vector<std::string> names;
  for (const Series& series : axes.series) names.push_back(series.name);
  return names;
}

}  // namespace

TEST_CASE("the width goes along the axis wherever it is varied", "[report]") {
  const std::vector<Row> rows = {row_at("a", 10, 0.0), row_at("b", 5, 0.0), row_at("c", 5, 0.4),
                                 row_at("d", 20, 0.0, Boundary::periodic)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(is_over_width(axes));
  REQUIRE(axes.series.size() == 3);
  REQUIRE(axes.series[0].groups.size() == 2);
  CHECK(place_on(axes, *axes.series[0].groups[0]) == 5.0);
  CHECK(place_on(axes, *axes.series[0].groups[1]) == 10.0);
  CHECK(axes.series[1].name == "MSP, small_share = 0.4");
  CHECK(axes.series[2].name.find("y periodic") != std::string::npos);
  CHECK(title_of(groups[2]) == "MSP, W = 5, small_share = 0.4");
}

TEST_CASE("tubes lie along the width of others by their diameter, in a series of their own",
          "[report]") {
  std::vector<Row> rows = {row_at("a", 10, 0.0), row_at("b", 5, 0.0), row_at("c", 4, 0.0),
                           row_at("d", 7, 0.0)};
  for (std::size_t k : {2, 3}) {
    const double diameter = rows[k].job.box.width;
    rows[k].job.box = tube_of(diameter);
    rows[k].job.parameters =
        R"({"accuracy":"balanced","shape":"sphere","sizes":{"small_share":0.0},"tube":{"diameter":)" +
        std::to_string(diameter) + "}}";
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  REQUIRE(is_over_width(axes));
  CHECK(axes.title == "gap between the walls, W / d, and diameter of tubes, D / d");
  REQUIRE(axes.series.size() == 2);
  REQUIRE(axes.series[1].groups.size() == 2);
  CHECK(place_on(axes, *axes.series[1].groups[0]) == 4.0);
  CHECK(place_on(axes, *axes.series[1].groups[1]) == 7.0);
}

TEST_CASE("lines are fitted over the diameter where all are tubes", "[report]") {
  std::vector<Row> rows = {row_at("a", 4, 0.0), row_at("b", 7, 0.0)};
  for (Row& row : rows) {
    const double diameter = row.job.box.width;
    row.job.box = tube_of(diameter);
    row.job.parameters =
        R"({"shape":"sphere","tube":{"diameter":)" + std::to_string(diameter) + "}}";
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "tube.diameter");
  CHECK(is_over_width(axes));
  CHECK(width_symbol(axes) == "D");
}

TEST_CASE("the diameter of tubes goes along the axis, whatever else has more values", "[report]") {
  std::vector<Row> rows;
  for (const double diameter : {4.0, 6.0, 8.0}) {
    for (const char* const spread : {"0.0", "0.02", "0.05", "0.1"}) {
      rows.push_back(row_at(std::to_string(rows.size()), diameter, 0.0));
      rows.back().job.box = tube_of(diameter);
      rows.back().job.parameters = std::string(R"({"sizes":{"spread":)") + spread +
                                   R"(},"tube":{"diameter":)" + std::to_string(diameter) + "}}";
    }
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "tube.diameter");
  CHECK(is_over_width(axes));
  CHECK(names_of(axes) == std::vector<std::string>{"MSP, spread = 0", "MSP, spread = 0.02",
                                                   "MSP, spread = 0.05", "MSP, spread = 0.1"});
}

Row sized_row(const std::string& label, const std::string& parameters) {
  Row row = row_at(label, 6, 0.0);
  row.job.label = label;
  row.job.parameters = parameters;
  return row;
}

TEST_CASE("square ducts are one series over their width", "[report]") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 6.0}) {
    rows.push_back(row_at(std::to_string(width), width, 0.0));
    rows.back().job.box.x = Boundary::walls;
    rows.back().job.box.length = width;
    rows.back().job.parameters = R"({"box":{"length":)" + std::to_string(width) + R"(,"width":)" +
                                 std::to_string(width) + R"(,"x":"walls","y":"walls"}})";
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "box.width");
  CHECK(names_of(axes) == std::vector<std::string>{"MSP"});
}

TEST_CASE("beds that differ in several things at a time have no axis", "[report]") {
  const auto classes = [](const char* share, const char* ratio) {
    return std::string(R"("sizes":{"size_ratio":)") + ratio + R"(,"small_share":)" + share + "}}";
  };
  std::vector<Row> rows = {
      sized_row("short", R"({"shape":{"cylinder":{"length":1}},)" + classes("0.0", "0.5")),
      sized_row("long", R"({"shape":{"cylinder":{"length":2}},)" + classes("0.0", "0.5")),
      sized_row("lognormal", R"({"sizes":{"distribution":{"lognormal":{"sigma":0.2}}}})"),
      sized_row("two sizes", "{" + classes("0.3", "0.4"))};
  rows[0].job.shape = rows[1].job.shape = "cylinder";
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter.empty());
  CHECK(names_of(axes) == std::vector<std::string>{"short", "long", "lognormal", "two sizes"});
  CHECK(place_on(axes, groups[3]) == 4.0);
  CHECK(title_of(groups[1]).find("size_ratio") == std::string::npos);
  CHECK(title_of(groups[3]).find("size_ratio = 0.4") != std::string::npos);
  CHECK(std::isnan(value_of(groups[0], "sizes.size_ratio")));
}

TEST_CASE("of what varies together under one label the first is along the axis", "[report]") {
  std::vector<Row> rows;
  for (int k = 1; k < 4; ++k) {
    rows.push_back(sized_row("zip", R"({"fill":{"solid_height":)" + std::to_string(k + 5) +
                                        R"(},"sizes":{"spread":0.0)" + std::to_string(k) + "}}"));
  }
  const std::vector<Group> groups = groups_of(rows);
  CHECK(axes_of(groups).parameter == "fill.solid_height");
}

TEST_CASE("a share that begins at 0 is in the series of the others, named by their ratio",
          "[report]") {
  std::vector<Row> rows;
  for (const char* const share : {"0.0", "0.1", "0.2"}) {
    rows.push_back(sized_row(
        "MSP", std::string(R"({"sizes":{"size_ratio":0.7,"small_share":)") + share + "}}"));
  }
  rows.push_back(sized_row("MSP", R"({"sizes":{"size_ratio":0.5,"small_share":0.3}})"));
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "sizes.small_share");
  CHECK(names_of(axes) ==
        std::vector<std::string>{"MSP, size_ratio = 0.7", "MSP, size_ratio = 0.5"});
  CHECK(axes.series[0].groups.size() == 3);
  CHECK(title_of(groups[0]) == "MSP, small_share = 0");
}

TEST_CASE("a sweep over something else has that along the axis", "[report]") {
  const std::vector<Row> rows = {row_at("a", 6, 0.4), row_at("b", 6, 0.0), row_at("c", 6, 0.2)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "sizes.small_share");
  CHECK_FALSE(is_over_width(axes));
  REQUIRE(axes.series.size() == 1);
  CHECK(axes.series[0].name == "MSP");
  CHECK(place_on(axes, *axes.series[0].groups[0]) == 0.0);
}

Row creep_row(const std::string& id, const std::string& preset, int creep_steps) {
  Row row = row_at(id, 6, 0.0);
  row.job.accuracy = preset;
  row.job.parameters =
      R"({"accuracy":{"creep_steps":)" + std::to_string(creep_steps) + R"(},"shape":"sphere"})";
  return row;
}

TEST_CASE("a part of the accuracy goes along the axis, also through the value of its preset",
          "[report]") {
  const std::vector<Row> rows = {creep_row("a", "custom", 120), creep_row("b", "fast", 240),
                                 creep_row("c", "custom", 480)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "accuracy.creep_steps");
  CHECK(axes.title == "creep steps");
  REQUIRE(axes.series.size() == 1);
  CHECK(axes.series[0].name == "MSP");
  CHECK(place_on(axes, groups[1]) == 240.0);
}

TEST_CASE("presets are told by their names where they vary", "[report]") {
  const std::vector<Row> rows = {creep_row("a", "fast", 240), creep_row("b", "balanced", 480),
                                 creep_row("c", "custom", 960)};
  const std::vector<Group> groups = groups_of(rows);
  CHECK(axes_of(groups).parameter.empty());
  CHECK(title_of(groups[1]) == "MSP, accuracy = balanced");
  CHECK(title_of(groups[2]) == "MSP, creep_steps = 960");
}

TEST_CASE("axes have words and a unit", "[report]") {
  CHECK(axis_title("box.width") == "gap between the walls, W / d");
  CHECK(axis_title("box.length") == "box length / d");
  CHECK(axis_title("sizes.size_ratio") == "size ratio / d");
  CHECK(axis_title("sizes.distribution.lognormal.sigma") == "lognormal sigma");
  CHECK(axis_title("shape.pinacoid.angle_deg") == "pinacoid angle / degrees");
  CHECK(axis_title("shape.prism.sides") == "prism sides");
  CHECK(axis_title("accuracy.step") == "step / sqrt(d/g)");
  CHECK(axis_title("fill.grains") == "grains");
}

TEST_CASE("a sweep that varies nothing has the number of the group along the axis", "[report]") {
  const std::vector<Row> rows = {row_at("a", 6, 0.0)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter.empty());
  CHECK(place_on(axes, groups[0]) == 1.0);
  CHECK(axes_of({}).series.empty());
}

TEST_CASE("shapes are series of their own, told by their names where these tell them", "[report]") {
  const std::string octahedron = R"({"octahedron":{"height":1.0}})",
                    icosahedron = R"({"icosahedron":{"height":1.0}})",
                    prism = R"({"prism":{"height":1.0,"sides":3}})",
                    other_prism = R"({"prism":{"height":1.0,"sides":5}})";
  std::vector<Row> rows;
  for (const double width : {5.0, 6.0}) {
    const std::string id = std::to_string(width);
    rows.push_back(shaped_row("o" + id, width, "octahedron", octahedron));
    rows.push_back(shaped_row("i" + id, width, "icosahedron", icosahedron));
    rows.push_back(shaped_row("p" + id, width, "prism", prism));
    rows.push_back(shaped_row("q" + id, width, "prism", other_prism));
    rows.push_back(shaped_row("s" + id, width, "sphere", R"("sphere")"));
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(is_over_width(axes));
  CHECK(names_of(axes) ==
        std::vector<std::string>{"MSP, shape = octahedron", "MSP, shape = icosahedron",
                                 "MSP, shape = prism, sides = 3", "MSP, shape = prism, sides = 5",
                                 "MSP, shape = sphere"});
  for (const Series& series : axes.series) {
    CHECK(series.groups.size() == 2);
    CHECK(series.groups.front()->family == series.groups.back()->family);
  }
  CHECK(title_of(groups[1]) == "MSP, W = 5, shape = icosahedron");
}

TEST_CASE("a parameter that most groups have goes along the axis, without those that lack it",
          "[report]") {
  std::vector<Row> rows;
  for (const int sides : {3, 5, 8}) {
    rows.push_back(shaped_row("p" + std::to_string(sides), 5, "prism",
                              R"({"prism":{"sides":)" + std::to_string(sides) + "}}"));
    rows.back().job.label = "prisms";
  }
  rows.push_back(shaped_row("c", 5, "cube", R"({"cube":{"edge":1.0}})"));
  rows.back().job.label = "cubes";
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "shape.prism.sides");
  CHECK(names_of(axes) == std::vector<std::string>{"prisms", "cubes"});
  CHECK(place_on(axes, *axes.series[0].groups[2]) == 8.0);
  CHECK(std::isnan(place_on(axes, *axes.series[1].groups[0])));
  rows.push_back(shaped_row("o", 5, "octahedron", R"({"octahedron":{"edge":1.0}})"));
  rows.push_back(shaped_row("i", 5, "icosahedron", R"({"icosahedron":{"edge":1.0}})"));
  const std::vector<Group> many_shapes = groups_of(rows);
  CHECK(axes_of(many_shapes).parameter.empty());
}

TEST_CASE("of mixtures of two components the share of one goes along the axis, in one series",
          "[report]") {
  std::vector<Row> rows;
  for (const double cubes : {0.25, 0.5, 0.75}) {
    rows.push_back(mixture_row(std::to_string(cubes), 5));
    rows.back().job.parameters = sample_mixture(5, cubes);
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "shape.mixture.1.share");
  CHECK(axes.title == "share of cube");
  REQUIRE(axes.series.size() == 1);
  CHECK(place_on(axes, *axes.series[0].groups[2]) == 0.75);
  CHECK(title_of(groups[0]) == "MSP, cube 0.25, sphere 0.75");
}

TEST_CASE("mixtures of other components are a series of their own, told by their shares",
          "[report]") {
  std::vector<Row> rows;
  for (const double cubes : {0.25, 0.5}) {
    rows.push_back(mixture_row(std::to_string(cubes), 5));
    rows.back().job.parameters = sample_mixture(5, cubes);
  }
  rows.push_back(mixture_row("prisms", 5));
  rows.back().job.label = "rods";
  rows.back().job.parameters =
      R"({"box":{"width":5},"shape":{"mixture":{"1":{"prism":{"height":2,"sides":5},"share":0.5},)"
      R"("2":{"sphere":{},"share":0.5}},"mixture_by":"volume"}})";
  const std::vector<Group> groups = groups_of(rows);
  CHECK(axes_of(groups).series.size() == 2);
  CHECK(title_of(groups[2]) == "rods, prism 0.5, sphere 0.5");
}

TEST_CASE("points of a random design are joined where some lack what others vary", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 12; ++k) {
    const double width = 3.0 + 0.25 * k;
    rows.push_back(row_at(std::to_string(k), width, 0.0));
    rows.back().job.label = k % 3 == 0 ? "ratio" : "spread";
    rows.back().job.parameters = R"({"box":{"width":)" + std::to_string(width) + R"(},"sizes":{")" +
                                 (k % 3 == 0 ? "size_ratio" : "spread") +
                                 "\":" + std::to_string(0.01 * (k + 1)) + "}}";
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.scattered ==
        std::vector<std::string>{"box.width", "sizes.size_ratio", "sizes.spread"});
  CHECK(names_of(axes) == std::vector<std::string>{"ratio", "spread"});
}

TEST_CASE("parameters whose paths end alike have as much of them as tells them", "[report]") {
  std::vector<Row> rows = {row_at("a", 6, 0.0), row_at("b", 6, 0.0)};
  rows[0].job.parameters = R"({"sizes":{"lognormal":{"sigma":0.1}}})";
  rows[1].job.parameters = R"({"sizes":{"normal":{"sigma":0.1}}})";
  const std::vector<Group> groups = groups_of(rows);
  CHECK(names_of(axes_of(groups)) ==
        std::vector<std::string>{"MSP, lognormal.sigma = 0.1", "MSP, normal.sigma = 0.1"});
}

TEST_CASE("points of a random design are a series for each label", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 20; ++k) {
    rows.push_back(row_at("r" + std::to_string(k), 3.0 + 0.21 * k, 0.015625 * ((7 * k) % 20 + 1)));
    rows.back().job.label = k < 12 ? "first" : "second";
  }
  for (const double width : {4.0, 5.0, 6.0}) {
    rows.push_back(row_at("w" + std::to_string(width), width, 0.0));
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.scattered == std::vector<std::string>{"box.width", "sizes.small_share"});
  CHECK(names_of(axes) == std::vector<std::string>{"MSP", "first", "second"});
  REQUIRE(axes.series.size() == 3);
  CHECK_FALSE(axes.series[0].is_scattered);
  CHECK(axes.series[0].groups.size() == 3);
  CHECK(axes.series[1].is_scattered);
  CHECK(axes.series[1].groups.size() == 12);
  CHECK(axes.series[2].groups.size() == 8);
  CHECK(place_on(axes, *axes.series[2].groups[0]) == Approx(3.0 + 0.21 * 12));
  CHECK(value_of(*axes.series[1].groups[1], "sizes.small_share") == Approx(0.015625 * 8));
}

TEST_CASE("points of a random design with one label and two shapes are two series", "[report]") {
  std::vector<Row> rows;
  for (int k = 0; k < 10; ++k) {
    const std::string shape = k % 2 == 0 ? "sphere" : "cube";
    rows.push_back(row_at(std::to_string(k), 3.0 + 0.25 * k, 0.0));
    rows.back().job.shape = shape;
    rows.back().job.parameters = R"({"box":{"width":)" + std::to_string(3.0 + 0.25 * k) +
                                 R"(},"fill":{"solid_height":)" + std::to_string(9 - k % 7) +
                                 R"(},"shape":")" + shape + "\"}";
  }
  const std::vector<Group> groups = groups_of(rows);
  CHECK(names_of(axes_of(groups)) ==
        std::vector<std::string>{"MSP, shape = sphere", "MSP, shape = cube"});
}

TEST_CASE("a grid is no random design, whatever it varies", "[report]") {
  std::vector<Row> rows;
  for (const double width : {3.0, 4.0, 5.0, 6.0}) {
    for (const double share : {0.1, 0.2, 0.3}) {
      rows.push_back(row_at(std::to_string(rows.size()), width, share));
    }
  }
  const std::vector<Group> groups = groups_of(rows);
  CHECK(axes_of(groups).scattered.empty());
  CHECK(axes_of(groups).series.size() == 3);
  rows.clear();  // and few points neither
  for (int k = 0; k < 7; ++k) rows.push_back(row_at(std::to_string(k), 3.0 + k, 0.1 * k));
  const std::vector<Group> few = groups_of(rows);
  CHECK(axes_of(few).scattered.empty());
  CHECK(axes_of(few).series.size() == 7);
}

TEST_CASE("short numbers have at most four significant digits, and all before the point",
          "[report]") {
  CHECK(short_number(7.98409342) == "7.984");
  CHECK(short_number(0.0137288945) == "0.01373");
  CHECK(short_number(5.0) == "5");
  CHECK(short_number(0.5) == "0.5");
  CHECK(short_number(9.99999) == "10");
  CHECK(short_number(-20000.4) == "-20000");
  CHECK(short_number(120.0) == "120");
  CHECK(short_number(0.0) == "0");
}

TEST_CASE("numbers in titles are short where there is no room, unless they would be alike",
          "[report]") {
  std::vector<Row> rows = {row_at("a", 6, 0.160044), row_at("b", 6, 0.168433)};
  std::vector<Group> groups = groups_of(rows);
  CHECK(titles_of({&groups[0], &groups[1]}, 27, {&groups[0], &groups[1]}) ==
        std::vector<std::string>{"MSP, small_share = 0.160044", "MSP, small_share = 0.168433"});
  CHECK(titles_of({&groups[0], &groups[1]}, 25, {&groups[0], &groups[1]}) ==
        std::vector<std::string>{"MSP, small_share = 0.16", "MSP, small_share = 0.1684"});
  rows = {row_at("a", 6, 0.160041), row_at("b", 6, 0.160042)};
  groups = groups_of(rows);
  CHECK(titles_of({&groups[0], &groups[1]}, 22, {&groups[0], &groups[1]}) ==
        std::vector<std::string>{"small_share = 0.160041", "small_share = 0.160042"});
}

TEST_CASE("numbers that nobody writes are short in titles and names", "[report]") {
  const std::vector<Row> rows = {
      sized_row("one", R"({"sizes":{"spread":0.03333333333333333}})"),
      sized_row("one", R"({"sizes":{"spread":0.05}})"),
      sized_row("sieve",
                R"({"sizes":{"table":{"diameters":[0.6666666666666666,1,1.3333333333333333]}}})")};
  const std::vector<Group> groups = groups_of(rows);
  CHECK(title_of(groups[0]) == "one, spread = 0.03333");
  CHECK(title_of(groups[1]) == "one, spread = 0.05");
  CHECK(title_of(groups[2]) == "sieve, diameters = [0.6667,1,1.333]");
  CHECK(groups[0].varied.at("sizes.spread") == "0.03333333333333333");
}

TEST_CASE("a key without room drops the label that all series share", "[report]") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0}) {
    for (const double share : {0.1, 0.2}) {
      rows.push_back(row_at(std::to_string(rows.size()), width, share));
      rows.back().job.label = "a label of this sweep that has forty-four letters";
      rows.back().job.parameters = R"({"box":{"width":)" + std::to_string(width) +
                                   R"(},"sizes":{"size_ratio":0.)" + (share > 0.15 ? "5" : "4") +
                                   R"(,"small_share":)" + std::to_string(share) + "}}";
    }
  }
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(names_of(axes)[0] == "a label of this…, size_ratio = 0.4, small_share = 0.1");
  const std::vector<KeyEntry> key = series_key(axes, "points");
  REQUIRE(key.size() == 2);
  CHECK(key[0].title == "size_ratio = 0.4, small_share = 0.1");
  CHECK(key[1].title == "size_ratio = 0.5, small_share = 0.2");
}

TEST_CASE("text is shortened by characters, not bytes", "[report]") {
  CHECK(shortened("φφφ", 3) == "φφφ");
  CHECK(shortened("φφφφ", 3) == "φφ…");
  CHECK(shortened("", 3).empty());
}

TEST_CASE("over the width of a box without walls groups stand at that width", "[report]") {
  const std::vector<Row> rows = {row_at("a", 5, 0.0, Boundary::periodic),
                                 row_at("b", 10, 0.0, Boundary::periodic)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK_FALSE(is_over_width(axes));
  CHECK(axes.title == "width of the box, W / d");
  CHECK(place_on(axes, groups[1]) == 10.0);
}

TEST_CASE("titles in a figure leave out what all share before they lose what tells them apart",
          "[report]") {
  std::vector<Row> rows = {row_at("a", 4.25, 0.1), row_at("b", 4.25, 0.2), row_at("c", 6, 0.3)};
  for (Row& row : rows) row.job.label = "two sizes of glass beads";
  const std::vector<Group> groups = groups_of(rows);
  const std::vector<const Group*> shown = {&groups[0], &groups[1]};
  CHECK(titles_of(shown, 60, shown) ==
        std::vector<std::string>{"two sizes of glass beads, W = 4.25, small_share = 0.1",
                                 "two sizes of glass beads, W = 4.25, small_share = 0.2"});
  CHECK(titles_of(shown, 43, shown) ==
        std::vector<std::string>{"two sizes of glass beads, small_share = 0.1",
                                 "two sizes of glass beads, small_share = 0.2"});
  CHECK(titles_of(shown, 30, shown) == std::vector<std::string>{"two sizes …, small_share = 0.1",
                                                                "two sizes …, small_share = 0.2"});
  CHECK(titles_of(shown, 20, shown) ==
        std::vector<std::string>{"small_share = 0.1", "small_share = 0.2"});
}

TEST_CASE("titles keep what the groups shown share with each other but not with the sweep",
          "[report]") {
  std::vector<Row> rows = {row_at("a", 4.25, 0.1), row_at("b", 4.25, 0.2), row_at("c", 6, 0.3)};
  for (Row& row : rows) row.job.label = "two sizes of glass beads";
  const std::vector<Group> groups = groups_of(rows);
  const std::vector<const Group*> shown = {&groups[0], &groups[1]},
                                  all = {&groups[0], &groups[1], &groups[2]};
  CHECK(titles_of(shown, 40, all) ==
        std::vector<std::string>{"two sizes …, W = 4.25, small_share = 0.1",
                                 "two sizes …, W = 4.25, small_share = 0.2"});
  CHECK(titles_of(shown, 20, all) ==
        std::vector<std::string>{"small_share = 0.1", "small_share = 0.2"});  // no room for more
}

TEST_CASE("titles leave out what all of a label share before they lose the label", "[report]") {
  std::vector<Row> rows = {row_at("a", 4, 0.0), row_at("b", 4, 0.1), row_at("c", 6, 0.1)};
  rows[0].job.label = "mono";
  rows[1].job.label = rows[2].job.label = "two sizes";
  const std::vector<Group> groups = groups_of(rows);
  const std::vector<const Group*> shown = {&groups[0], &groups[1], &groups[2]};
  CHECK(titles_of(shown, 40, shown) ==
        std::vector<std::string>{"mono, W = 4, small_share = 0",
                                 "two sizes, W = 4, small_share = 0.1",
                                 "two sizes, W = 6, small_share = 0.1"});
  CHECK(titles_of(shown, 16, shown) ==
        std::vector<std::string>{"mono, W = 4", "two sizes, W = 4", "two sizes, W = 6"});
}

TEST_CASE("shortened texts that would be alike are told by where they differ, or else by number",
          "[report]") {
  using Texts = std::vector<std::string>;
  CHECK(told_apart({"abcdef", "x"}, 4) == Texts{"abc…", "x"});
  CHECK(told_apart({"abcdef1", "abcdef2"}, 4) == Texts{"a…f1", "a…f2"});
  CHECK(told_apart({"φφφφφφ1", "φφφφφφ2"}, 4) == Texts{"φ…φ1", "φ…φ2"});
  CHECK(told_apart({"abcdefφ", "abcdefχ"}, 4) == Texts{"a…fφ", "a…fχ"});  // one byte in common
  CHECK(told_apart({"abc1defg", "abc2defg"}, 4) == Texts{"1: …", "2: …"});
  const std::string begin = "beads of two sizes, ", end = ", started from a file of centres";
  CHECK(told_apart({begin + "sieved, spread = 0.15" + end, begin + "sieved, spread = 0.3" + end},
                   30) ==
        Texts{"beads of two s…ad = 0.15, sta…", "beads of two s…ad = 0.3, star…"});
  CHECK(told_apart({"same", "same"}, 4) == Texts{"same", "same"});
}
