#include "diagnose/effect_test_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/fit/residual.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"
#include "terminal/json_number.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kWidest = 120;  // of a table
constexpr double kNotNoise = 0.01;    // as the sentences of residual.hpp

std::string known(double value, int decimals) { return std::isfinite(value) ? fixed(value, decimals) : "-"; }

std::string percent(double share) { return std::isfinite(share) ? fmt::format("{:.0f}", 100.0 * share) : "-"; }

// Three digits.
int digits_of(double value) {
  if (!(std::abs(value) > 0.0) || !std::isfinite(value)) return 2;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 6);
}

Table figures(const Trial& trial) {
  const LedgerRow &before = trial.before, &after = trial.after;
  const int decimals = digits_of(std::min(before.rmse_um, after.rmse_um));
  Table table({"", "before", "after"});
  const auto row = [&](const std::string& what, double from, double to, int digits) {
    table.add({what, known(from, digits), known(to, digits)});
  };
  row("RMSE um", before.rmse_um, after.rmse_um, decimals);
  row("times the floor", before.times_floor, after.times_floor, 2);
  row(before.level == Level::recording ? "left-out recordings um" : "left-out cycles um", before.held_out_um,
      after.held_out_um, decimals);
  row("free parameters", static_cast<double>(before.parameters), static_cast<double>(after.parameters), 0);
  return table;
}

Table added_table(const Trial& trial) {
  Table table({"added", "amplitude um", "evidence", "counts from", "fall %", "best fake's %"});
  const double fall = 1.0 - trial.after.rmse_um / trial.before.rmse_um;
  for (const Candidate& tried : trial.added) {
    table.add({shortened(tried.label, 44),
               std::isfinite(tried.amplitude_sigma_um)
                   ? with_sigma(tried.amplitude_um, tried.amplitude_sigma_um, digits_of(tried.amplitude_um))
                   : fixed(tried.amplitude_um, digits_of(tried.amplitude_um)),
               fixed(tried.evidence, 1), fixed(kFewestEvidence, 1), trial.added.size() == 1 ? percent(fall) : "-",
               percent(tried.best_fake_fall)});
  }
  return table;
}

std::string p_text(double p) { return p < 1e-6 ? "< 0.000001" : fmt::format("{:.2g}", p); }

Table earlier_table(const Trial& trial) {
  Table table({"earlier", "evidence", "parameters", "p to stay", "needed"});
  for (const Stay& stay : trial.earlier) {
    table.add({shortened(stay.label, 44), fixed(stay.evidence, 1), fmt::format("{}", stay.parameters), p_text(stay.p),
               stay.needed ? "yes" : "no"});
  }
  return table;
}

Table parameter_table(const Trial& trial) {
  Table table({"effect", "parameter", "before", "after", "unit"});
  for (std::size_t k = 0; k < trial.fit_after.parameters.size(); ++k) {
    const FittedParameter& after = trial.fit_after.parameters[k];
    if (k == 0 && after.state == ParameterState::held && after.value == 0.0) continue;  // recordings have none
    if (after.shape_of == ShapeOf::recording) continue;
    const auto same = [&](const FittedParameter& p) { return p.effect == after.effect && p.name == after.name; };
    const std::vector<FittedParameter>& all = trial.fit_before.parameters;
    const auto before = std::find_if(all.begin(), all.end(), same);
    table.add({shortened(after.effect, 44), shortened(after.name, 30), before == all.end() ? "-" : value_text(*before),
               value_text(after), shortened(after.unit, 12)});
  }
  return table;
}

nlohmann::ordered_json parameters_of(const std::string& label, const Fit& fit) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const FittedParameter& parameter : fit.parameters) {
    if (parameter.effect != label) continue;
    json.push_back({{"name", parameter.name},
                    {"value", parameter.value},
                    {"sigma", number(parameter.sigma)},
                    {"unit", parameter.unit}});
  }
  return json;
}

nlohmann::ordered_json figures_json(const LedgerRow& row) {
  return {{"parameters", row.parameters},
          {"rmse_um", number(row.rmse_um)},
          {"times_floor", number(row.times_floor)},
          {"held_out_um", number(row.held_out_um)}};
}

}  // namespace

std::string conclusion(const Trial& trial) {
  std::vector<std::string> labels, doubts;
  for (const Candidate& tried : trial.added) {
    labels.push_back(tried.label);
    if (tried.doubts.empty()) continue;
    doubts.push_back(
        fmt::format("{}{}", trial.added.size() == 1 ? "" : tried.label + ": ", fmt::join(tried.doubts, ", ")));
  }
  const std::string names = fmt::format("{}", fmt::join(labels, ", "));
  if (!doubts.empty()) return fmt::format("The data do not support {}: {}.", names, fmt::join(doubts, "; "));
  std::string text = fmt::format("The data support {}", names);
  if (trial.after.verdict == "time only") {
    text += ", which needs nothing but time, so that one run cannot name it as a cause";
  }
  const Whiteness white = whiteness(trial.fit_after);
  if (!is_adequate(trial.fit_after, white)) {
    const std::string_view these = trial.added.size() == 1 ? "this effect" : "these effects";
    text += white.p < kNotNoise
                ? fmt::format(
                      ". What is left is not noise: something else is missing too, and {} may stand in for that", these)
                : fmt::format(
                      ". What is left is above the floor: noise with a memory, or something else that is missing, for "
                      "which {} may stand in",
                      these);
  }
  return text + '.';
}

std::string tables(const Trial& trial) {
  std::string text = figures(trial).text(kWidest) + "\n" + added_table(trial).text(kWidest);
  if (!trial.earlier.empty()) text += "\n" + earlier_table(trial).text(kWidest);
  text += "\n" + parameter_table(trial).text(kWidest);
  return text + "\n" +
         wrapped(fmt::format(
             "Evidence: 2 ln of the likelihood ratio, the noise estimated anew on both sides; {:.0f} is d = 5. It "
             "holds "
             "for an effect chosen before looking at these data. best fake's %: by which the best of {} fakes, the "
             "same smoothness and no cause, lowers the RMSE. p to stay: an earlier effect is needed below {}.",
             kFewestEvidence, kFakes, kStays));
}

nlohmann::ordered_json json_of(const Trial& trial) {
  nlohmann::ordered_json json;
  json["target"] = trial.after.target;
  json["data"] = trial.after.data;
  json["before"] = figures_json(trial.before);
  json["after"] = figures_json(trial.after);
  json["evidence"] = number(trial.after.evidence);
  json["threshold"] = number(trial.after.threshold);
  json["best_fake_fall"] = number(trial.after.best_fake_fall);
  json["verdict"] = trial.after.verdict;
  json["effects"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < trial.added.size(); ++i) {
    const Candidate& tried = trial.added[i];
    const Term& term = trial.model.terms[trial.model.terms.size() - trial.added.size() + i];
    nlohmann::ordered_json columns = nlohmann::ordered_json::object();
    for (std::size_t k = 0; k < term.columns.size(); ++k) columns[term.effect->inputs[k].role] = term.columns[k];
    json["effects"].push_back({{"effect", term.effect->name},
                               {"columns", std::move(columns)},
                               {"amplitude_um", number(tried.amplitude_um)},
                               {"amplitude_sigma_um", number(tried.amplitude_sigma_um)},
                               {"evidence", number(tried.evidence)},
                               {"threshold", kFewestEvidence},
                               {"best_fake_fall", number(tried.best_fake_fall)},
                               {"p_same_gain", number(tried.p_same_gain)},
                               {"time_only", term.effect->time_only},
                               {"doubts", tried.doubts},
                               {"parameters", parameters_of(tried.label, trial.fit_after)}});
  }
  json["earlier"] = nlohmann::ordered_json::array();
  for (const Stay& stay : trial.earlier) {
    json["earlier"].push_back({{"effect", stay.label},
                               {"evidence", number(stay.evidence)},
                               {"parameters", stay.parameters},
                               {"p_stay", number(stay.p)},
                               {"needed", stay.needed}});
  }
  json["sentence"] = conclusion(trial);
  return json;
}

nlohmann::ordered_json json_of(const LedgerRow& row, const LedgerRow* before) {
  return {{"revision", row.revision},
          {"change", row.change},
          {"parameters", row.parameters},
          {"rmse_um", number(row.rmse_um)},
          {"times_floor", number(row.times_floor)},
          {"held_out_um", number(row.held_out_um)},
          {"verdict", row.verdict},
          {"target", row.target},
          {"data", row.data},
          {"evidence", number(row.evidence)},
          {"threshold", number(row.threshold)},
          {"best_fake_fall", number(row.best_fake_fall)},
          {"still_needed", row.still_needed},
          {"no_longer_needed", row.no_longer_needed},
          {"sentence", sentence(row, before)}};
}

std::string family_wise_text(double error) {
  const auto searches = std::lround(error / kErrorOfASearch);
  return fmt::format("{} ({} at {}{})", fixed(error, 2),
                     searches == 1 ? "1 search" : fmt::format("{} searches", searches), kErrorOfASearch,
                     searches == 1 ? "" : " each");
}

}  // namespace ballbar
