#include "numerics/tails.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace ballbar {

double chi2_upper_tail(double chi2, std::size_t degrees) {
  return chi2 > 0.0 ? boost::math::gamma_q(0.5 * static_cast<double>(degrees), 0.5 * chi2) : 1.0;
}

// sum_(i>=k) C(n, i) p^i (1 - p)^(n-i) = I_p(k, n - k + 1)
double binomial_upper_tail(std::size_t least, std::size_t count, double chance) {
  if (least == 0) return 1.0;
  if (least > count || !(chance > 0.0)) return 0.0;
  if (chance >= 1.0) return 1.0;
  return boost::math::ibeta(static_cast<double>(least), static_cast<double>(count - least + 1), chance);
}

}  // namespace ballbar
