#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"
#include "numerics/random_streams.hpp"
#include "simulation/simulate_parts.hpp"

namespace ballbar::simulation {
namespace {

Column measured(std::string name) { return {std::move(name), Role::measured, {}}; }

// A probe's true reading, x, y or z at a plane of the bar, from the drift since the first test.
double probe_um(const VirtualFiveProbe& probe, std::size_t column, const TruePosition& drift) {
  const double tilt_b_mrad = probe.tilt_b_urad_per_um * drift.x_um / 1e3;  // um per mm
  const double tilt_a_mrad = probe.tilt_a_urad_per_um * drift.y_um / 1e3;
  const double from_ball_mm = (column % 2 == 0 ? 0.0 : probe.spacing_mm) - probe.ball_offset_mm;
  if (column < 2) return drift.x_um + tilt_b_mrad * from_ball_mm;
  if (column < 4) return drift.y_um - tilt_a_mrad * from_ball_mm;
  return drift.z_um;
}

TruePosition since(const TruePosition& first, const TruePosition& later) {
  return {later.time_s, later.x_um - first.x_um, later.y_um - first.y_um, later.z_um - first.z_um,
          later.along_bar_um - first.along_bar_um};
}

}  // namespace

double interpolated(const std::vector<double>& time_s, const std::vector<double>& value, double at_s) {
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), at_s);
  if (after == time_s.begin()) return value.front();
  if (after == time_s.end()) return value.back();
  const auto i = static_cast<std::size_t>(after - time_s.begin());
  const double share = (at_s - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
  return value[i - 1] + share * (value[i] - value[i - 1]);
}

TruePosition truth_at(const VirtualMachine& machine, double at_s) {
  const std::vector<TruePosition>& truth = machine.truth;
  const auto later = [](double time_s, const TruePosition& point) { return time_s < point.time_s; };
  const auto after = std::upper_bound(truth.begin(), truth.end(), at_s, later);
  if (after == truth.begin() || after == truth.end()) {
    TruePosition held = after == truth.begin() ? truth.front() : truth.back();
    held.time_s = at_s;
    return held;
  }
  const TruePosition& before = *(after - 1);
  const double share = (at_s - before.time_s) / (after->time_s - before.time_s);
  const auto at = [&](double TruePosition::*component) {
    return before.*component + share * ((*after).*component - before.*component);
  };
  return {at_s, at(&TruePosition::x_um), at(&TruePosition::y_um), at(&TruePosition::z_um),
          at(&TruePosition::along_bar_um)};
}

std::vector<double> clock_s(double first_s, double last_s, double interval_s) {
  std::vector<double> time_s;
  const auto rows = static_cast<std::size_t>(std::ceil((last_s - first_s) / interval_s - 1e-9)) + 1;
  for (std::size_t i = 0; i < rows; ++i) time_s.push_back(first_s + static_cast<double>(i) * interval_s);
  return time_s;
}

Series signals_of(const VirtualMachine& machine) {
  Series series;
  if (machine.signals.empty()) return series;
  series.time_s = clock_s(machine.test_s.front(), machine.test_s.back(), machine.interval_s);
  for (const VirtualSignal& signal : machine.signals) {
    std::mt19937_64 random = stream_of(machine.seed, Stream::signal, key_of(signal.name));
    Column column{signal.name, signal.role, {}};
    for (const double at_s : series.time_s) {
      const double value = interpolated(signal.time_s, signal.value, at_s);
      column.values.push_back(rounded(value + signal.noise * normal(random), signal.resolution));
    }
    series.columns.push_back(std::move(column));
  }
  return series;
}

Series five_probe_of(const VirtualMachine& machine) {
  Series series;
  const VirtualFiveProbe& probe = machine.five_probe;
  if (!probe.present) return series;
  series.five_probe = FiveProbe{};
  series.five_probe->spacing_mm = probe.spacing_mm;
  if (probe.resolution_um > 0.0) series.five_probe->resolution_um = probe.resolution_um;
  series.time_s = clock_s(machine.test_s.front(), machine.test_s.back(), probe.interval_s);
  const TruePosition first = truth_at(machine, machine.test_s.front());
  for (const char* name : {"X1_um", "X2_um", "Y1_um", "Y2_um", "Z_um"}) {
    std::mt19937_64 random = stream_of(machine.seed, Stream::probe, key_of(std::string_view(name)));
    Column column = measured(name);
    for (const double at_s : series.time_s) {
      const double true_um = probe_um(probe, series.columns.size(), since(first, truth_at(machine, at_s)));
      column.values.push_back(rounded(true_um + probe.noise_um * normal(random), probe.resolution_um));
    }
    series.columns.push_back(std::move(column));
  }
  return series;
}

Series truth_of(const VirtualMachine& machine) {
  Series series;
  series.time_s = machine.test_s;
  if (machine.method == Method::spindle_rotation) {
    series.columns = {measured("radial_um"), measured("axial_um"), measured("shift_a_um"), measured("shift_b_um"),
                      measured("radius_change_um")};
  } else {
    series.columns = {measured("x_um"), measured("y_um"), measured("z_um")};
  }
  const TruePosition first = truth_at(machine, machine.test_s.front());
  for (const double at_s : machine.test_s) {
    const TruePosition drift = since(first, truth_at(machine, at_s));
    const std::vector<double> row = machine.method == Method::spindle_rotation
                                        ? std::vector<double>{std::hypot(drift.x_um, drift.y_um), drift.z_um,
                                                              drift.x_um, drift.y_um, drift.along_bar_um}
                                        : std::vector<double>{drift.x_um, drift.y_um, drift.z_um};
    for (std::size_t i = 0; i < row.size(); ++i) series.columns[i].values.push_back(row[i]);
  }
  return series;
}

}  // namespace ballbar::simulation
