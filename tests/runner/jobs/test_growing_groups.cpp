#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/jobs/growing_groups.hpp"
#include "runner/jobs/replicate_means.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

/// A group of spheres between walls, settled as `balanced`, that may have so many packings.
std::vector<Job> growing_group(const std::string& name, double width, int most, ErrorWish wish) {
  std::vector<Job> jobs;
  for (int replicate = 1; replicate <= most; ++replicate) {
    Job job;
    job.id = name + std::to_string(replicate);
    job.label = "MSP";
    job.parameters = sample_parameters(width, Boundary::walls, 0.0);
    job.replicate = replicate;
    job.spec.accuracy = *preset("balanced");
    job.spec.sizes.small_share = 0.0;
    job.wish = wish;
    jobs.push_back(job);
  }
  return jobs;
}

std::vector<const Outcome*> pointers(const std::vector<Outcome>& outcomes, std::size_t most) {
  std::vector<const Outcome*> made(most, nullptr);
  for (std::size_t i = 0; i < std::min(most, outcomes.size()); ++i) made[i] = &outcomes[i];
  return made;
}

TEST_CASE("a group has six packings before its scatter counts, and none more if they are alike") {
  std::vector<Outcome> alike(6, sample_outcome("a", 0.6, 5.5));
  const ErrorWish wish{0.001, 0.01};
  CHECK(replicates_called_for(pointers({}, 50), wish, {}) == 6);
  CHECK(replicates_called_for(pointers({alike.begin(), alike.begin() + 5}, 50), wish, {}) == 6);
  CHECK(replicates_called_for(pointers(alike, 50), wish, {}) == 6);
  CHECK(replicates_called_for(pointers(alike, 4), wish, {}) == 4);
}

TEST_CASE("a group grows to at most twice its size at once, and never beyond the most") {
  std::vector<Outcome> made;
  for (int i = 0; i < 24; ++i) made.push_back(sample_outcome("a", i % 2 == 0 ? 0.5 : 0.7, 5.5));
  const ErrorWish wish{0.001, 0.0};
  CHECK(replicates_called_for(pointers({made.begin(), made.begin() + 6}, 50), wish, {}) == 12);
  CHECK(replicates_called_for(pointers({made.begin(), made.begin() + 12}, 50), wish, {}) == 24);
  CHECK(replicates_called_for(pointers({made.begin(), made.begin() + 12}, 15), wish, {}) == 15);
  CHECK(replicates_called_for(pointers(made, 24), wish, {}) == 24);
}

TEST_CASE("packings that did not settle count as made, but not in the means") {
  std::vector<Outcome> made(6, sample_outcome("a", 0.6, 5.5));
  for (Outcome& outcome : made) outcome.result.status = PackingStatus::not_settled;
  CHECK(replicates_called_for(pointers(made, 50), {0.001, 0.0}, {}) == 12);
  made[0].result.status = made[1].result.status = PackingStatus::settled;
  CHECK(replicates_called_for(pointers(made, 50), {0.001, 0.0}, {}) == 6);
}

TEST_CASE("the bias of settling leaves less of a wish for the scatter") {
  std::vector<Outcome> made;
  for (int i = 0; i < 6; ++i) made.push_back(sample_outcome("a", 0.6 + 0.001 * i, 5.5));
  const double half = half_interval(0.001 * std::sqrt(3.5), 6);
  CHECK(replicates_called_for(pointers(made, 50), {half * 1.01, 0.0}, {}) == 6);
  CHECK(replicates_called_for(pointers(made, 50), {half * 1.01, 0.0}, ProtocolBias{half / 2, 0}) >
        6);
}

TEST_CASE("wishes are met in 93 % of groups, by at most half more packings than they take") {
  constexpr int repetitions = 200;
  std::mt19937_64 random(20221122);
  for (int scene = 0; scene < 20; ++scene) {
    const double ideal = 10.0 + 5.0 * scene;  // packings, were the scatter known
    const double mean = 0.55 + 0.005 * scene, sd = 0.002 + 0.0005 * scene;
    const ErrorWish wish{1.96 * sd / std::sqrt(ideal), 0.0};
    std::normal_distribution<double> value(mean, sd);
    int met = 0, packings = 0;
    for (int k = 0; k < repetitions; ++k) {
      std::vector<Outcome> made;
      int called = first_replicates;
      while (static_cast<int>(made.size()) < called) {
        made.resize(static_cast<std::size_t>(called), sample_outcome("a", 0.0, 5.5));
        for (Outcome& outcome : made) {
          if (outcome.result.solid_fraction == 0.0) outcome.result.solid_fraction = value(random);
        }
        called = replicates_called_for(pointers(made, 1000), wish, {});
      }
      double sum = 0.0;
      for (const Outcome& outcome : made) sum += outcome.result.solid_fraction;
      met += std::abs(sum / called - mean) <= wish.solid_fraction ? 1 : 0;
      packings += called;
    }
    INFO("ideal " << ideal << ", met " << met << ", packings " << packings / repetitions);
    // 95 % are meant; of 200 that is 190 with a standard deviation of 3, three of them are allowed.
    CHECK(met >= 181);
    CHECK(packings <= 1.5 * ideal * repetitions);
  }
}

TEST_CASE("a sweep has the packings that its groups call for, and all of groups that do not grow") {
  Sweep whole{"s", 7, 1, growing_group("a", 5.0, 20, {0.0034, 0.0})};
  for (const Job& job : growing_group("b", 6.0, 3, {})) whole.jobs.push_back(job);
  CHECK(grows(whole));
  GrowingSweep growing(whole, {});
  CHECK(growing.now().jobs.size() == 9);
  CHECK_FALSE(growing.grow({}));
  Outcomes outcomes;
  for (int i = 1; i <= 6; ++i) {
    const std::string id = "a" + std::to_string(i);
    outcomes[id] = sample_outcome(id, i % 2 == 0 ? 0.5 : 0.7, 5.5);
  }
  CHECK(growing.grow(outcomes));
  CHECK(growing.now().jobs.size() == 15);
  CHECK(growing.wishes() == wishes_text(whole, outcomes));
  outcomes["a3"]->exception = true;  // is made once more before anything else
  CHECK(GrowingSweep(whole, outcomes).now().jobs.size() == 9);
}

TEST_CASE("a sweep of which no group may grow is called for as it is, without a copy") {
  const Sweep still{"s", 7, 1, growing_group("b", 6.0, 3, {})};
  CHECK_FALSE(grows(still));
  GrowingSweep growing(still, {});
  CHECK(&growing.now() == &still);
  CHECK_FALSE(growing.grow({}));
  CHECK(growing.wishes().empty());
}

TEST_CASE("a growing group belongs to one shard") {
  Sweep whole{"s", 7, 1, {}};
  for (int group = 0; group < 8; ++group) {
    const auto jobs = growing_group("g" + std::to_string(group), 4.0 + group, 10, {0.01, 0.0});
    whole.jobs.insert(whole.jobs.end(), jobs.begin(), jobs.end());
  }
  const std::vector<int> shard_of = shards_of(whole, 3);
  REQUIRE(shard_of.size() == whole.jobs.size());
  for (std::size_t i = 0; i < shard_of.size(); ++i) CHECK(shard_of[i] == shard_of[i / 10 * 10]);
  CHECK(std::set<int>(shard_of.begin(), shard_of.end()).size() == 3);
}

/// Three groups between walls and one without, whose fit is to be so precise.
Sweep fit_sweep(int most, const FitWish& wish, const std::string& name = "f") {
  Sweep whole{"s", 7, 1, {}};
  for (const double width : {4.0, 5.0, 8.0, 9.0}) {
    for (Job& job :
         growing_group(name + std::to_string(static_cast<int>(width)) + "-", width, most, {})) {
      job.spec.box.width = width;
      job.spec.box.y = width == 9.0 ? Boundary::periodic : Boundary::walls;
      job.parameters = sample_parameters(width, job.spec.box.y, 0.0);
      job.parameters.insert(1, "\"name\":\"" + name + "\",");
      job.fit_wish = wish;
      whole.jobs.push_back(job);
    }
  }
  return whole;
}

/// All packings of a sweep, which scatter about a line.
Outcomes made_for(const Sweep& sweep) {
  Outcomes outcomes;
  for (const Job& job : sweep.jobs) {
    const double scatter = job.replicate % 2 == 0 ? 0.003 : -0.003;
    outcomes[job.id] =
        sample_outcome(job.id, 0.64 - 0.15 / job.spec.box.width + scatter, 5.5 + scatter);
  }
  return outcomes;
}

TEST_CASE("a family grows where its fit gains most; without walls a group stays at six") {
  const Sweep whole = fit_sweep(100, {0.005, 0, 0, 0});
  REQUIRE(grows(whole));
  GrowingSweep growing(whole, {});
  CHECK(growing.now().jobs.size() == 24);
  while (growing.grow(made_for(growing.now()))) {
  }
  std::map<double, int> count;
  for (const Job& job : growing.now().jobs) ++count[job.spec.box.width];
  CHECK(count.at(4) > 6);
  CHECK(count.at(5) == 6);
  CHECK(count.at(8) > count.at(4));
  CHECK(count.at(9) == 6);
  CHECK(growing.wishes() == "Errors as asked for (95 %) in 1 of 1 fit, by " +
                                std::to_string(growing.now().jobs.size()) + " packings\n");
}

TEST_CASE("a fit whose line does not hold is told apart, and grows no more") {
  const Sweep whole = fit_sweep(100, {0.05, 0, 0, 0});
  Outcomes outcomes = made_for(GrowingSweep(whole, {}).now());
  for (int i = 1; i <= 6; ++i) {
    outcomes.at("f5-" + std::to_string(i))->result.solid_fraction += 0.02;
  }
  CHECK(GrowingSweep(whole, outcomes).now().jobs.size() == 24);
  CHECK(
      wishes_text(whole, outcomes) ==
      "Errors as asked for (95 %) in 0 of 1 fit, by 24 packings; in 1 more the packings scatter as "
      "little, but the straight line does not hold: its errors in fits.csv are wider, and no "
      "packings mend it\n");
}

TEST_CASE("a fit waits for all of its round, whatever else is made") {
  const Sweep whole = fit_sweep(100, {0.005, 0, 0, 0});
  Outcomes outcomes = made_for(whole);
  outcomes.erase("f5-6");
  CHECK(GrowingSweep(whole, outcomes).now().jobs.size() == 24);
  outcomes = made_for(GrowingSweep(whole, {}).now());
  const std::size_t second = GrowingSweep(whole, outcomes).now().jobs.size();
  CHECK(second > 24);
  outcomes["f8-7"] =
      sample_outcome("f8-7", 0.9, 9.0);  // one of the next round alone changes nothing
  CHECK(GrowingSweep(whole, outcomes).now().jobs.size() == second);
}

TEST_CASE("a family whose fit grows belongs to one shard") {
  Sweep whole{"s", 7, 1, {}};
  for (const char* const name : {"a", "b", "c"}) {
    const Sweep one = fit_sweep(10, {0.005, 0, 0, 0}, name);
    whole.jobs.insert(whole.jobs.end(), one.jobs.begin(), one.jobs.end());
  }
  const std::vector<int> shard_of = shards_of(whole, 3);
  REQUIRE(shard_of.size() == 120);
  for (std::size_t i = 0; i < shard_of.size(); ++i) CHECK(shard_of[i] == shard_of[i / 40 * 40]);
  CHECK(std::set<int>(shard_of.begin(), shard_of.end()).size() == 3);
}

TEST_CASE(
    "fits that cannot be had are refused: too few widths, too fine, or beside wishes of means") {
  CHECK(unreachable_wishes(fit_sweep(10, {0.005, 0, 0, 0})).empty());
  const std::string fine = unreachable_wishes(fit_sweep(10, {0.001, 1e-6, 0.5, 0}));
  CHECK(fine.find("asks for phi_bulk within 0.001, but settled as \"balanced\"") !=
        std::string::npos);
  CHECK(fine.find("Z_bulk") == std::string::npos);
  Sweep narrow = fit_sweep(10, {0.005, 0, 0, 0});
  narrow.jobs.erase(narrow.jobs.begin(), narrow.jobs.begin() + 10);
  CHECK(unreachable_wishes(narrow).find("takes 3 or more widths between walls with otherwise equal "
                                        "parameters, and there are 2;") != std::string::npos);
  Sweep both = fit_sweep(10, {0.005, 0, 0, 0});
  for (int i = 0; i < 10; ++i) {
    both.jobs[static_cast<std::size_t>(i)].fit_wish = {};
    both.jobs[static_cast<std::size_t>(i)].wish = {0.01, 0.0};
  }
  CHECK(unreachable_wishes(both).find("of the same family, for errors of means") !=
        std::string::npos);
}

TEST_CASE("wishes below the bias of settling are refused, with what it is") {
  const Sweep whole{"s", 7, 1, growing_group("a", 5.0, 20, {0.001, 0.5})};
  const std::string said = unreachable_wishes(whole);
  CHECK(said.find("asks for solid_fraction within 0.001") != std::string::npos);
  CHECK(said.find("\"balanced\"") != std::string::npos);
  CHECK(said.find("coordination") == std::string::npos);
  CHECK(unreachable_wishes({"s", 7, 1, growing_group("a", 5.0, 20, {0.01, 0.0})}).empty());
}

TEST_CASE("the end of a run says which wishes were met") {
  const Sweep whole{"s", 7, 1, growing_group("a", 5.0, 8, {0.01, 0.0})};
  Outcomes outcomes;
  for (int i = 1; i <= 8; ++i) {
    const std::string id = "a" + std::to_string(i);
    outcomes[id] = sample_outcome(id, 0.6, 5.5);
  }
  CHECK(wishes_text(whole, outcomes) ==
        "Errors as asked for (95 %) in 1 of 1 group, by 6 packings\n");
  for (int i = 1; i <= 8; i += 2) {
    outcomes["a" + std::to_string(i)]->result.solid_fraction = 0.7;
  }
  CHECK(wishes_text(whole, outcomes) ==
        "Errors as asked for (95 %) in 0 of 1 group, by 8 packings; raise replicates.most for the "
        "others\nLarger: MSP, W = 10\n");
}

}  // namespace
}  // namespace grainsweep
