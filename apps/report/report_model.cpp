// A model held against data, and what it lacks, as parts of a report.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>

#include "ballbar/fit/residual.hpp"
#include "ballbar/series/cycles.hpp"
#include "ballbar/units.hpp"
#include "report/report_parts.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

const Column* speed_of(const Series& data) {
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  return speed == data.columns.end() ? nullptr : &*speed;
}

std::vector<double> at_rows(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> chosen;
  chosen.reserve(rows.size());
  for (const std::size_t row : rows) chosen.push_back(values[row]);
  return chosen;
}

Json column(const std::string& name, std::string_view role, std::string_view unit, const std::vector<double>& values) {
  return {{"name", name}, {"role", role}, {"unit", unit}, {"values", bulk(values)}};
}

// What the residual can be plotted against.
Json inputs_of(const Fit& fit, const ModelData& data) {
  Json inputs = Json::array();
  for (const Column& one : data.series.columns) {
    if (one.name == fit.target || one.name.find("_sigma_") != std::string::npos) continue;
    std::vector<double> values = at_rows(one.values, fit.row);
    const auto known = [](double value) { return std::isfinite(value); };
    if (std::none_of(values.begin(), values.end(), known)) continue;
    if (one.name == "angle_rad") {
      std::transform(values.begin(), values.end(), values.begin(), deg_from_rad);
      inputs.push_back(column("angle_deg", name_of(one.role), "deg", values));
    } else {
      inputs.push_back(column(one.name, name_of(one.role), unit_of(one.name), values));
    }
  }
  const std::vector<std::size_t> cycles = cycles_of(data.series, fit.row);
  inputs.push_back(column("cycle", "event", "", {cycles.begin(), cycles.end()}));
  return inputs;
}

Json regimes_of(const Series& data) {
  Json stretches = Json::array();
  const Column* speed = speed_of(data);
  if (speed == nullptr) return stretches;
  const std::vector<Regime> all = regimes(data.time_s, *speed);
  for (std::size_t row = 0; row < all.size(); ++row) {
    const bool goes_on = row > 0 && all[row] == all[row - 1];
    if (row > 0) stretches.back()["to_s"] = data.time_s[row];
    if (goes_on) continue;
    stretches.push_back({{"regime", name_of(all[row])}, {"from_s", data.time_s[row]}, {"to_s", data.time_s[row]}});
  }
  return stretches;
}

// A model of this effect alone, its parameters held at their values.
std::vector<double> drawn_by(const Term& term, const FittedParameter* parameters, const Series& data) {
  Model alone;
  alone.level = term.effect->level;
  alone.terms = {term};
  std::vector<FittedParameter> values(1);  // the constant, 0
  values.insert(values.end(), parameters, parameters + term.effect->parameters.size());
  return predict(alone, values, data).contribution_um.front();
}

// Least and largest of the column where the effect has its values.
std::pair<double, double> range_of(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return {low, high};
}

double median_of(const std::vector<double>& values) {
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](double v) { return std::isfinite(v); });
  if (known.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  return *middle;
}

// An input at its least value for a tenth of the time and at its largest from then on; the other inputs stay at their
// median. The time: five of the longest time constant, at least 30 min.
Json step_of(const Term& term, const FittedParameter* parameters, std::size_t input, const Series& data) {
  constexpr std::size_t kRows = 240;
  const std::string& name = term.columns[input];
  const Column* stepped = find_column(data, name);
  if (stepped == nullptr) return nullptr;
  const auto [low, high] = range_of(stepped->values);
  if (!(high > low)) return nullptr;
  double longest_s = 0.0;
  for (std::size_t k = 0; k < term.effect->parameters.size(); ++k) {
    const Parameter& parameter = term.effect->parameters[k];
    const bool time = parameter.unit == "s" && parameter.name.find("onset") == std::string::npos;
    if (time) longest_s = std::max(longest_s, parameters[k].value);
  }
  const double span_s = std::max(5.0 * longest_s, 1800.0);
  Series series;
  for (std::size_t i = 0; i < kRows; ++i) {
    series.time_s.push_back(span_s * (static_cast<double>(i) / (kRows - 1) * 1.1 - 0.1));
  }
  for (const std::string& other : term.columns) {
    if (find_column(series, other) != nullptr) continue;
    const Column* source = find_column(data, other);
    if (source == nullptr) return nullptr;
    const double usual = median_of(source->values);
    if (!std::isfinite(usual)) return nullptr;
    Column filled{other, source->role, std::vector<double>(kRows, usual)};
    for (std::size_t i = 0; i < kRows && other == name; ++i) filled.values[i] = series.time_s[i] < 0.0 ? low : high;
    series.columns.push_back(std::move(filled));
  }
  return {{"effect", label_of(term)},
          {"input", name},
          {"from", number(low)},
          {"to", number(high)},
          {"unit", unit_of(name)},
          {"time_s", bulk(series.time_s)},
          {"response_um", bulk(drawn_by(term, parameters, series))}};
}

Json steps_of(const Fit& fit, const Model& model, const Series& data) {
  Json steps = Json::array();
  std::size_t first = 1;  // after the constant
  for (const Term& term : model.terms) {
    for (std::size_t input = 0; input < term.columns.size(); ++input) {
      Json step = step_of(term, &fit.parameters[first], input, data);
      if (!step.is_null()) steps.push_back(std::move(step));
    }
    first += term.effect->parameters.size();
  }
  return steps;
}

// What the free parameters of the model can make of a curve at the rows of the fit, to first order: its part in the
// space of their columns of the Jacobian.
class Makeable {
 public:
  explicit Makeable(const Fit& fit) : free_(free_columns(fit)), solver_(free_.rows(), free_.cols()) {
    solver_.setThreshold(1e-6);  // two columns that differ by less are one: what they differ by is no freedom
    if (free_.cols() > 0) solver_.compute(free_);
  }

  std::vector<double> of(const std::vector<double>& curve) const {
    std::vector<double> made(curve.size(), 0.0);
    if (free_.cols() == 0 || curve.empty()) return made;
    const auto n = static_cast<Eigen::Index>(curve.size());
    Eigen::VectorXd::Map(made.data(), n) = free_ * solver_.solve(Eigen::VectorXd::Map(curve.data(), n));
    return made;
  }

 private:
  // Scaled to length 1: their units differ.
  static Eigen::MatrixXd free_columns(const Fit& fit) {
    std::vector<Eigen::Index> free;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const bool moves = fit.parameters[k].state == ParameterState::free && fit.jacobian.col(column).norm() > 0.0;
      if (moves) free.push_back(column);
    }
    Eigen::MatrixXd columns = fit.jacobian(Eigen::all, free);
    columns.colwise().normalize();
    return columns;
  }

  Eigen::MatrixXd free_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
};

// Of each candidate what it adds that the model cannot make: where it joins, the model's own parameters give way.
void add_curves(Json& candidates, const std::vector<Candidate>& found, const Fit& fit, const Makeable& makeable,
                const Series& data) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::vector<double> curve = curve_of(found[i], fit, data);
    const std::vector<double> made = makeable.of(curve);
    for (std::size_t row = 0; row < curve.size(); ++row) curve[row] -= made[row];
    candidates[i]["label"] = label_of(found[i].bound);
    candidates[i]["curve_um"] = bulk(curve);
  }
}

Json coherence_of(const Diagnosis& found) {
  std::vector<const Prospect*> testable;
  for (const Prospect& prospect : found.prospects) {
    if (prospect.testability == Testability::testable) testable.push_back(&prospect);
  }
  if (testable.size() < 2) return nullptr;
  Json labels = Json::array(), values = Json::array();
  for (const Prospect* mine : testable) {
    std::map<std::string, double> of;
    for (const Likeness& likeness : mine->imitated_by) of[likeness.with] = likeness.coherence;
    Json row = Json::array();
    for (const Prospect* other : testable) {
      row.push_back(mine == other ? Json(1.0) : number(of[other->effect->name]));
    }
    labels.push_back(label_of(BoundEffect{mine->effect, mine->columns}));
    values.push_back(std::move(row));
  }
  return {{"effects", labels}, {"values", values}};
}

}  // namespace

std::vector<double> curve_of(const Candidate& candidate, const Fit& fit, const Series& data) {
  Term term;
  term.effect = std::shared_ptr<const Effect>(std::shared_ptr<const Effect>(), candidate.bound.effect);
  term.columns = candidate.bound.columns;
  if (candidate.parameters.size() != term.effect->parameters.size()) return {};
  for (const FittedParameter& parameter : candidate.parameters) term.settings.push_back({true, parameter.value});
  return at_rows(drawn_by(term, candidate.parameters.data(), data), fit.row);
}

Json check_part(const Checked& checked, const Model& model, const ModelData& data) {
  const Fit& fit = checked.fit;
  Json json = json_of(checked);
  json["level"] = model.level == Level::recording ? "recording" : "series";
  json["floor_text"] = floor_text(fit);
  Json series{{"time_s", bulk(fit.time_s)},
              {"measured_um", bulk(fit.measured_um)},
              {"predicted_um", bulk(fit.predicted_um)},
              {"residual_um", bulk(fit.residual_um)}};
  if (!fit.sigma_um.empty()) series["sigma_um"] = bulk(fit.sigma_um);
  series["contributions"] = Json::array();
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    series["contributions"].push_back(
        {{"effect", label_of(model.terms[t])}, {"values_um", bulk(fit.contribution_um[t])}});
  }
  series["inputs"] = inputs_of(fit, data);
  series["regimes"] = model.level == Level::series ? regimes_of(data.series) : Json::array();
  json["series"] = std::move(series);
  // Between the tests as well, where a session's signals go on.
  if (model.level == Level::series && fit.row.size() < data.series.time_s.size()) {
    json["curve"] = {{"time_s", bulk(data.series.time_s)},
                     {"predicted_um", bulk(predict(model, fit.parameters, data.series).predicted_um)}};
  }
  json["steps"] = model.level == Level::series ? steps_of(fit, model, data.series) : Json::array();
  return json;
}

Json diagnosis_part(const Diagnosed& diagnosed, const ModelData& data) {
  const Diagnosis& found = diagnosed.diagnosis;
  Json json = json_of(diagnosed);
  for (const char* key : {"where", "parameters", "correlation", "noise", "whiteness", "sentences", "remarks"}) {
    json.erase(key);  // as in the check of the same target
  }
  json["rmse_after_um"] = number(found.rmse_after_um);
  json["next_test_text"] = next_text(diagnosed);
  const Fit& fit = diagnosed.checked.fit;
  const Makeable makeable(fit);
  // Noise with a long memory lets the model's parameters stand off the readings; beside what is missing they do not.
  json["refit_um"] = bulk(makeable.of(fit.residual_um));
  add_curves(json["candidates"], found.candidates, fit, makeable, data.series);
  add_curves(json["goes_with"], found.goes_with, fit, makeable, data.series);
  json["coherence"] = coherence_of(found);
  return json;
}

}  // namespace ballbar
