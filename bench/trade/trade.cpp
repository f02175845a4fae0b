// The trade of speed for accuracy: the tables of scenes that bench/trade.sh has settled.
//
//   bench_trade TABLES.md TABLE.csv FOLDER...          a folder for each scene
#include <cstdio>
#include <deque>
#include <exception>
#include <vector>

#include "bench/trade/tables.hpp"
#include "runner/store/files.hpp"

int main(int argc, char** argv) {
  using namespace grainsweep;
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_trade TABLES.md TABLE.csv FOLDER...\n");
    return 2;
  }
  try {
    std::deque<bench::Scene> scenes;  // whose settings stay where they are
    std::vector<bench::SceneRows> rows;
    for (int k = 3; k < argc; ++k) {
      const bench::Scene& scene = scenes.emplace_back(bench::read_scene(argv[k]));
      rows.push_back({&scene, bench::compare_settings(scene)});
    }
    replace_file(argv[1], bench::trade_markdown(rows));
    replace_file(argv[2], bench::trade_csv(rows));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_trade: %s\n", error.what());
    return 1;
  }
  return 0;
}
