// Virtual machine `machine.toml`: what `ballbar simulate` reads; and the files of the session it makes.
#pragma once

#include <filesystem>
#include <string_view>

#include "ballbar/simulate.hpp"

namespace ballbar {

// `name` stands in messages. Unknown keys are errors. Throws Error with name:line:column.
VirtualMachine read_machine(std::string_view bytes, std::string_view name);

// Writes session.toml, the logs (or `.b5r` files), signals.csv, five-probe.csv into `folder`, and the
// truth into `truth_file`. Existing files of those names are replaced one by one, each whole.
void write_simulated(const SimulatedSession& simulated, const std::filesystem::path& folder,
                     const std::filesystem::path& truth_file, bool as_b5r);

}  // namespace ballbar
