// Functions of <cmath>, correctly rounded (by MPFR): the same bits on every processor and with
// every C library. (glibc's own functions give other bits where the processor has fused
// multiply-adds.) A bed is chaotic: a start that differs by one last digit comes out as another
// bed. So everything that makes grains and shapes uses these, except for the order of a face's
// corners (engine/shape/hull.cpp). A call takes 1 to 3 us; all else uses those of <cmath>.
#pragma once

namespace grainsweep::portable {

double exp(double x);
double expm1(double x);
double log(double x);
double log1p(double x);
double pow(double base, double exponent);
double cbrt(double x);
double sin(double x);
double cos(double x);
double tan(double x);
double atan(double x);
double acos(double x);
double erfc(double x);

}  // namespace grainsweep::portable
