#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "simulation/simulate_parts.hpp"

namespace ballbar::simulation {
namespace {

constexpr std::size_t kMostReadings = 1'000'000;  // of one sweep
constexpr double kMostRows = 1e7;                 // of one series
constexpr double kShortestStep_s = 1e-5;          // between readings, which are logged to 1 us

[[noreturn]] void refuse(const VirtualMachine& machine, std::string_view sentence) {
  throw Error(fmt::format("{}: {}", machine.name, sentence));
}

struct Named {
  std::string_view name;
  double value;
};

void expect_finite(const VirtualMachine& machine, std::initializer_list<Named> numbers) {
  for (const auto& [name, value] : numbers) {
    if (!std::isfinite(value)) refuse(machine, fmt::format("expected a finite number for {}, found {}.", name, value));
  }
}

void expect_positive(const VirtualMachine& machine, std::initializer_list<Named> numbers) {
  expect_finite(machine, numbers);
  for (const auto& [name, value] : numbers) {
    if (!(value > 0.0)) refuse(machine, fmt::format("expected a number above 0 for {}, found {}.", name, value));
  }
}

void expect_not_negative(const VirtualMachine& machine, std::initializer_list<Named> numbers) {
  expect_finite(machine, numbers);
  for (const auto& [name, value] : numbers) {
    if (value < 0.0) refuse(machine, fmt::format("expected a number not below 0 for {}, found {}.", name, value));
  }
}

void expect_rising(const VirtualMachine& machine, std::string_view what, const std::vector<double>& time_s) {
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    expect_finite(machine, {{what, time_s[i]}});
    if (i > 0 && !(time_s[i] > time_s[i - 1])) {
      refuse(machine, fmt::format("expected rising times for {}, found {} min after {} min.", what,
                                  min_from_s(time_s[i]), min_from_s(time_s[i - 1])));
    }
  }
}

void expect_unused(const VirtualMachine& machine, Method only, std::initializer_list<Named> numbers) {
  if (machine.method == only) return;
  for (const auto& [name, value] : numbers) {
    if (value == 0.0) continue;
    refuse(machine,
           fmt::format("{} belongs to method {}, and the method is {}.", name, name_of(only), name_of(machine.method)));
  }
}

void check_times(const VirtualMachine& machine) {
  if (machine.truth.empty()) refuse(machine, "expected a truth of at least one point, found none.");
  std::vector<double> truth_s;
  for (const TruePosition& point : machine.truth) {
    expect_finite(machine, {{"the truth's x_um", point.x_um},
                            {"the truth's y_um", point.y_um},
                            {"the truth's z_um", point.z_um},
                            {"the truth's along_bar_um", point.along_bar_um}});
    expect_unused(machine, Method::spindle_rotation, {{"the truth's along_bar_um", point.along_bar_um}});
    truth_s.push_back(point.time_s);
  }
  expect_rising(machine, "the truth", truth_s);
  if (machine.test_s.empty()) refuse(machine, "expected at least one test, found none.");
  expect_rising(machine, "the tests", machine.test_s);
  if (truth_s.size() == 1) return;
  for (const double test_s : machine.test_s) {
    if (test_s >= truth_s.front() && test_s <= truth_s.back()) continue;
    refuse(machine, fmt::format("expected tests within the truth, {} to {} min, found one at {} min.",
                                min_from_s(truth_s.front()), min_from_s(truth_s.back()), min_from_s(test_s)));
  }
}

void check_sweep(const VirtualMachine& machine, std::string_view name, const Sweep& sweep) {
  const double arc_deg = std::abs(sweep.end_deg - sweep.start_deg);
  if (!(arc_deg > 0.0 && arc_deg <= 360.0)) {
    refuse(machine, fmt::format("expected an arc above 0 and up to 360 deg for {}, found {} to {} deg.", name,
                                sweep.start_deg, sweep.end_deg));
  }
  if (sweep.readings == 0 || sweep.readings > kMostReadings) {
    refuse(machine, fmt::format("expected 1 to {} readings for {}, found {}.", kMostReadings, name, sweep.readings));
  }
  const double radius_mm = machine.bar.nominal_length_mm + mm_from_um(machine.bar.radius_error_um);
  const double sweep_s = radius_mm * rad_from_deg(arc_deg) / machine.feed_mm_per_min * 60.0;
  if (sweep_s / static_cast<double>(sweep.readings) < kShortestStep_s) {
    refuse(machine, fmt::format("expected readings at least 0.01 ms apart, found {} in {} s for {}; lower the feed or "
                                "the readings.",
                                sweep.readings, sweep_s, name));
  }
}

void check_bar(const VirtualMachine& machine) {
  const VirtualBar& bar = machine.bar;
  expect_positive(machine,
                  {{"nominal_length_mm", bar.nominal_length_mm},
                   {"nominal_length_mm + radius_error_um", bar.nominal_length_mm + mm_from_um(bar.radius_error_um)},
                   {"feed_mm_per_min", machine.feed_mm_per_min}});
  expect_not_negative(machine, {{"the bar's noise_um", bar.noise_um}, {"the bar's resolution_um", bar.resolution_um}});
  expect_finite(machine, {{"outlier_um", bar.outlier_um},
                          {"the set-up's x_um", machine.setup_x_um},
                          {"the set-up's y_um", machine.setup_y_um},
                          {"the set-up's z_um", machine.setup_z_um},
                          {"height_offset_mm", machine.height_offset_mm}});
  if (!(bar.autocorrelation >= 0.0 && bar.autocorrelation < 1.0)) {
    refuse(machine, fmt::format("expected an autocorrelation from 0 to below 1, found {}.", bar.autocorrelation));
  }
  if (!(bar.outlier_share >= 0.0 && bar.outlier_share <= 1.0)) {
    refuse(machine, fmt::format("expected an outlier_share from 0 to 1, found {}.", bar.outlier_share));
  }
}

void check_method(const VirtualMachine& machine) {
  if (machine.method == Method::two_arcs) {
    check_sweep(machine, "c_arc", machine.c_arc);
    check_sweep(machine, "a_arc", machine.a_arc);
  } else {
    check_sweep(machine, "circle", machine.circle);
  }
  if (machine.method != Method::circles && machine.plane != Plane::XY) {
    refuse(machine, fmt::format("plane {} belongs to method circles, and the method is {}.", name_of(machine.plane),
                                name_of(machine.method)));
  }
  expect_finite(machine, {{"harmonic2_um", machine.harmonic2_um},
                          {"backlash_a_um", machine.backlash_a_um},
                          {"run_out_um", machine.run_out_um},
                          {"the axial offset_um", machine.axial.offset_um}});
  expect_unused(machine, Method::circles,
                {{"harmonic2_um", machine.harmonic2_um}, {"backlash_a_um", machine.backlash_a_um}});
  expect_unused(machine, Method::spindle_rotation,
                {{"run_out_um", machine.run_out_um},
                 {"the axial offset_um", machine.axial.offset_um},
                 {"axial readings", static_cast<double>(machine.axial.readings)},
                 {"spindle_above = false", machine.spindle_above ? 0.0 : 1.0}});
  if (machine.axial.readings > kMostReadings) {
    refuse(machine,
           fmt::format("expected at most {} axial readings, found {}.", kMostReadings, machine.axial.readings));
  }
  expect_positive(machine, {{"the axial interval_s", machine.axial.interval_s}});
  if (machine.axial.interval_s < kShortestStep_s) {
    refuse(machine,
           fmt::format("expected axial readings at least 0.01 ms apart, found {} s.", machine.axial.interval_s));
  }
}

void check_rows(const VirtualMachine& machine, std::string_view what, double interval_s) {
  const double rows = (machine.test_s.back() - machine.test_s.front()) / interval_s;
  if (rows > kMostRows) {
    refuse(machine,
           fmt::format("expected at most {:.0f} rows for {}, found {:.0f}; widen interval_s.", kMostRows, what, rows));
  }
}

void check_signal(const VirtualMachine& machine, const VirtualSignal& signal) {
  const std::string what = fmt::format("signal \"{}\"", signal.name);
  if (unit_of(signal.name).empty()) {
    refuse(machine,
           fmt::format("expected a name ending in its unit (_um, _mm, _degC, _rpm, _A, _W, _K), found {}.", what));
  }
  const auto same = [&](const VirtualSignal& other) { return other.name == signal.name; };
  if (std::count_if(machine.signals.begin(), machine.signals.end(), same) > 1) {
    refuse(machine, fmt::format("expected one signal of each name, found {} twice.", what));
  }
  if (signal.time_s.empty() || signal.time_s.size() != signal.value.size()) {
    refuse(machine, fmt::format("expected as many values as times, at least one, for {}, found {} times and {} values.",
                                what, signal.time_s.size(), signal.value.size()));
  }
  expect_rising(machine, what, signal.time_s);
  for (const double value : signal.value) expect_finite(machine, {{what, value}});
  expect_not_negative(machine, {{what + " noise", signal.noise}, {what + " resolution", signal.resolution}});
}

}  // namespace

void check(const VirtualMachine& machine) {
  check_times(machine);
  check_bar(machine);
  check_method(machine);
  expect_positive(machine, {{"interval_s", machine.interval_s}});
  check_rows(machine, "the signals", machine.interval_s);
  for (const VirtualSignal& signal : machine.signals) check_signal(machine, signal);
  const VirtualFiveProbe& probe = machine.five_probe;
  if (!probe.present) return;
  expect_positive(
      machine, {{"the five probes' spacing_mm", probe.spacing_mm}, {"the five probes' interval_s", probe.interval_s}});
  expect_not_negative(machine, {{"the five probes' noise_um", probe.noise_um},
                                {"the five probes' resolution_um", probe.resolution_um}});
  expect_finite(machine, {{"tilt_a_urad_per_um", probe.tilt_a_urad_per_um},
                          {"tilt_b_urad_per_um", probe.tilt_b_urad_per_um},
                          {"ball_offset_mm", probe.ball_offset_mm}});
  check_rows(machine, "the five probes", probe.interval_s);
}

}  // namespace ballbar::simulation
