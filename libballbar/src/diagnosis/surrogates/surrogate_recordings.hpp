// Surrogates of an effect on a recording: curves over the angle as smooth as what it adds, and without its cause.
//
// What the effect adds is taken as a function of the angle, on each recording apart, and its phases are drawn at
// random. Recordings on which it adds the same share the phases: the surrogate of a squareness is the same both ways,
// that of a play of the axis is another curve in each direction.
//
// An effect of one or two waves a turn has no surrogates: turned by a random angle it is still nearly itself, or the
// effect that stands beside it in the catalogue.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "diagnosis/surrogates/surrogate_series.hpp"

namespace ballbar {

// The best of `count`, fitted with as many gains as the effect. nullopt: more than 1 % of them are the effect itself
// (coherence above 0.95, freed of the model), so that to beat them means nothing. rows: of the fit.
std::optional<BestSurrogate> best_recording_surrogate(const SurrogateSource& traced, const Series& data,
                                                      const std::vector<std::size_t>& rows,
                                                      const Background& background, std::size_t count,
                                                      std::uint64_t seed);

}  // namespace ballbar
