// Damaged journals and checkpoints: noticed, never used.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/packing.hpp"
#include "kernels/isa.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/outcome_text.hpp"
#include "runner/store/shard.hpp"
#include "runner/store/states.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

/// How many damages of each kind to try.
std::size_t tries() {
  const char* const faults = std::getenv("GRAINSWEEP_FAULTS");
  return faults != nullptr && std::string_view(faults) == "full" ? 10'000 : 1'000;
}

/// Without a flush, which only a crash would need.
void write_quickly(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The byte to damage in try `number`: over all tries every one of a small file, and places spread
/// over a large one.
std::size_t place_in(const std::string& bytes, std::size_t number) {
  return bytes.size() < tries() ? number % bytes.size() : number * bytes.size() / tries();
}

/// `bytes` with a bit of one byte flipped, in the next round over a small file another bit.
std::string flipped(std::string bytes, std::size_t number) {
  const std::size_t at = place_in(bytes, number);
  bytes[at] = static_cast<char>(bytes[at] ^ (1 << (number / bytes.size() + number) % 8));
  return bytes;
}

/// The first bytes of a file.
std::string cut(const std::string& bytes, std::size_t number) {
  return bytes.substr(0, place_in(bytes, number));
}

/// A bed of grains that are turned, as a packing of shapes leaves it.
std::string sample_state() {
  StoredBed bed;
  bed.grains.assign(2, {0.5, 1.5, 2.5, 0.5, 2.75, 6});
  bed.curves = sample_curves();
  bed.turned = sample_turned();
  return bed_bytes(bed);
}

/// How many of the damages are refused.
template <class Damage>
std::size_t refused_states(Damage damaged) {
  const std::string bytes = sample_state();
  std::size_t refused = 0;
  for (std::size_t number = 0; number < tries(); ++number) {
    refused += bed_from_bytes(damaged(bytes, number)) ? 0 : 1;
  }
  return refused;
}

TEST_CASE("grains, orientations and mesh of a bed are refused with any bit changed") {
  CHECK(refused_states(flipped) == tries());
}

TEST_CASE("grains, orientations and mesh of a bed are refused cut at any byte") {
  CHECK(refused_states(cut) == tries());
}

/// A journal of three packings, and what reading it must give at most.
struct SampleJournal {
  std::map<std::string, Outcome> outcomes;
  std::string text;

  SampleJournal() {
    for (const char* job : {"a", "b", "c"}) {
      outcomes[job] = sample_outcome(job, 0.6, 6.0);
      if (job[0] == 'b') outcomes[job].result.shape_order = ShapeOrder{{0.5, 0.25, 0.25}, {}, {}};
      text += journal_line(outcomes[job]);
    }
  }
};

/// Whether everything read is what was written.
bool is_as_written(const SampleJournal& journal, const JournalReading& reading) {
  return std::all_of(reading.outcomes.begin(), reading.outcomes.end(), [&](const auto& entry) {
    const auto known = journal.outcomes.find(entry.first);
    return known != journal.outcomes.end() &&
           outcome_text(known->second) == outcome_text(*entry.second);
  });
}

TEST_CASE("a journal with any bit changed never gives a packing that was not made") {
  const TemporaryFolder folder;
  make_folder(shards_folder(folder.path()));
  const std::string path = journal_path(folder.path(), "1-of-1");
  const SampleJournal journal;
  std::size_t sound = 0;
  for (std::size_t number = 0; number < tries(); ++number) {
    write_quickly(path, flipped(journal.text, number));
    const JournalReading reading = read_journals(folder.path());
    const bool is_noticed = !reading.damage.empty() && reading.outcomes.size() < 3;
    sound += is_noticed && is_as_written(journal, reading) ? 1 : 0;
  }
  CHECK(sound == tries());
}

TEST_CASE("a journal cut at any byte gives the packings before the cut") {
  const TemporaryFolder folder;
  make_folder(shards_folder(folder.path()));
  const std::string path = journal_path(folder.path(), "1-of-1");
  const SampleJournal journal;
  std::size_t sound = 0;
  for (std::size_t number = 0; number < tries(); ++number) {
    const std::string text = cut(journal.text, number);
    write_quickly(path, text);
    const JournalReading reading = read_journals(folder.path());
    // A last line that lacks nothing but its line feed is whole.
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) +
                       (text.ends_with("}}") && journal.text[text.size()] == '\n' ? 1 : 0);
    sound += reading.outcomes.size() == lines && is_as_written(journal, reading) ? 1 : 0;
  }
  CHECK(sound == tries());
}

/// A bed of 24 grains, stopped after thirty steps.
std::string saved_packing() {
  PackingSpec spec;
  spec.box = {3.0, 3.0, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{24};
  std::string bytes;
  make_packing(spec, kernels_for(best_isa()), [&](const Progress& progress) {
    if (progress.step == 30) bytes = progress.save();
    return progress.step < 30;
  });
  return bytes;
}

/// Damages one of two checkpoints by `damaged`; the other one, and only it, must be used.
template <class Damage>
std::size_t uses_of_the_other(Damage damaged) {
  const TemporaryFolder folder;
  const std::string state = saved_packing();
  REQUIRE(state.size() > 1000);
  CheckpointFiles files(folder.path(), "job", "1.0");
  files.write({29, 0.5, "the one before"});
  files.write({30, 0.75, state});
  const std::string newest = folder.path() + "/checkpoints/job.1", bytes = read_file(newest);
  std::size_t right = 0;
  for (std::size_t number = 0; number < tries(); ++number) {
    write_quickly(newest, damaged(bytes, number));
    const auto used = CheckpointFiles(folder.path(), "job", "1.0").newest();
    right += used && used->step == 29 && used->state == "the one before" ? 1 : 0;
  }
  write_quickly(newest, bytes);
  CHECK(CheckpointFiles(folder.path(), "job", "1.0").newest().value().state == state);
  return right;
}

TEST_CASE("of a checkpoint with any bit changed the one before it is used") {
  CHECK(uses_of_the_other(flipped) == tries());
}

TEST_CASE("of a checkpoint cut at any byte the one before it is used") {
  CHECK(uses_of_the_other(cut) == tries());
}

}  // namespace
}  // namespace grainsweep
