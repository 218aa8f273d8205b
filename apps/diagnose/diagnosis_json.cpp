#include <nlohmann/json.hpp>

#include "diagnose/diagnosis_report.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const BoundEffect& bound) {
  Json columns = Json::object();
  for (std::size_t k = 0; k < bound.columns.size(); ++k) columns[bound.effect->inputs[k].role] = bound.columns[k];
  return {{"effect", bound.effect->name}, {"columns", columns}};
}

Json json_of(const std::vector<BoundEffect>& bounds) {
  Json json = Json::array();
  for (const BoundEffect& bound : bounds) json.push_back(json_of(bound));
  return json;
}

Json json_of(const Candidate& candidate) {
  Json json = json_of(candidate.bound);
  json["p"] = number(candidate.p);
  json["likelihood_ratio"] = number(candidate.likelihood_ratio);
  json["amplitude_um"] = number(candidate.amplitude_um);
  json["amplitude_sigma_um"] = number(candidate.amplitude_sigma_um);
  json["rmse_after_um"] = number(candidate.rmse_after_um);
  json["held_out_before_um"] = number(candidate.held_out_before_um);
  json["held_out_after_um"] = number(candidate.held_out_after_um);
  json["p_same_gain"] = number(candidate.p_same_gain);
  json["beats_surrogates"] = nullptr;  // not tested
  if (candidate.beats_surrogates) json["beats_surrogates"] = *candidate.beats_surrogates;
  json["in_best_set"] = candidate.in_best_set;
  json["minor"] = candidate.minor;
  json["doubts"] = candidate.doubts;
  json["inseparable_from"] = candidate.inseparable_from;
  json["parameters"] = Json::array();
  for (std::size_t k = 0; k < candidate.parameters.size(); ++k) {
    const FittedParameter& parameter = candidate.parameters[k];
    const Interval interval = k < candidate.intervals.size() ? candidate.intervals[k] : Interval{};
    json["parameters"].push_back({{"name", parameter.name},
                                  {"value", number(parameter.value)},
                                  {"sigma", number(parameter.sigma)},
                                  {"low", number(interval.low)},
                                  {"high", number(interval.high)},
                                  {"unit", parameter.unit}});
  }
  return json;
}

void add_posterior(const Diagnosis& found, Json& json) {
  json["drivers"] = Json::array();
  for (const Driver& driver : found.drivers) {
    json["drivers"].push_back({{"column", driver.column}, {"p", number(driver.p)}});
  }
  json["own"] = Json::array();
  for (const OwnValue& own : found.own) {
    json["own"].push_back({{"effect", own.effect},
                           {"parameter", own.parameter},
                           {"unit", own.unit},
                           {"held", number(own.held)},
                           {"fitted", number(own.fitted)},
                           {"low", number(own.interval.low)},
                           {"high", number(own.interval.high)},
                           {"p", number(own.p)}});
  }
  json["effects"] = Json::array();
  for (const EffectProbability& effect : found.effects) {
    Json one = json_of(effect.bound);
    one["p"] = number(effect.p);
    json["effects"].push_back(std::move(one));
  }
  json["p_nothing"] = number(found.p_nothing);
  json["p_discrepancy"] = number(found.p_discrepancy);
  json["discrepancy_um"] = number(found.discrepancy_um);
}

void add_not_seen(const Diagnosis& found, Json& json) {
  json["hidden_um"] = number(found.hidden_um);
  json["untestable"] = Json::array();
  for (const Detectability& detectable : found.detectability) {
    if (detectable.testability == Testability::testable || detectable.testability == Testability::in_the_model)
      continue;
    json["untestable"].push_back({{"effect", detectable.effect->name}, {"why", detectable.why}});
  }
  json["not_searched"] = Json::array();
  for (const Detectability& detectable : found.detectability) {
    if (detectable.bindings <= detectable.searched) continue;
    json["not_searched"].push_back({{"effect", detectable.effect->name},
                                    {"choices_of_columns", detectable.bindings},
                                    {"searched", detectable.searched}});
  }
}

}  // namespace

Json json_of(const DiagnosisReport& diagnosis_report) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  Json json = json_of(diagnosis_report.residual_report);
  json["verdict"] = name_of(found.verdict);
  json["sentence"] = found.sentence;
  json["command"] = diagnosis_report.command;
  json["named"] = json_of(found.named);
  json["probable"] = json_of(found.probable);
  json["equivalent"] = Json::array();
  for (const std::vector<BoundEffect>& group : found.equivalent) json["equivalent"].push_back(json_of(group));
  add_posterior(found, json);
  json["candidates"] = Json::array();
  for (const Candidate& candidate : found.candidates) json["candidates"].push_back(json_of(candidate));
  json["stand_ins"] = Json::array();
  for (const StandIn& one : diagnosis_report.stand_ins)
    json["stand_ins"].push_back({{"effect", one.effect}, {"by", one.by}, {"command", one.command}});
  add_not_seen(found, json);
  json["reasons"] = found.reasons;
  json["gains_by_run"] = Json::array();
  for (const GainByRun& one : found.gains_by_run) {
    Json runs = Json::array();
    for (std::size_t run = 0; run < one.gain.size(); ++run) {
      runs.push_back({{"gain", number(one.gain[run])}, {"sigma", number(one.sigma[run])}});
    }
    json["gains_by_run"].push_back({{"effect", one.effect},
                                    {"parameter", one.parameter},
                                    {"unit", one.unit},
                                    {"p", number(one.p)},
                                    {"runs", runs}});
  }
  json["next_test"] = nullptr;
  if (!diagnosis_report.plan_command.empty()) {
    json["next_test"] = {{"text", next_text(diagnosis_report)}, {"command", diagnosis_report.plan_command}};
  } else if (!diagnosis_report.next_tests.empty()) {
    json["next_test"] = {{"text", diagnosis_report.next_tests.front().text},
                         {"separation", number(diagnosis_report.next_tests.front().separation)}};
  }
  return json;
}

}  // namespace ballbar
