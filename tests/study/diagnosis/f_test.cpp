#include "f_test.hpp"

#include <cmath>

namespace ballbar::study {
namespace {

// I_x(a, b) by its series x^a (1 - x)^b / (a B(a, b)) sum of x^n (a + b)_n / (a + 1)_n: for x below a / (a + b).
double beta_series(double x, double a, double b) {
  double term = 1.0, sum = 1.0;
  for (int n = 0; n < 100000 && term > 1e-12 * sum; ++n) {
    term *= x * (a + b + n) / (a + 1.0 + n);
    sum += term;
  }
  const double log_beta = std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
  return std::exp(a * std::log(x) + b * std::log1p(-x) - std::log(a) - log_beta) * sum;
}

}  // namespace

double p_of_f(double f, double d1, double d2) {
  if (!(f > 0.0)) return 1.0;
  const double x = d2 / (d2 + d1 * f), a = 0.5 * d2, b = 0.5 * d1;
  if (x <= 0.0) return 0.0;
  return x < a / (a + b) ? beta_series(x, a, b) : 1.0 - beta_series(1.0 - x, b, a);
}

}  // namespace ballbar::study
