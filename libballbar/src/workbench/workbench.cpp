#include "ballbar/workbench/workbench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/message_catalogue.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "diagnosis/verdict/start_values.hpp"
#include "model/measured_input.hpp"
#include "revision/effect_test_parts.hpp"

namespace ballbar {
namespace {

// A fit in the form that the tests of effects need.
bool is_plain(const FitOptions& options) { return !options.robust && !options.white && !options.noise; }

// A fit with its misfits, and the inference about missing effects.
ResidualReport report_of(Fit fit, const Model& model, const Series& data) {
  ResidualReport report{std::move(fit), {}, {}, {}, {}};
  report.where = where_it_fails(report.fit, data);
  report.whiteness = whiteness(report.fit);
  if (model.level == Level::series) report.coefficients = coefficients_of(model, report.fit, data);
  if (model.level == Level::series) report.faults = faults_bearing_on(data, report.fit.target);
  for (const std::string& name : measured_inputs_with_gaps(model, data)) {
    const auto& values = find_column(data, name)->values;
    const auto known = std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    report.fit.remarks.emplace_back(messages::fit_measured_input(name, known, values.size()));
  }
  return report;
}

// An inference about a model with these terms as given; nullopt: all are as a search has them.
std::optional<Inference> inference_of_unusual(const Model& model, const Series& data, const DiagnosisOptions& options,
                                              std::vector<Term> terms) {
  std::erase_if(terms, [&](const Term& term) { return is_usual(term, model, data); });
  if (terms.empty()) return std::nullopt;
  return inference_of(model, data, 0, options, terms);
}

// Whether an inference looked at these effects in their usual ranges.
bool has_searched(const Inference& inference, const std::vector<Term>& terms) {
  return std::all_of(terms.begin(), terms.end(), [&](const Term& term) {
    const std::vector<Setting> usual = term_of(*term.effect, term.columns).settings;
    const bool has_usual_ranges =
        std::equal(usual.begin(), usual.end(), term.settings.begin(),
                   [](const Setting& a, const Setting& b) { return a.lower == b.lower && a.upper == b.upper; });
    return has_usual_ranges && family_of(*inference.problem, {term.effect.get(), term.columns});
  });
}

}  // namespace

ResidualReport residual_report_of(const Model& model, const Series& data, std::size_t target,
                                  const FitOptions& options) {
  return report_of(fit(model, data, target, options), model, data);
}

// A model with additional effects, their shapes at start values. The fit is not stored: it is large and quick to
// repeat.
struct TrialModel {
  std::vector<Term> terms;  // as they were given
  Model model;
  double rmse_um = 0.0;
};

// A model with its results.
struct Workbench::Step {
  Model model;
  std::vector<TrialModel> tried;      // additional effects that were tried
  std::vector<Term> added;            // to the previous step, as given
  std::optional<Inference> of_added;  // of the previous step with these terms; nullopt: its own
  std::optional<Fit> fit;             // as the tests of effects have it
  std::optional<LedgerRow> row;
  std::optional<ResidualReport> check;
  std::optional<Inference> inference;
  std::optional<Diagnosis> diagnosis;
  std::optional<std::optional<Predictability>> predictability;
  std::optional<EffectTest> test;  // of the added terms

  const TrialModel* find_tried(const std::vector<Term>& terms) const {
    const auto known =
        std::find_if(tried.begin(), tried.end(), [&](const TrialModel& one) { return one.terms == terms; });
    return known == tried.end() ? nullptr : &*known;
  }
};

Workbench::Workbench(std::shared_ptr<const Series> data, Model model, WorkbenchOptions options)
    : data_(std::move(data)), options_(std::move(options)) {
  steps_.push_back(std::make_unique<Step>());
  now().model = std::move(model);
}
Workbench::Workbench(Workbench&& other) noexcept = default;
Workbench& Workbench::operator=(Workbench&& other) noexcept = default;
Workbench::~Workbench() = default;

Workbench::Step& Workbench::now() const { return *steps_.back(); }
const Series& Workbench::data() const { return *data_; }
const Model& Workbench::model() const { return now().model; }

const ResidualReport& Workbench::check() {
  Step& step = now();
  if (!step.check) {
    if (options_.diagnosis.search.progress) options_.diagnosis.search.progress("fitting");
    step.check = is_plain(options_.fit) && !is_of_machine_errors(step.model, *data_)
                     ? report_of(plain_fit(step), step.model, *data_)
                     : residual_report_of(step.model, *data_, 0, options_.fit);
  }
  return *step.check;
}

const Fit& Workbench::plain_fit(Step& step) const {
  if (!step.fit) step.fit = fit(step.model, *data_);
  return *step.fit;
}

FittedModel Workbench::fitted(Step& step) const {
  const Fit& fit = plain_fit(step);
  if (!step.row) step.row = row_of(fit, step.model, *data_, 0);
  return {step.model, fit, *step.row};
}

Inference& Workbench::inference(Step& step) const {
  if (!step.inference) step.inference = inference_of(step.model, *data_, 0, options_.diagnosis);
  return *step.inference;
}

const Diagnosis& Workbench::diagnosis() {
  Step& step = now();
  if (!step.diagnosis) {
    DiagnosisOptions how = options_.diagnosis;
    how.where = worst_place(check().fit, check().where);
    step.diagnosis = diagnosis_of(inference(step), step.model, *data_, 0, how);
  }
  return *step.diagnosis;
}

const std::optional<Predictability>& Workbench::predictability() {
  Step& step = now();
  if (!step.predictability) {
    const auto& progress = options_.diagnosis.search.progress;
    step.predictability = ballbar::predictability(step.model, *data_, [&](const std::string& what) {
      if (progress) progress(what);
    });
  }
  return *step.predictability;
}

std::unique_ptr<Workbench::Step> Workbench::step_with(const std::vector<Term>& terms) {
  auto next = std::make_unique<Step>();
  next->added = terms;
  if (const TrialModel* known = now().find_tried(terms)) {
    next->model = known->model;
    return next;
  }
  next->model = model();
  next->model.terms.insert(next->model.terms.end(), terms.begin(), terms.end());
  expect_suits(next->model, *data_);
  if (is_of_machine_errors(next->model, *data_)) return next;
  // An inference at hand gives start values, even where a shape is held elsewhere than usual.
  if (!now().inference || !has_searched(*now().inference, terms))
    next->of_added = inference_of_unusual(model(), *data_, options_.diagnosis, terms);
  next->model = model_with(next->of_added ? *next->of_added : inference(now()), model(), terms);
  return next;
}

double Workbench::rmse_um_with(const std::vector<Term>& terms) {
  if (const TrialModel* known = now().find_tried(terms)) return known->rmse_um;
  const std::unique_ptr<Step> step = step_with(terms);
  const double rmse_um = fit(step->model, *data_, 0, {.among_all_errors = true}).rmse_um;
  now().tried.push_back({terms, std::move(step->model), rmse_um});
  return rmse_um;
}

void Workbench::add(const std::vector<Term>& terms) {
  steps_.push_back(step_with(terms));
  if (steps_.size() > 2) steps_[steps_.size() - 3]->inference.reset();  // large and no longer needed
}

const EffectTest& Workbench::added() {
  Step& step = now();
  if (!step.test) {
    Step& before = *steps_.at(steps_.size() - 2);
    if (is_of_machine_errors(step.model, *data_)) {
      step.test = machine_error_test(before.model, step.added, *data_, 0);
    } else {
      if (!step.of_added) step.of_added = inference_of_unusual(before.model, *data_, options_.diagnosis, step.added);
      step.test = effect_test_of(step.of_added ? *step.of_added : inference(before), fitted(before), fitted(step),
                                 step.added.size(), *data_, 0);
    }
    step.of_added.reset();
  }
  return *step.test;
}

LedgerRow Workbench::row(std::size_t back) {
  Step& step = *steps_.at(steps_.size() - 1 - back);
  if (is_of_machine_errors(step.model, *data_)) return row_of(step.model, *data_);
  return fitted(step).row;
}

EffectTest Workbench::effect_test(const std::vector<Term>& terms) {
  add(terms);
  const auto back = [this] { steps_.pop_back(); };
  try {
    EffectTest test = added();
    back();
    return test;
  } catch (...) {
    back();
    throw;
  }
}

void Workbench::replace(Model model) {
  steps_.push_back(std::make_unique<Step>());
  now().model = std::move(model);
}

bool Workbench::undo() {
  if (steps_.size() < 2) return false;
  steps_.pop_back();
  return true;
}

}  // namespace ballbar
