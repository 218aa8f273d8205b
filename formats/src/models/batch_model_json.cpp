#include "ballbar/formats/models/batch_model_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "ballbar/error.hpp"
#include "text/json_source.hpp"
#include "text/json_text.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kBatchFormat = "ballbar-batch-model 1";
constexpr std::size_t kMostBatchRows = 1'000'000'000;  // of a batch; their sum stays a size_t

std::string json_of(const TrainedRange& range) {
  std::vector<std::string> loadings;
  for (Eigen::Index j = 0; j < range.loadings.cols(); ++j) loadings.push_back(json_text(range.loadings.col(j)));
  std::string out = fmt::format("    \"mean_degC\": {},\n", json_text(range.mean_degC));
  out += fmt::format("    \"loadings\": [{}],\n", fmt::join(loadings, ",\n      "));
  out += fmt::format("    \"variance_K2\": {},\n", json_text(range.variance_K2));
  out += fmt::format("    \"score_low_K\": {},\n", json_text(range.score_low_K));
  out += fmt::format("    \"score_high_K\": {},\n", json_text(range.score_high_K));
  out += fmt::format("    \"low_degC\": {},\n", json_text(range.low_degC));
  out += fmt::format("    \"high_degC\": {},\n", json_text(range.high_degC));
  out += fmt::format("    \"largest_T2\": {},\n", json_text(range.largest_T2));
  return out + fmt::format("    \"largest_Q_K2\": {}\n", json_text(range.largest_Q_K2));
}

std::string json_of(const TrainedBatch& batch) {
  return fmt::format("    {{\"name\": {}, \"rows\": {}, \"weight\": {}, \"rmse_um\": {}, \"held_out_um\": {}}}",
                     json_text(batch.name), batch.rows, json_text(batch.weight), json_text(batch.rmse_um),
                     std::isnan(batch.held_out_um) ? "null" : json_text(batch.held_out_um));
}

std::string target_at(const JsonValue& value) {
  std::string name = text(value);
  if (!name.ends_with("_um")) fail(value, "a name that ends in _um");
  return name;
}

std::string sensor_at(const JsonValue& value) {
  std::string name = text(value);
  if (!name.ends_with("_degC") && !name.ends_with("_K")) fail(value, "a name that ends in _degC or _K");
  return name;
}

BatchColumns columns_at(const JsonValue& root) {
  BatchColumns columns;
  columns.target = target_at(member(root, "target"));
  if (!member(root, "room").value->is_null()) columns.room = text(member(root, "room"));
  const JsonValue speed = member(root, "speed");
  if (!speed.value->is_null()) {
    if (!speed.value->is_string()) fail(speed, "a printable text or null");
    columns.speed = text(speed);
  }
  const JsonValue sensors = member(root, "sensors");
  const std::size_t count = size_of_array(sensors);
  if (count == 0) fail(sensors, "at least one sensor", "none");
  std::set<std::string> known;
  for (std::size_t i = 0; i < count; ++i) {
    columns.sensors.push_back(sensor_at(element(sensors, i)));
    if (!known.insert(columns.sensors.back()).second) fail(element(sensors, i), "each sensor once");
  }
  constexpr InputKind kKinds[] = {InputKind::temperature, InputKind::rise, InputKind::both};
  columns.kind =
      kKinds[choice_index(member(root, "inputs"), {name_of(kKinds[0]), name_of(kKinds[1]), name_of(kKinds[2])})];
  return columns;
}

RegressionSettings settings_at(const JsonValue& root, std::size_t inputs) {
  const JsonValue method = member(root, "method");
  if (method.value->is_string() && (text(method) == "pls" || text(method) == "ols")) {
    fail(method, "\"pcr\" or \"ridge\"",
         fmt::format("\"{}\" of an older version. Train the model again", text(method)));
  }
  RegressionSettings settings;
  settings.method =
      kRegressionMethods[choice_index(method, {name_of(kRegressionMethods[0]), name_of(kRegressionMethods[1])})];
  settings.components = whole(member(root, "components"), settings.method == RegressionMethod::pcr ? 1 : 0, inputs);
  settings.penalty_K2 = number_not_below_0(member(root, "penalty_K2"));
  return settings;
}

void expect_low_below_high(const JsonValue& range, std::string_view low_key, const Eigen::VectorXd& low,
                           std::string_view high_key, const Eigen::VectorXd& high) {
  for (Eigen::Index i = 0; i < low.size(); ++i) {
    if (low[i] <= high[i]) continue;
    fail(element(member(range, low_key), static_cast<std::size_t>(i)),
         fmt::format("a number not above {} of {}", high[i], high_key));
  }
}

TrainedRange range_at(const JsonValue& value, std::size_t inputs) {
  expect_keys(value, {"mean_degC", "loadings", "variance_K2", "score_low_K", "score_high_K", "low_degC", "high_degC",
                      "largest_T2", "largest_Q_K2"});
  constexpr std::string_view kEachInput = "one for each input", kEachComponent = "one for each of the loadings";
  TrainedRange range;
  range.mean_degC = numbers(member(value, "mean_degC"), inputs, kEachInput);
  const JsonValue loadings = member(value, "loadings");
  const std::size_t components = size_of_array(loadings);
  if (components > inputs) {
    fail(loadings, fmt::format("at most {} arrays (one for each input)", inputs), fmt::format("{}", components));
  }
  // Each is read before there is room for all: the file has a number for every one in memory.
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t j = 0; j < components; ++j) columns.push_back(numbers(element(loadings, j), inputs, kEachInput));
  range.loadings.resize(static_cast<Eigen::Index>(inputs), static_cast<Eigen::Index>(components));
  for (std::size_t j = 0; j < components; ++j) range.loadings.col(static_cast<Eigen::Index>(j)) = columns[j];
  range.variance_K2 = numbers(member(value, "variance_K2"), components, kEachComponent);
  for (std::size_t j = 0; j < components; ++j) number_not_below_0(element(member(value, "variance_K2"), j));
  range.score_low_K = numbers(member(value, "score_low_K"), components, kEachComponent);
  range.score_high_K = numbers(member(value, "score_high_K"), components, kEachComponent);
  expect_low_below_high(value, "score_low_K", range.score_low_K, "score_high_K", range.score_high_K);
  range.low_degC = numbers(member(value, "low_degC"), inputs, kEachInput);
  range.high_degC = numbers(member(value, "high_degC"), inputs, kEachInput);
  expect_low_below_high(value, "low_degC", range.low_degC, "high_degC", range.high_degC);
  range.largest_T2 = number_not_below_0(member(value, "largest_T2"));
  range.largest_Q_K2 = number_not_below_0(member(value, "largest_Q_K2"));
  return range;
}

TrainedBatch batch_at(const JsonValue& value) {
  expect_keys(value, {"name", "rows", "weight", "rmse_um", "held_out_um"});
  TrainedBatch batch;
  batch.name = text(member(value, "name"));
  batch.rows = whole(member(value, "rows"), 1, kMostBatchRows);
  batch.weight = number_not_below_0(member(value, "weight"));
  batch.rmse_um = number_not_below_0(member(value, "rmse_um"));
  const JsonValue held_out = member(value, "held_out_um");
  batch.held_out_um =
      held_out.value->is_null() ? std::numeric_limits<double>::quiet_NaN() : number_not_below_0(held_out);
  return batch;
}

std::vector<TrainedBatch> batches_at(const JsonValue& value) {
  std::vector<TrainedBatch> batches;
  bool any_weight = false;
  const std::size_t count = size_of_array(value);
  for (std::size_t i = 0; i < count; ++i) {
    batches.push_back(batch_at(element(value, i)));
    any_weight = any_weight || batches.back().weight > 0.0;
  }
  if (!any_weight) fail(value, "at least one batch of weight above 0", "none");
  return batches;
}

}  // namespace

std::string write_batch_model(const TemperatureRegression& model) {
  std::vector<std::string> batches;
  for (const TrainedBatch& batch : model.batches) batches.push_back(json_of(batch));
  std::string out = fmt::format("{{\n  \"format\": \"{}\",\n", kBatchFormat);
  out += fmt::format("  \"target\": {},\n", json_text(model.columns.target));
  out += fmt::format("  \"room\": {},\n", model.columns.room.empty() ? "null" : json_text(model.columns.room));
  out += fmt::format("  \"speed\": {},\n", model.columns.speed ? json_text(*model.columns.speed) : "null");
  out += fmt::format("  \"sensors\": {},\n", json_text(model.columns.sensors));
  out += fmt::format("  \"inputs\": \"{}\",\n", name_of(model.columns.kind));
  out += fmt::format("  \"method\": \"{}\",\n", name_of(model.settings.method));
  out += fmt::format("  \"components\": {},\n", model.settings.components);
  out += fmt::format("  \"penalty_K2\": {},\n", json_text(model.settings.penalty_K2));
  out += fmt::format("  \"intercept_um\": {},\n", json_text(model.regression.intercept_um));
  out += fmt::format("  \"slope_um_per_K\": {},\n", json_text(model.regression.slope_um_per_K));
  out += fmt::format("  \"trained_range\": {{\n{}  }},\n", json_of(model.range));
  out += fmt::format("  \"rmse_um\": {},\n", json_text(model.rmse_um));
  out += fmt::format("  \"held_out_rmse_um\": {},\n", json_text(model.held_out_rmse_um));
  out += fmt::format("  \"half_width_um\": {},\n", json_text(model.half_width_um));
  return out + fmt::format("  \"batches\": [\n{}\n  ]\n}}\n", fmt::join(batches, ",\n"));
}

TemperatureRegression read_batch_model(std::string_view bytes, std::string_view name) {
  const JsonSource source = parse_json(bytes, name);
  const JsonValue root = root_of(source);
  if (!root.value->is_object()) fail(root, "an object");
  choice_index(member(root, "format"), {kBatchFormat});
  expect_keys(root, {"format", "target", "room", "speed", "sensors", "inputs", "method", "components", "penalty_K2",
                     "intercept_um", "slope_um_per_K", "trained_range", "rmse_um", "held_out_rmse_um", "half_width_um",
                     "batches"});
  TemperatureRegression model;
  model.columns = columns_at(root);
  const std::size_t inputs = model.columns.sensors.size() * (model.columns.kind == InputKind::both ? 2 : 1);
  model.settings = settings_at(root, inputs);
  model.regression.slope_um_per_K = numbers(member(root, "slope_um_per_K"), inputs, "one for each input");
  model.regression.intercept_um = number(member(root, "intercept_um"));
  model.range = range_at(member(root, "trained_range"), inputs);
  model.rmse_um = number_not_below_0(member(root, "rmse_um"));
  model.held_out_rmse_um = number_not_below_0(member(root, "held_out_rmse_um"));
  model.half_width_um = number_not_below_0(member(root, "half_width_um"));
  model.batches = batches_at(member(root, "batches"));
  return model;
}

bool is_batch_model_json(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] == '{';
}

}  // namespace ballbar
