#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/sweep/assignments.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

/// The specification of the only job of a sweep with this base and this block.
PackingSpec spec_of(const std::string& base, const std::string& block = "{}") {
  const SweepReading reading = reading_of(sweep_of(block, base));
  for (const Diagnostic& diagnostic : reading.errors) FAIL(to_string(diagnostic));
  REQUIRE(reading.sweep.jobs.size() == 1);
  return reading.sweep.jobs.front().spec;
}

using Messages = std::vector<std::string>;

/// Errors of a sweep with this base, which starts at line 2.
Messages errors_in_base(const std::string& base) {
  return errors_of("{\"name\": \"t\", \"base\":\n" + base + "}");
}

}  // namespace

TEST_CASE("nested and dotted keys set the same parameters") {
  const PackingSpec nested = spec_of(R"({"box": {"width": 7, "y": "periodic"}})");
  const PackingSpec dotted = spec_of(R"({"box.width": 7, "box.y": "periodic"})");
  CHECK(nested.box.width == 7.0);
  CHECK(nested.box.y == Boundary::periodic);
  CHECK(dotted.box.width == 7.0);
  CHECK(dotted.box.y == Boundary::periodic);
}

TEST_CASE("a block's set lies over base and leaves the rest of base alone") {
  const PackingSpec spec =
      spec_of(R"({"box": {"width": 7, "length": 12}})", R"({"set": {"box": {"width": 9}}})");
  CHECK(spec.box.width == 9.0);
  CHECK(spec.box.length == 12.0);
}

TEST_CASE("a grid lies over base") {
  CHECK(spec_of(R"({"box.width": 7})", R"({"grid": {"box.width": [8]}})").box.width == 8.0);
}

TEST_CASE("a value that a block sets and varies is refused") {
  CHECK(errors_of(sweep_of(R"({"set": {"box.width": 7}, "grid": {"box.width": [8]}})")) ==
        Messages{"s.json:1:59 /sweep/0/set/box.width: the block varies box.width, so that this "
                 "value is never used; take one of them out"});
}

TEST_CASE("of a container that a block sets and varies, what it varies is named") {
  CHECK(errors_of(sweep_of(R"({"set": {"tube.diameter": 7}, "grid": {"box.width": [8]}})")) ==
        Messages{"s.json:1:63 /sweep/0/set/tube.diameter: the block varies box.width, so that this "
                 "value is never used; take one of them out"});
}

TEST_CASE("a container without parts is a box with its defaults, and no tube") {
  const PackingSpec spec = spec_of(R"({"tube.diameter": 7})", R"({"set": {"box": {}}})");
  CHECK_FALSE(spec.box.is_tube);
  CHECK(spec.box.length == 20.0);
  CHECK(spec_of(R"({"box.length": 12})", R"({"set": {"box": {}}})").box.length == 12.0);
  CHECK(spec_of(R"({"box": {}, "box.length": 12})").box.length == 12.0);
  CHECK(
      errors_in_base(R"({"box": {}, "tube.diameter": 7})") ==
      Messages{"s.json:2:30 /base/tube.diameter: the container is already described at /base/box; "
               "keep one of box, tube"});
  CHECK(errors_in_base(R"({"tube": {}})") ==
        Messages{R"(s.json:2:10 /base/tube: a tube needs its diameter: write {"diameter": 7})"});
}

TEST_CASE("what a preset breaks is told where the preset is named") {
  CHECK(errors_in_base(R"({"shape": "cube", "accuracy": "exact"})") ==
        Messages{"s.json:2:31 /base/accuracy: accuracy.rest must be in_steps for grains that are "
                 "not spheres, is exact; accurate is the preset that settles them best"});
}

TEST_CASE("a sweep that names no accuracy is balanced") {
  CHECK(spec_of("{}").accuracy == *preset("balanced"));
}

TEST_CASE("presets are named alone, in an object or by their path") {
  CHECK(spec_of(R"({"accuracy": "fast"})").accuracy == *preset("fast"));
  CHECK(spec_of(R"({"accuracy": {"preset": "fast"}})").accuracy == *preset("fast"));
  CHECK(spec_of(R"({"accuracy.preset": "fast"})").accuracy == *preset("fast"));
}

TEST_CASE("a part of the accuracy holds over any preset, in whatever order and layer") {
  Accuracy wanted = *preset("fast");
  wanted.step = 0.125;
  CHECK(spec_of(R"({"accuracy": {"step": 0.125, "preset": "fast"}})").accuracy == wanted);
  CHECK(spec_of(R"({"accuracy": "fast", "accuracy.step": 0.125})").accuracy == wanted);
  CHECK(spec_of(R"({"accuracy": "accurate"})",
                R"({"set": {"accuracy.step": 0.125}, "grid": {"accuracy": ["fast"]}})")
            .accuracy == wanted);
}

TEST_CASE("a layer that fills the box replaces the fill below it") {
  const auto spec =
      spec_of(R"({"fill": {"solid_height": 5}})", R"({"set": {"fill.grains": 3210}})");
  CHECK(std::get<GrainCount>(spec.fill).count == 3210);
  CHECK(std::get<SolidHeight>(spec_of(R"({"fill": {"grains": 5000}})",
                                      R"({"grid": {"fill": [{"solid_height": 4.5}]}})")
                                  .fill)
            .height == 4.5);
}

TEST_CASE("two ways to fill the box in one object are refused") {
  CHECK(errors_in_base(R"({"fill": {"solid_height": 9, "grains": 10000}})") ==
        Messages{"s.json:2:40 /base/fill/grains: the box is already filled by fill.solid_height; "
                 "keep one of solid_height, grains, file, files"});
}

TEST_CASE("a parameter that is set twice in one object is refused") {
  CHECK(errors_in_base(R"({"box": {"width": 5}, "box.width": 6})") ==
        Messages{"s.json:2:36 /base/box.width: box.width is already set at /base/box/width"});
}

TEST_CASE("an unknown key is refused at the key, with the nearest known one") {
  CHECK(errors_in_base(R"({"box": {"widht": 5}})") ==
        Messages{"s.json:2:10 /base/box/widht: unknown key \"widht\"; did you mean \"width\"?"});
  CHECK(errors_in_base(R"({"sizes.spred": 0.1})") ==
        Messages{"s.json:2:2 /base/sizes.spred: unknown key \"sizes.spred\"; did you mean "
                 "\"sizes.spread\"?"});
  CHECK(errors_in_base(R"({"box.gap": 5})") ==
        Messages{"s.json:2:2 /base/box.gap: unknown key \"box.gap\"; known in box: length, width, "
                 "x, y"});
  CHECK(errors_in_base(R"({"shape.pinacoid.angle": 60})") ==
        Messages{"s.json:2:2 /base/shape.pinacoid.angle: unknown key \"shape.pinacoid.angle\"; "
                 "did you mean \"shape.pinacoid.angle_deg\"?"});
  CHECK(errors_in_base(R"({"bx": {}})") ==
        Messages{"s.json:2:2 /base/bx: unknown key \"bx\"; did you mean \"box\"?"});
  CHECK(errors_in_base(R"({"colour": 0.3})") ==
        Messages{"s.json:2:2 /base/colour: unknown key \"colour\"; known here: shape, box, tube, "
                 "fill, sizes, accuracy, measure"});
  CHECK(errors_in_base(R"({"": 1})").size() == 1);
}

TEST_CASE("a key that belongs elsewhere is sent there") {
  CHECK(errors_in_base(R"({"width": 5})") ==
        Messages{"s.json:2:2 /base/width: unknown key \"width\"; did you mean \"box.width\"?"});
}

TEST_CASE("why there is no parameter of a name depends on where it is looked for") {
  const auto hint = [](const std::string& base) {
    const Messages errors = errors_in_base(base);
    REQUIRE(errors.size() == 1);
    return errors[0].substr(errors[0].find("\"; ") + 3);
  };
  const std::string is_unit = "the mean diameter of the large grains is d, the unit of length";
  CHECK(hint(R"({"diameter": 1})") == is_unit);
  CHECK(hint(R"({"sizes": {"mean": 1}})") == is_unit);
  CHECK(
      hint(R"({"tube": {"diameter": 5, "length": 9}})") ==
      "a tube is open at the top; fill.solid_height says how much is filled in: a bed of height h "
      "is about 0.6 h of solid (its solid fraction times h), and plan prints the height to expect");
  CHECK(hint(R"({"shape": {"sphere": {}}})") ==
        "write \"shape\": \"sphere\"; a sphere has no parts");
  CHECK(hint(R"({"replicates": 3})") == "it stands beside \"base\", or in a block beside \"set\"");
  CHECK(hint(R"({"sizes": {"distribution": {"table": {"diameter": 1}}}})") ==
        "did you mean \"diameters\"?");
  CHECK(hint(R"({"sizes": {"distribution": {"uniform": {"diameter": 1}}}})") ==
        "known here: from, to");
  CHECK(hint(R"({"sizes": {"distribution": {"lognormal": {"mean": 1}}}})") ==
        "write \"median\"; the mean is exp(sigma^2 / 2) times it");
  CHECK(hint(R"({"sizes": {"distribution": {"lognormal": {"std": 1}}}})") ==
        "write \"sigma\", the standard deviation of the logarithm of the diameter");
  CHECK(hint(R"({"sizes": {"polydispersity": 0.1}})") ==
        "sizes of a class are Gaussian; sizes.spread is their deviation over the mean");
  const std::string is_open =
      "the box is open at the top; fill.solid_height says how much is filled in: a bed of height h "
      "is about 0.6 h of solid (its solid fraction times h), and plan prints the height to expect";
  CHECK(hint(R"({"box": {"z": 20}})") == is_open);
  CHECK(hint(R"({"box.depth": 20})") == is_open);
  CHECK(hint(R"({"sizes": {"distribution": {"lognormal": {"by": 1}}}})") ==
        "did you mean \"sizes.distribution.by\"?");
  CHECK(hint(R"({"sizes": {"distribution": {"sigma": 1}}})") ==
        "did you mean \"sizes.distribution.lognormal.sigma\"?");
  CHECK(hint(R"({"shape": {"icosahedron": {"edge": 1}}})") ==
        "a regular solid has a height, which is its edge times what configs/README.md says");
  CHECK(hint(R"({"shape": {"cuboid": {"edge": 1}}})") == "known here: length, width, height");
  CHECK(hint(R"({"shape": {"cube": {"height": 1}}})") == "known here: edge");
  CHECK(hint(R"({"shape": {"cylinder": {"radius": 1}}})") ==
        "write \"diameter\", twice the radius");
  CHECK(hint(R"({"shape": {"cylinder": {"length": 2}}})") == "write \"height\"");
  CHECK(hint(R"({"tube": {"radius": 1}})") ==
        "a tube has a diameter; d is the mean diameter of the large grains");
  CHECK(hint(R"({"box": {"friction": 1}})") == "grains are frictionless");
}

TEST_CASE("what is looked for inside base and stands at the top of the file is sent there") {
  CHECK(
      errors_in_base(R"({"units": {"d": 3.2, "unit": "mm"}})") ==
      Messages{"s.json:2:2 /base/units: unknown key \"units\"; \"units\" stands at the top of the "
               "file; here lengths are in d, the mean diameter of the large grains, times in "
               "sqrt(d/g)"});
  CHECK(errors_in_base(R"({"density": 2500})") ==
        Messages{"s.json:2:2 /base/density: unknown key \"density\"; no result depends on the "
                 "density of the grains; units.density, at the top of the file, is for bulk "
                 "densities"});
}

TEST_CASE("hints are the same for a dotted key") {
  CHECK_THAT(
      errors_in_base(R"({"shape": {"cylinder": {"sides": 32}}})").front(),
      Catch::EndsWith("unknown key \"sides\"; shape.cylinder.chord_error sets how many sides "
                      "a cylinder has; a prism has \"sides\""));
  CHECK(errors_in_base(R"({"shape.cylinder.radius": 1})") ==
        Messages{"s.json:2:2 /base/shape.cylinder.radius: unknown key \"shape.cylinder.radius\"; "
                 "write \"diameter\", twice the radius"});
  CHECK(errors_of(sweep_of(R"({"grid": {"box.friction": [0.1, 0.2]}})")) ==
        Messages{"s.json:1:47 /sweep/0/grid/box.friction: unknown key \"box.friction\"; grains are "
                 "frictionless"});
}

TEST_CASE("a group that is no object is refused with its keys") {
  CHECK(errors_in_base(R"({"box": 5})") ==
        Messages{"s.json:2:9 /base/box: must be an object with length, width, x, y, is 5"});
  CHECK(errors_in_base(R"({"accuracy": "balancd"})")
            .at(0)
            .starts_with("s.json:2:14 /base/accuracy: must be \"fast\", \"balanced\""));
  CHECK(errors_in_base(R"({"accuracy": 5})")
            .at(0)
            .starts_with("s.json:2:14 /base/accuracy: must be the name of a preset or an object "
                         "with preset, solid_fraction, coordination"));
  CHECK(errors_in_base("[]") ==
        Messages{"s.json:2:1 /base: must be an object of parameters, is an empty list"});
}

TEST_CASE("a shape is named alone, in an object or by the path of a part") {
  const auto angle_of = [](const std::string& base) {
    return std::get<PinacoidSize>(spec_of(base).shape).angle;
  };
  const double sixty = PinacoidSize{}.angle;
  CHECK(angle_of(R"({"shape": "pinacoid"})") == sixty);
  CHECK(angle_of(R"({"shape": {"pinacoid": {}}})") == sixty);
  CHECK(angle_of(R"({"shape.pinacoid": {}})") == sixty);
  CHECK(angle_of(R"({"shape": {"pinacoid": {"width": 2}}})") == sixty);
  CHECK(angle_of(R"({"shape.pinacoid.angle_deg": 60})") == sixty);
  CHECK(std::holds_alternative<SphereShape>(spec_of(R"({"shape": "sphere"})").shape));
  CHECK(std::holds_alternative<SphereShape>(spec_of("{}").shape));
  for (const std::string base : {R"({"shape": "prism"})", R"({"shape": {"prism": {}}})",
                                 R"({"shape.prism": {"sides": 6}})"}) {
    CHECK(std::get<PrismSize>(spec_of(base).shape).sides == 6);
  }
  CHECK(std::get<CubeSize>(spec_of(R"({"shape": {"cube": {"edge": 0.5}}})").shape).edge == 0.5);
}

TEST_CASE("a layer that names another shape replaces the one below with all its parts") {
  const std::string flat = R"({"shape": {"pinacoid": {"height": 0.5}}})";
  CHECK(
      std::holds_alternative<SphereShape>(spec_of(flat, R"({"set": {"shape": "sphere"}})").shape));
  const auto again =
      spec_of(R"({"shape.hull": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "size": 2}})",
              R"({"set": {"shape": {"pinacoid": {}}}})");
  CHECK(std::get<PinacoidSize>(again.shape).height == 1);
}

TEST_CASE("a layer that names the same shape changes only the parts it writes") {
  const auto shape_of = [](const std::string& block) {
    return std::get<PinacoidSize>(
        spec_of(R"({"shape": {"pinacoid": {"height": 0.5, "angle_deg": 45}}})", block).shape);
  };
  const PinacoidSize wide = shape_of(R"({"set": {"shape.pinacoid.width": 2}})");
  CHECK((wide.width == 2 && wide.height == 0.5));
  CHECK(shape_of(R"({"set": {"shape": "pinacoid"}})").height == 0.5);
  CHECK(shape_of(R"({"grid": {"shape.pinacoid.height": [0.25]}})").height == 0.25);
}

TEST_CASE("two shapes in one object are refused") {
  const std::string keep = "; keep one of them";
  CHECK(errors_in_base(R"({"shape": "sphere", "shape.pinacoid.width": 2})") ==
        Messages{"s.json:2:45 /base/shape.pinacoid.width: the grains already have the shape at "
                 "/base/shape" +
                 keep});
  CHECK(errors_in_base(R"({"shape": {"hull": {"file": "a.obj",
    "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]}}})") ==
        Messages{"s.json:3:17 /base/shape/hull/vertices: the grains already have the shape at "
                 "/base/shape/hull/file" +
                 keep});
  CHECK(errors_in_base(R"({"shape": {"pinacoid": {}, "hull": {"size": 2}}})")
            .at(0)
            .starts_with("s.json:2:45 /base/shape/hull/size: the grains already have"));
  CHECK(errors_in_base(R"({"shape": {"cube": {}, "prism": {"sides": 5}}})") ==
        Messages{"s.json:2:43 /base/shape/prism/sides: the grains already have the shape at "
                 "/base/shape/cube" +
                 keep});
}

TEST_CASE("a shape that is not said, or misspelt, is refused with what is known") {
  CHECK(errors_in_base(R"({"shape": {}})") ==
        Messages{"s.json:2:11 /base/shape: names no shape; must be \"sphere\", \"pinacoid\", "
                 "\"cube\", \"cuboid\", \"tetrahedron\", \"octahedron\", \"dodecahedron\", "
                 "\"icosahedron\", \"prism\", \"cylinder\" or an object with pinacoid, cube, "
                 "cuboid, tetrahedron, octahedron, dodecahedron, icosahedron, prism, cylinder, "
                 "hull, mixture, mixture_by"});
  CHECK(errors_in_base(R"({"shape": {"hull": {}}})") ==
        Messages{"s.json:2:20 /base/shape/hull: a hull needs its vertices: write \"vertices\" or "
                 "\"file\""});
  CHECK(errors_in_base(R"({"shape": {"pinacod": {}}})") ==
        Messages{"s.json:2:12 /base/shape/pinacod: unknown key \"pinacod\"; did you mean "
                 "\"pinacoid\"?"});
  CHECK(errors_in_base(R"({"shape": {"pinacoid": {"lenght": 1}}})") ==
        Messages{"s.json:2:25 /base/shape/pinacoid/lenght: unknown key \"lenght\"; did you mean "
                 "\"length\"?"});
  CHECK(errors_in_base(R"({"shape": {"pinacoid": {"angle": 1}}})") ==
        Messages{"s.json:2:25 /base/shape/pinacoid/angle: unknown key \"angle\"; did you mean "
                 "\"angle_deg\"?"});
  CHECK(errors_in_base(R"({"pinacoid": {}})") ==
        Messages{"s.json:2:2 /base/pinacoid: unknown key \"pinacoid\"; did you mean "
                 "\"shape.pinacoid\"?"});
  CHECK(errors_in_base(R"({"shape": {"pinacoid": 60}})") ==
        Messages{"s.json:2:24 /base/shape/pinacoid: must be an object with length, width, height, "
                 "angle_deg, is 60"});
}

TEST_CASE("a diameter without a fill file is refused, one that is not positive too") {
  CHECK(errors_in_base(R"({"fill": {"grains": 5000, "diameter": 2}})") ==
        Messages{
            "s.json:2:39 /base/fill/diameter: belongs to fill.file or fill.files; neither is set"});
  CHECK(errors_in_base(R"({"fill": {"file": "a.csv", "diameter": 0}})") ==
        Messages{"s.json:2:40 /base/fill/diameter: must be positive"});
}

TEST_CASE("the seed belongs beside base") {
  CHECK(errors_in_base(R"({"seed": 5})") ==
        Messages{"s.json:2:2 /base/seed: \"seed\" belongs beside \"base\", not into it"});
}

}  // namespace grainsweep
