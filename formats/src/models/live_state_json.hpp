// LiveModel::State as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "ballbar/model/live_model.hpp"
#include "text/json_source.hpp"

namespace ballbar {

nlohmann::ordered_json json_of(const LiveModel::State& live);

// Throws Error for anything but what json_of made; whether it suits a model is for LiveModel::resume.
LiveModel::State live_state_at(const JsonValue& value);

}  // namespace ballbar
