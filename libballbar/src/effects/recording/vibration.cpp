#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/units.hpp"
#include "effects/evaluate.hpp"
#include "effects/grids.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// s sin(2 pi f t) + c cos(2 pi f t), t from the middle of the sweep; s and c of the direction, as no two sweeps start
// at the same phase.
struct Vibration {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::cos, std::sin;
    const std::span<const double> sweep_s = rows.inputs[0], direction = rows.inputs[1], recording = rows.inputs[2];
    if (!belongs_to(p[5], recording[i])) return T(0.0);
    const T* gain = direction[i] > 0.0 ? p : p + 2;
    const T phase_rad = (2.0 * kPi * sweep_s[i]) * p[4];
    return gain[0] * sin(phase_rad) + gain[1] * cos(phase_rad);
  }
};

// Every 0.1 Hz: a sweep of 10 s tells frequencies apart that are 0.1 Hz apart.
std::vector<double> frequencies_Hz() {
  std::vector<double> grid;
  for (int tenth = 10; tenth <= 300; ++tenth) grid.push_back(tenth / 10.0);
  return grid;
}

double shortest_step_s(std::span<const double> time_s) {
  double shortest_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < time_s.size(); ++i) shortest_s = std::min(shortest_s, time_s[i] - time_s[i - 1]);
  return shortest_s;
}

// Those that the longest sweep tells apart, no higher than half the rate of the rows.
std::vector<double> searched_Hz(const EffectRows& rows, double, double, std::size_t most) {
  const std::vector<double> all_Hz = frequencies_Hz();
  const double highest_Hz = std::min(all_Hz.back(), 0.5 / shortest_step_s(rows.time_s));
  return wave_numbers(all_Hz.front(), highest_Hz, range_in(rows.inputs[0]), most);
}

}  // namespace

extern const Effect kVibration{
    "vibration",
    Level::recording,
    {.summary = "The machine vibrates at one frequency while it moves.",
     .cause = "A servo loop near its stability limit, a pump, a fan, motor cogging, or another machine nearby.",
     .formula = "sine sin(2 pi f t) + cosine cos(2 pi f t), t from the middle of the sweep; one pair a direction",
     .signature =
         "Waves of one length along the whole path, independent of the axes; their number changes with the feed.",
     .confused_with = {"cyclic_error_a", "cyclic_error_b", "lobing"},
     .separated_by = "Measure at another feed: twice the feed gives half as many waves. Position errors of the machine "
                     "stay in place.",
     .remedy = "Tune the servo loop; stop pumps and fans one by one and repeat the test; check the foundation.",
     .validity =
         "One constant frequency, from 1 Hz (slower waves are the form of the path) to half the reading rate. Two "
         "sweeps in one direction have different phases: use one vibration for each and state its `recording`.",
     .source = "Sinusoid in time; not from a paper."},
    {sweep_input(), direction_input(), recording_input()},
    {gain_within("sine_ccw_um", "um", 1000.0, "sine part in CCW recordings"),
     gain_within("cosine_ccw_um", "um", 1000.0, "cosine part in CCW recordings"),
     gain_within("sine_cw_um", "um", 1000.0, "sine part in CW recordings"),
     gain_within("cosine_cw_um", "um", 1000.0, "cosine part in CW recordings"),
     {"frequency_Hz", "Hz", ParameterKind::shape, 5.0, 1.0, 500.0, frequencies_Hz(), "of the vibration", false,
      ShapeOf::curve, searched_Hz},
     recording_parameter()},
    by_reading<6>(Vibration{}),
};

}  // namespace ballbar::catalogue
