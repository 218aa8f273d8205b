#include "diagnose/diagnosis_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/model/effect_argument.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/revision/revision.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "diagnose/effect_test_text.hpp"
#include "diagnose/next_command.hpp"
#include "errors/quantity_text.hpp"
#include "model/held_values.hpp"
#include "model/testability_text.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLabels = 4;

constexpr std::size_t kShownSoFar = 12;

constexpr double kClearlyBetter = 0.95;  // of the error of the model in left-out cycles

// For a page, which draws it.
void show_so_far(std::vector<ProbableSoFar> effects) {
  effects.resize(std::min(effects.size(), kShownSoFar));
  const nlohmann::ordered_json so_far{{"posterior", json_value(effects)}};  // the most probable first
  show_progress(so_far.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

std::set<std::string> labels_of(const Model& model) {
  std::set<std::string> labels;
  for (const Term& term : model.terms) labels.insert(label_of(term));
  return labels;
}

// Terms of the model that its file did not have before its first revision.
std::vector<std::size_t> terms_added(const ModelOptions& options, const Model& model) {
  if (options.model.empty()) return {};
  const std::string& file = options.model.name();
  std::string bytes = options.model.bytes(kLargestText);
  const std::size_t revisions = read_ledger(bytes, file, options.catalogue).size();
  if (revisions < 2) return {};
  for (std::size_t revision = 1; revision < revisions; ++revision)
    bytes = without_last_revision(bytes, file, options.catalogue);
  const std::set<std::string> first = labels_of(read_model(bytes, file, options.catalogue));
  std::vector<std::size_t> added;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    if (!first.contains(label_of(model.terms[t]))) added.push_back(t);
  }
  return added;
}

// Labels of effects of the model that a revision added although the data did not support it, and that no later revision
// found to be needed.
std::vector<std::string> unsupported_of(const ModelOptions& options, const Model& model) {
  if (options.model.empty()) return {};
  const std::string& file = options.model.name();
  std::string bytes = options.model.bytes(kLargestText);
  const std::vector<LedgerRow> rows = read_ledger(bytes, file, options.catalogue);
  if (std::none_of(rows.begin(), rows.end(), [](const LedgerRow& row) { return row.verdict == kNotSupported; }))
    return {};
  std::set<std::string> after = labels_of(read_model(bytes, file, options.catalogue)), added, needed, not_needed;
  for (auto row = rows.rbegin(); row != rows.rend() && std::next(row) != rows.rend(); ++row) {
    bytes = without_last_revision(bytes, file, options.catalogue);
    std::set<std::string> before = labels_of(read_model(bytes, file, options.catalogue));
    if (row->verdict == kNotSupported)
      std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::inserter(added, added.end()));
    after = std::move(before);
    // The last revision that tests an earlier effect decides.
    for (const std::string& label : row->still_needed) {
      if (!not_needed.contains(label) && !added.contains(label)) needed.insert(label);
    }
    for (const std::string& label : row->no_longer_needed) {
      if (!needed.contains(label)) not_needed.insert(label);
    }
  }
  std::vector<std::string> held;
  for (const Term& term : model.terms) {
    if (added.contains(label_of(term)) && !needed.contains(label_of(term))) held.push_back(label_of(term));
  }
  return held;
}

std::vector<std::string> columns_of_best_set(const Diagnosis& found) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const Candidate& one : found.candidates) {
    if (!one.in_best_set) continue;
    if (one.bound.columns.empty()) add(one.bound.effect->name);
    std::for_each(one.bound.columns.begin(), one.bound.columns.end(), add);
  }
  return names;
}

// The most probable set, if it reads a column and its left-out cycles have a smaller error than those of the model and
// than the forecasts of the regression that does not fall short.
std::optional<PredictedByColumns> predicted_by_of(const Diagnosis& found, const std::optional<Predictability>& other,
                                                  Workbench& bench) {
  const auto first = std::find_if(found.candidates.begin(), found.candidates.end(),
                                  [](const Candidate& one) { return one.in_best_set && !one.bound.columns.empty(); });
  if (first == found.candidates.end()) return std::nullopt;
  const double left_out_um = first->held_out_after_um;
  const bool is_alone = std::count_if(found.candidates.begin(), found.candidates.end(),
                                      [](const Candidate& one) { return one.in_best_set; }) == 1;
  if (other && other->is_better && !(left_out_um < other->forecasts.rmse_um)) return std::nullopt;
  const double model_um = is_alone ? first->held_out_before_um : bench.row().held_out_um;
  if (!(left_out_um < kClearlyBetter * model_um)) return std::nullopt;
  PredictedByColumns by{columns_of_best_set(found), left_out_um, std::nullopt};
  if (model_um < range_of(found.base.measured_um)) by.model_left_out_um = model_um;
  return by;
}

// The measurement that separates effects which the diagnosis cannot separate.
std::optional<NextMeasurement> next_measurement_of(const Diagnosis& found, const Series& recordings) {
  for (const std::vector<BoundEffect>& group : found.equivalent) {
    std::vector<ShapedEffect> effects;
    for (const BoundEffect& bound : group) {
      effects.push_back({bound.effect, 0.0});
      const Candidate* candidate = candidate_of(found, bound);
      for (std::size_t k = 0; candidate != nullptr && k < candidate->parameters.size(); ++k) {
        const Parameter& parameter = bound.effect->parameters[k];
        const bool is_shape = parameter.kind == ParameterKind::shape && parameter.shape_of != ShapeOf::recording;
        if (is_shape) effects.back().shape = candidate->parameters[k].value;
      }
    }
    if (std::optional<NextMeasurement> next = next_measurement(recordings, effects)) return next;
  }
  return std::nullopt;
}

// nullopt: of another test, or where the fit cannot be made.
std::optional<double> promised_rmse_um(const ModelOptions& options, const NextAction& next, Workbench& bench) {
  try {
    if (next.action == Action::free) {
      std::vector<std::string> settings;
      for (const ParameterStart& one : next.parameters)
        settings.push_back(fmt::format("{}.{}={:.17g}", one.effect, one.parameter, one.start));
      return fit(with_free_values(bench.model(), settings), bench.data(), 0, {}).rmse_um;
    }
    std::vector<Term> terms;
    Model model = bench.model();
    for (const std::string& effect : next.effects) {
      terms.push_back(term_from_text(effect, model, bench.data(), options.catalogue));
      model.terms.push_back(terms.back());
    }
    if (!terms.empty()) return bench.rmse_um_with(terms);
  } catch (const Error&) {  // the verdict is worth telling without
  }
  return std::nullopt;
}

}  // namespace

std::vector<StandIn> stand_ins_of(const ModelOptions& options, const DiagnoseOptions& how_to, const Model& model,
                                  const ModelData& data) {
  std::vector<StandIn> result;
  const std::vector<std::size_t> added = terms_added(options, model);
  if (added.empty() || model.level != Level::series) return result;
  const ProgressLine line;
  if (how_to.progress)
    show_progress(fmt::format("{}: asking {} earlier effects again", model.targets.front(), added.size()));
  DiagnosisOptions how = how_to.diagnosis;
  how.tolerance_um = 0.0;
  how.search.motion = data.motion;
  for (const Replacement& one : replacements(model, added, *data.series, 0, how))
    result.push_back({one.label, labels(one.without.named, ", "), replace_command(options, one)});
  return result;
}

Term as_diagnosed(const BoundEffect& bound, const Diagnosis& found) {
  Term term = term_of(*bound.effect, bound.columns);
  const Candidate* candidate = candidate_of(found, bound);
  if (candidate == nullptr) return term;
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const ShapeOf shape_of = bound.effect->parameters[k].shape_of;
    if (!term.settings[k].held && shape_of != ShapeOf::onset && shape_of != ShapeOf::period) continue;
    term.settings[k].start =
        std::stod(fmt::format("{:.8g}", candidate->parameters[k].value));  // as next_command() has it
    term.settings[k].stated = true;
  }
  return term;
}

const std::vector<BoundEffect>& best_of(const Diagnosis& found) {
  static const std::vector<BoundEffect> kNone;
  return found.verdict == Verdict::named ? found.named : found.verdict == Verdict::probable ? found.probable : kNone;
}

Paragraph next_test(const DiagnosisReport& diagnosis_report) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  if (found.verdict == Verdict::named && found.equivalent.empty()) return {};  // nothing is left to tell
  if (diagnosis_report.next_measurement) return message_of(*diagnosis_report.next_measurement);
  Paragraph text;
  if (diagnosis_report.is_for_plan) text += messages::decide_by_run();
  for (const std::vector<std::string>& columns : equal_columns_in_question(found))
    text += messages::decide_equal_columns(enumerated({columns.begin(), columns.end()}));
  return text;
}

std::string predicted_text(const DiagnosisReport& report) {
  const std::string_view unit = unit_of(report.diagnosis.target);
  if (report.predicted_by) {
    const PredictedByColumns& by = *report.predicted_by;
    const std::string model =
        by.model_left_out_um ? fmt::format(", to {:.2f} {} by the model", *by.model_left_out_um, unit) : "";
    return fmt::format("Left-out cycles are predicted to {:.2f} {} RMSE by {}{}.", by.left_out_um, unit,
                       text_of(enumerated({by.columns.begin(), by.columns.end()})), model);
  }
  if (!report.predicted) return "";
  const Predictability& of = *report.predicted;
  if (of.is_better) {
    return fmt::format(
        "It can still be predicted: on new rows the RMSE of a regression on all effects is {:.2f} {}, that of the "
        "model {:.2f} {}.",
        of.forecasts.rmse_um, unit, of.model_um, unit);
  }
  const bool is_hardly = of.forecasts.rmse_um < std::min(of.model_um, of.forecasts.held_um);
  return fmt::format(
      "A regression on all effects {}: on new rows its RMSE is {:.2f} {}, that of the model {:.2f} {}, that of a "
      "constant {:.2f} {}.",
      is_hardly ? "hardly predicts it" : "does not predict it", of.forecasts.rmse_um, unit, of.model_um, unit,
      of.forecasts.held_um, unit);
}

std::string unsupported_text(const DiagnosisReport& report) {
  if (report.unsupported.empty()) return "";
  const bool is_one = report.unsupported.size() == 1;
  return fmt::format(
      "The model contains {}, which the data did not support when {} added. The verdict is valid only if {} real.",
      text_of(enumerated(effects_of(report.unsupported))), is_one ? "it was" : "they were",
      is_one ? "it is" : "they are");
}

std::string labels(const std::vector<BoundEffect>& bounds, std::string_view between) {
  std::vector<std::string> texts;
  const std::size_t shown = bounds.size() > kLabels + 1 ? kLabels : bounds.size();
  for (std::size_t i = 0; i < shown; ++i) texts.push_back(label_of(bounds[i]));
  if (shown < bounds.size()) texts.push_back(fmt::format("one of {} more", bounds.size() - shown));
  return fmt::format("{}", fmt::join(texts, between));
}

std::string not_searched_text(const Diagnosis& found) {
  std::vector<std::string> texts;
  for (const Detectability& detectable : found.detectability) {
    if (detectable.bindings <= detectable.searched) continue;
    texts.push_back(fmt::format("{} on {} of {} choices of columns", detectable.effect->name,
                                detectable.bindings - detectable.searched, detectable.bindings));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

DiagnosisOptions diagnosis_options(const DiagnoseOptions& how_to, const std::string& target) {
  DiagnosisOptions how = how_to.diagnosis;
  if (!how_to.progress) return how;
  how.search.progress = [target](std::string_view step) { show_progress(fmt::format("{}: {}", target, step)); };
  if (progress_is_taken()) how.search.so_far = show_so_far;
  return how;
}

DiagnosisReport diagnosis_report_of(const ModelOptions& options, Workbench& bench) {
  return with_source(options.data.front().name(), [&] {
    DiagnosisReport report;
    report.residual_report = bench.check();
    report.diagnosis = bench.diagnosis();
    const Diagnosis& found = report.diagnosis;
    report.is_for_plan = bench.model().level == Level::series && is_for_plan(found);
    if (report.is_for_plan) report.plan_command = plan_command(options, found);
    if (bench.model().level == Level::recording) report.next_measurement = next_measurement_of(found, bench.data());
    report.command = next_command(options, found);
    report.next_action = next_action(options, found);
    if (report.next_action)
      report.next_action->promised_rmse_um = promised_rmse_um(options, *report.next_action, bench);
    report.hint = next_hint(options, found);
    report.unsupported = unsupported_of(options, bench.model());
    if (bench.model().level == Level::series && is_left(found.verdict)) {
      report.predicted = bench.predictability();
      report.predicted_by = predicted_by_of(found, report.predicted, bench);
      const bool is_noise = is_adequate(report.residual_report.fit, report.residual_report.whiteness);
      if (is_noise && report.predicted && !report.predicted->is_better) report.predicted.reset();  // nothing to predict
    }
    if (report.predicted && report.predicted->is_better && !report.predicted_by)
      report.train_command = train_command(options, found, report.predicted->with_model);
    return report;
  });
}

std::vector<Untestable> untestable_of(const Diagnosis& found) {
  std::vector<Untestable> untestable;
  for (const Detectability& one : found.detectability) {
    if (one.testability == Testability::testable || one.testability == Testability::in_the_model) continue;
    untestable.push_back({one.effect->name, reason_of(one)});
  }
  return untestable;
}

std::optional<DecidingTest> deciding_test(const DiagnosisReport& report) {
  if (report.is_for_plan) {
    const std::string& command = report.plan_command;
    return DecidingTest{next_test(report), {command.empty() ? std::nullopt : std::optional(command)}};
  }
  const Paragraph text = next_test(report);
  return text.empty() ? std::nullopt : std::optional(DecidingTest{text, {}});
}

}  // namespace ballbar
