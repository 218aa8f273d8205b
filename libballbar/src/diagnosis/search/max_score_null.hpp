// How large the best score of a whole search is when there is nothing to find.
#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/statistics/likelihood_ratio.hpp"

namespace ballbar {

// From draws of the noise through the same whitening: the largest score of every effect (all its columns and shapes)
// and, for each draw, the rarest of them. Beyond the draws the tails are exponential, from their mean excess.
class MaxScoreNull {
 public:
  // maxima: draws by effects.
  MaxScoreNull(std::vector<const Effect*> effects, Eigen::MatrixXf maxima);

  // Chance that this effect's best score is as large.
  double p_of_effect(const Effect& effect, double score) const;
  // Chance that any effect of the search shows something as rare.
  double p_search(const Effect& effect, double score) const;
  // Score of this effect that the search as a whole exceeds by chance in 1 %; of what needs nothing but time, and so
  // imitates anything slow, in 0.1 %.
  double threshold(const Effect& effect) const;

 private:
  struct Tail {
    std::vector<float> sorted;  // rising
    double from = 0.0;          // 90 % quantile
    double excess = 1.0;        // mean beyond it
    double p(double value) const;
    double quantile(double chance) const;
  };
  static Tail tail_of(std::vector<float> values);
  std::size_t index_of(const Effect& effect) const;

  std::vector<const Effect*> effects_;
  std::vector<Tail> tails_;
  Tail rarest_;  // of -ln of the smallest p_of_effect
};

// Draws through the whitening by `noise`; each from one of `plausible`.
MaxScoreNull max_score_null(const SignatureLibrary& library, const Projected& projected,
                            const LinearisedFit& linearised, const Noise& noise, const std::vector<Noise>& plausible,
                            std::size_t draws, std::uint64_t seed);

}  // namespace ballbar
