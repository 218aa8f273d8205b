// One more effect beside the best pairs, weighed beside one variant of the model.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/table.hpp"

namespace ballbar {

// At these points. The pairs have the shapes that are likeliest without the third.
void weigh_triples(const Problem& problem, SetTable& table, std::size_t variant,
                   const std::vector<std::size_t>& points);

}  // namespace ballbar
