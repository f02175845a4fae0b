#include <catch2/catch.hpp>

#include "runner/tables/columns.hpp"

namespace grainsweep {
namespace {

struct Point {
  double x;
};
struct NamedPoint : Point {
  std::string name;
};

TEST_CASE("a table is made of columns, of the item or of what it is derived from") {
  const Columns<Point> of_point = {
      {"x", "d", "place", [](const Point& point) { return cell(point.x); }}};
  Columns<NamedPoint> columns = {
      {"name", "", "of the point", [](const NamedPoint& point) { return cell(point.name); }}};
  append(columns, of_point);
  CHECK(header_line(columns) == "name,x\n");
  CHECK(row_line(columns, NamedPoint{{0.25}, "a,b"}) == "\"a,b\",0.25\n");
  const auto texts = described("points.csv", columns);
  CHECK(columns_csv(texts) ==
        "file,column,unit,meaning\npoints.csv,name,,of the point\npoints.csv,x,d,place\n");
  CHECK(columns_markdown(texts) ==
        "### `points.csv`\n\n| column | unit | meaning |\n|---|---|---|\n"
        "| `name` |  | of the point |\n| `x` | d | place |\n");
}

TEST_CASE("a column that is there already is not added again") {
  Columns<Point> columns = {{"x", "d", "place", [](const Point& point) { return cell(point.x); }},
                            {"x", "", "as varied", [](const Point&) { return std::string(); }}};
  remove_repeated(columns);
  CHECK(header_line(columns) == "x\n");
  CHECK(row_line(columns, Point{0.25}) == "0.25\n");
}

}  // namespace
}  // namespace grainsweep
