// What effects without any cause would buy on a drift series.
#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/signatures/bank.hpp"
#include "diagnosis/statistics/evidence.hpp"

namespace ballbar {

// The best of `count` fakes: the family's signatures with their phases scrambled, the same spectrum and no cause.
struct BestFake {
  double gain = 0.0;  // largest fall of chi^2
  double fall = 0.0;  // largest relative fall of the RMSE by least squares
};
BestFake best_fake(const Family& family, const Bank& bank, const Series& data, const Leftover& leftover,
                   const Noise& noise, std::size_t count, std::uint64_t seed);

}  // namespace ballbar
