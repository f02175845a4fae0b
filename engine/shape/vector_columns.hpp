// Vectors by columns, as kernels take them.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "kernels/kernels.hpp"

namespace grainsweep {

class VectorColumns {
 public:
  void clear() { count_ = 0; }
  void add(const Eigen::Vector3d& v) {
    if (count_ == x_.size()) {
      for (std::vector<double>* column : {&x_, &y_, &z_}) column->resize(count_ + block_width);
    }
    x_[count_] = v.x(), y_[count_] = v.y(), z_[count_] = v.z();
    ++count_;
  }
  std::size_t count() const { return count_; }
  /// With room up to a multiple of block_width.
  std::size_t padded() const { return x_.size(); }
  PointColumns columns() const { return {x_.data(), y_.data(), z_.data(), count_}; }

 private:
  std::vector<double> x_, y_, z_;
  std::size_t count_ = 0;
};

}  // namespace grainsweep
