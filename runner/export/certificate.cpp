#include "runner/export/certificate.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/dynamics/rest.hpp"
#include "runner/exit_codes.hpp"
#include "runner/export/contacts.hpp"
#include "runner/hash.hpp"

namespace grainsweep {
namespace {

using Json = nlohmann::ordered_json;

Json box_json(const Box& box) {
  if (box.is_tube) return {{"tube", box.length}};
  const auto name = [](Boundary boundary) {
    return boundary == Boundary::periodic ? "periodic" : "walls";
  };
  return {{"length", box.length}, {"width", box.width}, {"x", name(box.x)}, {"y", name(box.y)}};
}

/// The contacts that push, as the engine names them.
std::vector<ForceContact> force_contacts(const SphereBed& bed,
                                         const std::vector<Contact>& contacts) {
  std::vector<ForceContact> pushing;
  for (const Contact& c : contacts) {
    const std::int32_t b = c.is_wall ? bed.wall_name(c.b) : static_cast<std::int32_t>(c.b);
    pushing.push_back({static_cast<std::int32_t>(c.a), b, c.force});
  }
  return pushing;
}

/// Largest net force on a sphere, m g.
double imbalance_of(const StoredBed& bed, const std::vector<Contact>& contacts) {
  std::vector<Vector> net;
  for (const SettledGrain& grain : bed.grains) {
    net.emplace_back(0.0, 0.0, -8.0 * grain.radius * grain.radius * grain.radius);
  }
  for (const Contact& c : contacts) {
    net[c.a] -= c.force * c.place.normal;
    if (!c.is_wall) net[c.b] += c.force * c.place.normal;
  }
  double largest = 0.0;
  for (const Vector& force : net) largest = std::max(largest, force.norm());
  return largest;
}

Json found_json(const StoredBed& bed, const std::vector<Contact>& all,
                const std::vector<Contact>& pushing, std::size_t free_motions) {
  double overlap = 0.0, least = std::numeric_limits<double>::infinity();
  for (const Contact& c : all) overlap = std::max(overlap, -c.gap);
  for (const Contact& c : pushing) least = std::min(least, c.force);
  return {{"overlap_max", overlap},
          {"imbalance_max", imbalance_of(bed, pushing)},
          {"least_force", pushing.empty() ? 0.0 : least},
          {"contacts", pushing.size()},
          {"degrees_of_freedom", 3 * bed.grains.size() - free_motions}};
}

/// Of clusters in a tube.
Json turns_json(const SphereBed& bed, const std::vector<ForceContact>& pushing) {
  Json list = Json::array();
  for (const std::vector<std::int32_t>& spheres : clusters_that_turn(bed, pushing)) {
    list.push_back({{"turn", "axis"}, {"spheres", spheres}});
  }
  return list;
}

Json motions_json(const std::vector<FreeMotion>& motions) {
  Json list = Json::array();
  for (const FreeMotion& motion : motions) {
    const Vector& direction = motion.direction;
    list.push_back(
        {{"direction", {direction.x(), direction.y(), direction.z()}}, {"spheres", motion.grains}});
  }
  return list;
}

/// A member and its value; for a list, each entry on its line.
std::string member_text(const std::string& name, const Json& value) {
  std::string text = Json(name).dump() + ": ";
  if (!value.is_array()) return text + value.dump();
  std::string entries;
  for (const Json& entry : value) {
    entries += entries.empty() ? "\n" : ",\n";
    entries += entry.dump();
  }
  return text + '[' + entries + ']';
}

}  // namespace

std::string fault_for_certificate(const StoredBed& bed) {
  return bed.turned ? "only forces of spheres can be unique" : "";
}

std::string certificate_json(const ExportedBed& exported) {
  const StoredBed& stored = exported.bed;
  const std::string fault = fault_for_certificate(stored);
  if (!fault.empty()) throw BadInput("packing " + stored.job + ": " + fault);
  const std::vector<Contact> all = contacts_of(exported);
  std::vector<Contact> pushing = all;
  std::erase_if(pushing, [](const Contact& c) { return c.force == 0.0; });
  std::vector<PlacedSphere> placed;
  Json spheres = Json::array(), forces = Json::array(), wall_forces = Json::array();
  for (const SettledGrain& g : stored.grains) {
    placed.push_back({g.x, g.y, g.z, g.radius});
    spheres.push_back({g.x, g.y, g.z, g.radius});
  }
  for (const Contact& c : pushing) {
    if (c.is_wall) {
      wall_forces.push_back({c.a, wall_name(stored.box, c.b), c.force});
    } else {
      forces.push_back({c.a, c.b, c.force});
    }
  }
  const SphereBed bed = make_bed(stored.box, placed);
  const std::vector<ForceContact> named = force_contacts(bed, pushing);
  Json motions = motions_json(free_motions(bed, named));
  for (const Json& turn : turns_json(bed, named)) motions.push_back(turn);
  const Json units = {{"length", "d"}, {"force", "m g"}, {"mass", "m, of a sphere of diameter d"}};
  const Json certificate = {{"job", stored.job},
                            {"state_hash", hex16(stored.state_hash)},
                            {"units", units},
                            {"box", box_json(stored.box)},
                            {"found", found_json(stored, all, pushing, motions.size())},
                            {"free_motions", motions},
                            {"spheres", spheres},
                            {"forces", forces},
                            {"wall_forces", wall_forces}};
  std::string members;
  for (const auto& [name, value] : certificate.items()) {
    members += members.empty() ? "{" : ",\n";
    members += member_text(name, value);
  }
  return members + "}\n";
}

}  // namespace grainsweep
