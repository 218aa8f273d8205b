#include "history/event_texts.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "history/quantity_series.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostNamed = 3;

std::string signed_number(double value, std::string_view unit) {
  return fmt::format("{:+.{}f}", value, decimals_in(unit));
}

Message quantity_of(const AllSeries& all, const Call& call) {
  return ballbar::quantity_of(series_of(all, call).name, series_of(all, call).plane);
}

// "squareness XY +26.9 ± 1.0 um/m, ... and 3 more"; `place`: the message of one.
template <class Place>
MessageValue list_of(const AllSeries& all, const Event& event, Place place, bool is_signed) {
  std::vector<MessageValue> quantities;
  const std::size_t named = std::min(kMostNamed, event.calls.size());
  for (std::size_t i = 0; i < named; ++i) {
    const Call& call = *event.calls[i];
    const std::string_view unit = series_of(all, call).unit;
    quantities.emplace_back(place(
        quantity_of(all, call),
        is_signed ? fmt::format("{} ± {:.{}f} {}", signed_number(call.size, unit), call.sigma, decimals_in(unit), unit)
                  : amount_text(call.size, call.sigma, unit)));
  }
  const Paragraph list = listed(quantities);
  return event.calls.size() > named ? messages::and_more(list, event.calls.size() - named) : MessageValue(list);
}

// Of the clearest quantity that has an effect.
const Effect* effect_of(const AllSeries& all, const Event& event) {
  for (const Call* call : event.calls) {
    const Effect* effect = kind_of(series_of(all, *call).name, series_of(all, *call).plane).effect;
    if (effect != nullptr) return effect;
  }
  return nullptr;
}

Message remedy_of(const AllSeries& all, const Event& event, const Message& otherwise) {
  const Effect* effect = effect_of(all, event);
  return effect == nullptr || effect->explanation.remedy.empty()
             ? otherwise
             : effect_text(name_of(effect->level), effect->name, "remedy", effect->explanation.remedy);
}

std::string letter_of(int axis) { return {"XYZ"[axis]}; }

// um over mm, as parts per million.
std::string scale_text(const AllSeries& all, const Event& event) {
  const Call& call = *event.calls.front();
  const QuantitySeries& series = series_of(all, call);
  const double factor = series.unit == "um" ? 1e3 / series.radius_mm : 1.0;
  return fmt::format("{} ± {:.1f} um/m", signed_number(factor * call.size, "um/m"), factor * call.sigma);
}

EventTexts step_texts(const AllSeries& all, const Event& event) {
  const std::string from = day_text(event.from_s), to = day_text(event.to_s);
  if (event.is_common_scale)
    return {messages::scales_stepped(scale_text(all, event), from, to), messages::scales_stepped_do()};
  const std::size_t n = event.calls.size();
  const MessageValue quantities = list_of(all, event, messages::quantity_amount, true);
  const Message remedy = remedy_of(all, event, messages::stepped_do());
  if (!event.to_the_worse) {
    return {n > 1 ? messages::quantities_stepped(n, from, to, quantities)
                  : messages::quantity_stepped(from, to, quantities),
            remedy};
  }
  EventTexts texts{n > 1 ? messages::quantities_stepped_collision(n, from, to, quantities)
                         : messages::quantity_stepped_collision(from, to, quantities),
                   messages::collision_do()};
  texts.remedy += remedy;
  return texts;
}

EventTexts trend_texts(const AllSeries& all, const Event& event) {
  const Call& call = *event.calls.front();
  const bool grows = call.after == 0.0 ? call.size > 0.0 : call.size * call.after > 0.0;
  const MessageValue amounts = list_of(all, event, messages::quantity_amount, true);
  return {grows ? messages::quantity_grows(quantity_of(all, call), amounts)
                : messages::quantity_goes_back(quantity_of(all, call), amounts),
          remedy_of(all, event, messages::grows_do())};
}

EventTexts season_texts(const AllSeries& all, const Event& event) {
  constexpr std::array kMonths{messages::month_1, messages::month_2,  messages::month_3,  messages::month_4,
                               messages::month_5, messages::month_6,  messages::month_7,  messages::month_8,
                               messages::month_9, messages::month_10, messages::month_11, messages::month_12};
  const Call& call = *event.calls.front();
  const auto month = static_cast<std::size_t>(call.peak_year * 12.0) % kMonths.size();
  return {messages::follows_season(kMonths[month](), list_of(all, event, messages::quantity_by, false)),
          messages::follows_season_do()};
}

}  // namespace

std::string day_text(double time_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(std::floor(time_s))));
}

Message quantity_of(std::string_view name, Plane plane) {
  return messages::quantity_of_plane(EffectLabel{std::string(name)}, name_of(plane));
}

std::string amount_text(double value, double sigma, std::string_view unit) {
  const std::string of_sigma = std::isfinite(sigma) ? fmt::format(" ± {:.{}f}", sigma, decimals_in(unit)) : "";
  return fmt::format("{:.{}f}{} {}", value, decimals_in(unit), of_sigma, unit);
}

EventTexts texts_of(const AllSeries& all, const Event& event) {
  const std::string from = day_text(event.from_s), to = day_text(event.to_s);
  const auto bar = [](const std::string& name) {
    return name.empty() ? MessageValue(messages::bar_unnamed()) : MessageValue(name);
  };
  switch (event.kind) {
    case FindingKind::instrument:
      return {messages::bar_changed(scale_text(all, event), bar(event.bar_before), bar(event.bar_after), from, to),
              messages::bar_changed_do()};
    case FindingKind::replaced_part:
      return {messages::part_replaced(letter_of(*event.axis), from, to,
                                      list_of(all, event, messages::quantity_amount, true)),
              messages::part_replaced_do(letter_of(*event.axis))};
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
