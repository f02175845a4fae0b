// Variances of like groups, each known from few values: what all of them say together helps each.
//
// Groups are taken to scatter nearly alike: the true variance of one is that of the others times a
// factor whose own scatter counts as `k` degrees of freedom, as if the others said of each group
// what k + 1 values of its own would say. A group of d degrees of freedom and variance s^2 then has
//     (k s0^2 + d s^2) / (k + d)    known from    min(k + d, D)
// where D is the sum of all d (G. K. Smyth, Statistical Applications in Genetics and Molecular
// Biology 3, 2004, article 3; s0^2 is the pooled variance). So k is 0 where groups have nothing in
// common and infinite where all have one variance. It is `usual_likeness`, unless a smaller one
// makes the variances far more likely: then that is taken, with the s0^2 that goes with it. Of
// three values that happen to agree this says nothing, as their variance is as likely near 0
// whatever k is; Bartlett's test and the scatter of log s^2, which they decide, would give up what
// others say. A group whose variance is far beyond that (F test, 0.05 % above, 0.001 % below) keeps
// its own, and no other hears of it.
#pragma once

#include <vector>

namespace grainsweep {

/// A variance, and from how many degrees of freedom it is known; 0: not at all.
struct KnownVariance {
  double variance = 0.0;
  double degrees_of_freedom = 0.0;
};

/// What others say of a group, in degrees of freedom. Of 1024 `fast` beds each at six widths
/// between walls (2 to 12 d) and without walls, variance times volume differs by factors up to 3.6
/// in phi and 1.7 in Z: the scatter of its logarithm is that of 12 and 70 degrees of freedom.
inline constexpr double usual_likeness = 12.0;

/// In the order of `own`. Groups without a degree of freedom, and those whose values are all the
/// same (variance 0), have what the others say; if there are no others they stay as they are.
std::vector<KnownVariance> moderated(const std::vector<KnownVariance>& own);

}  // namespace grainsweep
