// What an effect of a fitted model is tested by, beside the rest of the model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/candidate.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/statistics/cross_validation.hpp"
#include "diagnosis/statistics/ml_noise_fit.hpp"
#include "diagnosis/surrogates/surrogate_series.hpp"

namespace ballbar {

// The term at `place` of a fitted model: what it is, its parameters and its amplitude.
Candidate candidate_of(const Model& model, const Fit& fit, std::size_t place);

// A model with and without one of its terms. Refers to all.
struct WithAndWithout {
  const Series& data;
  const Model& model;
  std::size_t term;
  const NoiseFit& with;
  const NoiseFit& without;
};

// By the noise with it.
struct FoldTests {
  double p_same_gain = 1.0;
  CrossValidation before, after;  // cycles left out, without and with it
  double in_one_fold = 0.0;       // largest share of one cycle in what it shows
  double gain_of_many = 0.0;      // fall of chi^2 that many readings make
};
FoldTests fold_tests(const WithAndWithout& models);

// Fall of chi^2 by the noise with it.
double gain_of(const WithAndWithout& models);

// The best surrogate of the effect; of recordings of the shape as fitted before `points`, which are all that a series
// has. nullopt: it has no surrogates.
std::optional<BestSurrogate> surrogate_of(const WithAndWithout& models, const BoundEffect& bound,
                                          std::vector<std::vector<double>> points, std::size_t count,
                                          std::uint64_t seed);

// The candidate with what the best surrogate does, which it has to beat.
Candidate beside_surrogate(Candidate candidate, const std::optional<BestSurrogate>& surrogate);

// Phrases of Candidate::doubts.
inline constexpr std::string_view kLowLikelihoodRatio = "its likelihood ratio is below 25 (d = 5)";
inline constexpr std::string_view kSurrogateDoesAsWell = "a surrogate of the same smoothness does as well";
std::string gain_differs(bool of_recordings);
std::string not_predicted_better(bool of_recordings);

}  // namespace ballbar
