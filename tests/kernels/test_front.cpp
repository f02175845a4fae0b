#include <cmath>
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
struct Front {
  std::size_t rows, stride;
  std::vector<double> numbers;

  explicit Front(std::size_t size)
      : rows(size),
        stride((size + block_width - 1) / block_width * block_width),
        numbers(stride * size, 0.0) {}
  double& at(std::size_t i, std::size_t j) { return numbers[j * stride + i]; }
};

Front drawn_front(std::size_t rows, std::uint64_t seed) {
  Draw draw(seed);
  Front front(rows);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = j; i < rows; ++i) front.at(i, j) = draw.uniform(-1.0, 1.0);
    front.at(j, j) += static_cast<double>(rows);  // larger than the rest of its row: definite
  }
  return front;
}

/// Column by column, number by number.
void eliminate_plainly(Front& front, std::size_t columns) {
  for (std::size_t k = 0; k < columns; ++k) {
    const double root = std::sqrt(front.at(k, k));
    for (std::size_t i = k; i < front.rows; ++i) front.at(i, k) /= root;
    for (std::size_t j = k + 1; j < front.rows; ++j) {
      for (std::size_t i = j; i < front.rows; ++i)
        front.at(i, j) -= front.at(i, k) * front.at(j, k);
    }
  }
}

TEST_CASE("a front is eliminated as number by number, with the same bits on all instruction sets") {
  for (const auto& [rows, columns] : {std::pair<std::size_t, std::size_t>{1, 1},
                                      {3, 0},
                                      {7, 3},
                                      {16, 16},
                                      {33, 30},
                                      {61, 21},
                                      {100, 100},
                                      {250, 150}}) {
    INFO(rows << " rows, " << columns << " columns");
    const Front given = drawn_front(rows, rows);
    Front plain = given;
    eliminate_plainly(plain, columns);
    Front first = given;
    REQUIRE(kernels_for(Isa::sse2).front.factor(first.numbers.data(), rows, columns, given.stride));
    for (const Isa isa : testable_isas()) {
      INFO(name_of(isa));
      Front front = given;
      REQUIRE(kernels_for(isa).front.factor(front.numbers.data(), rows, columns, given.stride));
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = j; i < rows; ++i) {
          // A few roundings of numbers of the size of the diagonal.
          CHECK(front.at(i, j) == Approx(plain.at(i, j)).margin(1e-14 * static_cast<double>(rows)));
          CHECK(front.at(i, j) == first.at(i, j));
        }
      }
    }
  }
}

TEST_CASE("a front with a pivot that is not positive is refused") {
  for (const double pivot : {0.0, -1.0, std::nan("")}) {
    Front front = drawn_front(20, 1);
    front.at(17, 17) = pivot;
    CHECK_FALSE(kernels_for(best_isa()).front.factor(front.numbers.data(), 20, 20, front.stride));
  }
}

TEST_CASE("solving forward and backward with all columns solves the system") {
  for (const std::size_t rows : {1, 5, 16, 17, 50}) {
    Front given = drawn_front(rows, 100 + rows);
    std::vector<double> wanted(given.stride, 0.0), right(given.stride, 0.0);
    for (std::size_t i = 0; i < rows; ++i) wanted[i] = static_cast<double>(i) - 3.5;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < rows; ++j) {
        right[i] += given.at(std::max(i, j), std::min(i, j)) * wanted[j];
      }
    }
    std::vector<double> first;
    for (const Isa isa : testable_isas()) {
      INFO(name_of(isa) << ", " << rows << " rows");
      const FrontKernels& kernels = kernels_for(isa).front;
      Front front = given;
      REQUIRE(kernels.factor(front.numbers.data(), rows, rows, given.stride));
      std::vector<double> x = right;
      kernels.solve_forward(front.numbers.data(), rows, rows, given.stride, x.data());
      kernels.solve_backward(front.numbers.data(), rows, rows, given.stride, x.data());
      // The matrix is conditioned by less than 10.
      for (std::size_t i = 0; i < rows; ++i) CHECK(x[i] == Approx(wanted[i]).epsilon(1e-12));
      if (first.empty()) first = x;
      CHECK(x == first);
    }
  }
}

}  // namespace
}  // namespace grainsweep
