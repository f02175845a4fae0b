#include "engine/portable.hpp"

#include <limits>
#include <mpfr.h>

namespace grainsweep::portable {
namespace {

/// A number of MPFR with as many digits as a double.
class Number {
 public:
  Number() { mpfr_init2(number_, std::numeric_limits<double>::digits); }
  ~Number() { mpfr_clear(number_); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  Number(Number&&) = delete;
  Number& operator=(Number&&) = delete;

  mpfr_ptr of(double value) {
    mpfr_set_d(number_, value, MPFR_RNDN);  // exact
    return number_;
  }
  mpfr_ptr get() { return number_; }
  double value() { return mpfr_get_d(number_, MPFR_RNDN); }

 private:
  mpfr_t number_ = {};
};

/// Made once for each thread; when the thread ends, it frees the constants that MPFR keeps for it.
struct Memory {
  Memory() = default;
  ~Memory() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  Memory(Memory&&) = delete;
  Memory& operator=(Memory&&) = delete;

  Number x, y, result;
};

Memory& memory() {
  thread_local Memory of_thread;
  return of_thread;
}

using Function = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

double value(Function function, double x) {
  Memory& numbers = memory();
  function(numbers.result.get(), numbers.x.of(x), MPFR_RNDN);
  return numbers.result.value();
}

}  // namespace

double exp(double x) { return value(mpfr_exp, x); }
double expm1(double x) { return value(mpfr_expm1, x); }
double log(double x) { return value(mpfr_log, x); }
double log1p(double x) { return value(mpfr_log1p, x); }
double cbrt(double x) { return value(mpfr_cbrt, x); }
double sin(double x) { return value(mpfr_sin, x); }
double cos(double x) { return value(mpfr_cos, x); }
double tan(double x) { return value(mpfr_tan, x); }
double atan(double x) { return value(mpfr_atan, x); }
double acos(double x) { return value(mpfr_acos, x); }
double erfc(double x) { return value(mpfr_erfc, x); }

double pow(double base, double exponent) {
  Memory& numbers = memory();
  mpfr_pow(numbers.result.get(), numbers.x.of(base), numbers.y.of(exponent), MPFR_RNDN);
  return numbers.result.value();
}

}  // namespace grainsweep::portable
