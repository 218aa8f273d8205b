// Single effects weighed beside one variant of the model, and that variant alone, at every point of the table.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/table.hpp"

namespace ballbar {

// Of all families, or of these alone, every shape.
void weigh_singles(const Problem& problem, SetTable& table, std::size_t variant);
void weigh_singles(const Problem& problem, SetTable& table, std::size_t variant,
                   const std::vector<std::size_t>& families);

}  // namespace ballbar
