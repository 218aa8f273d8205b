#include "diagnose/effect_test_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/internal/numerics/range.hpp"
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
std::string effect_words(const EffectTest& effect_test, const Candidate& tried) {
  const double size_um = std::min(tried.amplitude_um, range_of(effect_test.fit_after.measured_um));
  if (!(size_um > 0.0)) return tried.label;
  return fmt::format("{}, {} um of {}", tried.label, size_text(size_um), effect_test.after.target);
}

// "The data support expansion(T_room_degC), 14 um of z_um"
std::string first_words(const EffectTest& effect_test, bool supported) {
  std::vector<std::string> texts;
  texts.reserve(effect_test.added.size());
  for (const Candidate& tried : effect_test.added) texts.push_back(effect_words(effect_test, tried));
  const std::string_view all = supported || texts.size() == 1 ? "" : texts.size() == 2 ? "both " : "all of ";
  return fmt::format("The data {} {}{}", supported ? "support" : "do not support", all, enumeration(texts));
}

std::string error_words(const EffectTest& effect_test) {
  const std::string before = size_text(effect_test.before.rmse_um), after = size_text(effect_test.after.rmse_um);
  if (before == after) return fmt::format("The remaining error stays at {} um.", before);
  return fmt::format("The remaining error {} from {} to {} um.",
                     effect_test.after.rmse_um < effect_test.before.rmse_um ? "falls" : "rises", before, after);
}

}  // namespace

std::string enumeration(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  const auto last = names.end() - 1;
  return fmt::format("{}{}{}", fmt::join(names.begin(), last, ", "), names.size() > 1 ? " and " : "", *last);
}

std::string freed_text(const EffectTest& effect_test) {
  return effect_test.freed ? fmt::format("{} of {}", effect_test.freed->parameter, effect_test.freed->effect) : "";
}

std::string conclusion(const EffectTest& effect_test) {
  std::vector<std::string> doubts;
  for (const Candidate& tried : effect_test.added) {
    if (tried.doubts.empty()) continue;
    doubts.push_back(fmt::format("{}{}", effect_test.added.size() == 1 ? "" : tried.label + ": ",
                                 fmt::join(doubt_texts(tried), ", ")));
  }
  std::string text = fmt::format("{}. {}", first_words(effect_test, doubts.empty()), error_words(effect_test));
  if (!effect_test.beside.empty()) {
    text += fmt::format(" The test and the amplitude assume that {} {} missing as well.",
                        enumeration(effect_test.beside), effect_test.beside.size() == 1 ? "is" : "are");
  }
  if (effect_test.freed) {
    text += fmt::format(" The test and the amplitude assume another {} than the model holds.", freed_text(effect_test));
  }
  if (!doubts.empty()) return fmt::format("{} Why not: {}.", text, fmt::join(doubts, "; "));
  const bool is_one = effect_test.added.size() == 1;
  const auto is_of_time = [](const Candidate& tried) { return tried.bound.effect->time_only; };
  if (std::any_of(effect_test.added.begin(), effect_test.added.end(), is_of_time)) {
    text += fmt::format(" {} on time alone. One run cannot prove it as a cause.",
                        is_one ? effect_test.added.front().label + " depends" : "One of them depends");
  }
  const Whiteness white = whiteness(effect_test.fit_after);
  const bool knows_noise = !effect_test.fit_after.floor.source.empty();
  if (effect_test.beside.empty() && !effect_test.freed && !is_adequate(effect_test.fit_after, white) &&
      (knows_noise || white.p < kNotNoise)) {
    const std::string_view these = is_one ? "this effect" : "these effects";
    text +=
        white.p < kNotNoise
            ? fmt::format(" The residual is not noise: another effect is missing, which {} may partly imitate.", these)
            : fmt::format(
                  " The residual is larger than the noise: slow noise, or another effect that {} "
                  "partly imitates.",
                  these);
  }
  return text;
}

std::string tables(const EffectTest& effect_test, bool details) {
  std::string text;
  for (const Candidate& tried : effect_test.added) {
    if (const std::string coefficient = coefficient_text(tried); !coefficient.empty())
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
