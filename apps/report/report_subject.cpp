#include "report/report_subject.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/model/effect_argument.hpp"
#include "ballbar/message_catalogue.hpp"
#include "diagnose/diagnosis_sentence.hpp"
#include "diagnose/effect_test_text.hpp"
#include "model/effect_options.hpp"
#include "model/held_values.hpp"
#include "report/report_results.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

void overlay_effects(ModelPart& made, const Fit& fit, const Model& model, const Series& data) {
  if (model.level != Level::recording) return;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    if (model.terms[t].effect->rules.is_base) continue;  // drawn as itself
    overlay(*made.fit, label_of(model.terms[t]), fit.contribution_um[t], fit, data);
  }
}

void overlay_candidates(ModelPart& made, const DiagnosisReport& found, const ModelData& data) {
  if (data.level != Level::recording) return;
  for (const Candidate& candidate : found.diagnosis.candidates) {
    if (!candidate.in_best_set) continue;
    const std::vector<double> curve = curve_of(candidate, found.residual_report.fit, *data.series);
    if (curve.empty()) continue;
    overlay(*made.fit, "candidate " + label_of(candidate.bound), curve, found.residual_report.fit, *data.series);
  }
}

// Once each: a page names its files.
std::vector<std::string> names_of(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const fs::path& file : files) names.push_back(file_name(file));
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

ReportSubject::ReportSubject(ReportRequest request)
    : request_(std::move(request)), given_(request_), data_(report_data(request_)), marks_(marks()) {
  if (data_.for_model) open_model_file();
}

std::vector<ReportSubject::Mark> ReportSubject::marks() const {
  std::vector<Mark> marks;
  for (const fs::path& file : data_.report.files) {
    std::error_code absent;
    marks.emplace_back(file.string(), fs::file_size(file, absent), fs::last_write_time(file, absent));
  }
  return marks;
}

bool ReportSubject::is_of(const ReportRequest& request) const {
  const auto has_model = [](const ReportRequest& one) { return one.diagnose || !one.model.model.empty(); };
  const auto is_as = [](const Source& one, const Source& other) {
    return one.name() == other.name() && one.recipe() == other.recipe();
  };
  const auto are_as = [&](const std::vector<Source>& some, const std::vector<Source>& others) {
    return std::equal(some.begin(), some.end(), others.begin(), others.end(), is_as);
  };
  return are_as(request.model.data, given_.model.data) && are_as(request.compare, given_.compare) &&
         request.model.left_out == given_.model.left_out && has_model(request) == has_model(given_) &&
         marks() == marks_;
}

void ReportSubject::open_model_file() {
  const Model model = open_model(request_.model, *data_.for_model);
  say_start(request_.model, *data_.for_model);
  targets_ = model.targets;
  models_.clear();
  faults_.clear();
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    faults_.emplace_back();
    try {
      models_.push_back(std::make_unique<RevisedModel>(
          request_.model, data_.for_model, of_one_target(model, request_.model, *data_.for_model->series, k),
          diagnosis_options(request_.how, targets_[k])));
    } catch (const Error& error) {
      models_.push_back(nullptr);
      faults_.back() = error.what();
    }
  }
}

void ReportSubject::look_at(const ReportRequest& request) {
  if (!data_.for_model) return;
  const Source& file = request.model.model;
  const bool same = file.name() == request_.model.model.name() && request.model.target == request_.model.target;
  if (same && models_.size() == 1 && models_.front()) {
    if (file.empty()) return;
    const std::string text = file.bytes(kLargestText);
    if (text == models_.front()->text() || models_.front()->go_back_to(text)) return;
  }
  request_.model.model = file;
  request_.model.target = request.model.target;
  open_model_file();
}

RevisedModel& ReportSubject::only_one() {
  if (models_.size() != 1) throw Error("expected one target, which is looked at, found several or none.");
  if (!models_.front()) throw Error(faults_.front());
  return *models_.front();
}

void ReportSubject::add_target(ModelPart& made, RevisedModel& model, Parts parts) {
  Workbench& bench = model.bench();
  const ModelData& data = *data_.for_model;
  const ResidualReport& checked = with_source(
      request_.model.data.front().name(), [&]() -> auto& { return bench.check(); });
  // What is missing from a model of the errors of the axes, their ranked table says.
  const bool search = parts == Parts::all && !is_of_machine_errors(bench.model(), *data.series);
  std::optional<DiagnosisReport> found;
  if (search) found = diagnosis_report_of(request_.model, bench);
  value_of(made.check).targets.push_back(check_part(checked, bench.model(), data));
  const auto lines = sentences(checked.fit, checked.where, checked.whiteness);
  const std::string& target = bench.model().targets.front();
  made.summary.emplace_back(messages::target_says(target, lines.front()));
  overlay_effects(made, checked.fit, bench.model(), *data.series);
  if (!found) return;
  value_of(made.diagnose).targets.emplace_back(diagnosis_part(*found, data));
  made.summary.emplace_back(messages::target_says(target, sentence_of(found->diagnosis)));
  overlay_candidates(made, *found, data);
}

// A target that cannot be fitted is said and left out: the rest of the report is worth having.
void ReportSubject::add_model(ModelPart& made, Parts parts) {
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    std::string why = faults_[k];
    try {
      if (models_[k]) add_target(made, *models_[k], parts);
    } catch (const Error& error) {
      why = error.what();
    }
    if (why.empty()) continue;
    const bool fitted = parts == Parts::fitted;
    made.summary.emplace_back(fitted ? messages::not_fitted(targets_[k], why)
                                     : messages::not_diagnosed(targets_[k], why));
    if (!fitted) value_of(made.diagnose).targets.emplace_back(NotDiagnosed{targets_[k], why});
  }
  if (request_.model.model.empty()) return;
  const auto rows = read_ledger(
      models_.size() == 1 && models_.front() ? models_.front()->text() : request_.model.model.bytes(kLargestText),
      request_.model.model.name(), request_.model.catalogue);
  if (!rows.empty()) made.ledger = ledger_of(rows);
}

std::vector<fs::path> ReportSubject::files() const {
  std::vector<fs::path> files = data_.report.files;
  if (data_.for_model && request_.model.model.is_path()) files.push_back(request_.model.model.path());
  return files;
}

ModelPart ReportSubject::of_model(Parts parts) {
  const PageReport& data = data_.report.page;
  ModelPart made{names_of(files()), data.head.summary, {}, {}, {}, {}};
  if (!data_.for_model) return made;
  if (data_.for_model->level == Level::recording) made.fit = data.fit;
  add_model(made, parts);
  return made;
}

Report ReportSubject::report(bool search) {
  Report made = data_.report;
  ModelPart& model = made.page.model = of_model(search ? Parts::all : Parts::fitted);
  made.page.head.files = model.files;
  made.page.head.summary = model.summary;
  if (model.fit) made.page.fit = std::move(model.fit);
  made.files = files();
  return made;
}

ModelPart ReportSubject::fitted() {
  only_one();
  return of_model(Parts::fitted);
}

ModelPart ReportSubject::found() {
  only_one();
  ModelPart part = of_model(Parts::all);
  part.check.reset();
  return part;
}

Targets<CheckPart> ReportSubject::held(const std::vector<std::string>& settings) {
  Workbench& bench = only_one().bench();
  const Model model = with_held_values(bench.model(), settings);
  const ResidualReport checked = residual_report_of(model, bench.data(), 0, {});
  return {{{check_part(checked, model, *data_.for_model)}}};
}

ModelPart ReportSubject::add(const std::vector<std::string>& effects) {
  RevisedModel& model = only_one();
  for (const std::string& effect : effects) expect_known_effect(effect);
  model.add(terms_of(effects, model.model(), *data_.for_model));
  return fitted();
}

void ReportSubject::take_back() { only_one().take_back(); }

double ReportSubject::with(const std::vector<std::string>& effects) {
  RevisedModel& model = only_one();
  for (const std::string& effect : effects) expect_known_effect(effect);
  return model.bench().rmse_um_with(terms_of(effects, model.model(), *data_.for_model));
}

ModelPart ReportSubject::change(const HandChange& change) {
  RevisedModel& model = only_one();
  if (!change.removed.empty()) model.remove(change.removed);
  if (!change.held.empty() || !change.freed.empty())
    model.set(with_free_values(with_held_values(model.model(), change.held), change.freed));
  return fitted();
}

RevisedPart ReportSubject::revise(const std::string& file, bool keep) {
  RevisedModel& model = only_one();
  RevisedPart part{{}, true, true, {}};
  if (model.is_by_hand()) {
    model.revise_by_hand();
  } else if (const EffectTest& tried = model.bench().added(); !keep && tried.after.verdict == kNotSupported) {
    part = {conclusion(tried), false, false, ledger_of(read_ledger(model.text(), file, request_.model.catalogue))};
    model.take_back();
    return part;
  } else {
    const EffectTest revised = model.revise();
    part.supported = revised.after.verdict == "supported";
    part.sentence = conclusion(revised);
  }
  write_bytes(file, model.text());
  request_.model.model = file;
  part.ledger = ledger_of(read_ledger(model.text(), file, request_.model.catalogue));
  if (part.sentence.empty()) part.sentence = part.ledger.rows.back().sentence;
  return part;
}

std::vector<EffectChoice> ReportSubject::choices() {
  const Model& model = only_one().model();
  const ModelData& data = *data_.for_model;
  std::vector<EffectChoice> all;
  for (const auto& effect : request_.model.catalogue) {
    if (effect->level != model.level || effect->rules.is_base) continue;
    if (data.motion && !applies_to(*effect, *data.motion)) continue;
    EffectChoice one{effect->name, {}, {}};
    for (BoundEffect& bound : choices_of(*effect, model, *data.series)) {
      if (model.level == Level::recording) bound.columns.clear();  // they bind by themselves
      one.labels.push_back(label_of(bound));
      one.columns.push_back(std::move(bound.columns));
    }
    all.push_back(std::move(one));
  }
  return all;
}

Hypotheses ReportSubject::compare(const std::vector<std::vector<std::string>>& hypotheses) {
  RevisedModel& model = only_one();
  const ModelData& data = *data_.for_model;
  Hypotheses both;
  std::vector<double> ratios;  // 2 ln B against the model as it is
  for (const std::vector<std::string>& effects : hypotheses) {
    for (const std::string& effect : effects) expect_known_effect(effect);
    FittedHypothesis one{effects, {}, {}};
    if (!effects.empty()) model.add(terms_of(effects, model.model(), data));
    try {
      one.check.targets.push_back(check_part(model.bench().check(), model.model(), data));
      one.row.row = effects.empty() ? model.bench().row() : model.bench().added().after;
    } catch (...) {
      model.take_back();
      throw;
    }
    model.take_back();
    ratios.push_back(effects.empty() ? 0.0 : one.row.row.likelihood_ratio);
    both.hypotheses.push_back(std::move(one));
  }
  double sum = 0.0;
  const double largest = ratios.empty() ? 0.0 : *std::max_element(ratios.begin(), ratios.end());
  for (const double ratio : ratios) sum += std::exp(0.5 * (ratio - largest));
  for (const double ratio : ratios) both.p.push_back(std::exp(0.5 * (ratio - largest)) / sum);
  return both;
}

std::string ReportSubject::text_as_fitted() { return only_one().text_as_fitted(); }

}  // namespace ballbar
