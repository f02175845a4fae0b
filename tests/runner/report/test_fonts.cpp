#include <cstdlib>
#include <filesystem>

#include <catch2/catch.hpp>

#include "runner/report/figure.hpp"
#include "runner/report/fonts.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/temporary_folder.hpp"

using namespace grainsweep;

TEST_CASE("characters of all fonts with outlines are joined", "[report]") {
  CHECK(characters_of_fonts("TrueType 20-7e 3c6\nType 1 4e00-9fff\nPCF 65e5\nCFF 7f 3c0-3c5 \n") ==
        Characters{{0x20, 0x7f}, {0x3c0, 0x3c6}});
  CHECK(characters_of_fonts("").empty());
  CHECK(characters_of_fonts("CFF\n").empty());  // which is a number in hexadecimal digits, too
  CHECK(characters_of_fonts("TrueType \nTrueType -\n").empty());
}

TEST_CASE("characters without a glyph are question marks, one for each", "[report]") {
  const Characters known = {{0xa0, 0x377}, {0x3c6, 0x3c6}, {0x1f600, 0x1f601}};
  CHECK(drawable("日本 pellets, φ", known) == "?? pellets, φ");
  CHECK(drawable("\u00a0é\u0377\u0378", known) == "\u00a0é\u0377?");
  CHECK(drawable("😀😂", known) == "😀?");  // beyond 16 bits
  CHECK(drawable("plain", {}) == "plain");
  CHECK(drawable("", known).empty());
}

TEST_CASE("the fonts are those that fontconfig lists, else letters of Europe are drawn",
          "[report]") {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH"), program = folder.path() + "/fc-list";
  setenv("PATH", folder.path().c_str(), 1);
  const Characters unasked = installed_characters();
  replace_file(program, "#!/bin/sh\necho TrueType 20-7e 65e5\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const Characters asked = installed_characters();
  setenv("PATH", path.c_str(), 1);
  CHECK(drawable("日本 φ", asked) == "日? ?");
  CHECK(drawable("日 φ é ж …", unasked) == "? φ é ж …");
}

TEST_CASE("what no font has is left out of the PNG alone", "[report]") {
  Figure figure{.name = "means", .title = "", .caption = ""};
  figure.commands = "set xlabel '日 φ'\n";
  const std::string commands = drawing_commands(figure, {{0x3c6, 0x3c6}});
  const std::size_t png = commands.find("pngcairo");
  CHECK(commands.find("'日 φ'") < png);
  CHECK(commands.find("'日 φ'", png) == std::string::npos);
  CHECK(commands.find("'? φ'", png) != std::string::npos);
}
