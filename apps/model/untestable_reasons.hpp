// Why effects could not be tested, for the terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ballbar/diagnosis/signatures/identifiability.hpp"

namespace ballbar {

// What several effects have in common once: each reason with their names, in the order of the detectabilities.
std::vector<std::pair<std::string, std::vector<std::string>>> by_reason(const std::vector<Detectability>& untestable);

}  // namespace ballbar
