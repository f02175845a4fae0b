#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "runner/sweep/text_lines.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Lines = std::vector<std::string_view>;

TEST_CASE("a text has the lines between its line feeds, without blank ones at the end") {
  CHECK(lines_of("a\nb\n\nc\n\n \n") == Lines{"a", "b", "", "c"});
  CHECK(lines_of("\xEF\xBB\xBFx,y") == Lines{"x,y"});
  CHECK(lines_of("") == Lines{""});
  CHECK(lines_of("a\rb\r\rc\r") == Lines{"a", "b", "", "c"});
  CHECK(lines_of("a\r\nb\r\n") == Lines{"a\r", "b"});
}

TEST_CASE("what a terminal would obey becomes a question mark, other characters stay") {
  CHECK(without_controls("W = 5 \xC3\xA4 \xE2\x82\xAC") == "W = 5 \xC3\xA4 \xE2\x82\xAC");
  CHECK(without_controls("a\x1B[2Jb\x7F") == "a?[2Jb?");
  CHECK(without_controls("\xC2\x9B"
                         "1m\xE2\x80\xAE"
                         "x\xE2\x81\xA6\xE2\x80\xA8") == "?1m?x??");
  CHECK(without_controls("\xE2\x80") == "\xE2\x80");
  CHECK(without_controls("a\nb") == "a?b");
}

TEST_CASE("a message keeps its lines, and nothing else that a terminal would obey") {
  CHECK(lines_without_controls("a\x1B[31m: b\n\nc\r") == "a?[31m: b\n\nc?");
  CHECK(lines_without_controls("").empty());
}

TEST_CASE("a pipe is no file to read from") {
  const ScratchFolder folder;
  const std::string pipe = folder.path("pipe");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(read_text(pipe).errors.at(0).message == "is a pipe or a device, not a file");
}

TEST_CASE("blanks around words are dropped") {
  CHECK(trimmed(" \ta b\r") == "a b");
  CHECK(trimmed(" \t").empty());
}

TEST_CASE("only whole finite numbers with a decimal point are numbers") {
  CHECK(finite_number("-1.5e3") == -1500.0);
  CHECK(finite_number(".5") == 0.5);
  CHECK(finite_number("+.5") == 0.5);
  for (const char* text : {"", "+", "+-1", "++1", "1,5", "1.5x", "nan", "inf", "1e999", " 1"}) {
    INFO(text);
    CHECK_FALSE(finite_number(text));
  }
}

TEST_CASE("lines and columns count from one, columns in characters") {
  const std::string text = "ab\n\xC3\xA4\xE2\x82\xACx\n\n";
  const LineIndex lines(text);
  CHECK(lines.place(0) == ":1:1");
  CHECK(lines.place(2) == ":1:3");
  CHECK(lines.place(3) == ":2:1");
  CHECK(lines.place(5) == ":2:2");
  CHECK(lines.place(8) == ":2:3");
  CHECK(lines.place(10) == ":3:1");
  CHECK(lines.place(text.size()) == ":4:1");
  CHECK(lines.place(1000) == ":4:1");
}

TEST_CASE("a byte order mark takes no column") {
  CHECK(LineIndex("\xEF\xBB\xBF{").place(3) == ":1:1");
  CHECK(LineIndex("\xEF\xBB\xBF{").place(0) == ":1:1");
}

TEST_CASE("files that hold no text are refused by name") {
  const ScratchFolder folder;
  const auto error = [&](const std::string& path) {
    const FileText file = read_text(path);
    REQUIRE(file.errors.size() == 1);
    CHECK(file.text.empty());
    return folder.without_folder(to_string(file.errors.front()));
  };
  CHECK(error(folder.path("none.json")) == "none.json: cannot be read: No such file or directory");
  CHECK(error(folder.write("empty.json", "")) == "empty.json: is empty");
  CHECK(error(folder.write("blank.json", " \n\t\r\n")) == "blank.json: is empty");
  CHECK(error(folder.write("wide.csv", {"\xFF\xFE"
                                        "x\0,\0",
                                        6})) == "wide.csv: is text in UTF-16; save it as UTF-8");
  CHECK(error(folder.write("wide.csv", {"\xFE\xFF\0x\0,", 6})) ==
        "wide.csv: is text in UTF-16; save it as UTF-8");
  std::filesystem::create_directory(folder.path("sub"));
  CHECK(error(folder.path("sub")) == "sub: is a folder, not a file");
}

}  // namespace
}  // namespace grainsweep
