#include <algorithm>

#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// k (u(t - delta) - u(t)), u a straight line between the rows and constant before the first and after the last.
struct ClockOffset {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> time_s = rows.time_s;
    const std::span<const double> signal = rows.inputs[0];
    const T at_s = time_s[i] - p[1];
    const auto next =
        std::upper_bound(time_s.begin(), time_s.end(), at_s, [](const T& at, double row_s) { return at < T(row_s); });
    T shifted(signal[0]);
    if (next == time_s.end()) {
      shifted = T(signal.back());
    } else if (at_s > T(time_s[0])) {
      const auto j = static_cast<std::size_t>(next - time_s.begin()) - 1;
      shifted = signal[j] + (signal[j + 1] - signal[j]) / (time_s[j + 1] - time_s[j]) * (at_s - time_s[j]);
    }
    return p[0] * (shifted - signal[i]);
  }
};

}  // namespace

extern const Effect kClockOffset{
    "clock_offset",
    Level::series,
    {.summary = "The clocks of two loggers disagree.",
     .cause = "The signal and the drift are logged on different clocks, so the column is early or late.",
     .formula =
         "gain (u(t - offset) - u(t)); where another effect takes gain u(t), both together are gain u(t - offset)",
     .signature = "Sharp errors of alternating sign where the signal changes fast, none where it is steady.",
     .confused_with = {"lagged_expansion", "play_hysteresis", "gradient_bending"},
     .separated_by = "Compare a sharp event in both logs, such as a stop: a clock offset shifts it, a lag rounds it.",
     .remedy = "Set both clocks before the run, note one event by both, or log everything with one logger.",
     .validity =
         "Constant offset; rows closer than the offset. For an offset within which the signal is a straight line "
         "only gain times offset is determined.",
     .source = "Shift of the time axis with linear interpolation; not from a paper."},
    {{"signal",
      {"degC", "K", "um", "rpm", "W", "A", "percent", "Nm"},
      "signal that may have another clock",
      {},
      true,
      "the model reads no signal whose clock could be off"}},
    {gain_within("gain_um_per_unit", "um/unit", 1000.0,
                 "drift for each unit of the signal: that of the effect that uses it"),
     {"offset_s",
      "s",
      ParameterKind::shape,
      60.0,
      -7200.0,
      7200.0,
      {-3600.0, -1200.0, -600.0, -180.0, -60.0, 60.0, 180.0, 600.0, 1200.0, 3600.0},
      "how late the signal takes effect by the clock of the data"}},
    by_reading<2>(ClockOffset{}),
};

}  // namespace ballbar::catalogue
