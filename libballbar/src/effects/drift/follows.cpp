#include <algorithm>
#include <array>

#include "ballbar/internal/series/signal_kind.hpp"
#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k LP_tau[u - u_0]
struct Follows {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    const std::span<const double> input = rows.inputs[0];
    return low_pass_at(rows, i, T(input[i] - input[0]), p[1], false, kept) * p[0];
  }
};

// A search looks here for what no physical effect takes: switches, valves, counts, columns without a unit.
bool has_no_other_effect(const Column& column) {
  constexpr std::array<std::string_view, 10> kTaken{"degC", "K", "rpm", "W", "A", "Nm", "percent", "um", "mm", "urad"};
  if (column.role == Role::measured) return false;
  if (std::find(kTaken.begin(), kTaken.end(), unit_of(column.name)) != kTaken.end()) return false;
  return may_drive(column.values);
}

}  // namespace

extern const Effect kFollows{
    "follows",
    Level::series,
    {.summary = "The drift follows a column of any unit.",
     .cause = "A switch, a valve, a pressure, a flow or a sensor without a unit changes with what warms or loads the "
              "machine.",
     .formula = "gain (LP_tau[u] - u0), u the column, LP_tau the first-order low pass; tau = 0: at once",
     .signature = "The residual follows the column, at once or as an exponential after each of its changes.",
     .confused_with = {"lagged_expansion", "speed_heating", "load_heating"},
     .separated_by = "Switch or change this column alone, at constant speed and in a steady room.",
     .remedy = "Keep the input constant, or compensate with the column.",
     .validity = "One dominant time constant; a change of drift in proportion to the column.",
     .source = "Heat balance of a lumped body; not from a paper."},
    {{"input", {}, "column that the drift follows", has_no_other_effect, false, "no column without a physical effect"}},
    {gain_within("gain_um_per_unit", "um/unit", 1e6, "final drift for a change by one unit of the column"),
     {"time_constant_s",
      "s",
      ParameterKind::shape,
      600.0,
      0.0,
      200000.0,
      {0.0, 60.0, 100.0, 180.0, 330.0, 600.0, 1000.0, 1800.0, 3300.0, 5400.0, 9500.0, 16000.0},
      "time constant of the body; 0: no delay"}},
    by_row<2, kLowPassKept>(Follows{}),
};

}  // namespace ballbar::catalogue
