#include "runner/analysis/student.hpp"

#include <map>

#include <boost/math/distributions/students_t.hpp>

namespace grainsweep {

// A sweep of many packings asks for the same few a million times.
double student_quantile(double degrees_of_freedom) {
  thread_local std::map<double, double> known;
  const auto [entry, is_new] = known.try_emplace(degrees_of_freedom);
  if (is_new) {
    const boost::math::students_t means(degrees_of_freedom);
    entry->second = boost::math::quantile(means, 0.975);
  }
  return entry->second;
}

}  // namespace grainsweep
