#include "runner/store/states.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "runner/store/archive.hpp"
#include "runner/store/files.hpp"
#include "runner/store/shard.hpp"

namespace grainsweep {

constexpr auto members_of(const Box* /*type*/) {
  return std::tuple(&Box::length, &Box::width, &Box::x, &Box::y, &Box::is_tube);
}
constexpr auto members_of(const ProfileBin* /*type*/) {
  return std::tuple(&ProfileBin::large, &ProfileBin::small, &ProfileBin::large_grains,
                    &ProfileBin::small_grains, &ProfileBin::neighbours, &ProfileBin::walls);
}
constexpr auto members_of(const Profile* /*type*/) {
  return std::tuple(&Profile::bin_width, &Profile::bins);
}
constexpr auto members_of(const Curve* /*type*/) {
  return std::tuple(&Curve::bin_width, &Curve::values);
}
constexpr auto members_of(const SizeRow* /*type*/) {
  return std::tuple(&SizeRow::diameter, &SizeRow::asked, &SizeRow::packed, &SizeRow::slab);
}
constexpr auto members_of(const ComponentBin* /*type*/) {
  return std::tuple(&ComponentBin::solid_fraction, &ComponentBin::grains, &ComponentBin::neighbours,
                    &ComponentBin::walls, &ComponentBin::nematic);
}
constexpr auto members_of(const ComponentProfile* /*type*/) {
  return std::tuple(&ComponentProfile::bin_width, &ComponentProfile::bins);
}
constexpr auto members_of(const ComponentMeasure* /*type*/) {
  using Measure = ComponentMeasure;
  return std::tuple(&Measure::grains, &Measure::slab_grains, &Measure::packed, &Measure::slab_share,
                    &Measure::solid_fraction, &Measure::coordination,
                    &Measure::coordination_with_walls, &Measure::neighbours, &Measure::nematic,
                    &Measure::contacts, &Measure::profile_x, &Measure::profile_y,
                    &Measure::profile_from_walls, &Measure::profile_z);
}
constexpr auto members_of(const Curves* /*type*/) {
  return std::tuple(&Curves::profile_x, &Curves::profile_y, &Curves::profile_from_walls,
                    &Curves::profile_z, &Curves::pair_correlation, &Curves::force_density,
                    &Curves::sizes, &Curves::components);
}
constexpr auto members_of(const SettledGrain* /*type*/) {
  using Grain = SettledGrain;
  return std::tuple(&Grain::x, &Grain::y, &Grain::z, &Grain::radius, &Grain::force,
                    &Grain::touching);
}
constexpr auto members_of(const Mesh* /*type*/) {
  return std::tuple(&Mesh::vertices, &Mesh::faces);
}
constexpr auto members_of(const Turned* /*type*/) {
  return std::tuple(&Turned::meshes, &Turned::components, &Turned::orientations);
}
/// Its height follows from the grains.
constexpr auto members_of(const PairForce* /*type*/) {
  return std::tuple(&PairForce::a, &PairForce::b, &PairForce::magnitude);
}
constexpr auto members_of(const WallForce* /*type*/) {
  return std::tuple(&WallForce::grain, &WallForce::wall, &WallForce::magnitude);
}
constexpr auto members_of(const ForceLine* /*type*/) {
  return std::tuple(&ForceLine::normal, &ForceLine::lever, &ForceLine::constraints);
}
constexpr auto members_of(const StoredBed* /*type*/) {
  using Bed = StoredBed;
  return std::tuple(&Bed::job, &Bed::state_hash, &Bed::box, &Bed::curves, &Bed::grains,
                    &Bed::turned, &Bed::forces, &Bed::wall_forces, &Bed::lines, &Bed::wall_lines,
                    &Bed::axes);
}

namespace {

constexpr std::string_view bed_mark = "GRAINS14\n";

/// Throws BedError: the bed is not what was stored.
[[noreturn]] void refuse(const std::string& folder, const Outcome& outcome,
                         const std::string& why) {
  throw BedError({beds_path(folder, outcome.shard), outcome.job, why});
}

/// "packing a1", "packings a1, a2", "20 packings, a1, a2 and others".
std::string names_of(const std::vector<const BedFault*>& faults) {
  constexpr std::size_t most_named = 3;
  const bool are_many = faults.size() > most_named;
  std::string names;
  for (std::size_t k = 0; k < (are_many ? 2 : faults.size()); ++k) {
    names += (k == 0 ? "" : ", ") + faults[k]->packing;
  }
  if (are_many) return std::to_string(faults.size()) + " packings, " + names + " and others";
  return (faults.size() == 1 ? "packing " : "packings ") + names;
}

}  // namespace

BedError::BedError(BedFault fault)
    : FileError(fault.file, "packing " + fault.packing + ": " + fault.what),
      fault_(std::move(fault)) {}

BedFault fault_of_bed(const std::string& packing, const FileError& error) {
  const auto* const of_bed = dynamic_cast<const BedError*>(&error);
  return of_bed != nullptr ? of_bed->fault() : BedFault{"", packing, error.what()};
}

std::vector<std::string> lines_of(const std::vector<BedFault>& faults, std::string_view remedy) {
  std::vector<std::vector<const BedFault*>> alike;  // as they come first
  for (const BedFault& fault : faults) {
    const auto known = std::find_if(alike.begin(), alike.end(), [&](const auto& others) {
      return std::tie(others[0]->file, others[0]->what) == std::tie(fault.file, fault.what);
    });
    (known == alike.end() ? alike.emplace_back() : *known).push_back(&fault);
  }
  std::vector<std::string> lines;
  lines.reserve(alike.size());
  for (const std::vector<const BedFault*>& some : alike) {
    const std::string& file = some[0]->file;
    lines.push_back((file.empty() ? "" : file + ": ") + names_of(some) + ": " + some[0]->what +
                    "; " + std::string(remedy));
  }
  return lines;
}

Packing packing_of(StoredBed&& bed, const PackingResult& result) {
  Packing packing;
  packing.result = result;
  static_cast<Curves&>(packing.result) = std::move(bed.curves);
  static_cast<SettledBed&>(packing) = static_cast<SettledBed&&>(bed);
  const auto height_of = [&](std::int32_t grain) {
    return packing.grains[static_cast<std::size_t>(grain)].z;
  };
  for (PairForce& force : packing.forces) {
    force.height = (height_of(force.a) + height_of(force.b)) / 2.0;
  }
  return packing;
}

std::string bed_bytes(const StoredBed& bed) { return file_bytes(bed_mark, bed); }

std::optional<StoredBed> bed_from_bytes(std::string_view bytes) {
  return value_in_file<StoredBed>(bed_mark, bytes);
}

void expect_bed(const std::string& folder, const Outcome& outcome,
                const std::optional<std::int64_t>& file_size) {
  if (!file_size) refuse(folder, outcome, "missing");
  if (*file_size < outcome.stored_at + outcome.stored_bytes) refuse(folder, outcome, "cut off");
}

StoredBed read_bed(const std::string& folder, const Outcome& outcome) {
  expect_bed(folder, outcome, file_size(beds_path(folder, outcome.shard)));
  auto bed = bed_from_bytes(read_part(beds_path(folder, outcome.shard), outcome.stored_at,
                                      static_cast<std::size_t>(outcome.stored_bytes)));
  if (!bed) refuse(folder, outcome, "damaged, or of another version");
  if (bed->job != outcome.job || bed->state_hash != outcome.result.state_hash) {
    refuse(folder, outcome, "the bed of another packing");
  }
  return std::move(*bed);
}

}  // namespace grainsweep
