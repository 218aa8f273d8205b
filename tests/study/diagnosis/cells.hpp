// The rows of the table: which data sets, and what is asked of them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "outcome.hpp"

namespace ballbar::study {

// Shares that a study fails by where they are clearly missed: what is measured now, with a margin.
struct Gate {
  std::optional<double> most_wrong, most_called, least_in_set;
};

struct Cell {
  std::string name;
  std::string aim;
  std::function<std::optional<Outcome>(std::uint64_t seed)> outcome;  // nothing: the seed has no such data set
  Gate gate = {};
};

std::vector<Cell> cells();

// On the rich record, means of `each` rows of 15 s; the base model is speed_heating.
DataSet rich_set(std::uint64_t seed, std::size_t count, double d, const Scatter& scatter = {}, std::size_t each = 5);

}  // namespace ballbar::study
