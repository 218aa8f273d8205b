#include "report/report_subject.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "model/effect_options.hpp"
#include "model/held_values.hpp"
#include "model/known_effect.hpp"
#include "report/report_parts.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void overlay_effects(Report& made, const Fit& fit, const Model& model, const Series& data) {
  if (model.level != Level::recording) return;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    if (model.terms[t].effect->rules.is_base) continue;  // drawn as itself
    overlay(made.json["fit"]["recordings"], label_of(model.terms[t]), fit.contribution_um[t], fit, data);
  }
}

void overlay_candidates(Report& made, const DiagnosisReport& found, const ModelData& data) {
  if (data.level != Level::recording) return;
  for (const Candidate& candidate : found.diagnosis.candidates) {
    if (!candidate.in_best_set) continue;
    const std::vector<double> curve = curve_of(candidate, found.residual_report.fit, data.series);
    if (curve.empty()) continue;
    overlay(made.json["fit"]["recordings"], "candidate " + label_of(candidate.bound), curve, found.residual_report.fit,
            data.series);
  }
}

// Once each: a page names its files.
void name_files(Report& made) {
  std::vector<std::string> names;
  for (const fs::path& file : made.files) names.push_back(file_name(file));
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  made.json["files"] = names;
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
  return request.model.data == given_.model.data && request.compare == given_.compare &&
         has_model(request) == has_model(given_) && marks() == marks_;
}

void ReportSubject::open_model_file() {
  const Model model = open_model(request_.model, *data_.for_model);
  say_start(request_.model, *data_.for_model);
  targets_ = model.targets;
  models_.clear();
  faults_.clear();
  for (const std::string& target : targets_) {
    ModelOptions of_one = request_.model;
    if (targets_.size() > 1) of_one.target = {target};
    faults_.emplace_back();
    try {
      models_.push_back(
          std::make_unique<RevisedModel>(of_one, data_.for_model, diagnosis_options(request_.how, target)));
    } catch (const Error& error) {
      models_.push_back(nullptr);
      faults_.back() = error.what();
    }
  }
}

void ReportSubject::look_at(const ReportRequest& request) {
  if (!data_.for_model) return;
  const std::string& file = request.model.model;
  const bool same = file == request_.model.model && request.model.target == request_.model.target;
  if (same && models_.size() == 1 && models_.front()) {
    if (file.empty()) return;
    const std::string text = read_bytes(file, kLargestText);
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

void ReportSubject::add_target(Report& made, RevisedModel& model, Parts parts) {
  Workbench& bench = model.bench();
  const ModelData& data = *data_.for_model;
  const ResidualReport& checked = with_source(
      request_.model.data.front(), [&]() -> auto& { return bench.check(); });
  // What is missing from a model of the errors of the axes, their ranked table says.
  const bool search = parts == Parts::all && !is_of_machine_errors(bench.model(), data.series);
  std::optional<DiagnosisReport> found;
  if (search) found = diagnosis_report_of(request_.model, bench);
  made.json["check"]["targets"].push_back(check_part(checked, bench.model(), data));
  const auto said = sentences(checked.fit, checked.where, checked.whiteness);
  if (!said.empty()) made.conclude(fmt::format("{}: {}", bench.model().targets.front(), said.front()));
  overlay_effects(made, checked.fit, bench.model(), data.series);
  if (!found) return;
  made.json["diagnose"]["targets"].push_back(diagnosis_part(*found, data));
  made.conclude(fmt::format("{}: {}", bench.model().targets.front(), found->diagnosis.sentence));
  overlay_candidates(made, *found, data);
}

// A target that cannot be fitted is said and left out: the rest of the report is worth having.
void ReportSubject::add_model(Report& made, Parts parts) {
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    std::string why = faults_[k];
    try {
      if (models_[k]) add_target(made, *models_[k], parts);
    } catch (const Error& error) {
      why = error.what();
    }
    if (why.empty()) continue;
    const bool fitted = parts == Parts::fitted;
    made.conclude(fmt::format("{}: not {}: {}", targets_[k], fitted ? "fitted" : "diagnosed", why));
    if (!fitted) made.json["diagnose"]["targets"].push_back({{"target", targets_[k]}, {"not_diagnosed", why}});
  }
  if (request_.model.model.empty()) return;
  made.files.emplace_back(request_.model.model);
  const auto rows = read_ledger(
      models_.size() == 1 && models_.front() ? models_.front()->text() : read_bytes(request_.model.model, kLargestText),
      request_.model.model);
  if (!rows.empty()) made.json["ledger"] = ledger_part(rows);
}

// What a report says that changes with the model.
Report ReportSubject::of_model(Parts parts) {
  const Json& data = data_.report.json;
  Report made{{{"files", Json::array()}, {"summary", data["summary"]}}, data_.report.files, {}};
  if (data_.for_model && data_.for_model->level == Level::recording) made.json["fit"] = data["fit"];
  if (data_.for_model) add_model(made, parts);
  name_files(made);
  return made;
}

Report ReportSubject::report() {
  Report made = data_.report;
  Report part = of_model(request_.no_diagnosis ? Parts::fitted : Parts::all);
  made.json.update(part.json);
  made.files = std::move(part.files);
  return made;
}

Json ReportSubject::fitted() {
  only_one();
  return of_model(Parts::fitted).json;
}

Json ReportSubject::found() {
  only_one();
  Json part = of_model(Parts::all).json;
  part.erase("check");
  return part;
}

Json ReportSubject::held(const std::vector<std::string>& settings) {
  Workbench& bench = only_one().bench();
  const Model model = with_held_values(bench.model(), settings);
  const ResidualReport checked = residual_report_of(model, bench.data(), 0, {});
  return {{"check", {{"targets", {check_part(checked, model, *data_.for_model)}}}}};
}

Json ReportSubject::add(const std::vector<std::string>& effects) {
  RevisedModel& model = only_one();
  for (const std::string& effect : effects) expect_known_effect(effect, true);
  model.add(terms_of(effects, model.model(), *data_.for_model));
  return fitted();
}

void ReportSubject::take_back() { only_one().take_back(); }

Json ReportSubject::revise(const std::string& file) {
  RevisedModel& model = only_one();
  const EffectTest tried = model.revise();
  write_bytes(file, model.text());
  request_.model.model = file;
  const std::vector<LedgerRow> rows = read_ledger(model.text(), file);
  return {{"sentence", sentence(rows.back(), &rows[rows.size() - 2])},
          {"supported", tried.after.verdict == "supported"},
          {"ledger", ledger_part(rows)}};
}

}  // namespace ballbar
