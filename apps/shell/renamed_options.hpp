// Options that have another name now. The old one is understood for one more release, and not shown in any help.
#pragma once

#include <string>
#include <vector>

namespace ballbar {

// The words with the names of now; what was renamed is said on the standard error.
std::vector<std::string> with_names_of_now(std::vector<std::string> words);

}  // namespace ballbar
