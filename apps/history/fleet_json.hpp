// Many machines as JSON; the keys: apps/history/README.md.
#pragma once

#include <nlohmann/json.hpp>

#include "ballbar/history/fleet.hpp"

namespace ballbar {

nlohmann::ordered_json json_of(const Fleet& fleet);

}  // namespace ballbar
