// Whether an effect is one of the catalogue, which no file has to be read for.
#pragma once

#include <string>

namespace ballbar {

// Throws CLI::ValidationError, with the nearest name where one is near, for a word, NAME, NAME:ROLE=COLUMN or
// NAME(COLUMN), whose name no effect of either level has. `or_file`: where a file could stand as well.
void expect_known_effect(const std::string& word, bool or_file);

}  // namespace ballbar
