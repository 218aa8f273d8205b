// The first-order low pass x' = (u - x) / tau, exact where u is a straight line between the rows:
//
//   x_1 = x_0 + a (u_0 - x_0) + (u_1 - u_0) (1 - a tau / dt),     a = 1 - exp(-dt / tau)
//
// Steps may be uneven. tau = 0 gives u itself, with the derivative from the right: -(u_1 - u_0) / dt.
#pragma once

#include <ceres/jet.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

// Time constants from 10 s to 56 h.
inline Parameter time_constant(std::vector<double> grid, const char* meaning, const char* name = "time_constant_s",
                               double start_s = 1800.0) {
  return {name, "s", ParameterKind::shape, start_s, 10.0, 200000.0, std::move(grid), meaning};
}

template <class T>
struct LowPassStep {
  T towards;  // a
  T along;    // 1 - a tau / dt
};

template <class T>
LowPassStep<T> low_pass_step(double dt_s, const T& tau_s) {
  using std::expm1;
  if (!(tau_s > T(1e-9 * dt_s))) return {T(1.0), T(1.0) - tau_s / T(dt_s)};
  const T towards = -expm1(T(-dt_s) / tau_s);
  return {towards, T(1.0) - towards * tau_s / T(dt_s)};
}

// out[i] = LP[u](t_i) with u(i) the input at row i; starts at u(0). `out` may not alias what u reads.
template <class T, class U>
void low_pass(std::span<const double> time_s, const U& u, const T& tau_s, T* out) {
  if (time_s.empty()) return;
  T last = T(u(0));
  out[0] = last;
  double dt_s = -1.0;
  LowPassStep<T> step{};
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double now_s = time_s[i] - time_s[i - 1];
    if (now_s != dt_s) {  // most logs keep their step
      dt_s = now_s;
      step = low_pass_step(dt_s, tau_s);
    }
    const T next = T(u(i));
    out[i] = out[i - 1] + step.towards * (last - out[i - 1]) + (next - last) * step.along;
    last = next;
  }
}

// The same row by row, for an effect of rows (evaluate.hpp). Memory: x, u and the coefficients of the previous row,
// which are reused if step and tau have not changed.
inline constexpr int kLowPassKept = 5;

template <class T>
T low_pass_at(const EffectRows& rows, std::size_t i, const T& u, const T& tau_s, bool other_tau, T* kept) {
  T &x = kept[0], &last = kept[1], &towards = kept[2], &along = kept[3], &dt_s = kept[4];
  if (i == 0) {
    x = u;
    dt_s = T(-1.0);
  } else {
    const double now_s = rows.time_s[i] - rows.time_s[i - 1];
    if (other_tau || dt_s != T(now_s)) {  // most logs keep their step
      const LowPassStep<T> step = low_pass_step(now_s, tau_s);
      towards = step.towards;
      along = step.along;
      dt_s = T(now_s);
    }
    x = x + towards * (last - x) + (u - last) * along;
  }
  last = u;
  return x;
}

}  // namespace ballbar
