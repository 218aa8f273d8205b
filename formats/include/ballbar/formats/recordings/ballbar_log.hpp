// Ballbar log `.csv`: one recording with its header. The file begins with comment lines, which are TOML after the `# `.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// `name` is used in messages. Throws Error with name:line:column.
Recording read_ballbar_log(std::string_view bytes, std::string_view name);

// The recording without readings, from the comment lines. `bytes`: the first lines of the file, or all of it.
Recording read_ballbar_log_header(std::string_view bytes, std::string_view name);

// The text reads back to the same doubles (lengths in mm; angles in deg: within one unit in the last place).
std::string write_ballbar_log(const Recording& recording);

}  // namespace ballbar
