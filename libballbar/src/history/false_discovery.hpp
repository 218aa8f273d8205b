// p values of many questions at a time.
#pragma once

#include <span>
#include <vector>

namespace ballbar {

// q of each: of those with q below a rate no larger share is by chance (Benjamini and Hochberg 1995),
// for p values that are independent or rise and fall together. O(n log n).
std::vector<double> q_values(std::span<const double> p_values);

// That nothing at all is behind these (Simes 1986): min of n p_(i) / i. 1 of none.
double simes(std::vector<double> p_values);

}  // namespace ballbar
