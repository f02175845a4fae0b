#include <cmath>
#include <map>
#include <random>
#include <string>

#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "runner/analysis/decay.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

constexpr double bin_width = 0.1;

struct Planted {
  double bulk, amplitude, length, period, phase;
};
constexpr Planted layers{0.62, 0.3, 1.2, 0.9, 0.4};

std::vector<double> profile_of(const Planted& p, double width, double bin = bin_width) {
  std::vector<double> values;
  for (double y = bin / 2; y < width; y += bin) {
    values.push_back(p.bulk + p.amplitude * std::exp(-y / p.length) *
                                  std::cos(2 * pi * y / p.period + p.phase));
  }
  return values;
}

/// Noise as grains make it: a sum over the ten bins around each.
std::vector<double> correlated_noise(std::size_t bins, double sd, std::mt19937_64& generator) {
  std::normal_distribution<double> normal(0.0, sd / std::sqrt(10.0));
  std::vector<double> white(bins + 9), noise(bins, 0.0);
  for (double& value : white) value = normal(generator);
  for (std::size_t k = 0; k < bins; ++k) {
    for (std::size_t j = 0; j < 10; ++j) noise[k] += white[k + j];
  }
  return noise;
}

std::vector<std::vector<double>> noisy_profiles(const Planted& p, std::size_t count, double sd,
                                                std::mt19937_64& generator) {
  std::vector<std::vector<double>> profiles(count, profile_of(p, 5.0));
  for (auto& profile : profiles) {
    const auto noise = correlated_noise(profile.size(), sd, generator);
    for (std::size_t k = 0; k < profile.size(); ++k) profile[k] += noise[k];
  }
  return profiles;
}

// 1e-6: the method stops when a step changes the sum of squares by less than 1e-8 of itself or so.
TEST_CASE("a damped oscillation without noise gives back what was planted") {
  for (const Planted& p : {layers, Planted{0.4, 0.1, 0.5, 0.95, -2.5},
                           Planted{0.7, 0.2, 3.0, 0.85, 3.0}, Planted{0.1, 0.05, 0.6, 0.45, 1.0}}) {
    const DecayFit fit = fit_decay({profile_of(p, 5), profile_of(p, 5)}, bin_width, 5);
    INFO(fit.not_determined);
    REQUIRE(fit.not_determined.empty());
    CHECK(fit.bulk.value == Approx(p.bulk).epsilon(1e-6));
    CHECK(fit.amplitude.value == Approx(p.amplitude).epsilon(1e-6));
    CHECK(fit.length.value == Approx(p.length).epsilon(1e-6));
    CHECK(fit.period.value == Approx(p.period).epsilon(1e-6));
    CHECK(fit.phase.value == Approx(p.phase).epsilon(1e-5));
    CHECK(fit.r_squared == Approx(1.0));
    const double envelope = p.amplitude * std::exp(-fit.reach.value / p.length);
    CHECK(envelope == Approx(0.05 * p.bulk).epsilon(1e-5));
    CHECK(fit.bins == 48);  // centres .25, .35, ... 4.95
  }
}

// Of these widths the first bin's centre lies at 0.25 d, or the middle one's at half the width, but
// for rounding.
TEST_CASE("rounding does not decide whether a bin belongs to the window") {
  struct Case {
    double width;
    int bins, in_window;
  };
  for (const auto& [width, bins, in_window] :
       {Case{6.0, 60, 28}, Case{9.6, 96, 46}, Case{2.4, 24, 10}, Case{4.1, 41, 19},
        Case{3.89, 39, 17}, Case{7.06, 71, 33}}) {
    const double bin = width / bins;
    const auto profile = profile_of(layers, width, bin);
    CHECK(fit_decay({profile, profile}, bin, width / 2).bins == in_window);
  }
}

// Two replicates between two walls are four profiles, three are six. Shares of 1000 sets are known
// to 0.7 %.
TEST_CASE("a planted decay lies within two printed errors as often as it must", "[slow]") {
  std::mt19937_64 generator(17);
  const double sets = 1000,
               reach = layers.length * std::log(layers.amplitude / (0.05 * layers.bulk));
  for (const std::size_t profiles : {4, 6, 12}) {
    std::map<std::string, int> hits;
    const auto judge = [&](const std::string& name, const Estimate& estimate, double truth) {
      hits[name] += std::abs(estimate.value - truth) < 2.0 * estimate.error ? 1 : 0;
    };
    double bias = 0.0, claimed = 0.0;
    for (int set = 0; set < sets; ++set) {
      const DecayFit fit =
          fit_decay(noisy_profiles(layers, profiles, 0.01, generator), bin_width, 5);
      REQUIRE(fit.not_determined.empty());
      judge("lambda", fit.length, layers.length);
      judge("bulk", fit.bulk, layers.bulk);
      judge("amplitude", fit.amplitude, layers.amplitude);
      judge("period", fit.period, layers.period);
      judge("phase", fit.phase, layers.phase);
      judge("reach", fit.reach, reach);
      bias += (fit.length.value - layers.length) / sets;
      claimed += fit.length.error / sets;
    }
    for (const auto& [name, count] : hits) {
      INFO(name << " of " << profiles << " profiles");
      CHECK(count / sets == about(0.95, 0.03));
    }
    CHECK(std::abs(bias) < 0.2 * claimed);
  }
}

// Both curves have the same squares in the window, amplitude^2 length / 4 exp(-0.5 / length), and
// their strengths scatter against each other: chance says which of them fits the mean better.
TEST_CASE("layers of two lengths have none") {
  std::mt19937_64 generator(29);
  std::normal_distribution<double> normal(0.0, 0.2);
  int two_lengths = 0, determined = 0;
  for (int set = 0; set < 20; ++set) {
    auto profiles = noisy_profiles({0.6, 0, 1, 1, 0}, 6, 0.005, generator);
    for (auto& profile : profiles) {
      const double share = normal(generator);
      const auto near = profile_of({0, 0.255 * (1 + share), 0.6, 0.5, 0}, 5);
      const auto far = profile_of({0, 0.1 * (1 - share), 2.4, 0.95, 0}, 5);
      for (std::size_t k = 0; k < profile.size(); ++k) profile[k] += near[k] + far[k];
    }
    const DecayFit fit = fit_decay(profiles, bin_width, 5);
    determined += fit.not_determined.empty() ? 1 : 0;
    two_lengths +=
        fit.not_determined.starts_with("two lengths describe the layers as well: ") ? 1 : 0;
  }
  CHECK(two_lengths >= 12);
  CHECK(determined <= 4);
}

// Noise that ten bins share leaves about ten independent numbers in the window, of which the curve
// takes five: the mean square of misfits lies between a quarter and one.
TEST_CASE("the misfit is below one where the curve is right, far above where it is not") {
  std::mt19937_64 generator(5);
  double squares = 0;
  for (int set = 0; set < 100; ++set) {
    const DecayFit right = fit_decay(noisy_profiles(layers, 6, 0.01, generator), bin_width, 5);
    squares += right.misfit * right.misfit / 100;
    CHECK(right.misfit < largest_misfit);
  }
  CHECK((squares > 0.25 && squares < 1.0));
  auto bent = noisy_profiles(layers, 40, 0.01, generator);
  for (auto& profile : bent) {
    for (std::size_t k = 0; k < profile.size(); ++k) {
      profile[k] += 0.02 * std::sin(0.9 * static_cast<double>(k));
    }
  }
  CHECK(fit_decay(bent, bin_width, 5).misfit > 1.5 * largest_misfit);
}

TEST_CASE("pure noise, a flat profile and a short window determine nothing, and say why") {
  std::mt19937_64 generator(23);
  int determined = 0;
  for (int set = 0; set < 20; ++set) {
    const auto flat = noisy_profiles({0.6, 0, 1, 1, 0}, 6, 0.01, generator);
    const DecayFit fit = fit_decay(flat, bin_width, 5);
    determined += fit.not_determined.empty() ? 1 : 0;
    if (!fit.not_determined.empty()) CHECK(fit.length.value == 0);
  }
  CHECK(determined <= 2);
  CHECK_THAT(fit_decay({{0.6}, {0.6}}, 5, 2.5).not_determined, Catch::Contains("holds 1 bins"));
  CHECK_THAT(fit_decay({{0.6}, {0.6}}, 5, 2.4).not_determined, Catch::Contains("holds 0 bins"));
  const std::vector<double> flat(50, 0.6);
  CHECK(fit_decay({flat, flat}, bin_width, 5).not_determined ==
        "the solid fraction is the same in all bins");
  CHECK(fit_decay({profile_of(layers, 5), profile_of(layers, 5)}, bin_width, 1.0).not_determined ==
        "the window from 0.25 d to 1 d holds 8 bins of 0.1 d, a fit needs 10; make "
        "measure.bin_width smaller or the container wider");
}

// All have the same layers, but so much stronger in one profile than in the other that their mean
// strength, 0.175, has a jackknife error of 0.125; every other number is exact.
TEST_CASE("layers whose strength is uncertain are lost in the noise, however well they fit") {
  Planted strong = layers, weak = layers;
  strong.amplitude = 0.3;
  weak.amplitude = 0.05;
  const DecayFit fit = fit_decay({profile_of(strong, 5), profile_of(weak, 5)}, bin_width, 5);
  CHECK_THAT(fit.not_determined, Catch::Contains("amplitude is 1.4 standard errors"));
  CHECK(fit.length.value == 0);
}

// Waves of one length that differ in phase by delta add up to one of the mean phase, to within
// delta^2; the jackknife error of a mean is sqrt(sum delta^2 / n (n - 1)). Student's t with three
// degrees of freedom widens it by 3.182 / 1.96.
TEST_CASE("the error of a phase near pi knows that pi and -pi are one") {
  std::vector<std::vector<double>> profiles;
  for (const double delta : {-0.06, -0.02, 0.02, 0.06}) {
    Planted planted = layers;
    planted.phase = pi + delta;
    profiles.push_back(profile_of(planted, 5));
  }
  const DecayFit fit = fit_decay(profiles, bin_width, 5);
  REQUIRE(fit.not_determined.empty());
  CHECK(std::abs(std::remainder(fit.phase.value - pi, 2 * pi)) < 0.06 * 0.06);
  CHECK(fit.phase.error == Approx(3.182 / 1.96 * std::sqrt(0.008 / 12)).epsilon(0.01));
}

// In bins of 0.1 d a wave of 0.1125 d takes the same values as one of 0.9 d.
TEST_CASE("a fit that runs away without one of the packings determines nothing, and says so") {
  // Layers that one of the profiles alone has.
  std::vector<std::vector<double>> profiles = {profile_of(layers, 5.0)};
  for (int k = 1; k <= 3; ++k) {
    profiles.emplace_back(profiles.front().size());
    for (std::size_t i = 0; i < profiles.back().size(); ++i) {
      profiles.back()[i] = 0.62 + 0.01 * k * static_cast<double>(i) / 50.0;
    }
  }
  const DecayFit fit = fit_decay(profiles, bin_width, 5.0);
  CHECK(fit.not_determined ==
        "the fit without one of the packings does not converge; add replicates");
}

TEST_CASE("a wave shorter than two bins is never meant") {
  std::mt19937_64 generator(5);
  int determined = 0;
  for (int sweep = 0; sweep < 50; ++sweep) {
    const DecayFit fit = fit_decay(noisy_profiles(layers, 3, 0.01, generator), bin_width, 2.0);
    if (!fit.not_determined.empty()) continue;
    ++determined;
    CHECK(fit.period.value == Approx(layers.period).epsilon(0.1));
  }
  CHECK(determined > 10);
}

TEST_CASE("a decay longer than the window is not determined") {
  std::mt19937_64 generator(29);
  const auto profiles = noisy_profiles({0.6, 0.2, 30, 0.9, 0}, 6, 0.002, generator);
  CHECK_THAT(fit_decay(profiles, bin_width, 5).not_determined,
             Catch::Contains("do not decay within the window of 4.75 d"));
}

TEST_CASE("layers that are weak at the wall reach nowhere") {
  const auto weak = profile_of({0.62, 0.02, 1.2, 0.9, 0.4}, 5);
  const DecayFit fit = fit_decay({weak, weak}, bin_width, 5);
  REQUIRE(fit.not_determined.empty());
  CHECK(fit.amplitude.value < 0.05 * fit.bulk.value);
  CHECK(fit.reach.value == 0.0);
}

TEST_CASE("layers that are strong up to the middle have no reach, but a length") {
  const auto strong = profile_of({0.62, 0.4, 1.8, 0.9, 0.4}, 3);
  const DecayFit fit = fit_decay({strong, strong}, bin_width, 3);
  REQUIRE(fit.not_determined.empty());
  CHECK(fit.length.value == Approx(1.8));
  CHECK(why_no_reach(fit) ==
        "the curve falls to 5 % of the bulk only beyond the middle, 3 d from the wall, where the "
        "fit ends");
  const auto farther = profile_of({0.62, 0.4, 1.8, 0.9, 0.4}, 5);  // 4.6 d
  CHECK(why_no_reach(fit_decay({farther, farther}, bin_width, 5)).empty());
  CHECK_THAT(why_no_reach(fit_decay({strong, strong}, bin_width, 1)), Catch::Contains("bins of"));
}

TEST_CASE("a period longer than the window is not determined") {
  std::mt19937_64 generator(31);
  const auto profiles = noisy_profiles({0.6, 0.2, 2, 3, 0}, 6, 0.0005, generator);
  CHECK_THAT(fit_decay(profiles, bin_width, 2).not_determined, Catch::Contains("no whole period"));
}

}  // namespace
}  // namespace grainsweep
