#include "errors/quantity_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ctime>
#include <utility>

#include "ballbar/message_catalogue.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

bool is_letter(char sign) { return std::isalnum(static_cast<unsigned char>(sign)) != 0; }

}  // namespace

std::string date_text(double time_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(std::floor(time_s))));
}

std::string iso_date_text(std::int64_t time_s) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(time_s)));
}

std::string several(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string signed_text(double value, int decimals) {
  const std::string text = fixed(value, decimals);
  return text.starts_with('-') ? text : '+' + text;
}

Message error_of(std::string_view effect, Plane plane, FirstLetter first) {
  std::string axis;
  if (effect.ends_with("_a") || effect.ends_with("_b")) {
    axis = name_of(plane)[effect.back() == 'a' ? 0 : 1];
    effect.remove_suffix(2);
  }
  EffectLabel label{std::string(effect), std::string(effect)};
  std::replace(label.english.begin(), label.english.end(), '_', ' ');
  char& letter = label.english.front();
  if (first == FirstLetter::capital) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return axis.empty() ? messages::effect(std::move(label)) : messages::error_of_axis(std::move(label), axis);
}

std::string plain_name(std::string_view effect, Plane plane) { return text_of(error_of(effect, plane)); }

std::string with_axes(std::string_view summary, Plane plane) {
  const std::string_view axes = name_of(plane);
  std::string text(summary);
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool alone = (k == 0 || !is_letter(text[k - 1])) && (k + 1 == text.size() || !is_letter(text[k + 1]));
    if (alone && (text[k] == 'A' || text[k] == 'B')) text[k] = axes[text[k] == 'A' ? 0 : 1];
  }
  return text;
}

Message summary_of(const Effect& effect, Plane plane) {
  Message text = effect_text(name_of(effect.level), effect.name, "summary",
                             within_sentence(with_axes(effect.explanation.summary, plane)));
  const std::string_view axes = name_of(plane);
  text.values = {{"a", axes.substr(0, 1)}, {"b", axes.substr(1, 1)}};
  return text;
}

std::string within_sentence(std::string sentence) {
  const auto is_capital = [](char sign) { return std::isupper(static_cast<unsigned char>(sign)) != 0; };
  if (sentence.ends_with('.')) sentence.pop_back();
  if (sentence.size() > 1 && !is_capital(sentence[1]))
    sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
  return sentence;
}

Paragraph message_of(const NextMeasurement& next) {
  return next.measurement == Measurement::other_direction ? messages::measure_other_direction()
         : next.measurement == Measurement::full_circle   ? messages::measure_full_circle()
                                                          : messages::measure_another_feed();
}

}  // namespace ballbar
