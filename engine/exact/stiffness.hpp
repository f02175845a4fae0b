// The stiffness matrix of a bed whose contacts are springs, and its Cholesky factors.
//
// Multifrontal (Duff and Reid 1983): each node of the elimination tree gathers its own springs, and
// what its children hand on to it, in its front, a dense matrix over its grains and their border;
// it eliminates its grains and hands on what is left. Nearly all work is dense, in
// kernels/front_kernels.hpp, with the same bits on every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <tuple>
#include <vector>

#include "engine/exact/elimination.hpp"
#include "engine/shape/convex_shape.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// A spring between two grains, or a grain and something fixed.
struct Spring {
  static constexpr std::int32_t fixed = -1;

  std::int32_t a = 0;
  std::int32_t b = fixed;
  Vector along = Vector::UnitZ();  ///< unit
  double stiffness = 0.0;          ///< m g / d
  double across = 0.0;             ///< the same in all directions across; may be negative
};

/// Multiplications that take some tenths of a second.
inline constexpr double asks_seldom = 1e9;

class StiffnessFactors {
 public:
  /// A factorisation asks whether to go on each time it has taken so many multiplications.
  explicit StiffnessFactors(const Kernels& kernels, double asked_after = asks_seldom)
      : kernels_(&kernels), asked_after_(asked_after) {}

  /// Prepares for springs between these ends of grains with these centres. Their order must stay;
  /// their directions and stiffnesses may change. The factors, which may take gigabytes, are only
  /// allocated at the first factorisation.
  void analyse(std::span<const Record<double>> centres, const std::vector<Spring>& springs);

  /// Multiplications that a factorisation takes.
  double operations() const;

  /// Factors the matrix of all springs, and of springs of stiffness ground[i] in all directions
  /// between grain i and the ground, in numbers of type Real. False if rounding leaves it not
  /// positive definite, or if `keep_going`, asked now and then, returns false.
  template <class Real>
  bool factor(
      const std::vector<Spring>& springs, const std::vector<double>& ground,
      const std::function<bool()>& keep_going = [] { return true; });

  /// Replaces forces on the grains, m g, by the displacements that they cause, d, with the factors
  /// that were made last, of this type.
  template <class Real>
  void solve(std::vector<Vector>& x);

 private:
  /// A spring of a node, which eliminates the spring's first end: where its ends are in the node's
  /// front.
  struct PlacedSpring {
    std::size_t spring;
    std::int32_t a;
    std::int32_t b;  ///< or Spring::fixed
  };
  struct Front {
    std::size_t columns = 0;  ///< of the grains that it eliminates, three for each
    std::size_t rows = 0;     ///< including those of its border
    std::size_t stride = 0;
    std::size_t factor = 0;               ///< where its columns begin in `factors`
    std::vector<std::int32_t> at_parent;  ///< place of each grain of the border there
    std::vector<PlacedSpring> springs;
  };
  template <class Real>
  struct Numbers {
    std::vector<Real> factors;
    /// What each front hands on: the lower triangle of its border, by columns.
    std::vector<std::vector<Real>> left;
    std::vector<Real> at_front;  ///< memory of solve

    /// Its columns and, behind them, those of its border, where later fronts will be.
    Real* matrix_of(const Front& front) { return factors.data() + front.factor; }
  };

  static double operations_of(const Front& front);
  template <class Real>
  void allocate(Numbers<Real>& numbers);
  template <class Real>
  void gather(std::size_t node, const std::vector<Spring>& springs,
              const std::vector<double>& ground, Numbers<Real>& numbers);
  template <class Real>
  static void add_left(const Front& child, const std::vector<Real>& left, Real* matrix,
                       std::size_t stride);
  template <class Real>
  static void hand_on(const Front& front, const Real* matrix, std::vector<Real>& left);
  template <class Real, class Solve>
  void solve_front(std::size_t node, Solve solve_columns, std::vector<Vector>& x,
                   Numbers<Real>& numbers);

  template <class Real>
  Numbers<Real>& numbers() {
    return std::get<Numbers<Real>>(numbers_);
  }

  const Kernels* kernels_;
  double asked_after_;  ///< multiplications
  EliminationTree tree_;
  std::vector<Front> fronts_;
  std::tuple<Numbers<float>, Numbers<double>> numbers_;
};

}  // namespace grainsweep
