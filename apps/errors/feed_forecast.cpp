#include "errors/feed_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/units.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// The readings about the fitted centre, with what servo mismatch adds to each.
struct ServoTrace {
  std::vector<double> y_um, s_um, feed_mm_per_min;

  double circularity_um(double feed, double k = 1.0) const {
    double least = y_um.front() - k * (1.0 - feed / feed_mm_per_min.front()) * s_um.front(), most = least;
    for (std::size_t i = 1; i < y_um.size(); ++i) {
      const double y = y_um[i] - k * (1.0 - feed / feed_mm_per_min[i]) * s_um[i];
      least = std::min(least, y);
      most = std::max(most, y);
    }
    return most - least;
  }
};

ServoTrace servo_trace(const MachineErrors& found, const Effect& servo, std::span<const Recording> recordings) {
  ServoTrace trace;
  trace.s_um = curve_of(found, &servo, recordings);
  trace.y_um = found.freed_um;
  for (const Recording& one : recordings)
    trace.feed_mm_per_min.insert(trace.feed_mm_per_min.end(), one.length_mm.size(), *one.feed_mm_per_min);
  return trace;
}

// Where the convex C is least between 0 and `most`, to 1e-6 of it.
double best_feed(const ServoTrace& trace, double most) {
  double low = 0.0, high = most;
  while (high - low > 1e-6 * most) {
    const double third = (high - low) / 3.0;
    if (trace.circularity_um(low + third) <= trace.circularity_um(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<FeedForecast> feed_forecast(const MachineErrors& found, std::span<const Recording> recordings,
                                          double tolerance_um) {
  if (found.circularity_um <= tolerance_um) return std::nullopt;
  const auto servo = std::find_if(found.ranked.begin(), found.ranked.end(), [](const RankedError& one) {
    return one.significant && one.rank && grows_with_feed(*one.effect);
  });
  const bool states_feeds =
      std::all_of(recordings.begin(), recordings.end(), [](const Recording& one) { return one.feed_mm_per_min > 0.0; });
  if (servo == found.ranked.end() || !states_feeds) return std::nullopt;
  const ServoTrace trace = servo_trace(found, *servo->effect, recordings);
  const double most = *std::max_element(trace.feed_mm_per_min.begin(), trace.feed_mm_per_min.end());
  FeedForecast forecast{tolerance_um, trace.circularity_um(0.0), std::nullopt, 0.0};
  double holds = best_feed(trace, most), fails = most;
  if (trace.circularity_um(holds) > tolerance_um) return forecast;
  if (trace.circularity_um(fails) <= tolerance_um) return std::nullopt;
  while (fails - holds > 1e-6 * most) {
    const double middle = 0.5 * (holds + fails);
    (trace.circularity_um(middle) <= tolerance_um ? holds : fails) = middle;
  }
  const double step = 1e-3, step_feed = step * most;
  const MachineError& mismatch = found.errors[servo->rows.front()];
  const double per_k =
      (trace.circularity_um(holds, 1.0 + step) - trace.circularity_um(holds, 1.0 - step)) / (2.0 * step);
  const double per_feed =
      (trace.circularity_um(holds + step_feed) - trace.circularity_um(holds - step_feed)) / (2.0 * step_feed);
  const double sigma_circularity_um = std::sqrt(2.0) * std::hypot(found.noise.white_um, found.noise.correlated_um);
  forecast.feed_mm_per_min = holds;
  forecast.sigma_mm_per_min = std::hypot(per_k * mismatch.sigma / mismatch.value, sigma_circularity_um) / per_feed;
  return forecast;
}

std::string forecast_text(const FeedForecast& forecast) {
  if (!forecast.feed_mm_per_min) {
    return fmt::format(
        "No feed would hold {:g} um: without servo mismatch the circularity would be {:.1f} um (forecast of the "
        "fitted model).",
        forecast.tolerance_um, forecast.circularity_without_um);
  }
  return fmt::format(
      "At {} mm/min the circularity would be {:g} um, if servo mismatch is its only part that grows with the "
      "feed (forecast of the fitted model).",
      with_sigma(*forecast.feed_mm_per_min, forecast.sigma_mm_per_min, 0), forecast.tolerance_um);
}

}  // namespace ballbar
