// Runs of a machine whose drift is linear in two lagged temperatures and the heat of its speed.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../made_series.hpp"
#include "made_batches.hpp"

namespace ballbar::made {

// Equal bits, gaps included.
inline bool same(double left, double right) {
  return std::bit_cast<std::uint64_t>(left) == std::bit_cast<std::uint64_t>(right);
}

struct Plan {
  std::size_t rows = 600;
  double interval_s = 30.0;
  double start_s = 0.0;
  double noise_um = 0.3;
  double wander_um = 0.0;  // standard deviation of a discrepancy that forgets in two hours
};

// x' = (u - x) / tau, u held from row to row.
class Lag {
 public:
  Lag(double time_constant_s, double interval_s) : towards_(-std::expm1(-interval_s / time_constant_s)) {}
  double next(double input) {
    const double now = value_;
    value_ += towards_ * (input - value_);
    return now;
  }

 private:
  double towards_, value_ = 0.0;
};

// At rest and cold at first, then speeds of 0 to 8000 rpm, each held for a quarter or half of an hour. Front and
// base warm with the speed, the base beside a room that swings;
//   z = 1.5 LP_900s[front] - 2 LP_3000s[base] + 0.8 LP_2500s[n^1.5] + noise
// with time constants and an exponent that no effect's grid has.
inline Series run(const Plan& plan, std::string_view seed) {
  std::seed_seq words(seed.begin(), seed.end());
  std::mt19937_64 random(words);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> krpm(0, 8), quarters(1, 2);
  Lag front(700.0, plan.interval_s), base(5000.0, plan.interval_s), of_front(900.0, plan.interval_s),
      of_base(3000.0, plan.interval_s), of_speed(2500.0, plan.interval_s);
  Series series;
  Column speed{"speed_rpm", Role::speed, {}}, front_degC{"T_front_degC"}, base_degC{"T_base_degC"},
      z{"z_um", Role::measured, {}};
  const double forgets = std::exp(-plan.interval_s / 7200.0), phase = normal(random);
  double n = 0.0, wander = normal(random);
  std::size_t until = 0;
  for (std::size_t i = 0; i < plan.rows; ++i) {
    if (i == until) {
      n = i == 0 ? 0.0 : krpm(random);
      until += static_cast<std::size_t>(900.0 * quarters(random) / plan.interval_s);
    }
    const double since_s = plan.interval_s * static_cast<double>(i);
    const double front_K = front.next(1.2 * n);
    const double base_K = base.next(0.8 * n) + std::sin(since_s / 1500.0 + phase) - std::sin(phase);
    series.time_s.push_back(plan.start_s + since_s);
    speed.values.push_back(1000.0 * n);
    front_degC.values.push_back(20.0 + front_K);
    base_degC.values.push_back(21.0 + base_K);
    wander = forgets * wander + std::sqrt(1.0 - forgets * forgets) * normal(random);
    z.values.push_back(1.5 * of_front.next(front_K) - 2.0 * of_base.next(base_K) +
                       0.8 * of_speed.next(std::pow(n, 1.5)) + plan.wander_um * wander +
                       plan.noise_um * normal(random));
  }
  series.columns = {std::move(speed), std::move(front_degC), std::move(base_degC), std::move(z)};
  return series;
}

}  // namespace ballbar::made
