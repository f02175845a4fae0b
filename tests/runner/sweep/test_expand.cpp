#include <array>
#include <cmath>
#include <ctime>

#include <catch2/catch.hpp>

#include "runner/sweep/expand.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Messages = std::vector<std::string>;
using Rows = std::vector<std::vector<double>>;

/// Width, length and replicate of every job.
Rows rows_of(const std::string& text) {
  Rows rows;
  for (const Job& job : jobs_of(text)) {
    rows.push_back({job.spec.box.width, job.spec.box.length, double(job.replicate)});
  }
  return rows;
}

/// CPU time that a call takes, s.
template <class Call>
double seconds_of(const Call& call) {
  const std::clock_t start = std::clock();
  call();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// What ten times as much may take, in times of once as much: it takes 10 times (jobs) and 15 to 20
/// times (errors), and would take a hundred if each were looked for among all.
constexpr double ten_times = 40.0;

std::string numbers(int count, const std::string& start) {
  std::string list;
  for (int i = 0; i < count; ++i) list += (i == 0 ? "" : ",") + start + std::to_string(1000 + i);
  return "[" + list + "]";
}

}  // namespace

TEST_CASE("the last path of a grid changes fastest, replicates fastest of all") {
  CHECK(
      rows_of(R"({"name": "t", "replicates": 2,
                    "sweep": [{"grid": {"box.width": [6, 5], "box.length": [9, 8]}}]})") ==
      Rows{{6, 9, 1}, {6, 9, 2}, {6, 8, 1}, {6, 8, 2}, {5, 9, 1}, {5, 9, 2}, {5, 8, 1}, {5, 8, 2}});
  CHECK(rows_of(sweep_of(R"({"grid": {"box.length": [9, 8], "box.width": [6, 5]}})")) ==
        Rows{{6, 9, 1}, {5, 9, 1}, {6, 8, 1}, {5, 8, 1}});
}

TEST_CASE("a zip runs through its lists together, inside the grid") {
  CHECK(rows_of(sweep_of(R"({"zip": {"box.width": [5, 6], "box.length": [8, 9]}})")) ==
        Rows{{5, 8, 1}, {6, 9, 1}});
  const auto jobs = jobs_of(sweep_of(
      R"({"zip": {"box.width": [5, 6], "seed": [1, 2]}, "grid": {"box.length": [8, 9]}})"));
  REQUIRE(jobs.size() == 4);
  CHECK(jobs[1].spec.box.width == 6.0);
  CHECK(jobs[1].spec.box.length == 8.0);
  CHECK(jobs[1].seed == 2);
  CHECK(jobs[2].spec.box.length == 9.0);
  CHECK(jobs[2].seed == 1);
}

TEST_CASE("random points change fastest within a block") {
  const auto jobs = jobs_of(sweep_of(
      R"({"grid": {"box.length": [8, 9]}, "random": {"count": 3, "box.width": {"uniform": [5, 9]}}})"));
  REQUIRE(jobs.size() == 6);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(jobs[i].spec.box.length == 8.0);
    CHECK(jobs[i].spec.box.width == jobs[i + 3].spec.box.width);
  }
}

TEST_CASE("grids run through presets, groups and lists of tolerances") {
  CHECK(jobs_of(sweep_of(R"({"grid": {"accuracy": ["fast", "balanced", "accurate"]}})")).size() ==
        3);
  CHECK(rows_of(sweep_of(R"({"grid": {"box": [{"width": 5, "length": 8}, {"width": 6}]}})")) ==
        Rows{{5, 8, 1}, {6, 20, 1}});
  const auto jobs =
      jobs_of(sweep_of(R"({"grid": {"measure.gap_tolerances": [[1e-4], [1e-3, 1e-5]]}})"));
  REQUIRE(jobs.size() == 2);
  CHECK(jobs[1].spec.measure.gap_tolerances == std::vector<double>{1e-3, 1e-5});
}

TEST_CASE("shapes and their parts are swept like any other parameter") {
  const auto angles = [](const std::string& block, const std::string& base = "{}") {
    std::vector<double> degrees;
    for (const Job& job : jobs_of(sweep_of(block, base))) {
      const auto* pinacoid = std::get_if<PinacoidSize>(&job.spec.shape);
      degrees.push_back(pinacoid == nullptr ? 0 : std::round(pinacoid->angle * 57.29577951308232));
    }
    return degrees;
  };
  using Degrees = std::vector<double>;
  CHECK(angles(R"({"grid": {"shape.pinacoid.angle_deg": [50, 60, 70]}})") == Degrees{50, 60, 70});
  CHECK(angles(R"({"grid": {"shape": ["sphere", "pinacoid", {"pinacoid": {"angle_deg": 45}}]}})") ==
        Degrees{0, 60, 45});
  CHECK(angles(R"({"zip": {"shape.pinacoid": [{"angle_deg": 50}, {}], "box.width": [5, 6]}})",
               R"({"shape.pinacoid.angle_deg": 70})") == Degrees{50, 70});
  const Degrees drawn =
      angles(R"({"random": {"count": 3, "shape.pinacoid.angle_deg": {"uniform": [50, 80]}}})");
  REQUIRE(drawn.size() == 3);
  for (const double degrees : drawn) CHECK((degrees >= 50 && degrees <= 80));
}

TEST_CASE("the vertices of a hull are those of a file beside the sweep, in units of its size") {
  const ScratchFolder folder;
  const auto job_with = [&](const std::string& hull) {
    const SweepReading reading = read_sweep(
        folder.write("s.json", R"({"name": "t", "base": {"shape": {"hull": )" + hull + "}}}"));
    for (const Diagnostic& diagnostic : reading.errors) FAIL(to_string(diagnostic));
    return reading.sweep.jobs.at(0);
  };
  folder.write("rock.obj", "# a corner\nv 0 0 -0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n");
  const Job from_file = job_with(R"({"file": "rock.obj", "size": 4})");
  const auto& points = std::get<HullVertices>(from_file.spec.shape).points;
  REQUIRE(points.size() == 4);
  CHECK(points[1] == std::array{0.5, 0.0, 0.0});
  CHECK(from_file.id == job_with(R"({"vertices": [[0,0,0],[0.5,0,0],[0,0.5,0],[0,0,0.5]]})").id);
  CHECK(from_file.id ==
        job_with(R"({"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "size": 2})").id);
  CHECK(from_file.id != job_with(R"({"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]})").id);
}

TEST_CASE("a size of a hull that is not the d of the units is worth a note") {
  const ScratchFolder folder;
  folder.write("rock.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n");
  const auto said = [&](const std::string& shape) {
    const SweepReading reading =
        read_sweep(folder.write("s.json", R"({"name": "t", "units": {"d": 3.2, "unit": "mm"},
                                             "base": {"shape": )" +
                                              shape + "}}"));
    CHECK(reading.errors.empty());
    Messages notes;
    for (const Diagnostic& note : reading.notes) notes.push_back(note.pointer + " " + note.message);
    return notes;
  };
  const std::string of_file =
      " is not the d of units, 3.2 mm: if the file is in mm, tables will give other lengths in mm; "
      "set both to one length";
  CHECK(said(R"({"hull": {"file": "rock.obj", "size": 4}})") ==
        Messages{"/base/shape/hull/size" + of_file});
  CHECK(said(R"({"hull": {"vertices": [[0,0,0],[4,0,0],[0,4,0],[0,0,4]], "size": 4}})") ==
        Messages{"/base/shape/hull/size is not the d of units, 3.2 mm: if the vertices are in mm, "
                 "tables will give other lengths in mm; set both to one length"});
  CHECK(said(R"({"mixture": [{"share": 0.5, "cube": {}},
                             {"share": 0.5, "hull": {"file": "rock.obj", "size": 4}}]})") ==
        Messages{"/base/shape/mixture/1/hull/size" + of_file});
  CHECK(said(R"({"hull": {"file": "rock.obj", "size": 3.2}})").empty());
  CHECK(said(R"({"mixture": [{"share": 0.5, "cube": {}},
                             {"share": 0.5, "hull": {"file": "rock.obj"}}]})")
            .empty());  // lengths in d
}

TEST_CASE("errors of a hull's file name its own lines, once for all jobs") {
  const ScratchFolder folder;
  folder.write("rock.obj", "v 0 0 0\nv 0 zero 0\n");
  const std::string path = folder.write("s.json", R"({"name": "t", "replicates": 3,
    "base": {"shape.hull.file": "rock.obj"},
    "sweep": [{"grid": {"box.width": [5, 6, 7]}}, {"set": {"shape.hull.file": "none.obj"}}]})");
  Messages errors;
  for (const Diagnostic& diagnostic : read_sweep(path).errors) {
    errors.push_back(folder.without_folder(to_string(diagnostic)));
  }
  CHECK(errors == Messages{"rock.obj:2: y must be a finite number, is \"zero\"",
                           "s.json:3:79 /sweep/1/set/shape.hull.file: none.obj cannot be read: No "
                           "such file or directory"});
}

TEST_CASE("a shape that cannot be is refused at the part that forbids it, once for all jobs") {
  const auto errors_with = [](const std::string& shape) {
    return errors_of("{\"name\": \"t\", \"replicates\": 2, \"base\": {\"shape\":\n" + shape +
                     R"(}, "sweep": [{"grid": {"box.width": [6, 7, 8]}}]})");
  };
  const auto first_with = [&](const std::string& shape) {
    const Messages errors = errors_with(shape);
    REQUIRE(errors.size() == 1);
    return errors.front();
  };
  CHECK(first_with(R"({"pinacoid": {"length": -1, "angle_deg": 60}})") ==
        "s.json:2:25 /base/shape/pinacoid/length: length must lie in [1e-06, 10000], is -1");
  CHECK(first_with(R"({"pinacoid": {"length": 2, "angle_deg": 90}})")
            .starts_with("s.json:2:41 /base/shape/pinacoid/angle_deg: angle must be above 0"));
  CHECK(first_with(R"({"pinacoid": {"height": 2, "angle_deg": 60}})")
            .starts_with("s.json:2:41 /base/shape/pinacoid/angle_deg: the ends would cross"));
  CHECK(first_with(R"({"pinacoid": {"height": 2}})")
            .starts_with("s.json:2:25 /base/shape/pinacoid/height: the ends would cross"));
  CHECK(first_with(R"({"hull": {"vertices": [], "size": 2}})") ==
        "s.json:2:23 /base/shape/hull/vertices: a hull needs at least 4 vertices, has 0");
  CHECK(first_with(R"({"hull": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]}})") ==
        "s.json:2:23 /base/shape/hull/vertices: the vertices lie on a plane, so that the hull has "
        "no volume");
  CHECK(first_with(R"({"hull": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "size": 0}})") ==
        "s.json:2:66 /base/shape/hull/size: must be positive");
  CHECK(first_with(R"({"hull": {"size": 2}})") ==
        "s.json:2:19 /base/shape/hull/size: belongs to shape.hull.vertices or shape.hull.file; "
        "neither is set");
}

TEST_CASE("a grain of too many vertices is refused before they are looked at") {
  std::string list;
  for (int i = 0; i < 1001; ++i) list += (i == 0 ? "[0,0," : ",[0,0,") + std::to_string(i) + "]";
  const auto errors = errors_of(sweep_of("{\"set\": {\"shape.hull.vertices\": [" + list + "]}}"));
  REQUIRE(errors.size() == 1);
  CHECK(
      errors[0].ends_with("holds 1,001 vertices, more than the 1,000 that a grain may have; "
                          "simplify the shape"));
}

TEST_CASE("blocks are joined in order and may override the replicates") {
  const auto jobs = jobs_of(R"({"name": "t", "replicates": 2, "sweep": [
    {"label": "a", "set": {"box.width": 5}}, {"label": "b", "replicates": 3}]})");
  Messages labels;
  for (const Job& job : jobs) labels.push_back(job.label + std::to_string(job.replicate));
  CHECK(labels == Messages{"a1", "a2", "b1", "b2", "b3"});
}

TEST_CASE("a grid of a trillion jobs is refused before it is expanded, longest list first") {
  const std::string block =
      "{\"grid\": {\"box.width\": " + numbers(100, "") + ", \"box.length\": " + numbers(1000, "") +
      ", \"measure.exclude_floor\": " + numbers(1000, "") +
      ", \"sizes.spread\": " + numbers(1000, "0.0") + "}, \"replicates\": 10}";
  CHECK(errors_of(sweep_of(block)) ==
        Messages{"s.json:1:37 /sweep/0: asks for 1,000,000,000,000 jobs, more than the 1,000,000 "
                 "that a sweep may have; shorten box.length (1,000), measure.exclude_floor "
                 "(1,000), sizes.spread (1,000), box.width (100), replicates (10)"});
}

TEST_CASE("a count of jobs beyond 64 bits is still a count") {
  std::string grid;
  for (const char* path : {"box.width", "box.length", "sizes.spread", "sizes.small_share",
                           "sizes.size_ratio", "accuracy.step", "accuracy.momentum"}) {
    grid += (grid.empty() ? "\"" : ", \"") + std::string(path) + "\": " + numbers(1000, "0.");
  }
  const auto errors = errors_of(sweep_of("{\"grid\": {" + grid + "}}"));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].find("asks for more than 10^19 jobs") != std::string::npos);
}

TEST_CASE("blocks that are too many jobs only together are refused together") {
  const std::string block = "\"grid\": {\"box.width\": " + numbers(600, "") +
                            ", \"box.length\": " + numbers(1000, "") + "}}";
  CHECK(errors_of(sweep_of("{\"label\": \"a\", " + block + ", {\"label\": \"b\", " + block)) ==
        Messages{"s.json:1:36 /sweep: the blocks ask together for 1,200,000 jobs, more than the "
                 "1,000,000 that a sweep may have; split the file"});
}

TEST_CASE("equal jobs of blocks with one label are made once") {
  CHECK(rows_of(sweep_of(R"({"label": "w", "grid": {"box.width": [5, 6]}},
                            {"label": "w", "replicates": 2, "grid": {"box.width": [6, 7]}})")) ==
        Rows{{5, 20, 1}, {6, 20, 1}, {6, 20, 2}, {7, 20, 1}, {7, 20, 2}});
}

TEST_CASE("equal jobs of blocks with different labels are refused, both named") {
  CHECK(errors_of(sweep_of("\n{\"label\": \"a\", \"grid\": {\"box.width\": [5, 6, 7]}},\n"
                           "{\"label\": \"b\", \"grid\": {\"box.width\": [6, 7, 8]}}")) ==
        Messages{"s.json:3:1 /sweep/1: block \"b\" repeats 2 jobs of block \"a\" (/sweep/0), the "
                 "first with box.width 6; give "
                 "both the same label, or take the repeated values out"});
}

TEST_CASE("a value out of range is named where it is written, once for all jobs") {
  CHECK(errors_of(R"({"name": "t", "replicates": 5, "base": {
  "sizes": {"small_share": 1.4}},
  "sweep": [
    {"grid": {"box.width": [4, 0.5, 6], "box.length": [10, 12]}},
    {"set": {"box": {"width": 0.25}}},
    {"zip": {"box.width": [7, 0.75], "accuracy.step": [3, 0.1]}}]})") ==
        Messages{"s.json:2:28 /base/sizes/small_share: must lie in [0, 1], is 1.4",
                 "s.json:4:32 /sweep/0/grid/box.width/1: must lie in [1, 10000], is 0.5",
                 "s.json:5:31 /sweep/1/set/box/width: must lie in [1, 10000], is 0.25",
                 "s.json:6:31 /sweep/2/zip/box.width/1: must lie in [1, 10000], is 0.75",
                 "s.json:6:56 /sweep/2/zip/accuracy.step/0: must lie in [0.0001, 2], is 3"});
}

TEST_CASE("a bed too high to fall is told at its fill, or at what shortens its steps") {
  const std::string box = R"("box": {"length": 4, "width": 4}, )";
  CHECK(
      errors_of(R"({"name": "t", "base": {)" + box +
                R"("fill": {"grains": 10000000}, "accuracy": "fast"}})") ==
      Messages{"s.json:1:77 /base/fill/grains: gives a bed too high to come to rest, 3.28e+05 d of "
               "solid: in steps of 0.2 the fall alone takes 1.64e+06 of them, max_steps is 20000; "
               "fill in less, or widen the box"});
  CHECK(errors_of(R"({"name": "t", "base": {"accuracy": {"preset": "fast", "max_steps": 10}}})") ==
        Messages{"s.json:1:68 /base/accuracy/max_steps: cannot come to rest: in steps of 0.2 the "
                 "fall alone takes 50 of them, max_steps is 10"});
}

TEST_CASE("a default that breaks a rule is named at the block that makes it break") {
  const ScratchFolder folder;
  folder.write("bed.csv", "x,y,z,r\n15,5,15,12\n");
  const std::string path = folder.write("s.json", R"({"name": "t", "sweep": [
    {"label": "a"}, {"label": "b", "set": {"fill.file": "bed.csv", "box.length": 60}}]})");
  const auto errors = read_sweep(path).errors;
  REQUIRE(errors.size() == 2);
  CHECK(errors[1].pointer == "/sweep/1/set/fill.file");  // the grain sticks out of that default
  CHECK(folder.without_folder(to_string(errors[0])) ==
        "s.json:2:21 /sweep/1: box.width must lie in [24, 10000] (the largest grain between two "
        "walls), is 10");
}

/// The notes about `text`, as errors_of gives its errors.
Messages notes_of(const std::string& text) {
  const ScratchFolder folder;
  const SweepReading reading = read_sweep(folder.write("s.json", text));
  CHECK(reading.errors.empty());
  Messages notes;
  for (const Diagnostic& note : reading.notes) {
    notes.push_back(folder.without_folder(to_string(note)));
  }
  return notes;
}

TEST_CASE("a value that every block sets itself is noted, and refused if none could use it") {
  const std::string blocks = R"({"set": {"box.width": 5}}, {"grid": {"box.width": [6, 7]}})";
  CHECK(notes_of(sweep_of(blocks, R"({"box.width": 20})")) ==
        Messages{"s.json:1:37 /base/box.width: is never used: every block sets it itself"});
  CHECK(errors_of(sweep_of(blocks, R"({"box.width": 0.5})")) ==
        Messages{"s.json:1:37 /base/box.width: must lie in [1, 10000], is 0.5"});
  CHECK(notes_of(sweep_of(R"({"set": {"box.width": 5}}, {})", R"({"box.width": 20})")).empty());
}

TEST_CASE("a value that has no effect on any packing is noted with the reason") {
  CHECK(notes_of(sweep_of(R"({"grid": {"sizes.size_ratio": [0.3, 0.4]}})")) ==
        Messages{
            "s.json:1:68 /sweep/0/grid/sizes.size_ratio/0: has no effect: sizes.small_share is 0",
            "s.json:1:73 /sweep/0/grid/sizes.size_ratio/1: has no effect: sizes.small_share is 0"});
  CHECK(notes_of(sweep_of(R"({"grid": {"sizes.small_share": [0, 0.4]}})",
                          R"({"sizes.size_ratio": 0.3})"))
            .empty());
  const auto cut = [](const std::string& ends) {
    return notes_of(sweep_of(
        "{}", R"({"sizes.distribution": {"uniform": {"from": 0.5, "to": 2}, )" + ends + "}}"));
  };
  CHECK(cut(R"("smallest": 0.5, "largest": 2)").empty());
  CHECK(cut(R"("smallest": 0.4)") ==
        Messages{
            "s.json:1:94 /base/sizes.distribution/smallest: has no effect: no grain is smaller"});
  CHECK(
      cut(R"("largest": 2.5)") ==
      Messages{"s.json:1:93 /base/sizes.distribution/largest: has no effect: no grain is larger"});
}

TEST_CASE("a list that holds a value twice, and a zip with two equal rows, are refused") {
  CHECK(errors_of(sweep_of(R"({"grid": {"box.width": [5, 6, 5.0]}})")) ==
        Messages{"s.json:1:67 /sweep/0/grid/box.width/2: repeats value 1 of "
                 "/sweep/0/grid/box.width; for more packings of a point raise replicates"});
  CHECK(errors_of(sweep_of(R"({"zip": {"box.width": [5, 6, 5], "box.length": [9, 9, 9]}})")) ==
        Messages{"s.json:1:66 /sweep/0/zip/box.width/2: repeats row 1 of /sweep/0/zip; for more "
                 "packings of a point raise replicates"});
  CHECK(
      errors_of(sweep_of(R"({"zip": {"box.width": [5, 6, 5], "box.length": [9, 9, 8]}})")).empty());
  CHECK(errors_of(sweep_of(
            R"({"grid": {"box": [{"length": 9, "width": 5}, {"width": 5, "length": 9}]}})")) ==
        Messages{"s.json:1:92 /sweep/0/grid/box/1/width: repeats value 1 of /sweep/0/grid/box; for "
                 "more packings of a point raise replicates"});
}

TEST_CASE("points that are there twice, said otherwise, are packed once, and that is noted") {
  CHECK(notes_of(sweep_of(R"({"grid": {"shape": ["cube", {"cube": {"edge": 1}}]}})")) ==
        Messages{"s.json:1:37 /sweep/0: 1 of 2 points is there again and packed once, with "
                 "shape.cube.edge 1; for more "
                 "packings of a point raise replicates"});
}

TEST_CASE("points that differ in nothing that has an effect are noted") {
  const std::string grid =
      R"({"grid": {"sizes.small_share": [0, 0.1], "sizes.size_ratio": [0.5, 0.7]}})";
  CHECK(notes_of(sweep_of(grid)) ==
        Messages{"s.json:1:37 /sweep/0: 1 of 4 points differs from another one only in "
                 "sizes.size_ratio, which has no effect where sizes.small_share is 0, with "
                 "sizes.small_share 0, sizes.size_ratio 0.7; give that share a block of its own to "
                 "pack it once"});
  CHECK(notes_of(sweep_of(R"({"grid": {"sizes.small_share": [0, 0.1]}})")).empty());
}

TEST_CASE("minus zero in a list is zero") {
  const auto id_of = [](const std::string& passing) {
    return jobs_of(sweep_of("{}", R"({"sizes.distribution.table": {"diameters": [1, 2, 3], )"
                                  R"("passing": )" +
                                      passing + "}}"))
        .at(0)
        .id;
  };
  CHECK(id_of("[-0.0, 0.5, 1]") == id_of("[0, 0.5, 1]"));
}

TEST_CASE("ten times as many jobs take ten times as long to expand", "[slow]") {
  const auto seconds_for = [](int widths) {
    const std::string text = sweep_of("{\"grid\": {\"box.width\": " + numbers(widths, "") +
                                      ", \"sizes.spread\": " + numbers(100, "0.0") + "}}");
    std::size_t jobs = 0;
    const double seconds = seconds_of([&] { jobs = jobs_of(text).size(); });
    CHECK(jobs == static_cast<std::size_t>(100 * widths));
    return seconds;
  };
  const double tenth = seconds_for(100);
  CHECK(seconds_for(1000) < ten_times * tenth);
}

TEST_CASE("ten times as many errors take ten times as long to find and to place", "[slow]") {
  const auto seconds_for = [](int wrong) {
    std::string list;
    for (int i = 0; i < wrong; ++i) list += (i == 0 ? "0." : ",0.") + std::to_string(100'000 + i);
    std::size_t errors = 0;
    const double seconds = seconds_of([&] {
      errors = reading_of(sweep_of("{\"grid\": {\"box.width\": [" + list + "]}}")).errors.size();
    });
    CHECK(errors == static_cast<std::size_t>(wrong));
    return seconds;
  };
  const double tenth = seconds_for(10'000);
  CHECK(seconds_for(100'000) < ten_times * tenth);
}

}  // namespace grainsweep
