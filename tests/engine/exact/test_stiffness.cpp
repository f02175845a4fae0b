#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "engine/exact/stiffness.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::testable_isas;

struct Net {
  std::vector<Record<double>> centres;
  std::vector<Spring> springs;
  std::vector<double> ground;
};

Vector drawn_direction(Draw& draw) {
  return Vector(draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0), draw.uniform(0.1, 1.0))
      .normalized();
}

/// Grains at random, each joined to near ones and, if low, to the ground below.
Net drawn_net(std::size_t grains) {
  Draw draw(grains);
  Net net;
  for (std::size_t i = 0; i < grains; ++i) {
    net.centres.push_back(
        {draw.uniform(0.0, 3.0), draw.uniform(0.0, 3.0), draw.uniform(0.0, 12.0), 0.5});
    net.ground.push_back(draw.uniform(0.1, 0.2));
  }
  for (std::size_t a = 0; a < grains; ++a) {
    for (std::size_t b = a + 1; b < grains; ++b) {
      const double dz = net.centres[a].z - net.centres[b].z;
      if (dz * dz > 1.0) continue;
      net.springs.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
                             drawn_direction(draw), draw.uniform(0.1, 10.0),
                             draw.uniform(-0.002, 0.1)});
    }
    if (net.centres[a].z < 1.0) {
      net.springs.push_back({static_cast<std::int32_t>(a), Spring::fixed, drawn_direction(draw),
                             draw.uniform(0.1, 10.0)});
    }
  }
  return net;
}

Eigen::MatrixXd matrix_of(const Net& net) {
  const auto size = static_cast<Eigen::Index>(3 * net.centres.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < net.centres.size(); ++i) {
    matrix.diagonal().segment(static_cast<Eigen::Index>(3 * i), 3).setConstant(net.ground[i]);
  }
  for (const Spring& spring : net.springs) {
    const Eigen::Matrix3d along = spring.along * spring.along.transpose();
    const Eigen::Matrix3d block =
        spring.stiffness * along + spring.across * (Eigen::Matrix3d::Identity() - along);
    const Eigen::Index a = 3 * spring.a, b = 3 * spring.b;
    matrix.block<3, 3>(a, a) += block;
    if (spring.b == Spring::fixed) continue;
    matrix.block<3, 3>(b, b) += block;
    matrix.block<3, 3>(a, b) -= block;
    matrix.block<3, 3>(b, a) -= block;
  }
  return matrix;
}

// Stiffnesses differ by a factor of 1e4 at most: as many roundings.
TEMPLATE_TEST_CASE(
    "factors of springs solve as a dense matrix does, with the same bits on all instruction sets",
    "", float, double) {
  constexpr double rounding = 4e4 * std::numeric_limits<TestType>::epsilon();
  for (const std::size_t grains : {1U, 5U, 40U, 150U}) {
    INFO(grains << " grains");
    const Net net = drawn_net(grains);
    Draw draw(3);
    std::vector<Vector> forces(grains);
    for (Vector& force : forces) force = drawn_direction(draw);
    Eigen::VectorXd right(static_cast<Eigen::Index>(3 * grains));
    for (std::size_t i = 0; i < grains; ++i) {
      right.segment(static_cast<Eigen::Index>(3 * i), 3) = forces[i];
    }
    const Eigen::VectorXd expected = matrix_of(net).llt().solve(right);
    std::vector<Vector> first;
    for (const Isa isa : testable_isas()) {
      INFO(name_of(isa));
      StiffnessFactors factors(kernels_for(isa));
      factors.analyse(net.centres, net.springs);
      for (int twice = 0; twice < 2; ++twice) {
        REQUIRE(factors.factor<TestType>(net.springs, net.ground));
        std::vector<Vector> ways = forces;
        factors.solve<TestType>(ways);
        for (std::size_t i = 0; i < grains; ++i) {
          const Vector way = expected.segment(static_cast<Eigen::Index>(3 * i), 3);
          CHECK((ways[i] - way).norm() < rounding * expected.norm());
        }
        if (first.empty()) first = ways;
        CHECK(ways == first);
      }
    }
  }
}

TEST_CASE("factors of one type replace those of the other") {
  const Net net = drawn_net(40);
  StiffnessFactors factors(testing::kernels()), fresh(testing::kernels());
  factors.analyse(net.centres, net.springs);
  fresh.analyse(net.centres, net.springs);
  REQUIRE(factors.factor<float>(net.springs, net.ground));
  REQUIRE(factors.factor<double>(net.springs, net.ground));
  REQUIRE(factors.factor<float>(net.springs, net.ground));
  REQUIRE(fresh.factor<float>(net.springs, net.ground));
  std::vector<Vector> ways(40, Vector::UnitZ()), expected = ways;
  factors.solve<float>(ways);
  fresh.solve<float>(expected);
  CHECK(ways == expected);
}

TEMPLATE_TEST_CASE("a grain that nothing holds has no factors", "", float, double) {
  Net net = drawn_net(30);
  net.ground.assign(30, 0.0);
  net.centres.push_back({1.0, 1.0, 20.0, 0.5});
  net.ground.push_back(0.0);
  StiffnessFactors factors(testing::kernels());
  factors.analyse(net.centres, net.springs);
  CHECK_FALSE(factors.factor<TestType>(net.springs, net.ground));
}

}  // namespace
}  // namespace grainsweep
