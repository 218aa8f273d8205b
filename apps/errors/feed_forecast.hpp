// The feed at which a test that fails its tolerance would hold it, as a forecast of the fitted model.
//
// Servo mismatch is in proportion to the feed V: at the feed f the readings about the fitted centre would be
//
//   y_i(f) = y_i - k (1 - f / V_i) s_i,     C(f) = max y_i(f) - min y_i(f)
//
// s: its fitted curve; k = 1. C is convex, so that the feeds which hold the tolerance T are one interval; the forecast
// is its upper end, C(f) = T. All else is taken as it is at the feed of the test. Its sigma has two parts, that of the
// mismatch and that of the circularity:
//
//   sigma_f^2 = ((dC/dk sigma_m / m)^2 + sigma_C^2) / (dC/df)^2
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ballbar/circle/recording.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"

namespace ballbar {

struct FeedForecast {
  double tolerance_um = 0.0;
  double circularity_without_um = 0.0;    // C(0): without servo mismatch
  std::optional<double> feed_mm_per_min;  // nullopt: no feed holds the tolerance
  double sigma_mm_per_min = 0.0;
};

// nullopt: the tolerance holds, a feed is not stated, or servo mismatch is not significant or does not add to the
// circularity.
std::optional<FeedForecast> feed_forecast(const MachineErrors& found, std::span<const Recording> recordings,
                                          double tolerance_um);

// "At 600 ± 60 mm/min the circularity would be 6 um, if ...": one sentence.
std::string forecast_text(const FeedForecast& forecast);

}  // namespace ballbar
