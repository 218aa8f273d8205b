// The story of a model: one row a revision, what it changed, what it bought, and whether the data demanded it.
//
// A falling error alone is no evidence: every row also carries 2 ln B, the value from which that counts, and
// the fall that a surrogate effect would have bought, where these are known.
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
  Level level = Level::series;              // of the model
  std::string target;                       // which the figures are of
  std::vector<std::string> data;            // files, as they were named
  std::size_t parameters = 0;               // free ones
  double rmse_um = 0.0;                     // of the fit to all rows
  double times_floor = kUnknown;            // RMSE over the floor
  double held_out_um = kUnknown;            // RMSE of cycles (recordings) left out, each predicted from the others
  double likelihood_ratio = kUnknown;       // 2 ln B of the change (effect_test.hpp)
  double threshold = kUnknown;              // from which that counts
  double best_surrogate_fall = kUnknown;    // relative fall of the RMSE by the best of 200 surrogates
  double forecast_um = kUnknown;            // RMSE of rows forecast from earlier ones alone (growth.hpp)
  double surrogate_forecast_um = kUnknown;  // the same with as many surrogates in place of the effects
  double discrepancy_um = kUnknown;         // standard deviation of the slow curve that is left, of grown models
  // "start", "named", "supported", "time only", "not supported"; of grown models "driver known": what drives it is, its
  // form is not; "empirical": it predicts, no cause is claimed; "by hand": who keeps the model wants it so, no test of
  // it
  std::string verdict = "start";
  std::vector<std::string> still_needed, no_longer_needed;  // labels of earlier effects, tested anew
};

// Figures of a model that is fitted to all rows. held_out_um: cycles are stretches between changes of speed (without
// one, five parts of the time), the noise that of the model itself; series with more than 1500 values of the target by
// every second, third ... value. The rest is as of a model that starts.
LedgerRow row_of(const Model& model, const Series& data, std::size_t target = 0);

// "Revision 2 added lagged_expansion(T16_degC). RMSE 12.3 -> 3.1 um (4.0 -> 1.0 times the noise), left-out cycles
// 14.0 -> 3.9 um. 2 ln B is 431.2 (threshold 10.0). A random curve lowers the RMSE by up to 27 %.
// speed_heating(speed_rpm) is still needed." Without figures from before where `before` is nullptr or of another
// target or other data; of recordings "left-out recordings".
std::string sentence(const LedgerRow& row, const LedgerRow* before);

}  // namespace ballbar
