#include "numerics/tails.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

namespace ballbar {

double chi2_upper_tail(double chi2, std::size_t degrees) {
  return chi2 > 0.0 ? boost::math::gamma_q(0.5 * static_cast<double>(degrees), 0.5 * chi2) : 1.0;
}

double chi2_exceeded(double chance, std::size_t degrees) {
  return 2.0 * boost::math::gamma_q_inv(0.5 * static_cast<double>(degrees), chance);
}

double student_tails(double t, double degrees) {
  if (std::isinf(degrees)) return std::erfc(std::abs(t) / std::numbers::sqrt2);
  return boost::math::ibeta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

double fisher_upper_tail(double f, std::size_t degrees, double degrees_of_rest) {
  const auto d = static_cast<double>(degrees);
  if (!(f > 0.0)) return 1.0;
  if (std::isinf(degrees_of_rest)) return chi2_upper_tail(d * f, degrees);
  return boost::math::ibeta(0.5 * degrees_of_rest, 0.5 * d, degrees_of_rest / (degrees_of_rest + d * f));
}

// sum_(i>=k) C(n, i) p^i (1 - p)^(n-i) = I_p(k, n - k + 1)
double binomial_upper_tail(std::size_t least, std::size_t count, double chance) {
  if (least == 0) return 1.0;
  if (least > count || !(chance > 0.0)) return 0.0;
  if (chance >= 1.0) return 1.0;
  return boost::math::ibeta(static_cast<double>(least), static_cast<double>(count - least + 1), chance);
}

}  // namespace ballbar
