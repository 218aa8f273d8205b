#include "logging.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar::verdicts {
namespace {

// Nothing moved before the record began.
double value_at(const Track& track, double time_s) {
  const double held_s = std::clamp(std::floor(time_s), 0.0, static_cast<double>(track.size() - 1));
  return track[static_cast<std::size_t>(held_s)];
}

double sample_of(const Conventions& conventions) {
  return static_cast<double>(conventions.logging != Logging::exact ? conventions.every_s : conventions.row_s);
}

}  // namespace

std::vector<double> rows_of(const Plan& plan, std::size_t row_s) {
  std::vector<double> time_s;
  time_s.reserve(plan.span_s / row_s + 1);
  for (std::size_t t = 0; t <= plan.span_s; t += row_s) time_s.push_back(static_cast<double>(t));
  return time_s;
}

std::vector<double> at_rows(const Track& track, const std::vector<double>& time_s) {
  std::vector<double> values;
  values.reserve(time_s.size());
  for (const double t : time_s) values.push_back(value_at(track, t));
  return values;
}

Clock drawn_clock(const Conventions& conventions, Chance& chance) {
  const double every_s = sample_of(conventions);
  const double late_s = every_s * chance.between(0.0, conventions.most_late);
  return {late_s, chance.between(-every_s, 0.0)};
}

std::vector<double> logged(const Track& track, Quantity quantity, const std::vector<double>& time_s,
                           const Conventions& conventions, Chance& chance) {
  const Clock clock = drawn_clock(conventions, chance);
  return logged(track, quantity, time_s, conventions, clock, chance);
}

std::vector<double> logged(const Track& track, Quantity quantity, const std::vector<double>& time_s,
                           const Conventions& conventions, const Clock& clock, Chance& chance) {
  const bool has_own_samples = conventions.logging != Logging::exact;
  const double sample_s = sample_of(conventions);
  const auto seen = [&](double at_s) {
    double value = value_at(track, at_s - clock.late_s);
    if (!is_temperature(quantity)) return std::round(value);
    value += conventions.sensor_noise_K * chance.normal();
    const double step = conventions.kelvin_step;
    return step > 0.0 ? step * std::round(value / step) : value;
  };
  std::vector<double> values;
  values.reserve(time_s.size());
  double last_s = clock.phase_s, last = has_own_samples ? seen(last_s) : 0.0,
         next = has_own_samples ? seen(last_s + sample_s) : 0.0;
  for (const double t : time_s) {
    if (!has_own_samples) {
      values.push_back(seen(t));
      continue;
    }
    while (t >= last_s + sample_s) {
      last_s += sample_s;
      last = next;
      next = seen(last_s + sample_s);
    }
    const double share = conventions.logging == Logging::ramped ? (t - last_s) / sample_s : 0.0;
    values.push_back(last + share * (next - last));
  }
  return values;
}

}  // namespace ballbar::verdicts
