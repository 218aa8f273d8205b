// A straight line in place of a model: what the temperature compensation of a control itself can follow.
//
//   K(T) = sum_j b_j (T_j - T0_j)        um, the error; of one sensor, or a few
//
// The slopes are those of least squares to what the model predicts since a run's zero, its first measured value at row
// z, over all rows of the run from there on:
//
//   min_b  sum over runs and rows i of ((p_i - p_z) - sum_j b_j (T_ij - T_zj))^2
//
// The model begins anew in each run, as it does live. No constant is fitted, for a machine is zeroed where a run
// begins. T0, where K is 0, is the mean reading at these zeros. Of all sets of as many sensors as asked for the one
// with the least sum is taken. Each T_j stops at the ends of what was read, widened as a trained range is.
//
// What is judged is the measured error with what is written: slopes and temperatures rounded, K in whole increments,
//
//   after_i = (y_i - y_z) - (K(T_i) - K(T_z))
//
// once on all values, and once on values that choice and slopes did not have: of several runs each one left out, of one
// the fourth and fifth fifths of its time, each from what is before it.
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

// Temperatures are in the column's own unit, degC or K.
struct SensorSlope {
  std::string column;
  double slope_um_per_K = 0.0;  // b, four decimals
  double sigma_um_per_K = 0.0;  // by leaving out each run, or each fifth of one, in turn (delete-one jackknife)
  double zero = 0.0;            // T0, one decimal as the next two
  double low = 0.0, high = 0.0;
};

// A control's smallest step of the result.
struct Increment {
  double um = 0.1;
  bool toward_zero = false;  // what is left of a step is cut off; false: to the nearest
};

struct LinearCompensation {
  std::vector<SensorSlope> sensors;  // at least one
  Increment increment;
};

// K at these readings, one a sensor, in whole increments.
double error_um(const LinearCompensation& line, std::span<const double> readings);

// The error without compensation, with all of the model, and with the line, on the same values.
struct LineErrors {
  Reduction model, line;
  double largest_um = 0.0;        // of what is measured, since the zeros
  double largest_model_um = 0.0;  // of what is left
  double largest_line_um = 0.0;
  std::size_t values = 0;
  std::size_t beyond = 0;  // of these, with a reading beyond an end of the line
};

struct Simplification {
  LinearCompensation line;
  std::size_t rows = 0;                // from the zeros on
  std::size_t runs = 0;                // with at least two values
  double from_model_um = 0.0;          // RMS of what the model predicts less the line, over these rows
  LineErrors fitted;                   // all values
  std::optional<LineErrors> left_out;  // nothing: a fifth without a value, or too little heat before one
};

inline constexpr std::size_t kMostLineSensors = 3;

// model: of one target, all held. candidates: columns of temperatures. `count` of them are taken; those that stand
// still are not. range_margin: of what was read, at either end.
//
// Throws Error: a model of several targets or one not in um, no such column, fewer than two values of the target in
// every run, fewer than `count` sensors that move independently, a count of 0 or above kMostLineSensors, and what
// predict() throws.
Simplification simplified(const Model& model, const Series& data, std::span<const std::string> candidates,
                          std::size_t count, double range_margin, const Increment& increment);

}  // namespace ballbar
