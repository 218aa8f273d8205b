// The ledger of a model: one row per revision, with the change, its benefit and the evidence for it.
//
// A smaller error alone is no evidence. Every row therefore has 2 ln B and its threshold, as far as these are known.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// NaN: not known.
inline constexpr std::string_view kNotSupported = "not supported";

struct LedgerRow {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::size_t revision = 0;  // 0: the model as it started
  // "+ lagged_expansion(T_air_degC), - speed_heating(speed_rpm)"; "= expansion(T_air_degC).gain_um_per_K 3.2 held"
  std::string change = "start";
  Level level = Level::series;         // of the model
  std::string target;                  // to which the figures refer
  std::vector<std::string> data;       // file names as given
  std::size_t parameters = 0;          // free ones
  double rmse_um = 0.0;                // of the fit to all rows
  double times_floor = kUnknown;       // RMSE over the floor
  double held_out_um = kUnknown;       // RMSE of left-out cycles (recordings), each predicted from the others
  double likelihood_ratio = kUnknown;  // 2 ln B of the change (effect_test.hpp)
  double threshold = kUnknown;         // of the likelihood ratio
  double forecast_um = kUnknown;       // RMSE of rows forecast from earlier rows (growth.hpp)
  double discrepancy_um = kUnknown;    // grown models: standard deviation of the slow part of the residual
  // "start", "named", "supported", "time only", "not supported". Grown models: "driver known" (the driver is known, its
  // form is not), "empirical" (it predicts, without a claimed cause). "by hand": the user's choice, not tested.
  std::string verdict = "start";
  std::vector<std::string> still_needed, no_longer_needed;  // labels of earlier effects after this revision
};

// The row of a model fitted to all rows. held_out_um leaves out the stretches between changes of speed, or fifths of
// the time without a speed, with the noise of the model itself. Series with more than 1500 values of the target use
// every second, third ... value for it. The other members have their default values.
LedgerRow row_of(const Model& model, const Series& data, std::size_t target = 0);

// Whether the likelihood ratio is chi^2 of errors of linear axes (effect_test.hpp). Their thresholds are quantiles,
// those of 2 ln B multiples of kLeastLikelihoodRatio.
bool is_of_axes(const LedgerRow& row);

}  // namespace ballbar
