#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::testable_isas;

/// A front of the form that kernels take: padded, the lower triangle of a positive definite matrix.
template <class Real>
struct Front {
  std::size_t rows, stride;
  std::vector<Real> numbers;

  explicit Front(std::size_t size)
      : rows(size),
        stride((size + block_width - 1) / block_width * block_width),
        numbers(stride * size, Real(0)) {}
  Real& at(std::size_t i, std::size_t j) { return numbers[j * stride + i]; }
};

template <class Real>
Front<Real> drawn_front(std::size_t rows, std::uint64_t seed) {
  Draw draw(seed);
  Front<Real> front(rows);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = j; i < rows; ++i)
      front.at(i, j) = static_cast<Real>(draw.uniform(-1.0, 1.0));
    front.at(j, j) += static_cast<Real>(rows);  // larger than the rest of its row: definite
  }
  return front;
}

/// Column by column, number by number.
template <class Real>
void eliminate_plainly(Front<Real>& front, std::size_t columns) {
  for (std::size_t k = 0; k < columns; ++k) {
    const Real root = std::sqrt(front.at(k, k));
    for (std::size_t i = k; i < front.rows; ++i) front.at(i, k) /= root;
    for (std::size_t j = k + 1; j < front.rows; ++j) {
      for (std::size_t i = j; i < front.rows; ++i)
        front.at(i, j) -= front.at(i, k) * front.at(j, k);
    }
  }
}

TEMPLATE_TEST_CASE(
    "a front is eliminated as number by number, with the same bits on all instruction sets", "",
    float, double) {
  constexpr double roundings = 50.0 * std::numeric_limits<TestType>::epsilon();
  for (const auto& [rows, columns] : {std::pair<std::size_t, std::size_t>{1, 1},
                                      {3, 0},
                                      {7, 3},
                                      {16, 16},
                                      {33, 30},
                                      {61, 21},
                                      {100, 100},
                                      {250, 150}}) {
    INFO(rows << " rows, " << columns << " columns");
    const auto given = drawn_front<TestType>(rows, rows);
    Front<TestType> plain = given;
    eliminate_plainly(plain, columns);
    Front<TestType> first = given;
    REQUIRE(kernels_of<TestType>(kernels_for(Isa::sse2))
                .fronts.factor(first.numbers.data(), rows, columns, given.stride));
    for (const Isa isa : testable_isas()) {
      INFO(name_of(isa));
      Front<TestType> front = given;
      REQUIRE(kernels_of<TestType>(kernels_for(isa))
                  .fronts.factor(front.numbers.data(), rows, columns, given.stride));
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = j; i < rows; ++i) {
          // A few roundings of numbers of the size of the diagonal.
          CHECK(static_cast<double>(std::abs(front.at(i, j) - plain.at(i, j))) <=
                roundings * static_cast<double>(rows));
          CHECK(front.at(i, j) == first.at(i, j));
        }
      }
    }
  }
}

TEMPLATE_TEST_CASE("a front with a pivot that is not positive is refused", "", float, double) {
  for (const double pivot : {0.0, -1.0, std::nan("")}) {
    auto front = drawn_front<TestType>(20, 1);
    front.at(17, 17) = static_cast<TestType>(pivot);
    CHECK_FALSE(kernels_of<TestType>(kernels_for(best_isa()))
                    .fronts.factor(front.numbers.data(), 20, 20, front.stride));
  }
}

TEMPLATE_TEST_CASE("solving forward and backward with all columns solves the system", "", float,
                   double) {
  constexpr double roundings = 4e3 * std::numeric_limits<TestType>::epsilon();
  for (const std::size_t rows : {1, 5, 16, 17, 50}) {
    auto given = drawn_front<TestType>(rows, 100 + rows);
    std::vector<TestType> wanted(given.stride, 0), right(given.stride, 0);
    for (std::size_t i = 0; i < rows; ++i) wanted[i] = static_cast<TestType>(i) - TestType(3.5);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < rows; ++j) {
        right[i] += given.at(std::max(i, j), std::min(i, j)) * wanted[j];
      }
    }
    std::vector<TestType> first;
    for (const Isa isa : testable_isas()) {
      INFO(name_of(isa) << ", " << rows << " rows");
      const FrontKernels<TestType>& kernels = kernels_of<TestType>(kernels_for(isa)).fronts;
      Front<TestType> front = given;
      REQUIRE(kernels.factor(front.numbers.data(), rows, rows, given.stride));
      std::vector<TestType> x = right;
      kernels.solve_forward(front.numbers.data(), rows, rows, given.stride, x.data());
      kernels.solve_backward(front.numbers.data(), rows, rows, given.stride, x.data());
      // The matrix is conditioned by less than 10.
      for (std::size_t i = 0; i < rows; ++i) CHECK(x[i] == Approx(wanted[i]).epsilon(roundings));
      if (first.empty()) first = x;
      CHECK(x == first);
    }
  }
}

}  // namespace
}  // namespace grainsweep
