// Which column a user means: by the name that the file writes or by that of the series, with its unit or without.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// How each column may be called: as written, and without the unit.
using Headers = std::vector<std::pair<std::string, std::string>>;

// A name to compare with others: capitals, accents, signs and brackets make no difference. "probe Z (um)" and
// "probe_Z_um" are "probe z" in um; "pos_steps" is "pos" in steps.
struct ComparableName {
  std::string stem;
  std::string unit;  // the same of all its spellings; empty: none
};
std::vector<ComparableName> comparables_of(const Headers& headers);  // of the first names

// The places of the columns that are meant. An equal name is preferred to a comparable one with the same unit,
// and that to a comparable one without a unit or with another. More than one: the same header several times, or a name
// that fits several columns. O(n); `comparables`: of the headers.
std::vector<std::size_t> columns_named(std::string_view typed, const Headers& headers,
                                       const std::vector<ComparableName>& comparables);

// The name of the column in the data that is meant; `typed` itself if there is none. Throws Error for several.
std::string column_named(const Series& data, const std::string& typed);
std::vector<std::string> columns_named(const Series& data, std::vector<std::string> typed);

}  // namespace ballbar
