// Surrogates of an effect on recordings: curves over the angle with the same smoothness, without the cause.
//
// The curve of the effect over the angle gets random phases, separately on each recording. Recordings with equal curves
// share the phases: the surrogate of a squareness is the same in both directions, that of a play differs.
//
// An effect with one or two waves per turn has no surrogates: rotated by a random angle it is still nearly itself, or a
// related effect of the catalogue.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "diagnosis/surrogates/surrogate_series.hpp"

namespace ballbar {

// The best of `count` surrogates, fitted with as many gains as the effect. nullopt: more than 1 % of them equal the
// effect (coherence above 0.95 after removing the model), so that the comparison is meaningless. rows: of the fit.
std::optional<BestSurrogate> best_recording_surrogate(const SurrogateSource& traced, const Series& data,
                                                      const std::vector<std::size_t>& rows,
                                                      const Background& background, std::size_t count,
                                                      std::uint64_t seed);

}  // namespace ballbar
