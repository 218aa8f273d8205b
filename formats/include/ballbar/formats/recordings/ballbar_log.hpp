// Ballbar log `.csv`: one recording with its header. Comment lines first; each, without its `# `, is TOML.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// `name` stands in messages. Throws Error with name:line:column.
Recording read_ballbar_log(std::string_view bytes, std::string_view name);

// What its comment lines say, without readings. `bytes`: its first lines, or all.
Recording read_ballbar_log_header(std::string_view bytes, std::string_view name);

// Reads back to the same doubles (lengths in mm, angles in deg: to one unit in the last place).
std::string write_ballbar_log(const Recording& recording);

}  // namespace ballbar
