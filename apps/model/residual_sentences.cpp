#include "model/residual_sentences.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// "-3.1 ± 0.4": two digits of sigma where its first is 1, else one.
std::string bias_text(double value, double sigma) {
  if (!(sigma > 0.0) || !std::isfinite(sigma)) return fmt::format("{:.3g}", value);
  const double first = sigma / std::pow(10.0, std::floor(std::log10(sigma)));
  const int decimals = decimals_showing(first < 1.95 ? 2 : 1, sigma);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, sigma, decimals);
}

// Three digits, whole micrometres above 1000, exponents for absurd values.
std::string digits(double value_um) {
  return value_um < 999.5 || value_um >= 1e9 ? fmt::format("{:.3g}", value_um) : fmt::format("{:.0f}", value_um);
}

// What an engineer reads first; how the noise is known comes after that.
Paragraph error_against_noise(const Fit& fit) {
  const double noise_um = fit.floor.rms_um;
  const std::string error = digits(fit.rmse_um);
  Paragraph text;
  if (!(noise_um > 0.0) || fit.floor.source.empty()) {
    text += messages::remaining_error_unknown_noise(error);
    text += messages::noise_unknown();
    return text;
  }
  const double ratio = fit.rmse_um / noise_um;
  const std::string times =
      ratio < 1e6 ? fmt::format("{:.{}f}", ratio, ratio < 2.0 ? 2 : 1) : fmt::format("{:.1e}", ratio);
  text += ratio < 1.05 ? messages::remaining_error_noise(error) : messages::remaining_error_times(error, times);
  text += messages::noise_is(digits(noise_um), fit.floor.source);
  return text;
}

Message where_worst(const Fit& fit, const std::vector<Misfit>& where) {
  const std::optional<Misfit> worst = worst_place(fit, where);
  if (!worst) return messages::fails_evenly();
  const auto n = static_cast<double>(fit.residual_um.size() - fit.discounted.size());
  return messages::fails_most_share(misfit_place(*worst), fmt::format("{:.0f}", 100.0 * worst->share),
                                    fmt::format("{:.0f}", 100.0 * static_cast<double>(worst->n) / n),
                                    bias_text(worst->bias_um, worst->bias_sigma_um));
}

std::string duration(double time_s) {
  if (time_s < 90.0) return fmt::format("{:.2g} s", time_s);
  const double time_min = min_from_s(time_s);
  return time_min < 100.0 ? fmt::format("{:.2g} min", time_min) : fmt::format("{:.1f} h", time_min / 60.0);
}

Message residual_sentence(const Fit& fit, const Whiteness& whiteness) {
  const std::string p = p_equals_text(whiteness.p);
  const ResidualNature nature = residual_nature(fit, whiteness);
  const std::string slow = duration(nature.correlation_time_s);
  switch (nature.kind) {
    case ResidualKind::too_few:
      return messages::residual_too_few(fit.residual_um.size() - fit.discounted.size());
    case ResidualKind::not_noise:
      return messages::residual_not_noise(p);
    case ResidualKind::slow_not_noise:
      return messages::residual_not_noise_slow(p, slow);
    case ResidualKind::slow:
      return messages::residual_slow(slow, p);
    case ResidualKind::noise:
      break;
  }
  return messages::residual_noise(p);
}

}  // namespace

Message misfit_place(const Misfit& group) {
  if (group.what == "regime") {
    if (group.from == name_of(Regime::after_change)) return messages::place_after_change();
    if (group.from == name_of(Regime::standstill)) return messages::place_standstill();
    if (group.from == name_of(Regime::warming)) return messages::place_warming();
    return group.from == name_of(Regime::steady) ? messages::place_steady() : messages::place_cooling();
  }
  const bool of_time = group.what == "time";
  if (group.from == group.to)
    return of_time ? messages::place_at(group.to) : messages::place_where_at(group.what, group.to);
  const std::size_t unit = group.from.rfind(' '), other = group.to.rfind(' ');
  const bool same =
      unit != std::string::npos && other != std::string::npos && group.from.substr(unit) == group.to.substr(other);
  const std::string from = same ? group.from.substr(0, unit) : group.from;
  return of_time ? messages::place_from_to(from, group.to) : messages::place_where_from_to(group.what, from, group.to);
}

std::vector<Paragraph> sentences(const Fit& fit, const std::vector<Misfit>& where, const Whiteness& whiteness) {
  return {error_against_noise(fit), where_worst(fit, where), residual_sentence(fit, whiteness)};
}

}  // namespace ballbar
