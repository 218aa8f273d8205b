// Virtual fleet `fleet.toml`: a plant of machines that `ballbar simulate` makes the tests of. All but the format is
// optional; what is not given has the default of virtual_fleet.hpp. The keys are fleet_keys() of keys.hpp.
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

#include "ballbar/lab/simulation/virtual_fleet.hpp"

namespace ballbar {

// Whether the bytes say that they are a fleet; text of another format, and what is no TOML, is none.
bool is_fleet(std::string_view bytes);

// `name` stands in messages. Unknown keys are errors. Throws Error with name:line:column; stories of machines and
// errors that are not there are left to fleet_tests().
VirtualFleet read_fleet(std::string_view bytes, std::string_view name);

}  // namespace ballbar
