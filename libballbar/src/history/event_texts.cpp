#include "history/event_texts.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "ballbar/internal/number_text.hpp"
#include "history/quantity_series.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostNamed = 3;

std::string signed_number(double value, std::string_view unit) {
  return fmt::format("{:+.{}f}", value, decimals_in(unit));
}

std::string label_of(const AllSeries& all, const Call& call) {
  return ballbar::label_of(series_of(all, call).name, series_of(all, call).plane);
}

// "squareness XY +26.9 ± 1.0 um/m, ... and 3 more"; `with`: between name and number.
std::string list_of(const AllSeries& all, const Event& event, std::string_view with, bool is_signed) {
  std::string text;
  const std::size_t named = std::min(kMostNamed, event.calls.size());
  for (std::size_t i = 0; i < named; ++i) {
    const Call& call = *event.calls[i];
    const std::string_view unit = series_of(all, call).unit;
    text += fmt::format(
        "{}{}{}{}", i == 0 ? "" : ", ", label_of(all, call), with,
        is_signed ? fmt::format("{} ± {:.{}f} {}", signed_number(call.size, unit), call.sigma, decimals_in(unit), unit)
                  : amount_text(call.size, call.sigma, unit));
  }
  if (event.calls.size() > named) text += fmt::format(" and {} more", event.calls.size() - named);
  return text;
}

std::string between(const Event& event) {
  return fmt::format("between {} and {}", day_text(event.from_s), day_text(event.to_s));
}

// Of the clearest quantity that has an effect.
const Effect* effect_of(const AllSeries& all, const Event& event) {
  for (const Call* call : event.calls) {
    const Effect* effect = kind_of(series_of(all, *call).name, series_of(all, *call).plane).effect;
    if (effect != nullptr) return effect;
  }
  return nullptr;
}

std::string remedy_of(const AllSeries& all, const Event& event, std::string_view otherwise) {
  const Effect* effect = effect_of(all, event);
  return effect == nullptr || effect->explanation.remedy.empty() ? std::string(otherwise) : effect->explanation.remedy;
}

char letter_of(int axis) { return "XYZ"[axis]; }

// um over mm, as parts per million.
std::string scale_text(const AllSeries& all, const Event& event) {
  const Call& call = *event.calls.front();
  const QuantitySeries& series = series_of(all, call);
  const double factor = series.unit == "um" ? 1e3 / series.radius_mm : 1.0;
  return fmt::format("{} ± {:.1f} um/m", signed_number(factor * call.size, "um/m"), factor * call.sigma);
}

EventTexts step_texts(const AllSeries& all, const Event& event) {
  if (event.is_common_scale) {
    return {fmt::format("The scales of all axes stepped alike, by {}, {}. Nothing else changed.",
                        scale_text(all, event), between(event)),
            "Check whether the bar was calibrated again, with which calibrator and at which temperature. Repeat the "
            "test with another bar before adjusting the machine."};
  }
  const bool several = event.calls.size() > 1;
  std::string sentence =
      fmt::format("{} stepped {}{}: {}{}.", several ? fmt::format("{} quantities", event.calls.size()) : "One quantity",
                  several ? "together " : "", between(event), list_of(all, event, " ", true),
                  event.to_the_worse ? ", as after a collision" : "");
  const std::string remedy = remedy_of(all, event, "Check what was done to the machine on these days, and test again.");
  if (!event.to_the_worse) return {std::move(sentence), remedy};
  return {std::move(sentence),
          "Ask about a collision on these days. Check guideways, clamping and levelling. " + remedy};
}

EventTexts trend_texts(const AllSeries& all, const Event& event) {
  const Call& call = *event.calls.front();
  const bool grows = call.after == 0.0 ? call.size > 0.0 : call.size * call.after > 0.0;
  return {fmt::format("{} {}: {} per year.", label_of(all, call), grows ? "grows" : "goes back",
                      list_of(all, event, " ", true)),
          remedy_of(all, event, "Find which error makes it grow: ballbar history shows them one by one.")};
}

EventTexts season_texts(const AllSeries& all, const Event& event) {
  constexpr std::array kMonths{"January", "February", "March",     "April",   "May",      "June",
                               "July",    "August",   "September", "October", "November", "December"};
  const Call& call = *event.calls.front();
  const auto month = static_cast<std::size_t>(call.peak_year * 12.0) % kMonths.size();
  return {
      fmt::format("Follows the season, highest in {}, to either side of the mean: {}. This is neither wear nor a step.",
                  kMonths[month], list_of(all, event, " by ", false)),
      "No repair is needed. Keep the hall's temperature steady, or compare with tests of the same month."};
}

}  // namespace

std::string day_text(double time_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(std::floor(time_s))));
}

std::string label_of(std::string_view name, Plane plane) { return fmt::format("{} {}", name, name_of(plane)); }

std::string amount_text(double value, double sigma, std::string_view unit) {
  const std::string of_sigma = std::isfinite(sigma) ? fmt::format(" ± {:.{}f}", sigma, decimals_in(unit)) : "";
  return fmt::format("{:.{}f}{} {}", value, decimals_in(unit), of_sigma, unit);
}

EventTexts texts_of(const AllSeries& all, const Event& event) {
  switch (event.kind) {
    case FindingKind::instrument:
      return {
          fmt::format("The scales of all axes stepped alike, by {}, when the bar changed from {} to {} {}. Nothing "
                      "else changed. The cause is the instrument, not the machine.",
                      scale_text(all, event), event.bar_before.empty() ? "one unnamed" : event.bar_before,
                      event.bar_after.empty() ? "one unnamed" : event.bar_after, between(event)),
          "Do not adjust the machine. Calibrate both bars on one calibrator and correct the scales by the difference."};
    case FindingKind::replaced_part:
      return {fmt::format("Errors of {} decreased together {}: {}. A part of that axis was replaced or adjusted.",
                          letter_of(*event.axis), between(event), list_of(all, event, " ", true)),
              fmt::format(
                  "Record the repair and check the pitch compensation of {}. Later tests show the machine's new state.",
                  letter_of(*event.axis))};
    case FindingKind::trend:
      return trend_texts(all, event);
    case FindingKind::season:
      return season_texts(all, event);
    case FindingKind::step:
      break;
  }
  return step_texts(all, event);
}

}  // namespace ballbar
