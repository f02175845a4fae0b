// The trade of speed for accuracy: the tables of a scene that bench/trade.sh has settled.
//
//   bench_trade FOLDER TABLES.md TABLE.csv [POOL.json]
//
// With POOL.json, in which the rows of each seed stand, they are means over the starts of all
// seeds.
#include <cstdio>
#include <exception>

#include "bench/trade/pool.hpp"
#include "bench/trade/tables.hpp"
#include "runner/store/files.hpp"

int main(int argc, char** argv) {
  using namespace grainsweep;
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: bench_trade FOLDER TABLES.md TABLE.csv [POOL.json]\n");
    return 2;
  }
  try {
    const bench::Scene scene = bench::read_scene(argv[1]);
    bench::SceneRows compared{&scene, bench::compare_settings(scene)};
    if (argc == 5) bench::pool_with(argv[4], scene, compared.rows);
    replace_file(argv[2], bench::trade_markdown(compared));
    replace_file(argv[3], bench::trade_csv(compared));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_trade: %s\n", error.what());
    return 1;
  }
  return 0;
}
