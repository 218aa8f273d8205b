// [spindle] of a machine.toml.
#pragma once

#include "ballbar/lab/simulation/virtual_spindle.hpp"
#include "text/toml_source.hpp"

namespace ballbar {

// default_end_s: end of the plan where the table has no end_min; none: it must have one.
VirtualSpindle read_spindle(const TomlTable& table, std::optional<double> default_end_s);

}  // namespace ballbar
