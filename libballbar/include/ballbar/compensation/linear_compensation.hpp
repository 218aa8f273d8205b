// A linear replacement for a model, simple enough for the built-in temperature compensation of a control.
//
//   K(T) = sum_j b_j (T_j - T0_j)        um, the error; one or a few sensors
//
// The slopes are a least squares fit to the predictions p of the model. In each run the zero is the row z of the first
// measured value, and the fit uses all rows from there on:
//
//   min_b  sum over runs and rows i of ((p_i - p_z) - sum_j b_j (T_ij - T_zj))^2
//
// The model restarts in each run, as it does live. No constant is fitted, because the machine is zeroed at the start of
// a run. T0, where K is 0, is the mean reading at these zeros. Of all sets of `count` sensors the one with the smallest
// sum is taken. Each T_j is limited to the range of its readings, widened by range_margin.
//
// The result is judged by the measured error y with the line as written, i.e. with rounded slopes and temperatures and
// K in whole increments:
//
//   after_i = (y_i - y_z) - (K(T_i) - K(T_z))
//
// It is judged on all values, and on values that were not used for choice and slopes: with several runs each run left
// out in turn, with one run the fourth and the fifth fifth of its time, each predicted from the time before.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/compensation/compensation_replay.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The slope of one sensor. Temperatures are in the unit of the column, degC or K.
struct SensorSlope {
  std::string column;
  double slope_um_per_K = 0.0;  // b, rounded to four decimals
  double sigma_um_per_K = 0.0;  // delete-one jackknife over the runs, or over the fifths of one run
  double zero = 0.0;            // T0, rounded to one decimal, as low and high
  double low = 0.0, high = 0.0;
};

// The smallest step of the offset in the control.
struct Increment {
  double um = 0.1;
  bool toward_zero = false;  // truncate to whole steps; false: round to the nearest
};

struct LinearCompensation {
  std::vector<SensorSlope> sensors;  // at least one
  Increment increment;
};

// K in um at these readings (one per sensor), in whole increments.
double error_um(const LinearCompensation& line, std::span<const double> readings);

// The error without compensation, with the full model, and with the line, on the same values.
struct LineErrors {
  Reduction model, line;
  double largest_um = 0.0;        // of the measured error since the zeros
  double largest_model_um = 0.0;  // of the error with the model
  double largest_line_um = 0.0;
  std::size_t values = 0;
  std::size_t beyond = 0;  // number of these with a reading outside low to high
};

struct Simplification {
  LinearCompensation line;
  std::size_t rows = 0;                // number of rows from the zeros on
  std::size_t runs = 0;                // number of runs with at least two values
  double from_model_um = 0.0;          // RMS of model minus line over these rows
  LineErrors fitted;                   // on all values
  std::optional<LineErrors> left_out;  // nullopt: a fifth has no value, or too small a temperature rise before it
};

inline constexpr std::size_t kMostLineSensors = 3;

// model: one target, all parameters held. candidates: temperature columns, of which `count` are chosen; constant ones
// are ignored. range_margin: share of the range of the readings, added at either end.
//
// Throws Error: several targets or one not in um, an unknown column, fewer than two values of the target in every run,
// fewer than `count` sensors that vary independently, a count of 0 or above kMostLineSensors, and the errors of
// predict().
Simplification simplified(const Model& model, const Series& data, std::span<const std::string> candidates,
                          std::size_t count, double range_margin, const Increment& increment);

}  // namespace ballbar
