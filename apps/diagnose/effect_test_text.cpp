#include "diagnose/effect_test_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/message_catalogue.hpp"
#include "diagnose/doubt_text.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kNotNoise = 0.01;  // as the sentences of fit.hpp

std::string known(double value, int decimals) { return std::isfinite(value) ? fixed(value, decimals) : "-"; }

Table figures(const EffectTest& effect_test) {
  const LedgerRow &before = effect_test.before, &after = effect_test.after;
  const int decimals = decimals_showing(3, std::min(before.rmse_um, after.rmse_um));
  Table table({"", "before", "after"});
  const auto row = [&](const std::string& what, double from, double to, int digits) {
    table.add({what, known(from, digits), known(to, digits)});
  };
  row("RMSE um", before.rmse_um, after.rmse_um, decimals);
  row("times the noise", before.times_floor, after.times_floor, 2);
  row(before.level == Level::recording ? "left-out recordings um" : "left-out cycles um", before.held_out_um,
      after.held_out_um, decimals);
  row("free parameters", static_cast<double>(before.parameters), static_cast<double>(after.parameters), 0);
  return table;
}

Table added_table(const EffectTest& effect_test) {
  Table table(
      {"added effect", "amplitude um", is_of_axes(effect_test.after) ? "chi^2" : "2 ln B", "threshold", "RMSE fall %"});
  const double fall = 1.0 - effect_test.after.rmse_um / effect_test.before.rmse_um;
  for (const Candidate& tried : effect_test.added) {
    const int decimals = decimals_showing(3, tried.amplitude_um);
    table.add({one_line(tried.label),
               std::isfinite(tried.amplitude_sigma_um)
                   ? with_sigma(tried.amplitude_um, tried.amplitude_sigma_um, decimals)
                   : fixed(tried.amplitude_um, decimals),
               fixed(tried.likelihood_ratio, 1), known(tried.threshold, 1),
               effect_test.added.size() == 1 ? known(100.0 * fall, 0) : "-"});
  }
  return table;
}

Table earlier_table(const EffectTest& effect_test) {
  const bool of_axes = is_of_axes(effect_test.after);
  Table table({"earlier effect", of_axes ? "chi^2" : "2 ln B", "parameters", of_axes ? "p" : "probability superfluous",
               "needed"});
  for (const DropTest& drop_test : effect_test.earlier) {
    table.add({one_line(drop_test.label), fixed(drop_test.likelihood_ratio, 1), fmt::format("{}", drop_test.parameters),
               p_text(drop_test.p), drop_test.needed ? "yes" : "no"});
  }
  return table;
}

// As the test of the added effects has it, which is what `diagnose` says of them; else as the fit has it.
const FittedParameter& tested(const FittedParameter& fitted, const EffectTest& effect_test) {
  for (const FittedParameter& parameter : effect_test.parameters) {
    if (parameter.effect == fitted.effect && parameter.name == fitted.name) return parameter;
  }
  return fitted;
}

Table parameter_table(const EffectTest& effect_test) {
  Table table({"effect", "parameter", "before", "after", "unit"});
  for (std::size_t k = 0; k < effect_test.fit_after.parameters.size(); ++k) {
    const FittedParameter& after = effect_test.fit_after.parameters[k];
    if (k == 0 && after.state == ParameterState::held && after.value == 0.0) continue;  // recordings have none
    if (after.shape_of == ShapeOf::recording) continue;
    const auto same = [&](const FittedParameter& p) { return p.effect == after.effect && p.name == after.name; };
    const std::vector<FittedParameter>& all = effect_test.fit_before.parameters;
    const auto before = std::find_if(all.begin(), all.end(), same);
    table.add({one_line(after.effect), one_line(after.name), before == all.end() ? "-" : value_text(*before),
               value_text(tested(after, effect_test)), one_line(after.unit)});
  }
  return table;
}

// "expansion(T_room_degC), 14 um of z_um". An effect that another one partly cancels is no larger than what was
// measured.
Message with_size(const EffectTest& effect_test, const Candidate& tried) {
  const double size_um = std::min(tried.amplitude_um, range_of(effect_test.fit_after.measured_um));
  if (!(size_um > 0.0)) return messages::effect(EffectLabel{tried.label});
  return messages::effect_sized(EffectLabel{tried.label}, size_text(size_um), effect_test.after.target);
}

Message first_sentence(const EffectTest& effect_test, bool supported) {
  std::vector<MessageValue> effects;
  effects.reserve(effect_test.added.size());
  for (const Candidate& tried : effect_test.added) effects.emplace_back(with_size(effect_test, tried));
  if (supported) return messages::data_support(enumerated(effects));
  return effects.size() == 1   ? messages::data_do_not_support(enumerated(effects))
         : effects.size() == 2 ? messages::data_do_not_support_both(enumerated(effects))
                               : messages::data_do_not_support_all(enumerated(effects));
}

Message error_sentence(const EffectTest& effect_test) {
  const std::string before = size_text(effect_test.before.rmse_um), after = size_text(effect_test.after.rmse_um);
  if (before == after) return messages::error_stays(before);
  return effect_test.after.rmse_um < effect_test.before.rmse_um ? messages::error_falls(before, after)
                                                                : messages::error_rises(before, after);
}

}  // namespace

std::string freed_text(const EffectTest& effect_test) {
  return effect_test.freed ? fmt::format("{} of {}", effect_test.freed->parameter, effect_test.freed->effect) : "";
}

Paragraph conclusion(const EffectTest& effect_test) {
  const bool is_one = effect_test.added.size() == 1;
  std::vector<MessageValue> doubts;
  for (const Candidate& tried : effect_test.added) {
    if (tried.doubts.empty()) continue;
    const std::vector<Paragraph> all = doubts_of(tried);
    const Paragraph of_effect = listed({all.begin(), all.end()});
    doubts.emplace_back(is_one ? of_effect : messages::doubts_of_effect(EffectLabel{tried.label}, of_effect));
  }
  Paragraph text = first_sentence(effect_test, doubts.empty());
  text += error_sentence(effect_test);
  if (!effect_test.beside.empty())
    text += messages::test_beside(enumerated(effects_of(effect_test.beside)), effect_test.beside.size());
  if (effect_test.freed)
    text += messages::test_frees(effect_test.freed->parameter, EffectLabel{effect_test.freed->effect});
  if (!doubts.empty()) {
    text += messages::why_not(semicolon_list(doubts));
    return text;
  }
  const auto is_of_time = [](const Candidate& tried) { return tried.bound.effect->time_only; };
  if (std::any_of(effect_test.added.begin(), effect_test.added.end(), is_of_time)) {
    text += is_one ? messages::one_of_time_alone(EffectLabel{effect_test.added.front().label})
                   : messages::some_of_time_alone();
    text += messages::one_run_proves_no_cause();
  }
  const Whiteness white = whiteness(effect_test.fit_after);
  const bool knows_noise = !effect_test.fit_after.floor.source.empty();
  if (effect_test.beside.empty() && !effect_test.freed && !is_adequate(effect_test.fit_after, white) &&
      (knows_noise || white.p < kNotNoise)) {
    const std::size_t n = effect_test.added.size();
    text += white.p < kNotNoise ? messages::another_is_missing(n) : messages::another_may_be_missing(n);
  }
  return text;
}

std::string tables(const EffectTest& effect_test, bool details) {
  std::string text;
  for (const Candidate& tried : effect_test.added) {
    if (const std::string coefficient = text_of(coefficient_of(tried)); !coefficient.empty())
      text += wrapped(fmt::format("{}: {}{} um.", tried.label, coefficient, size_text(tried.amplitude_um)));
  }
  if (!text.empty()) text += "\n";
  text += figures(effect_test).text(table_width()) + "\n" + added_table(effect_test).text(table_width());
  if (!details) return text;
  if (!effect_test.earlier.empty()) text += "\n" + earlier_table(effect_test).text(table_width());
  text += "\n" + parameter_table(effect_test).text(table_width());
  if (is_of_axes(effect_test.after)) {
    return text + "\n" +
           wrapped(
               "Each error has its value beside all errors of the axes; sigma is by the noise that these leave "
               "together. chi^2: of all gains of the error together. threshold: what noise reaches in 1 % of tests. An "
               "earlier error is needed where p is below 0.001. left-out recordings: CCW predicted from CW and the "
               "other way round.");
  }
  return text + "\n" +
         wrapped(fmt::format(
             "2 ln B: 10 means that the readings are 150 times as likely with the effect, whatever its gain and shape. "
             "It holds for an effect chosen before looking at these data. An earlier effect is needed where the "
             "probability that it is superfluous is below {}.",
             kDropTest));
}

}  // namespace ballbar
