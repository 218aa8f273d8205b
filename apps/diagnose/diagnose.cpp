// `ballbar diagnose DATA --model M`: which physical effect the model lacks, or that the data cannot tell.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/error.hpp"
#include "commands.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/machine_errors_report.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"
#include "model/untestable_reasons.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

constexpr std::size_t kWidest = 120;

struct Options {
  ModelOptions model;
  DiagnoseOptions how;
  ErrorsOptions errors;
  std::string prior = "usual";
  bool json = false;
};

Table candidate_table(const Diagnosis& found) {
  Table table(
      {"candidate", "amplitude um", "RMSE um", "held out um", "2 ln LR", "needed", "by chance", "not told from"});
  const int decimals = decimals_of(found.base.rmse_um);
  std::vector<const Candidate*> order;
  for (const Candidate& candidate : found.candidates) order.push_back(&candidate);
  std::stable_sort(order.begin(), order.end(), [](const Candidate* a, const Candidate* b) {
    if (a->in_best_set != b->in_best_set) return a->in_best_set;
    return a->likelihood_ratio > b->likelihood_ratio;
  });
  const auto number_of = [&](const std::string& label) -> std::size_t {  // 0: not in the table
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (label_of(order[i]->bound) == label) return i + 1;
    }
    return 0;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Candidate& candidate = *order[i];
    std::vector<std::string> same;
    std::size_t more = 0;
    for (const std::string& label : candidate.inseparable_from) {
      const std::size_t number = number_of(label);
      if (number > 0) same.push_back(fmt::format("{}", number));
      more += number > 0 ? 0 : 1;
    }
    if (more > 0) same.push_back(fmt::format("{} more", more));
    table.add(
        {fmt::format("{}{} {}", i + 1, candidate.in_best_set ? "*" : ".", shortened(label_of(candidate.bound), 44)),
         with_sigma(candidate.amplitude_um, candidate.amplitude_sigma_um, decimals),
         fmt::format("{:.{}f}", candidate.rmse_after_um, decimals + 1),
         fmt::format("{:.{}f} -> {:.{}f}", candidate.held_out_before_um, decimals, candidate.held_out_after_um,
                     decimals),
         fmt::format("{:.0f}", candidate.likelihood_ratio), fmt::format("{:.0f}", candidate.threshold),
         chance_text(candidate.p_search), same.empty() ? "-" : fmt::format("{}", fmt::join(same, ", "))});
  }
  return table;
}

Table association_table(const Diagnosis& found) {
  Table table({"it goes with", "amplitude um", "RMSE um", "held out um"});
  const int decimals = decimals_of(found.base.rmse_um);
  for (const Candidate& candidate : found.associations) {
    table.add({shortened(label_of(candidate.bound), 60),
               with_sigma(candidate.amplitude_um, candidate.amplitude_sigma_um, decimals),
               fmt::format("{:.{}f} -> {:.{}f}", found.base.rmse_um, decimals, candidate.rmse_after_um, decimals),
               fmt::format("{:.{}f} -> {:.{}f}", candidate.held_out_before_um, decimals, candidate.held_out_after_um,
                           decimals)});
  }
  return table;
}

std::string untestable_text(const Diagnosis& found) {
  std::vector<Detectability> untestable;
  std::copy_if(found.detectability.begin(), found.detectability.end(), std::back_inserter(untestable),
               [](const Detectability& detectable) {
                 return detectable.testability != Testability::testable &&
                        detectable.testability != Testability::in_the_model &&
                        detectable.testability != Testability::other_motion;
               });
  const auto reasons = by_reason(untestable);
  std::vector<std::string> texts;
  texts.reserve(reasons.size());
  for (const auto& [why, names] : reasons) texts.push_back(fmt::format("{} ({})", fmt::join(names, ", "), why));
  return fmt::format("{}", fmt::join(texts, "; "));
}

// "gradient_bending (512 of 780 choices of columns)"; empty where all were searched.
std::string not_searched_text(const Diagnosis& found) {
  std::vector<std::string> texts;
  for (const Detectability& detectable : found.detectability) {
    if (detectable.bindings <= detectable.searched) continue;
    texts.push_back(fmt::format("{} on {} of {} choices of columns", detectable.effect->name,
                                detectable.bindings - detectable.searched, detectable.bindings));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

// Of the best set on recordings.
std::vector<std::string> without_surrogates(const Diagnosis& found) {
  std::vector<std::string> names;
  for (const Candidate& candidate : found.candidates) {
    const Effect& effect = *candidate.bound.effect;
    if (!candidate.in_best_set || candidate.beats_surrogates || effect.time_only) continue;
    if (effect.level == Level::recording) names.push_back(effect.name);
  }
  return names;
}

void print_text(const DiagnosisReport& diagnosis_report, const std::string& title) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  fmt::print("{}\n{}\n\n{}\n", title, heading(diagnosis_report.residual_report.fit), wrapped(verdict_text(found)));
  print_sentences(diagnosis_report.residual_report);
  fmt::print("{}", wrapped(floor_text(diagnosis_report.residual_report.fit)));
  if (!found.candidates.empty()) {
    fmt::print("\n{}", candidate_table(found).text(kWidest));
    const bool of_recordings = found.candidates.front().bound.effect->level == Level::recording;
    fmt::print("{}", wrapped(fmt::format("* the best set, each beside the others. RMSE with it; held out: {} left out, "
                                         "before and after.",
                                         of_recordings ? "recordings, or quarters of their sweeps," : "cycles")));
    fmt::print("2 ln LR: 2 ln of the likelihood ratio; needed: what 1 % of searches find by chance.\n");
  }
  for (const Candidate& candidate : found.candidates) {
    if (candidate.also_drawn_by.empty()) continue;
    fmt::print("{}", wrapped(fmt::format("{} would draw the same curve as {}: with what it adds to it at nothing.",
                                         fmt::join(candidate.also_drawn_by, " and "), label_of(candidate.bound))));
  }
  std::string falls;
  if (found.best_surrogate_fall > 0.0) {
    falls = fmt::format("The best surrogate of {} with the same smoothness lowers the RMSE by {:.0f} %",
                        diagnosis_report.surrogates, 100.0 * found.best_surrogate_fall);
    falls += fmt::format("; the best set by {:.0f} %. ", 100.0 * (1.0 - found.rmse_after_um / found.base.rmse_um));
  }
  const std::vector<std::string> untried = without_surrogates(found);
  if (!untried.empty()) {
    falls += fmt::format("Not tested against surrogates: {} (a random curve as smooth is nearly the effect itself). ",
                         fmt::join(untried, ", "));
  }
  if (found.verdict != Verdict::untestable) {
    falls += fmt::format("Likelihood ratio of the most likely smooth curve: {:.0f}.",
                         std::max(0.0, found.smooth_likelihood_ratio));
    fmt::print("\n{}", wrapped(falls));
  }
  if (!found.associations.empty()) {
    fmt::print("\n{}{}", association_table(found).text(kWidest),
               wrapped("Each alone beside the model. That it goes with something is no proof of a cause."));
  }
  if (!found.reasons.empty() && found.verdict != Verdict::nothing) {
    fmt::print("\nWhy it is not named, or not all of it:\n");
    for (const std::string& reason : found.reasons) fmt::print("{}", wrapped("- " + reason));
  }
  const std::string untestable = untestable_text(found);
  if (!untestable.empty()) fmt::print("\n{}", wrapped("Not testable here: " + untestable + "."));
  const std::string not_searched = not_searched_text(found);
  if (!not_searched.empty()) fmt::print("\n{}", wrapped("Not searched: " + not_searched + "."));
  const std::string next = next_text(diagnosis_report);
  if (!next.empty()) fmt::print("\n{}", wrapped(next));
}

// The text or JSON of one of several targets; why there is none where it cannot be fitted, as without values.
void show_one_of_several(const Options& options, const Model& model, const ModelData& data, std::size_t target,
                         nlohmann::ordered_json& targets) {
  if (target > 0 && !options.json) fmt::print("\n");
  try {
    const DiagnosisReport diagnosis_report = diagnosis_report_of(options.model, options.how, model, data, target);
    if (options.json) {
      targets.push_back(json_of(diagnosis_report));
    } else {
      print_text(diagnosis_report, data.title);
    }
  } catch (const Error& error) {
    if (options.json) {
      targets.push_back({{"target", model.targets[target]}, {"not_diagnosed", error.what()}});
    } else {
      fmt::print("{}\n{}\n\n{}", data.title, model.targets[target],
                 wrapped(fmt::format("Not diagnosed: {}", error.what())));
    }
  }
}

// Recordings of two linear axes: all of their errors together, ranked.
void run_on_circles(Options options) {
  options.errors.prior = options.prior == "usual";
  if (!options.model.model.empty()) {
    const ModelData data = open_data(options.model);
    for (const Term& term : open_model(options.model, data).terms)
      options.errors.in_the_model.insert(term.effect->name);
  }
  const ErrorsReports reports = errors_reports_of(options.model.data, options.errors);
  options.json ? fmt::print("{}\n", json_of(reports).dump(2)) : print_text(reports);
  for (const std::string& remark : reports.remarks) stderr_line(remark);
}

void run(const Options& options) {
  if (are_of_linear_axes(options.model.data)) {
    run_on_circles(options);
    return;
  }
  const ModelData data = open_data(options.model);
  const Model model = open_model(options.model, data);
  if (model.targets.size() == 1) {
    const DiagnosisReport diagnosis_report = diagnosis_report_of(options.model, options.how, model, data, 0);
    options.json ? fmt::print("{}\n", json_of(diagnosis_report).dump(2)) : print_text(diagnosis_report, data.title);
    return;
  }
  nlohmann::ordered_json targets = nlohmann::ordered_json::array();
  for (std::size_t target = 0; target < model.targets.size(); ++target) {
    show_one_of_several(options, model, data, target, targets);
  }
  if (options.json) fmt::print("{}\n", nlohmann::ordered_json{{"targets", targets}}.dump(2));
}

}  // namespace

void add_diagnose(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("diagnose", "Which physical effect a model lacks");
  add_model_options(*command, options->model, false);
  command->add_option("--tolerance-um", options->how.tolerance_um, "smaller effects are called minor")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--seed", options->how.seed, "of the random draws; the same seed gives the same result");
  command
      ->add_option("--most-rows", options->how.most_rows,
                   "values of the target that are searched, of longer series every k-th")
      ->check(CLI::Range(30, 5000));
  command->add_option("--prior", options->prior, "circles: what holds errors that the readings hardly tell, or none")
      ->check(CLI::IsMember({"usual", "none"}));
  command->add_option("--tolerance", options->errors.tolerance_um, "circles: largest circularity in um that passes")
      ->check(CLI::Range(0.0, 1e6));
  command->add_flag("--strict", options->errors.strict, "circles: stop at the first file that cannot be read");
  command->add_flag("--json", options->json, "the result for a program");
  command->footer(
      "Example:\n"
      "  ballbar diagnose sample-runs/spindle-46h/measured.csv --model sample-runs/spindle-46h/speed.toml "
      "--target ch3_um");
  command->callback([options] {
    options->how.progress = !options->json;
    run(*options);
  });
}

}  // namespace ballbar::commands
