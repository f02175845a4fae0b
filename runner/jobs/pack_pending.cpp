#include "runner/jobs/pack_pending.hpp"

#include <atomic>
#include <cstdio>
#include <mutex>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include "engine/dynamics/workspace.hpp"
#include "engine/packing.hpp"
#include "runner/jobs/stop.hpp"
#include "runner/machine.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/runners.hpp"
#include "runner/store/states.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/job_facts.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

std::string packing_line(const std::string& name, int replicate, const Outcome& outcome) {
  const PackingResult& result = outcome.result;
  std::string text = name + " #" + std::to_string(replicate) + "  " + words_of(result.status);
  if (!result.reason.empty()) text += " (" + result.reason + ")";
  if (!result.coordination.empty()) {
    text += "  φ " + fixed(result.solid_fraction, 4) + "  Z " +
            fixed(result.coordination.front().between_grains, 3);
  }
  return text + "  " + duration_text(outcome.cpu_seconds);
}

std::string went_on_text(std::int64_t step) {
  return step == 0 ? "" : ", went on from step " + std::to_string(step);
}

/// What is to be stored of a bed.
StoredBed bed_of(const Job& job, const PackingResult& result, Packing&& packing, bool no_grains) {
  StoredBed bed;
  bed.job = job.id;
  bed.state_hash = result.state_hash;
  bed.box = job.spec.box;
  bed.curves = static_cast<const Curves&>(result);
  if (!no_grains) static_cast<SettledBed&>(bed) = static_cast<SettledBed&&>(packing);
  return bed;
}

/// Puts a finished packing on the disk.
Outcome store(const Job& job, ShardFiles& files, Finished&& finished, bool no_grains) {
  Outcome outcome;
  outcome.job = job.id;
  outcome.version = program_version();
  outcome.result = std::move(finished.packing.result);
  outcome.exception = finished.threw;
  outcome.cpu_seconds = finished.cpu_seconds;
  outcome.finished_at = calendar_seconds();
  if (!finished.packing.grains.empty()) {
    if (!no_grains) outcome.bed = name_of_bed(job, outcome.result);
    files.add_bed(bed_of(job, outcome.result, std::move(finished.packing), no_grains), outcome);
  }
  Outcome written = files.add(std::move(outcome));
  files.flush();
  return written;
}

std::vector<double> cpu_seconds_of(const std::vector<Cost>& costs) {
  std::vector<double> seconds;
  seconds.reserve(costs.size());
  for (const Cost& cost : costs) seconds.push_back(cost.cpu_seconds);
  return seconds;
}

/// What the threads of a run share.
class Packer {
 public:
  Packer(RunningSweep& running, const PackOptions& options, const std::vector<Cost>& costs)
      : running_(running),
        options_(options),
        kernels_(kernels_for(options.isa)),
        display_(cpu_seconds_of(costs), options.style, stderr, running.done),
        build_(build_name()),
        costs_(costs),
        before_(costs.size()) {}

  Packed pack() {
    run_tasks(
        costs_, options_.limits,
        [this](std::size_t task, ThreadTeam& team, const KeepGoing& keep_going) {
          return make_one(task, team, keep_going);
        },
        events());
    display_.clear();
    return packed_;
  }

 private:
  /// What a packing took in earlier runs.
  struct Before {
    std::int64_t step = 0;
    double cpu_seconds = 0.0;
    bool was_packed = false;  ///< its bed was known: it was measured again
  };

  CheckpointFiles checkpoints_of(const Job& job) const { return {running_.folder, job.id, build_}; }

  /// Measures its bed if that is known; otherwise goes on from the packing's checkpoint, if it has
  /// one.
  Packing make_one(std::size_t task, ThreadTeam& team, const KeepGoing& keep_going) {
    const Job& job = *running_.pending[task];
    if (auto measured = measured_from(running_.beds, running_.folder, job, kernels_)) {
      before_[task] = {0, running_.beds.at(job.id)->cpu_seconds, true};
      return std::move(*measured);
    }
    CheckpointFiles files = checkpoints_of(job);
    const std::optional<Checkpoint> saved = newest_of(files);
    if (saved) before_[task] = {saved->step, saved->cpu_seconds, false};
    double due_at = wall_seconds() + options_.checkpoint_seconds;
    const KeepGoing saving = [&](const Progress& progress) {
      const bool goes_on = keep_going(progress);
      if (goes_on && wall_seconds() < due_at) return true;
      save(files, progress, before_[task].cpu_seconds + team.cpu_seconds());
      due_at = wall_seconds() + options_.checkpoint_seconds;
      return goes_on;
    };
    return make_packing(job.spec, {kernels_, team.loop(), &workspaces_.local()}, saving,
                        saved ? saved->state : std::string_view());
  }

  /// A packing is worth more than its checkpoint: where none can be read it begins anew.
  std::optional<Checkpoint> newest_of(CheckpointFiles& files) {
    try {
      return files.newest();
    } catch (const FileError& error) {
      display_.say(std::string("warning: ") + error.what() + "; the packing begins anew");
      return std::nullopt;
    }
  }

  /// Where none can be made or written the packing goes on without.
  void save(CheckpointFiles& files, const Progress& progress, double cpu_seconds) {
    try {
      files.write({progress.step, cpu_seconds, progress.save()});
    } catch (const FileError& error) {
      warn_of_no_checkpoint(error.what());
    } catch (const std::bad_alloc&) {
      warn_of_no_checkpoint("there is no memory for a checkpoint");
    }
  }

  void warn_of_no_checkpoint(const std::string& why) {
    if (warned_.exchange(true)) return;
    display_.say("warning: " + why + "; packings under way begin anew if this run is stopped");
  }

  TaskEvents events() {
    TaskEvents events;
    events.started = [this](std::size_t /*task*/) { display_.start(); };
    events.progressed = [this](std::size_t task, const Progress& progress) {
      beat();
      display_.advance(task, progress.share_done);
    };
    events.finished = [this](Finished&& finished) { keep(std::move(finished)); };
    events.stop_asked = [this] {
      return stop_signal() != 0 || has_failed_ || options_.time_limit.is_over();
    };
    events.may_start = [this](std::size_t task) {
      return has_time_for(task) && is_left_to_me(task);
    };
    return events;
  }

  bool has_time_for(std::size_t task) {
    const std::scoped_lock lock(learning_);
    return options_.time_limit.may_begin(running_.estimates.of(costs_[task].cpu_seconds));
  }

  /// Asked by one thread at a time.
  bool is_left_to_me(std::size_t task) {
    if (!running_.claims || running_.claims->may_begin(running_.pending[task]->id)) {
      return true;
    }
    ++packed_.left_to_others;
    return false;
  }

  void beat() {
    double due = beat_due_;
    const double now = wall_seconds();
    if (now < due || !beat_due_.compare_exchange_strong(due, now + heartbeat_seconds)) return;
    running_.files.beat();
  }

  void keep(Finished&& finished) {
    const std::size_t task = finished.task;
    const Job& job = *running_.pending[task];
    finished.cpu_seconds += before_[task].cpu_seconds;
    const bool lacked_memory = finished.lacked_memory;
    const Outcome outcome = store(job, running_.files, std::move(finished), options_.no_grains);
    if (!outcome.exception && !running_.beds.contains(job.id)) {
      const std::scoped_lock lock(learning_);
      running_.estimates.add(costs_[task].cpu_seconds, outcome.cpu_seconds);
    }
    if (!lacked_memory) remove_checkpoints(job);  // with more memory it goes on from there
    ++packed_.packings;
    const std::string line =
        packing_line(options_.names.set_of(facts_of(job)), job.replicate, outcome) +
        (before_[task].was_packed ? ", measured again" : went_on_text(before_[task].step));
    display_.finish(task, outcome.result.status == PackingStatus::settled, line);
    if (!options_.fail_fast || outcome.result.status != PackingStatus::failed) return;
    if (!has_failed_.exchange(true)) packed_.first_failure = line;
  }

  void remove_checkpoints(const Job& job) {
    for (const std::string& line : checkpoints_of(job).remove()) {
      display_.say("warning: " + line);
    }
  }

  RunningSweep& running_;
  const PackOptions& options_;
  const Kernels& kernels_;
  ProgressDisplay display_;
  const std::string build_;
  const std::vector<Cost>& costs_;
  std::vector<Before> before_;  ///< by task
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  Packed packed_;
  std::atomic<double> beat_due_{0.0};  ///< wall time
  std::atomic<bool> warned_{false};
  std::atomic<bool> has_failed_{false};
  std::mutex learning_;  ///< while estimates learn or are asked
};

}  // namespace

Packed pack_pending(RunningSweep& running, const PackOptions& options) {
  const std::vector<Cost> costs = costs_with(running.beds, running.pending);
  return Packer(running, options, costs).pack();
}

}  // namespace grainsweep
