#include <catch2/catch.hpp>

#include "runner/sweep/grains_csv.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

std::vector<std::string> errors_of_grains(const std::string& text) {
  std::vector<std::string> errors;
  for (const Diagnostic& diagnostic : parse_grains(text, "b.csv").errors) {
    errors.push_back(to_string(diagnostic));
  }
  return errors;
}

using Messages = std::vector<std::string>;

}  // namespace

TEST_CASE("grains are read by column name, in any order, past other columns") {
  const GrainsReading reading = parse_grains("r, z,note,x,y\n0.5,3,a,1,2\n.25,-3,b,1e1,2\n", "f");
  REQUIRE(reading.errors.empty());
  REQUIRE(reading.grains.size() == 2);
  CHECK(reading.grains[0].x == 1.0);
  CHECK(reading.grains[0].y == 2.0);
  CHECK(reading.grains[0].z == 3.0);
  CHECK(reading.grains[0].radius == 0.5);
  CHECK(reading.grains[1].x == 10.0);
  CHECK(reading.grains[1].z == -3.0);
  CHECK(reading.grains[1].radius == 0.25);
}

TEST_CASE("grains that begin in one place are refused with their lines") {
  CHECK(errors_of_grains("x,y,z,r\n1,2,3,0.5\n4,5,6,0.5\n1,2,3,0.4\n1.0,2,3,0.5\n") ==
        Messages{"b.csv:4: has the place of line 2; two grains cannot begin in one",
                 "b.csv:5: has the place of line 4; two grains cannot begin in one"});
  CHECK(errors_of_grains("x,y,z,r\n1,2,3,0.5\n1,2,3.0001,0.5\n").empty());
}

TEST_CASE("an exported bed, whose radii are called radius, can be read") {
  const GrainsReading reading =
      parse_grains("x,y,z,radius,force,coordination\n1,2,3,0.5,7,6\n", "f");
  REQUIRE(reading.errors.empty());
  CHECK(reading.grains.at(0).radius == 0.5);
}

TEST_CASE("orientations are read where the first line names their columns") {
  const GrainsReading reading =
      parse_grains("qw,x,y,z,r,qx,qy,qz\n1,1,2,3,0.5,0,0,0\n0,4,5,6,0.5,.6,0,-.8\n", "f");
  REQUIRE(reading.errors.empty());
  REQUIRE(reading.orientations.size() == 2);
  CHECK(reading.orientations[0] == std::array<double, 4>{0, 0, 0, 1});
  CHECK(reading.orientations[1] == std::array<double, 4>{0.6, 0, -0.8, 0});
  CHECK(reading.grains[1].z == 6.0);
  CHECK(parse_grains("x,y,z,r\n1,2,3,4\n", "f").orientations.empty());
}

TEST_CASE("columns of an orientation are there all or not at all, and hold numbers") {
  CHECK(errors_of_grains("x,y,z,r,qx,qy,qz\n1,2,3,1,0,0,0\n") ==
        Messages{"b.csv:1: the first line must name the columns x,y,z,r and all of qx,qy,qz,qw; "
                 "\"qw\" is missing or there twice in \"x,y,z,r,qx,qy,qz\""});
  CHECK(errors_of_grains("x,y,z,r,qx,qy,qz,qw\n1,2,3,1,0,0,0,one\n") ==
        Messages{"b.csv:2: qw must be a finite number, is \"one\""});
}

TEST_CASE("components are read from 1 where the first line names their column") {
  const GrainsReading reading =
      parse_grains("component,x,y,z,r\n1,1,2,3,1\n16,1,2,4,1\n17,1,2,5,1\nsand,1,2,6,1\n", "f");
  REQUIRE(reading.errors.empty());
  CHECK(reading.components == std::vector<std::uint8_t>{0, 15, no_component, no_component});
  CHECK(parse_grains("x,y,z,r\n1,2,3,4\n", "f").components.empty());
}

TEST_CASE("which grains are small is read where the first line names the column of classes") {
  const GrainsReading reading =
      parse_grains("size_class,x,y,z,r\nlarge,1,2,3,1\nsmall,1,2,4,1\n2,1,2,5,1\n,1,2,6,1\n", "f");
  REQUIRE(reading.errors.empty());
  CHECK(reading.are_small == std::vector<bool>{false, true, false, false});
  CHECK(parse_grains("x,y,z,r\n1,2,3,4\n", "f").are_small.empty());
}

TEST_CASE("line ends of other systems, quotes and a byte order mark change no grain") {
  const GrainsReading reading =
      parse_grains("\xEF\xBB\xBF\"x\",\"y\",\"z\",\"r\"\r\n1,\"2\",3,0.5\r\n\r\n", "f");
  REQUIRE(reading.errors.empty());
  REQUIRE(reading.grains.size() == 1);
  CHECK(reading.grains[0].y == 2.0);
}

TEST_CASE("a first line without the four columns is refused with what it holds") {
  CHECK(errors_of_grains("1,2,3,0.5\n") ==
        Messages{"b.csv:1: the first line must name the columns x,y,z,r; \"x\" is missing or there "
                 "twice in \"1,2,3,0.5\""});
  CHECK(errors_of_grains("x,y,z,r,radius\n1,2,3,4,5\n") ==
        Messages{"b.csv:1: the first line must name the columns x,y,z,r; \"r\" is missing or there "
                 "twice in \"x,y,z,r,radius\""});
  CHECK(errors_of_grains("x,y,z,r\n") == Messages{"b.csv:1: no grain follows the first line"});
}

TEST_CASE("every bad line is named with what is wrong in it") {
  const Messages errors = errors_of_grains(
      "x,y,z,r\n"
      "1,2,3,0.5\n"
      "1,2,3\n"
      "1,two,3,0.5\n"
      "1,2,nan,0.5\n"
      "inf,2,3,0.5\n"
      "1,2,3,0\n"
      "1,2,3,-0.5\n"
      "\n"
      "1,2,,0.5\n"
      "1,2,3 4,0.5\n");
  CHECK(errors == Messages{
                      "b.csv:3: must hold 4 values like the first line, holds 3",
                      "b.csv:4: y must be a finite number, is \"two\"",
                      "b.csv:5: z must be a finite number, is \"nan\"",
                      "b.csv:6: x must be a finite number, is \"inf\"",
                      "b.csv:7: r must be positive, is 0",
                      "b.csv:8: r must be positive, is -0.5",
                      "b.csv:9: must hold 4 values like the first line, holds 1",
                      "b.csv:10: z must be a finite number, is \"\"",
                      "b.csv:11: z must be a finite number, is \"3 4\"",
                  });
}

TEST_CASE("a file of bad lines names twenty of them and says that there are more") {
  std::string text = "x,y,z,r\n";
  for (int i = 0; i < 1000; ++i) text += "a,b,c,d\n";
  const Messages errors = errors_of_grains(text);
  REQUIRE(errors.size() == 20);
  CHECK(errors.back() ==
        "b.csv:21: x must be a finite number, is \"a\" (further lines are not listed)");
}

TEST_CASE("the content hash follows the bytes of the file") {
  const std::string text = "x,y,z,r\n1,2,3,0.5\n";
  CHECK(parse_grains(text, "a").content == parse_grains(text, "b").content);
  CHECK(parse_grains(text, "a").content != parse_grains(text + "\n", "a").content);
  CHECK(parse_grains(text, "a").content.size() == 16);
}

TEST_CASE("lengths are divided by the diameter that is d") {
  const auto grains = scaled_grains({{2.0, 4.0, 6.0, 1.0}}, 2.0);
  CHECK(grains[0].x == 1.0);
  CHECK(grains[0].y == 2.0);
  CHECK(grains[0].z == 3.0);
  CHECK(grains[0].radius == 0.5);
}

TEST_CASE("a sweep packs the grains of a file beside it, in units of its diameter") {
  const ScratchFolder folder;
  folder.write("bed.csv", "x,y,z,r\n0.002,0.002,0.002,0.001\n0.006,0.006,0.002,0.001\n");
  const std::string path = folder.write("s.json", R"({"name": "t", "base": {
    "box": {"length": 5, "width": 5},
    "fill": {"file": "bed.csv", "diameter": 0.002}}})");
  const SweepReading reading = read_sweep(path);
  REQUIRE(reading.errors.empty());
  REQUIRE(reading.sweep.jobs.size() == 1);
  const auto& fill = std::get<PlacedGrains>(reading.sweep.jobs[0].spec.fill);
  REQUIRE(fill.grains.size() == 2);
  CHECK(fill.grains[1].x == Approx(3.0));
  CHECK(fill.grains[1].radius == Approx(0.5));

  SECTION("its content, not its name, belongs to the job") {
    folder.write("same.csv", "x,y,z,r\n0.002,0.002,0.002,0.001\n0.006,0.006,0.002,0.001\n");
    folder.write("other.csv", "x,y,z,r\n0.002,0.002,0.002,0.001\n0.006,0.006,0.003,0.001\n");
    const auto id_with = [&](const std::string& name) {
      const auto other =
          read_sweep(folder.write("o.json", R"({"name": "t", "base": {
        "box": {"length": 5, "width": 5}, "fill": {"file": ")" +
                                                name + R"(", "diameter": 0.002}}})"));
      REQUIRE(other.errors.empty());
      return other.sweep.jobs.at(0).id;
    };
    CHECK(id_with("same.csv") == reading.sweep.jobs[0].id);
    CHECK(id_with("other.csv") != reading.sweep.jobs[0].id);
  }
}

TEST_CASE("grains of a file that are no spheres are turned as it says, if it says so") {
  const ScratchFolder folder;
  folder.write("turned.csv", "x,y,z,r,qx,qy,qz,qw\n2,2,2,0.5,0,0.6,0,0.8\n");
  folder.write("long.csv", "x,y,z,r,qx,qy,qz,qw\n2,2,2,0.5,0,1,0,1\n");
  folder.write("plain.csv", "x,y,z,r\n2,2,2,0.5\n");
  const auto read = [&](const std::string& shape, const std::string& file) {
    return read_sweep(folder.write("s.json", R"({"name": "t", "base": {"shape": ")" + shape +
                                                 R"(", "fill.file": ")" + file + "\"}}"));
  };
  const auto error = [&](const std::string& shape, const std::string& file) {
    const auto errors = read(shape, file).errors;
    return errors.empty() ? std::string() : errors.front().pointer + " " + errors.front().message;
  };
  const SweepReading reading = read("pinacoid", "turned.csv");
  REQUIRE(reading.errors.empty());
  const auto& fill = std::get<PlacedGrains>(reading.sweep.jobs.at(0).spec.fill);
  CHECK(fill.orientations == std::vector<std::array<double, 4>>{{0, 0.6, 0, 0.8}});
  CHECK(error("sphere", "plain.csv").empty());
  CHECK(error("sphere", "turned.csv").starts_with("/base/fill.file spheres have no orientation"));
  CHECK(error("pinacoid", "plain.csv").starts_with("/base/fill.file non-spherical grains"));
  CHECK(error("pinacoid", "long.csv").find("unit quaternion") != std::string::npos);
}

TEST_CASE("one start is no start for several replicates, a list of starts is one for each") {
  const ScratchFolder folder;
  folder.write("a.csv", "x,y,z,r\n2,2,2,0.5\n");
  folder.write("b.csv", "x,y,z,r\n3,2,2,0.5\n");
  folder.write("copy.csv", "x,y,z,r\n2,2,2,0.5\n");
  folder.write("lines.csv", "x, y, z, r\r\n2.0,2,2,+0.5\r\n");
  folder.write("out.csv", "x,y,z,r\n99,2,2,0.5\n");
  const auto read = [&](const std::string& fill, int replicates) {
    return read_sweep(folder.write("s.json", R"({"name": "t", "replicates": )" +
                                                 std::to_string(replicates) +
                                                 R"(, "base": {"fill": )" + fill + "}}"));
  };
  const auto error = [&](const std::string& fill, int replicates) {
    const auto errors = read(fill, replicates).errors;
    return errors.empty() ? std::string() : errors.front().pointer + " " + errors.front().message;
  };
  CHECK(error(R"({"file": "a.csv"})", 3) ==
        "/base/fill/file would give all 3 replicates the same start; write \"replicates\": 1, or "
        "list a start for each in fill.files");
  CHECK(error(R"({"files": ["a.csv", "b.csv"]})", 3) ==
        "/base/fill/files lists 2 starts for 3 replicates; write \"replicates\": 2");
  CHECK(error(R"({"files": ["a.csv", "b.csv", "copy.csv"]})", 1) ==
        "/base/fill/files/2 is the same start as a.csv; replicates must differ");
  CHECK(error(R"({"files": ["a.csv", "b.csv", "lines.csv"]})", 1) ==
        "/base/fill/files/2 is the same start as a.csv; replicates must differ");
  folder.write("zero.csv", "x,y,z,r,qw,qx,qy,qz\n0,2,2,0.5,0,0.6,0.8,0\n");
  folder.write("minus.csv", "x,y,z,r,qw,qx,qy,qz\n-0.0,2,2,0.5,0,-0.6,-0.8,-0\n");
  CHECK(error(R"({"files": ["zero.csv", "minus.csv"]}, "shape": {"cube": {}})", 1) ==
        "/base/fill/files/1 is the same start as zero.csv; replicates must differ");
  CHECK_THAT(error(R"({"files": ["a.csv", "out.csv"]})", 2),
             Catch::StartsWith("/base/fill/files/1 grain 1 lies outside the box"));
  const std::vector<Job> jobs = read(R"({"files": ["a.csv", "b.csv"]})", 1).sweep.jobs;
  REQUIRE(jobs.size() == 2);
  CHECK(jobs[0].parameters == jobs[1].parameters);
  CHECK(std::get<PlacedGrains>(jobs[1].spec.fill).grains.at(0).x == 3.0);
  CHECK((jobs[0].replicate == 1 && jobs[1].replicate == 2));
  CHECK(jobs[1].files.at("fill.files") == "b.csv");

  const std::vector<Job> turned = read(R"({"files": ["b.csv", "a.csv"]})", 2).sweep.jobs;
  REQUIRE(turned.size() == 2);
  CHECK((turned[0].id == jobs[1].id && turned[1].id == jobs[0].id));
  CHECK(turned[0].id != read(R"({"file": "b.csv"})", 1).sweep.jobs.at(0).id);
}

TEST_CASE("each list of starts is a point, and a longer one keeps the packings of the shorter") {
  const ScratchFolder folder;
  for (const char* name : {"a", "b", "c"}) {
    folder.write(std::string(name) + ".csv",
                 "x,y,z,r\n" + std::to_string(name[0] - 'a' + 1) + ",2,2,0.5\n");
  }
  const auto jobs_of = [&](const std::string& lists) {
    return read_sweep(folder.write("s.json", R"({"name": "t", "sweep": [{"grid": {"fill.files": )" +
                                                 lists + "}}]}"))
        .sweep.jobs;
  };
  const std::vector<Job> two = jobs_of(R"([["a.csv", "b.csv"], ["c.csv"]])");
  REQUIRE(two.size() == 3);
  CHECK(two[0].parameters == two[1].parameters);
  CHECK(two[0].parameters != two[2].parameters);
  CHECK(jobs_of(R"([["a.csv", "b.csv", "c.csv"]])").at(1).id == two[1].id);
}

TEST_CASE("the same start with another seed is no other packing") {
  const ScratchFolder folder;
  folder.write("a.csv", "x,y,z,r\n2,2,2,0.5\n");
  for (const char* fill : {R"("fill.file": "a.csv")", R"("fill.files": ["a.csv"])"}) {
    const SweepReading reading =
        read_sweep(folder.write("s.json", std::string(R"({"name": "t", "base": {)") + fill +
                                              R"(}, "sweep": [{"grid": {"seed": [1, 2, 3]}}]})"));
    REQUIRE(!reading.errors.empty());
    CHECK(reading.errors[0].pointer == "/sweep/0/grid/seed/1");
    CHECK_THAT(reading.errors[0].message, Catch::Contains("it comes out as the same bed"));
  }
}

TEST_CASE("the diameter in a file of starts holds for every file that blocks name") {
  const ScratchFolder folder;
  folder.write("a.csv", "x,y,z,r\n2,2,2,0.5\n");
  const auto parameters_of = [&](const std::string& block) {
    const SweepReading reading = read_sweep(folder.write(
        "s.json", R"({"name": "t", "base": {"fill.diameter": 1.25}, "sweep": [)" + block + "]}"));
    REQUIRE(reading.errors.empty());
    return reading.sweep.jobs.at(0).parameters.text();
  };
  const std::string kept = R"("fill":{"diameter":1.25,)";
  CHECK_THAT(parameters_of(R"({"set": {"fill.file": "a.csv"}})"), Catch::Contains(kept));
  CHECK_THAT(parameters_of(R"({"grid": {"fill.file": ["a.csv"]}})"), Catch::Contains(kept));
  CHECK_THAT(parameters_of(R"({"set": {"fill.diameter": 1.5}, "grid": {"fill.file": ["a.csv"]}})"),
             Catch::Contains(R"("fill":{"diameter":1.5,)"));
  CHECK_THAT(parameters_of(R"({"set": {"fill.grains": 9000}}, {"set": {"fill.file": "a.csv"}})"),
             !Catch::Contains("diameter"));
}

TEST_CASE("small grains of a file that count as large are worth a note, with what to write") {
  const ScratchFolder folder;
  folder.write("two.csv", "size_class,x,y,z,r\nlarge,2,2,2,1\nsmall,5,2,2,0.5\nsmall,5,5,2,0.5\n");
  folder.write("one.csv", "size_class,x,y,z,r\nlarge,2,2,2,1\nlarge,5,2,2,0.5\n");
  const auto said = [&](const std::string& fill, const std::string& sizes) {
    const SweepReading reading =
        read_sweep(folder.write("s.json", R"({"name": "t", "base": {"fill": {"diameter": 2, )" +
                                              fill + "}" + sizes + "}}"));
    CHECK(reading.errors.empty());
    Messages notes;
    for (const Diagnostic& note : reading.notes) notes.push_back(note.pointer + " " + note.message);
    return notes;
  };
  const std::string note =
      " calls grains small in its column size_class that count as large, as sizes.small_share is "
      "0; "
      "to tell them apart write \"sizes\": {\"small_share\": 0.2, \"size_ratio\": 0.5}";
  CHECK(said(R"("file": "two.csv")", "") == Messages{"/base/fill/file" + note});
  CHECK(said(R"("files": ["one.csv", "two.csv"])", "") == Messages{"/base/fill/files/1" + note});
  CHECK(said(R"("file": "two.csv")", R"(, "sizes": {"small_share": 0.2, "size_ratio": 0.5})")
            .empty());
  CHECK(said(R"("file": "one.csv")", "").empty());
}

TEST_CASE("a diameter in a file of starts that is not the d of the units is worth a note") {
  const ScratchFolder folder;
  folder.write("a.csv", "x,y,z,r\n4,4,4,1\n");
  const auto said = [&](const std::string& fill, const std::string& units) {
    const SweepReading reading = read_sweep(
        folder.write("s.json", R"({"name": "t", )" + units + R"("base": {"fill": )" + fill + "}}"));
    CHECK(reading.errors.empty());
    Messages notes;
    for (const Diagnostic& note : reading.notes) notes.push_back(note.pointer + " " + note.message);
    return notes;
  };
  const std::string units = R"("units": {"d": 6, "unit": "mm"}, )";
  CHECK(said(R"({"file": "a.csv", "diameter": 5})", units) ==
        Messages{"/base/fill/diameter is not the d of units, 6 mm: if the file is in mm, tables "
                 "will give other lengths in mm; set both to one length"});
  CHECK(said(R"({"files": ["a.csv"], "diameter": 5})", units) ==
        Messages{"/base/fill/diameter is not the d of units, 6 mm: if the files are in mm, tables "
                 "will give other lengths in mm; set both to one length"});
  CHECK(said(R"({"file": "a.csv", "diameter": 6})", units).empty());
  CHECK(said(R"({"file": "a.csv", "diameter": 1})", units).empty());  // lengths in d
  CHECK(said(R"({"file": "a.csv"})", units).empty());
  CHECK(said(R"({"file": "a.csv", "diameter": 5})", "").empty());
}

TEST_CASE(
    "names of files in tables are no formulas of a spreadsheet and nothing a terminal obeys") {
  const ScratchFolder folder;
  const auto name_of = [&](const std::string& file) {
    folder.write(file, "x,y,z,r\n2,2,2,0.5\n");
    const auto text = R"({"name": "t", "base": {"fill": {"file": ")" + file + "\"}}}";
    return read_sweep(folder.write("s.json", text)).sweep.jobs.at(0).files.at("fill.file");
  };
  CHECK(name_of("=1+1.csv") == "./=1+1.csv");
  CHECK(name_of("@a.csv") == "./@a.csv");
  CHECK(name_of("+a.csv") == "./+a.csv");
  CHECK(name_of("-a.csv") == "./-a.csv");
  CHECK(name_of("a\u009b2J.csv") == "a?2J.csv");
  CHECK(name_of("a=1.csv") == "a=1.csv");
}

TEST_CASE("errors of a fill file name its own lines, once for all jobs") {
  const ScratchFolder folder;
  folder.write("bed.csv", "x,y,z,r\n1,1,1,zero\n");
  const std::string path = folder.write("s.json", R"({"name": "t", "replicates": 3,
    "base": {"fill": {"file": "bed.csv"}},
    "sweep": [{"grid": {"box.width": [5, 6, 7]}}, {"set": {"fill.file": "none.csv"}}]})");
  Messages errors;
  for (const Diagnostic& diagnostic : read_sweep(path).errors) {
    errors.push_back(folder.without_folder(to_string(diagnostic)));
  }
  CHECK(errors == Messages{"bed.csv:2: r must be a finite number, is \"zero\"",
                           "s.json:3:73 /sweep/1/set/fill.file: none.csv cannot be read: No such "
                           "file or directory"});
}

}  // namespace grainsweep
