// A long series by means of neighbouring rows.
#pragma once

#include <cstddef>
#include <string>

#include "ballbar/series.hpp"

namespace ballbar {

// At most `most` values of the target: means of as many consecutive rows of one recording each, of the time and of
// every column; a mean is a gap where one of its rows is. Of sigmas the mean's: root of the sum of squares over the
// count. The series itself where the target has no more values.
Series condensed(const Series& data, const std::string& target, std::size_t most);

}  // namespace ballbar
