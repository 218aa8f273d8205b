#include "state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "ballbar/error.hpp"

namespace ballbar::hal {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kFormat = "ballbar-hal-state 1";

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double number_of(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

}  // namespace

std::string write_state(const Compensator& compensator) {
  const Compensator::State& state = compensator.state();
  const LiveModel::State& model = compensator.model().state();
  Json json;
  json["format"] = kFormat;
  json["columns"] = std::vector<std::string>(compensator.columns().begin(), compensator.columns().end());
  json["resolution_um"] = state.resolution_um;
  json["timed"] = state.timed;
  json["started"] = state.started;
  json["time_s"] = state.time_s;
  json["clock_s"] = state.clock_s;
  json["doubtful_s"] = number(state.doubtful_s);
  json["origin_um"] = state.origin_um;
  json["offset_um"] = state.offset_um;
  json["counts"] = state.counts;
  for (const Compensator::Sensor& sensor : state.sensors) {
    json["sensors"].push_back(
        {number(sensor.believed), number(sensor.believed_s), number(sensor.read), number(sensor.unchanged_since_s)});
  }
  json["model"] = {{"rows", model.rows}, {"time_s", model.time_s}, {"inputs", model.inputs}, {"kept", model.kept}};
  return json.dump(1) + "\n";
}

void resume(Compensator& compensator, std::string_view bytes, const std::string& name) {
  Compensator::State state;
  LiveModel::State model;
  try {
    const Json json = Json::parse(bytes);
    if (json.at("format") != kFormat) throw Error(fmt::format("{}: expected format \"{}\".", name, kFormat));
    if (json.at("columns") !=
        Json(std::vector<std::string>(compensator.columns().begin(), compensator.columns().end()))) {
      throw Error(
          fmt::format("{}: this is the state of a model of other columns: {}.", name, json.at("columns").dump()));
    }
    json.at("resolution_um").get_to(state.resolution_um);
    json.at("timed").get_to(state.timed);
    json.at("started").get_to(state.started);
    json.at("time_s").get_to(state.time_s);
    json.at("clock_s").get_to(state.clock_s);
    state.doubtful_s = number_of(json.at("doubtful_s"));
    json.at("origin_um").get_to(state.origin_um);
    json.at("offset_um").get_to(state.offset_um);
    json.at("counts").get_to(state.counts);
    for (const Json& sensor : json.at("sensors")) {
      state.sensors.push_back(
          {number_of(sensor.at(0)), number_of(sensor.at(1)), number_of(sensor.at(2)), number_of(sensor.at(3))});
    }
    json.at("model").at("rows").get_to(model.rows);
    json.at("model").at("time_s").get_to(model.time_s);
    json.at("model").at("inputs").get_to(model.inputs);
    json.at("model").at("kept").get_to(model.kept);
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: expected a state that ballbar-hal wrote: {}.", name, error.what()));
  }
  try {
    compensator.resume(state, model);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace ballbar::hal
