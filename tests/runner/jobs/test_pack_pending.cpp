#include <chrono>
#include <filesystem>
#include <thread>

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/packing.hpp"
#include "runner/jobs/pack_pending.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/journal.hpp"
#include "runner/versions.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

Sweep sweep_of_a_small_bed() {
  Job job;
  job.id = "00c0ffee00c0ffee";
  job.spec.box = {3, 3, Boundary::periodic, Boundary::periodic};
  job.spec.fill = GrainCount{30};
  job.spec.accuracy = *preset("fast");
  job.spec.accuracy.max_steps = 40;
  job.spec.measure.exclude_floor = 0;
  job.spec.measure.exclude_surface = 0;
  return {"small", 1, 1, {job}};
}

/// A packing after its third step.
Checkpoint stopped_early(const Job& job, double cpu_seconds) {
  Checkpoint checkpoint;
  checkpoint.cpu_seconds = cpu_seconds;
  make_packing(job.spec, kernels_for(Isa::sse2), [&](const Progress& progress) {
    checkpoint.step = progress.step;
    checkpoint.state = progress.save();
    return progress.step < 3;
  });
  return checkpoint;
}

TEST_CASE("the CPU time of a packing is that of all runs that worked on it") {
  const TemporaryFolder folder;
  const Sweep sweep = sweep_of_a_small_bed();
  const double hour = 3600;  // far longer than what is left of this packing
  CheckpointFiles(folder.path(), sweep.jobs[0].id, build_name())
      .write(stopped_early(sweep.jobs[0], hour));
  ShardFiles files(folder.path(), {}, sample_run());
  RunningSweep running{folder.path(), files, 0, {&sweep.jobs[0]}, {}};
  PackOptions options;
  options.isa = Isa::sse2;
  CHECK(pack_pending(running, options).packings == 1);
  const Outcome outcome = *read_journals(folder.path()).outcomes.at(sweep.jobs[0].id);
  CHECK(outcome.cpu_seconds > hour);
  CHECK(outcome.cpu_seconds < hour + 60);
  CHECK(saved_packings(folder.path()) == 0);
}

TEST_CASE("a packing that ends in an exception begins anew, unless it lacked memory") {
  const TemporaryFolder folder;
  Sweep sweep = sweep_of_a_small_bed();
  const Checkpoint checkpoint = stopped_early(sweep.jobs[0], 1.0);
  CheckpointFiles(folder.path(), sweep.jobs[0].id, build_name()).write(checkpoint);
  const Mixture inner{{{1.0, CubeSize{}}}};
  sweep.jobs[0].spec.shape = Mixture{{{1.0, inner}}};  // no sweep can ask for one within another
  ShardFiles files(folder.path(), {}, sample_run());
  RunningSweep running{folder.path(), files, 0, {&sweep.jobs[0]}, {}};
  PackOptions options;
  options.isa = Isa::sse2;
  CHECK(pack_pending(running, options).packings == 1);
  CHECK(read_journals(folder.path()).outcomes.at(sweep.jobs[0].id)->exception);
  CHECK(saved_packings(folder.path()) == 0);
}

TEST_CASE("a folder in the place of a checkpoint is no reason to stop a run") {
  const TemporaryFolder folder;
  const Sweep sweep = sweep_of_a_small_bed();
  make_folder(folder.path() + "/checkpoints/" + sweep.jobs[0].id + ".0");
  ShardFiles files(folder.path(), {}, sample_run());
  RunningSweep running{folder.path(), files, 0, {&sweep.jobs[0]}, {}};
  PackOptions options;
  options.isa = Isa::sse2;
  options.checkpoint_seconds = 0;
  CHECK(pack_pending(running, options).packings == 1);
  CHECK(read_journals(folder.path()).outcomes.size() == 1);
}

TEST_CASE("no packing begins that would outlive the limit by what others like it took") {
  const Sweep sweep = sweep_of_a_small_bed();
  const TemporaryFolder folder;
  ShardFiles files(folder.path(), {}, sample_run());
  PackOptions options;
  options.isa = Isa::sse2;
  options.time_limit = TimeLimit(10);  // of which 9 s are for packings
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const auto packed_where_others_took = [&](double seconds) {
    RunningSweep running{folder.path(), files, 1, {&sweep.jobs[0]}, {}};
    running.estimates.add(estimate_cost(sweep.jobs[0].spec).cpu_seconds, seconds);
    return pack_pending(running, options).packings;
  };
  CHECK(packed_where_others_took(8.97) == 0);
  CHECK(packed_where_others_took(1.0) == 1);
}

double ticks = 0.0;
double ticking() { return ticks += 1.0; }

// Others take a runner for lost whose journal nothing has touched for long: here it lies untouched
// for an hour when a packing begins, and that is stopped before anything of it is stored.
TEST_CASE("a runner gives signs of life while a packing is under way") {
  const Sweep sweep = sweep_of_a_small_bed();
  const TemporaryFolder folder;
  ShardFiles files(folder.path(), {}, sample_run());
  const std::string journal = journal_path(folder.path(), "1-of-1");
  const auto long_ago = std::filesystem::last_write_time(journal) - std::chrono::hours(1);
  RunningSweep running{folder.path(), files, 0, {&sweep.jobs[0]}, {}};
  PackOptions options;
  options.isa = Isa::sse2;
  options.time_limit = TimeLimit(20.0, ticking);
  std::filesystem::last_write_time(journal, long_ago);
  CHECK(pack_pending(running, options).packings == 0);
  CHECK(saved_packings(folder.path()) == 1);
  CHECK(std::filesystem::last_write_time(journal) > long_ago);
}

TEST_CASE("without grains the same curves are stored") {
  const Sweep sweep = sweep_of_a_small_bed();
  std::string curves[2];
  for (const bool no_grains : {false, true}) {
    const TemporaryFolder folder;
    ShardFiles files(folder.path(), {}, sample_run());
    RunningSweep running{folder.path(), files, 0, {&sweep.jobs[0]}, {}};
    PackOptions options;
    options.isa = Isa::sse2;
    options.no_grains = no_grains;
    pack_pending(running, options);
    StoredBed bed =
        read_bed(folder.path(), *read_journals(folder.path()).outcomes.at(sweep.jobs[0].id));
    CHECK(bed.grains.size() == (no_grains ? 0 : 30));
    bed.grains.clear();
    bed.forces.clear();
    bed.wall_forces.clear();
    curves[no_grains ? 1 : 0] = bed_bytes(bed);
  }
  CHECK(curves[0] == curves[1]);
}

TEST_CASE("a bed that is known is measured again, and its packing is told what it took") {
  const TemporaryFolder folder;
  ShardFiles files(folder.path(), {}, sample_run());
  Sweep sweep = sweep_of_a_small_bed();
  Job& job = sweep.jobs[0];
  job.bed = 7;
  job.settled_bed = 7;
  PackOptions options;
  options.isa = Isa::sse2;
  RunningSweep first{folder.path(), files, 0, {&job}, {}};
  pack_pending(first, options);
  Outcomes stored = read_journals(folder.path()).outcomes;
  Outcome& made = *stored.at(job.id);
  CHECK(made.bed == 7U);
  made.cpu_seconds = 3600;
  job.id = "0ff1ce000ff1ce00";
  job.spec.measure.bin_width = 0.5;
  RunningSweep again{folder.path(), files, 0, {&job}, {}};
  again.beds = known_beds(folder.path(), stored, again.pending);
  CHECK(again.beds.size() == 1);
  CHECK(pack_pending(again, options).packings == 1);
  const Outcome outcome = *read_journals(folder.path()).outcomes.at(job.id);
  CHECK(outcome.cpu_seconds > 3600);
  CHECK(outcome.result.state_hash == made.result.state_hash);
  CHECK(read_bed(folder.path(), outcome).curves.profile_z.bin_width == 0.5);
}

}  // namespace
}  // namespace grainsweep
