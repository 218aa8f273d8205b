// The same measurement in another dress: the verdict has to stay.
#pragma once

#include <map>
#include <string>

#include "judged.hpp"

namespace ballbar::verdicts {

enum class Change { fewer_rows, renamed, kelvin, means, noise_column, second_target };

struct Twin {
  Made made;
  std::map<std::string, std::string> before;  // columns that have another name: that name to the one before
};
Twin twin_of(const Made& made, Change change, Chance& chance);

// The same word, and the same effects named.
bool is_same_verdict(const Said& before, const Said& after, const Twin& twin);

}  // namespace ballbar::verdicts
