#include "ballbar/formats/models/compensation_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "ballbar/formats/models/prediction_state.hpp"
#include "text/json_source.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kCompensationFormat = "ballbar-compensation 1";
constexpr std::string_view kPredictionFormat = "ballbar-prediction 1";
constexpr std::size_t kMostNumbers = 1'000'000;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double number_or_none(const JsonValue& value) { return value.value->is_null() ? kNone : number(value); }

std::uint64_t unsigned_at(const JsonValue& value) {
  if (!value.value->is_number_unsigned()) fail(value, "a whole number not below 0");
  return value.value->get<std::uint64_t>();
}

bool truth(const JsonValue& value) {
  if (!value.value->is_boolean()) fail(value, "true or false");
  return value.value->get<bool>();
}

std::vector<double> numbers_of(const JsonValue& value) {
  const std::size_t count = size_of_array(value);
  if (count > kMostNumbers) fail(value, "at most a million numbers");
  std::vector<double> read;
  read.reserve(count);
  for (std::size_t i = 0; i < count; ++i) read.push_back(number(element(value, i)));
  return read;
}

// LiveModel::State as JSON.
Json json_of(const LiveModel::State& live) {
  return {{"rows", live.rows}, {"time_s", live.time_s}, {"inputs", live.inputs}, {"kept", live.kept}};
}

// Throws Error for anything but what json_of made; whether it suits a model is for LiveModel::resume.
LiveModel::State live_state_at(const JsonValue& value) {
  expect_keys(value, {"rows", "time_s", "inputs", "kept"});
  LiveModel::State live;
  live.rows = whole(member(value, "rows"), 0, live.time_s.size());
  const std::vector<double> time_s = numbers_of(member(value, "time_s"));
  if (time_s.size() != live.time_s.size()) fail(member(value, "time_s"), "3 numbers");
  std::copy(time_s.begin(), time_s.end(), live.time_s.begin());
  live.inputs = numbers_of(member(value, "inputs"));
  live.kept = numbers_of(member(value, "kept"));
  return live;
}

Json json_of(const StoredAxis& axis) {
  const Compensator::State& state = axis.state;
  Json json{{"name", axis.name},
            {"model", axis.model},
            {"resolution_um", state.resolution_um},
            {"counts", state.counts},
            {"offset_um", state.offset_um},
            {"timed", state.timed},
            {"started", state.started},
            {"believed", state.believed},
            {"contradicted", state.contradicted},
            {"time_s", state.time_s},
            {"pace_s", state.pace_s},
            {"clock_s", state.clock_s},
            {"doubtful_s", or_null(state.doubtful_s)},
            {"origin_um", state.origin_um}};
  Json sensors = Json::array();
  for (const Compensator::Sensor& sensor : state.sensors) {
    sensors.push_back({{"believed", or_null(sensor.believed)},
                       {"believed_s", or_null(sensor.believed_s)},
                       {"read", or_null(sensor.read)},
                       {"unchanged_since_s", or_null(sensor.unchanged_since_s)}});
  }
  json["sensors"] = std::move(sensors);
  json["live"] = json_of(axis.live);
  return json;
}

Compensator::State state_at(const JsonValue& value) {
  Compensator::State state;
  state.resolution_um = number(member(value, "resolution_um"));
  const double counts = number(member(value, "counts"));
  if (!(std::abs(counts) <= 1e15) || counts != std::round(counts)) fail(member(value, "counts"), "a whole number");
  state.counts = static_cast<std::int64_t>(counts);
  state.offset_um = number(member(value, "offset_um"));
  state.timed = truth(member(value, "timed"));
  state.started = truth(member(value, "started"));
  state.believed = static_cast<int>(whole(member(value, "believed"), 0, 2));
  state.contradicted = static_cast<int>(whole(member(value, "contradicted"), 0, 2));
  state.time_s = number(member(value, "time_s"));
  state.pace_s = number_not_below_0(member(value, "pace_s"));
  state.clock_s = number(member(value, "clock_s"));
  state.doubtful_s = number_or_none(member(value, "doubtful_s"));
  state.origin_um = number(member(value, "origin_um"));
  const JsonValue sensors = member(value, "sensors");
  for (std::size_t i = 0; i < size_of_array(sensors); ++i) {
    const JsonValue sensor = element(sensors, i);
    expect_keys(sensor, {"believed", "believed_s", "read", "unchanged_since_s"});
    state.sensors.push_back({number_or_none(member(sensor, "believed")), number_or_none(member(sensor, "believed_s")),
                             number_or_none(member(sensor, "read")),
                             number_or_none(member(sensor, "unchanged_since_s"))});
  }
  return state;
}

}  // namespace

std::string write_compensation(const StoredCompensation& stored) {
  Json json{{"format", kCompensationFormat}, {"signals", nullptr}, {"axes", Json::array()}};
  if (stored.signals) {
    json["signals"] = {
        {"file", stored.signals->file}, {"inode", stored.signals->inode}, {"bytes", stored.signals->bytes}};
  }
  for (const StoredAxis& axis : stored.axes) json["axes"].push_back(json_of(axis));
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + '\n';
}

StoredCompensation read_compensation(std::string_view bytes, std::string_view name) {
  const JsonSource source = parse_json(bytes, name);
  const JsonValue root = root_of(source);
  expect_keys(root, {"format", "signals", "axes"});
  choice_index(member(root, "format"), {kCompensationFormat});
  StoredCompensation stored;
  const JsonValue signals = member(root, "signals");
  if (!signals.value->is_null()) {
    expect_keys(signals, {"file", "inode", "bytes"});
    stored.signals = {text(member(signals, "file")), unsigned_at(member(signals, "inode")),
                      unsigned_at(member(signals, "bytes"))};
  }
  const JsonValue list = member(root, "axes");
  for (std::size_t i = 0; i < size_of_array(list); ++i) {
    const JsonValue value = element(list, i);
    expect_keys(value, {"name", "model", "resolution_um", "counts", "offset_um", "timed", "started", "believed",
                        "contradicted", "time_s", "pace_s", "clock_s", "doubtful_s", "origin_um", "sensors", "live"});
    const JsonValue model = member(value, "model");
    if (!model.value->is_string()) fail(model, "a text");
    stored.axes.push_back({text(member(value, "name")), model.value->get<std::string>(), state_at(value),
                           live_state_at(member(value, "live"))});
  }
  return stored;
}

std::string write_prediction_state(const StoredPrediction& stored) {
  const Json json{{"format", kPredictionFormat},
                  {"model", stored.model},
                  {"since_end", stored.since_end},
                  {"live", json_of(stored.live)}};
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + '\n';
}

StoredPrediction read_prediction_state(std::string_view bytes, std::string_view name) {
  const JsonSource source = parse_json(bytes, name);
  const JsonValue root = root_of(source);
  expect_keys(root, {"format", "model", "since_end", "live"});
  choice_index(member(root, "format"), {kPredictionFormat});
  return {text(member(root, "model")), truth(member(root, "since_end")), live_state_at(member(root, "live"))};
}

}  // namespace ballbar
