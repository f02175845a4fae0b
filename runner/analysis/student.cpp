#include "runner/analysis/student.hpp"

#include <boost/math/distributions/students_t.hpp>

namespace grainsweep {

double student_quantile(double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

}  // namespace grainsweep
