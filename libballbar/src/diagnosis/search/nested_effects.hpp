// Effects that at the edge of their shapes are another effect: a lag of nothing is no lag.
#pragma once

#include <cstddef>

#include "diagnosis/search/subset_fits.hpp"

namespace ballbar {

// `rich` is at the edge of its shapes `plain`, on the same columns.
bool becomes(const BoundEffect& rich, const BoundEffect& plain);

// The effect at place k of `rich` is one that at the edge of its shapes becomes that at place m of `plain`, and as
// fitted draws the same curve but for its factor.
bool draws_the_same(const SubsetFits& now, const SubsetFit& plain, std::size_t m, const SubsetFit& rich, std::size_t k);

// `rich` is `plain` but for one effect, and that draws the same.
bool redrawn(const SubsetFits& now, const SubsetFit& plain, const SubsetFit& rich);

}  // namespace ballbar
