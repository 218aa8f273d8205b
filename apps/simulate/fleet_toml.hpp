// Virtual fleet `fleet.toml`: the machines whose tests `ballbar simulate` makes. All keys but the format are optional,
// with the defaults of virtual_fleet.hpp. The keys are fleet_keys().
//
//   format = "ballbar-fleet 1"
//   machines = 40
//   [[error]]
//   name = "squareness"
//   spread = 10.0
//   scatter = 1.5
//   [[story]]
//   machine = 7
//   kind = "crash"
//   month = 20
//   errors = { squareness_xy = 25.0 }
#pragma once

#include <string_view>
#include <vector>

#include "ballbar/formats/text/keys.hpp"
#include "ballbar/lab/simulation/virtual_fleet.hpp"

namespace ballbar {

std::vector<KeyTable> fleet_keys();

// Whether the bytes are TOML with the format of a fleet.
bool is_fleet(std::string_view bytes);

// `name` is used in messages. Unknown keys are errors. Throws Error with name:line:column. fleet_tests() checks that
// the machines and errors of the stories exist.
VirtualFleet read_fleet(std::string_view bytes, std::string_view name);

}  // namespace ballbar
