#include "ballbar/formats/models/effect_regression_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "text/json_source.hpp"
#include "text/json_text.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kAnyFormat = "\"ballbar-effect-regression ";
constexpr std::size_t kMostRows = 1'000'000'000;

std::vector<std::string> texts_at(const JsonValue& value) {
  std::vector<std::string> texts;
  const std::size_t count = size_of_array(value);
  for (std::size_t i = 0; i < count; ++i) texts.push_back(text(element(value, i)));
  return texts;
}

std::vector<double> numbers_at(const JsonValue& value) {
  const Eigen::VectorXd read = numbers(value, size_of_array(value), "any");
  return {read.begin(), read.end()};
}

double number_not_below(const JsonValue& value, double low) {
  const double read = number(value);
  if (read < low) fail(value, fmt::format("a number not below {}", low));
  return read;
}

std::optional<Forecasts> forecasts_at(const JsonValue& value) {
  if (value.value->is_null()) return std::nullopt;
  if (!value.value->is_object()) fail(value, "an object or null");
  expect_keys(value, {"count", "error_um", "rmse_um", "held_um", "within_share"});
  Forecasts forecasts;
  forecasts.count = whole(member(value, "count"), 1, kMostRows);
  forecasts.error_um = number_not_below_0(member(value, "error_um"));
  forecasts.rmse_um = number_not_below_0(member(value, "rmse_um"));
  const JsonValue held = member(value, "held_um");
  forecasts.held_um = held.value->is_null() ? std::numeric_limits<double>::quiet_NaN() : number_not_below_0(held);
  forecasts.within_share = number_not_below_0(member(value, "within_share"));
  if (forecasts.within_share > 1.0) fail(member(value, "within_share"), "a share from 0 to 1");
  return forecasts;
}

void read_columns(const JsonValue& value, EffectRegression& regression) {
  const std::size_t count = size_of_array(value);
  if (count == 0) fail(value, "at least one column", "none");
  for (std::size_t c = 0; c < count; ++c) {
    const JsonValue column = element(value, c);
    expect_keys(column, {"name", "role", "low", "high"});
    const ColumnRange range{text(member(column, "name")), number(member(column, "low")),
                            number(member(column, "high"))};
    if (range.column == regression.model.targets.front())
      fail(member(column, "name"), "another column than the target");
    if (range.low > range.high) fail(member(column, "low"), fmt::format("a number not above {} of high", range.high));
    const std::optional<Role> role = role_from_name(text(member(column, "role")));
    if (!role) fail(member(column, "role"), "a role of a column");
    regression.model.trained.push_back(range);
    regression.roles.push_back(*role);
  }
}

// Columns by name, to find those of many terms at once.
class Columns {
 public:
  explicit Columns(const JsonValue& columns, const std::vector<ColumnRange>& ranges)
      : at_(columns), is_read_(ranges.size()) {
    for (const ColumnRange& range : ranges) {
      names_.push_back(range.column);
      if (index_.emplace(range.column, index_.size()).second) continue;
      fail(member(element(columns, names_.size() - 1), "name"), "each column once");
    }
  }

  std::string read(const JsonValue& value, const Input& input) {
    std::string name = text(value);
    const auto known = index_.find(name);
    if (known == index_.end()) {
      fail(value, "one of the names in columns",
           fmt::format("{}; the nearest is {}", in_quotes(name), nearest_name(name, names_)));
    }
    if (!input.units.empty() && std::find(input.units.begin(), input.units.end(), unit_of(name)) == input.units.end()) {
      fail(value, fmt::format("a column in {} for {}", fmt::join(input.units, " or "), input.role));
    }
    is_read_[known->second] = true;
    return name;
  }

  void expect_all_read() const {
    const auto idle = std::find(is_read_.begin(), is_read_.end(), false);
    if (idle == is_read_.end()) return;
    fail(member(element(at_, static_cast<std::size_t>(idle - is_read_.begin())), "name"), "a column that a term reads");
  }

 private:
  JsonValue at_;
  std::vector<bool> is_read_;
  std::vector<std::string_view> names_;
  std::map<std::string_view, std::size_t> index_;
};

std::shared_ptr<const Effect> effect_at(const JsonValue& value, const Catalogue& effects) {
  const std::string name = text(value);
  std::vector<std::string_view> known;
  for (const std::shared_ptr<const Effect>& effect : effects) {
    if (effect->name == name) return effect;
    known.push_back(effect->name);
  }
  fail(value, fmt::format("one of the effects {}", fmt::join(known, ", ")),
       fmt::format("{}; the nearest is {}", in_quotes(name), nearest_name(name, known)));
}

// A prediction takes the first gain alone; shapes may be 0, where an effect is without delay.
void expect_usable(const JsonValue& values, const Effect& effect, const Eigen::VectorXd& parameters) {
  bool is_first = true;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const Parameter& parameter = effect.parameters[k];
    const double value = parameters[static_cast<Eigen::Index>(k)];
    if (parameter.kind == ParameterKind::gain) {
      if (!is_first && value != 0.0) fail(element(values, k), fmt::format("0 for {}, its second gain", parameter.name));
      is_first = false;
      continue;
    }
    const double low = std::min(parameter.lower, 0.0);
    if (value >= low && value <= parameter.upper) continue;
    fail(element(values, k), fmt::format("a {} from {} to {}", parameter.name, low, parameter.upper));
  }
}

Term term_at(const JsonValue& value, const Catalogue& effects, Columns& columns) {
  expect_keys(value, {"effect", "columns", "parameters", "mean_um", "sd_um"});
  const std::shared_ptr<const Effect> effect = effect_at(member(value, "effect"), effects);
  const JsonValue inputs = member(value, "columns");
  const std::size_t count = effect->inputs.size();
  if (size_of_array(inputs) != count) {
    fail(inputs, fmt::format("an array of {} (one for each input of {})", count, effect->name),
         fmt::format("an array of {}", size_of_array(inputs)));
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) names.push_back(columns.read(element(inputs, k), effect->inputs[k]));
  const JsonValue values = member(value, "parameters");
  const Eigen::VectorXd parameters =
      numbers(values, effect->parameters.size(), fmt::format("one for each parameter of {}", effect->name));
  expect_usable(values, *effect, parameters);
  return held_term(effect, std::move(names), {parameters.begin(), parameters.end()});
}

void read_terms(const JsonValue& value, const JsonValue& columns_value, const Catalogue& catalogue,
                EffectRegression& regression) {
  const std::size_t count = size_of_array(value);
  if (count == 0) fail(value, "at least one term", "none");
  const Catalogue effects = predictor_effects(catalogue);
  Columns columns(columns_value, regression.model.trained);
  std::vector<double> mean_um, sd_um;
  for (std::size_t t = 0; t < count; ++t) {
    const JsonValue term = element(value, t);
    regression.model.terms.push_back(term_at(term, effects, columns));
    mean_um.push_back(number(member(term, "mean_um")));
    sd_um.push_back(number(member(term, "sd_um")));
    if (!(sd_um.back() > 0.0)) fail(member(term, "sd_um"), "a number above 0");
  }
  columns.expect_all_read();
  const auto m = static_cast<Eigen::Index>(count);
  regression.mean_um = Eigen::Map<const Eigen::VectorXd>(mean_um.data(), m);
  regression.sd_um = Eigen::Map<const Eigen::VectorXd>(sd_um.data(), m);
}

// Every row is read before there is room for the square: the file has half its numbers.
Eigen::MatrixXd factor_at(const JsonValue& value, std::size_t terms) {
  const std::size_t m = terms + 2;
  if (size_of_array(value) != m) {
    fail(value, fmt::format("{} arrays (two more than terms)", m), fmt::format("{}", size_of_array(value)));
  }
  std::vector<Eigen::VectorXd> rows;
  rows.reserve(m);
  for (std::size_t i = 0; i < m; ++i) rows.push_back(numbers(element(value, i), i + 1, "a row of a lower triangle"));
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(m));
  for (Eigen::Index i = 0; i < factor.rows(); ++i) {
    factor.row(i).head(i + 1) = rows[static_cast<std::size_t>(i)].transpose();
  }
  return factor;
}

void read_end(const JsonValue& value, EffectRegression& regression) {
  expect_keys(value, {"time_s", "step_s", "discrepancy_um", "rows", "times_s", "inputs", "kept"});
  regression.end_s = number(member(value, "time_s"));
  regression.end_step_s = number_not_below_0(member(value, "step_s"));
  regression.end_discrepancy_um = number(member(value, "discrepancy_um"));
  LiveModel::State& end = regression.end;
  end.rows = whole(member(value, "rows"), 0, end.time_s.size());
  const Eigen::VectorXd times_s = numbers(member(value, "times_s"), end.time_s.size(), "first, last but one, last");
  std::copy(times_s.begin(), times_s.end(), end.time_s.begin());
  end.inputs = numbers_at(member(value, "inputs"));
  end.kept = numbers_at(member(value, "kept"));
  try {
    LiveModel(regression.model).resume(end);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", value.source->name, error.what()));
  }
}

std::string json_of(std::span<const double> numbers) {
  return json_text(Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size())));
}

std::string json_of(const Forecasts& forecasts) {
  return fmt::format("{{\"count\": {}, \"error_um\": {}, \"rmse_um\": {}, \"held_um\": {}, \"within_share\": {}}}",
                     forecasts.count, json_text(forecasts.error_um), json_text(forecasts.rmse_um),
                     std::isnan(forecasts.held_um) ? "null" : json_text(forecasts.held_um),
                     json_text(forecasts.within_share));
}

std::string columns_text(const EffectRegression& regression) {
  std::vector<std::string> lines;
  for (std::size_t c = 0; c < regression.model.trained.size(); ++c) {
    const ColumnRange& range = regression.model.trained[c];
    lines.push_back(fmt::format("    {{\"name\": {}, \"role\": \"{}\", \"low\": {}, \"high\": {}}}",
                                json_text(range.column), name_of(regression.roles[c]), json_text(range.low),
                                json_text(range.high)));
  }
  return fmt::format("{}", fmt::join(lines, ",\n"));
}

std::string terms_text(const EffectRegression& regression) {
  std::vector<std::string> lines;
  for (std::size_t t = 0; t < regression.model.terms.size(); ++t) {
    const Term& term = regression.model.terms[t];
    std::vector<double> parameters;
    parameters.reserve(term.settings.size());
    for (const Setting& setting : term.settings) parameters.push_back(setting.start);
    const auto at = static_cast<Eigen::Index>(t);
    lines.push_back(
        fmt::format("    {{\"effect\": {}, \"columns\": {}, \"parameters\": {}, \"mean_um\": {}, \"sd_um\": {}}}",
                    json_text(term.effect->name), json_text(term.columns), json_of(parameters),
                    json_text(regression.mean_um[at]), json_text(regression.sd_um[at])));
  }
  return fmt::format("{}", fmt::join(lines, ",\n"));
}

// Most of the file: rounded, which the half width alone shows.
std::string factor_text(const Eigen::MatrixXd& factor) {
  std::string out;
  for (Eigen::Index i = 0; i < factor.rows(); ++i) {
    out += i == 0 ? "    [" : ",\n    [";
    for (Eigen::Index j = 0; j <= i; ++j) {
      if (!std::isfinite(factor(i, j))) json_text(factor(i, j));
      out += fmt::format("{}{:.9g}", j == 0 ? "" : ", ", factor(i, j) + 0.0);  // "-0" would be an integer
    }
    out += ']';
  }
  return out;
}

}  // namespace

std::string write_effect_regression(const EffectRegression& regression) {
  std::string out = fmt::format("{{\n  \"format\": \"{}\",\n", kRegressionFormat);
  out += fmt::format("  \"target\": {},\n", json_text(regression.model.targets.front()));
  out += fmt::format("  \"dictionary\": {},\n", json_text(regression.dictionary));
  out += fmt::format("  \"prior_variance\": {},\n", json_text(regression.prior_variance));
  out += fmt::format("  \"sigma_um\": {},\n", json_text(regression.sigma_um));
  out += fmt::format("  \"length_s\": {},\n", json_text(regression.length_s));
  out += fmt::format("  \"interval_scale\": {},\n", json_text(regression.interval_scale));
  out += fmt::format("  \"rows\": {},\n  \"runs\": {},\n", regression.rows, regression.runs);
  out += fmt::format("  \"rmse_um\": {},\n", json_text(regression.rmse_um));
  out += fmt::format("  \"forecasts\": {},\n", regression.forecasts ? json_of(*regression.forecasts) : "null");
  out += fmt::format("  \"columns\": [\n{}\n  ],\n", columns_text(regression));
  out += fmt::format("  \"left_out\": {},\n", json_text(regression.left_out));
  out += fmt::format("  \"constant_um\": {},\n", json_text(regression.model.constant_um.value_or(0.0)));
  out += fmt::format("  \"terms\": [\n{}\n  ],\n", terms_text(regression));
  out += fmt::format("  \"factor_um\": [\n{}\n  ],\n", factor_text(regression.factor_um));
  const LiveModel::State& end = regression.end;
  out += fmt::format("  \"end\": {{\n    \"time_s\": {},\n    \"step_s\": {},\n    \"discrepancy_um\": {},\n",
                     json_text(regression.end_s), json_text(regression.end_step_s),
                     json_text(regression.end_discrepancy_um));
  out += fmt::format("    \"rows\": {},\n    \"times_s\": {},\n", end.rows, json_of(end.time_s));
  return out + fmt::format("    \"inputs\": {},\n    \"kept\": {}\n  }}\n}}\n", json_of(end.inputs), json_of(end.kept));
}

EffectRegression read_effect_regression(std::string_view bytes, std::string_view name, const Catalogue& catalogue) {
  const JsonSource source = parse_json(bytes, name);
  const JsonValue root = root_of(source);
  if (!root.value->is_object()) fail(root, "an object");
  choice_index(member(root, "format"), {kRegressionFormat});
  expect_keys(root,
              {"format", "target", "dictionary", "prior_variance", "sigma_um", "length_s", "interval_scale", "rows",
               "runs", "rmse_um", "forecasts", "columns", "left_out", "constant_um", "terms", "factor_um", "end"});
  EffectRegression regression;
  regression.model.targets = {text(member(root, "target"))};
  const std::string_view unit = unit_of(regression.model.targets.front());
  if (unit != "um" && !unit.empty()) fail(member(root, "target"), "a name that ends in _um, or in no unit");
  regression.dictionary = texts_at(member(root, "dictionary"));
  regression.prior_variance = number_not_below_0(member(root, "prior_variance"));
  regression.sigma_um = number_not_below_0(member(root, "sigma_um"));
  regression.length_s = number_not_below_0(member(root, "length_s"));
  regression.interval_scale = number_not_below(member(root, "interval_scale"), 1.0);
  regression.rows = whole(member(root, "rows"), 1, kMostRows);
  regression.runs = whole(member(root, "runs"), 1, kMostRows);
  regression.rmse_um = number_not_below_0(member(root, "rmse_um"));
  regression.forecasts = forecasts_at(member(root, "forecasts"));
  read_columns(member(root, "columns"), regression);
  regression.left_out = texts_at(member(root, "left_out"));
  regression.model.constant_um = number(member(root, "constant_um"));
  read_terms(member(root, "terms"), member(root, "columns"), catalogue, regression);
  regression.factor_um = factor_at(member(root, "factor_um"), regression.model.terms.size());
  read_end(member(root, "end"), regression);
  return regression;
}

bool is_effect_regression_json(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] == '{' && head.find(kAnyFormat) != std::string_view::npos;
}

}  // namespace ballbar
