#include "diagnose/diagnosis_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "terminal/json_number.hpp"
#include "terminal/progress.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kInASentence = 4;

std::string labels(const std::vector<BoundEffect>& bounds, std::string_view between) {
  std::vector<std::string> texts;
  const std::size_t said = bounds.size() > kInASentence + 1 ? kInASentence : bounds.size();
  for (std::size_t i = 0; i < said; ++i) texts.push_back(label_of(bounds[i]));
  if (said < bounds.size()) texts.push_back(fmt::format("one of {} more", bounds.size() - said));
  return fmt::format("{}", fmt::join(texts, between));
}

const Candidate* candidate_of(const Diagnosis& diagnosis, const BoundEffect& bound) {
  const auto at = std::find_if(diagnosis.candidates.begin(), diagnosis.candidates.end(),
                               [&](const Candidate& candidate) { return candidate.bound == bound; });
  return at == diagnosis.candidates.end() ? nullptr : &*at;
}

nlohmann::ordered_json json_of(const BoundEffect& bound) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < bound.columns.size(); ++k) columns[bound.effect->inputs[k].role] = bound.columns[k];
  return {{"effect", bound.effect->name}, {"columns", columns}};
}

nlohmann::ordered_json json_of(const Candidate& candidate) {
  nlohmann::ordered_json json = json_of(candidate.bound);
  json["amplitude_um"] = number(candidate.amplitude_um);
  json["amplitude_sigma_um"] = number(candidate.amplitude_sigma_um);
  json["rmse_after_um"] = number(candidate.rmse_after_um);
  json["held_out_before_um"] = number(candidate.held_out_before_um);
  json["held_out_after_um"] = number(candidate.held_out_after_um);
  json["likelihood_ratio"] = number(candidate.likelihood_ratio);
  json["likelihood_ratio_needed"] = number(candidate.threshold);
  json["p_search"] = number(candidate.p_search);
  json["p_same_gain"] = number(candidate.p_same_gain);
  json["beats_surrogates"] = nullptr;  // not tested
  if (candidate.beats_surrogates) json["beats_surrogates"] = *candidate.beats_surrogates;
  json["in_best_set"] = candidate.in_best_set;
  json["minor"] = candidate.minor;
  json["inseparable_from"] = candidate.inseparable_from;
  json["also_drawn_by"] = candidate.also_drawn_by;
  json["parameters"] = nlohmann::ordered_json::array();
  for (const FittedParameter& parameter : candidate.parameters) {
    json["parameters"].push_back({{"name", parameter.name},
                                  {"value", number(parameter.value)},
                                  {"sigma", number(parameter.sigma)},
                                  {"unit", parameter.unit}});
  }
  return json;
}

}  // namespace

std::string chance_text(double p) { return p < 0.0005 ? "< 0.1 %" : fmt::format("{:.1f} %", 100.0 * p); }

std::string verdict_text(const Diagnosis& found) {
  std::string text = fmt::format("Verdict: {}. ", name_of(found.verdict));
  const std::string searched = fmt::format("after searching {} effects", found.searched_effects);
  const std::string chance = fmt::format("A data set without any effect shows one as clear in {} of cases, {}.",
                                         chance_text(found.p_anything), searched);
  switch (found.verdict) {
    case Verdict::named:
      text += fmt::format("What is missing is {}.", labels(found.named, " and "));
      for (const BoundEffect& bound : found.named) {
        const Candidate* candidate = candidate_of(found, bound);
        if (candidate != nullptr && candidate->minor) text += fmt::format(" {} is minor.", label_of(bound));
      }
      for (const std::vector<BoundEffect>& group : found.equivalent) {
        text += fmt::format(" Beside it something that the data cannot tell apart: {}.", labels(group, " or "));
      }
      text += " " + chance;
      break;
    case Verdict::equivalent:
      text += "Something is missing, and the data cannot tell what. They are consistent with ";
      for (std::size_t i = 0; i < found.equivalent.size(); ++i) {
        text += fmt::format("{}{}", i == 0 ? "" : "; and with ", labels(found.equivalent[i], " or "));
      }
      text += ". " + chance;
      break;
    case Verdict::unexplained:
      text += "Something is missing that is no effect of the catalogue, or none that these data allow to test.";
      if (found.p_anything < 0.01) text += " " + chance;
      break;
    case Verdict::untestable:
      text += "These data could not have shown a missing effect.";
      break;
    case Verdict::nothing:
      text += found.p_anything < 0.01 ? "No effect was found that is clear: a noise with a longer memory does as well. "
                                      : fmt::format("No effect was found. {} ", chance);
      if (std::isfinite(found.smallest_um) && found.smallest.effect != nullptr) {
        text += fmt::format("The smallest that would have been: {:.2g} um of {}.", found.smallest_um,
                            label_of(found.smallest));
      }
      break;
  }
  return text;
}

std::string next_text(const DiagnosisReport& diagnosis_report) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  if (found.verdict == Verdict::named && found.equivalent.empty()) return "";  // nothing is left to tell
  if (diagnosis_report.next_tests.empty() || diagnosis_report.next_tests.front().text.empty()) return "";
  return fmt::format("Next test: {}", diagnosis_report.next_tests.front().text);
}

nlohmann::ordered_json json_of(const DiagnosisReport& diagnosis_report) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  nlohmann::ordered_json json = json_of(diagnosis_report.residual_report);
  json["verdict"] = name_of(found.verdict);
  json["verdict_text"] = verdict_text(found);
  json["named"] = nlohmann::ordered_json::array();
  for (const BoundEffect& bound : found.named) json["named"].push_back(json_of(bound));
  json["equivalent"] = nlohmann::ordered_json::array();
  for (const std::vector<BoundEffect>& group : found.equivalent) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const BoundEffect& bound : group) list.push_back(json_of(bound));
    json["equivalent"].push_back(std::move(list));
  }
  if (!found.associations.empty()) {  // of an unexplained one: what is nearest to it
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Candidate& candidate : found.associations) list.push_back(json_of(candidate.bound));
    json["equivalent"].push_back(std::move(list));
  }
  json["candidates"] = nlohmann::ordered_json::array();
  for (const Candidate& candidate : found.candidates) json["candidates"].push_back(json_of(candidate));
  json["associations"] = nlohmann::ordered_json::array();
  for (const Candidate& candidate : found.associations) json["associations"].push_back(json_of(candidate));
  json["p_anything"] = number(found.p_anything);
  json["smooth_likelihood_ratio"] = number(found.smooth_likelihood_ratio);
  json["best_surrogate_fall"] = number(found.best_surrogate_fall);
  json["smallest_um"] = number(found.smallest_um);
  json["untestable"] = nlohmann::ordered_json::array();
  for (const Detectability& detectable : found.detectability) {
    if (detectable.testability == Testability::testable || detectable.testability == Testability::in_the_model)
      continue;
    json["untestable"].push_back({{"effect", detectable.effect->name}, {"why", detectable.why}});
  }
  json["not_searched"] = nlohmann::ordered_json::array();
  for (const Detectability& detectable : found.detectability) {
    if (detectable.bindings <= detectable.searched) continue;
    json["not_searched"].push_back({{"effect", detectable.effect->name},
                                    {"choices_of_columns", detectable.bindings},
                                    {"searched", detectable.searched}});
  }
  json["reasons"] = found.reasons;
  json["next_test"] = nullptr;
  if (!diagnosis_report.next_tests.empty()) {
    json["next_test"] = {{"text", diagnosis_report.next_tests.front().text},
                         {"separation", number(diagnosis_report.next_tests.front().separation)}};
  }
  return json;
}

DiagnosisReport diagnosis_report_of(const ModelOptions& options, const DiagnoseOptions& how_to, const Model& model,
                                    const ModelData& data, std::size_t target) {
  const ProgressLine line;
  const auto tell = [&](std::string_view step) {
    if (how_to.progress) show_progress(fmt::format("{}: {}", model.targets[target], step));
  };
  tell("fitting");
  DiagnosisReport diagnosis_report;
  diagnosis_report.residual_report = residual_report_of(options, model, data, target);
  DiagnosisOptions how;
  how.search.motion = data.motion;
  how.tolerance_um = how_to.tolerance_um;
  how.search.seed = how_to.seed;
  how.most_rows = how_to.most_rows;
  how.search.progress = tell;
  diagnosis_report.surrogates = how.surrogates;
  diagnosis_report.diagnosis = diagnose(model, data.series, target, how);
  tell("predicting what the next tests would tell");
  diagnosis_report.next_tests = next_tests(model, data.series, diagnosis_report.diagnosis);
  return diagnosis_report;
}

}  // namespace ballbar
