#include "diagnosis/follow/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "ballbar/number_text.hpp"
#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kForecastSigmas = 2.0;  // width of the forecast of ln of odds to the planned end
constexpr double kTwinMoves = 0.2;       // change of ln of the odds over the last half of the values
constexpr double kTwinNow = 0.1;         // P of a rival that the readings cannot separate from the first

double log_odds(double p) {
  constexpr double kLeast = 1e-9;  // P is a sum of rounded shares
  const double held = std::clamp(p, kLeast, 1.0 - kLeast);
  return std::log(held / (1.0 - held));
}

double p_of(const Look& look, const std::string& label) {
  const auto at = std::find_if(look.hypotheses.begin(), look.hypotheses.end(),
                               [&](const Hypothesis& one) { return one.label == label; });
  return at == look.hypotheses.end() ? 0.0 : at->p;
}

double best_p(const Look& look) { return look.hypotheses.empty() ? 0.0 : look.hypotheses.front().p; }

// The last look with at most half of the values; looks.size() where there is none.
std::size_t look_of_half(const std::vector<Look>& looks) {
  for (std::size_t k = looks.size(); k-- > 0;) {
    if (2 * looks[k].values <= looks.back().values) return k;
  }
  return looks.size();
}

// Range (max - min) of ln of the odds of two labels since the look `half`.
double moved(const std::vector<Look>& looks, std::size_t half, const std::string& first, const std::string& other) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = half; k < looks.size(); ++k) {
    const double ratio = std::log(p_of(looks[k], first) / p_of(looks[k], other));
    if (!std::isfinite(ratio)) return std::numeric_limits<double>::infinity();
    low = std::min(low, ratio);
    high = std::max(high, ratio);
  }
  return high - low;
}

// Why another label is as good as the first; empty: there is none.
std::string why_not_the_first(const std::vector<Look>& looks, std::size_t half) {
  const Look& now = looks.back();
  if (now.p_nothing > kNothing || now.hypotheses.empty()) return "";
  const Hypothesis& first = now.hypotheses.front();
  for (const Hypothesis& other : now.hypotheses) {
    if (other.label == first.label) continue;
    if (other.once == first.once) {
      return fmt::format("No readings can distinguish {} from {}: the same values are logged twice.", first.label,
                         other.label);
    }
    if (half == looks.size() || other.p < kTwinNow || first.p >= 1.0 - kTwinNow) continue;
    if (moved(looks, half, first.label, other.label) < kTwinMoves) {
      return fmt::format(
          "The readings do not distinguish {} from {}: their odds stayed the same while the number of values doubled.",
          first.label, other.label);
    }
  }
  return "";
}

// The forecast for ln of odds with the values `now`, and `before` at an earlier time.
double at_most(double before, double now, double further) {
  const double gained = std::max(0.0, now - before);
  return now + further * gained + kForecastSigmas * std::sqrt((further * further + further) * (2.0 * gained + 1.0));
}

}  // namespace

double least_log_bayes_factor() { return std::log(static_cast<double>(kMostLooks) / kFalselyDecided); }

std::string why_it_stays_open(const FollowState& state) {
  const Look& now = state.looks.back();
  const std::size_t half = look_of_half(state.looks);
  if (!now.fault.empty() || !now.sure.empty()) return "";
  const std::string why = why_not_the_first(state.looks, half);
  if (!why.empty() || half == state.looks.size()) return why;
  const Look& then = state.looks[half];
  if (!state.planned_hours || 2.0 * now.hours < *state.planned_hours) return "";
  const double end_h = *state.planned_hours;
  if (!then.fault.empty() || !(now.hours > then.hours)) return "";
  if (now.hours >= end_h) return fmt::format("The planned end, {}, is over.", duration_text(3600.0 * end_h));
  const double further = (end_h - now.hours) / (now.hours - then.hours);
  const double most = at_most(then.log_bayes_factor, now.log_bayes_factor, further);
  if (most < least_log_bayes_factor()) {
    return fmt::format(
        "At this rate the readings will be at most {:.2g} times as likely with something missing as with nothing by "
        "the planned end, {}. A decision needs {:.0f} times.",
        std::exp(most), duration_text(3600.0 * end_h), std::exp(least_log_bayes_factor()));
  }
  if (now.hypotheses.empty()) return "";
  const double most_odds = at_most(log_odds(best_p(then)), log_odds(best_p(now)), further);
  if (most_odds >= log_odds(1.0 - kFalselyDecided)) return "";
  return fmt::format(
      "At this rate the probability of {}, the best candidate, will be at most {:.2f} by the planned end, {}. A "
      "decision needs {:.2f}.",
      now.hypotheses.front().label, 1.0 / (1.0 + std::exp(-most_odds)), duration_text(3600.0 * end_h),
      1.0 - kFalselyDecided);
}

}  // namespace ballbar
