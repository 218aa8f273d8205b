// Selects the recorded batches to train on for a given job.
//
// Tan 2024: batches k are ranked by |T0 - Tk|, the difference between the room temperature at the start of the job and
// the mean room temperature of the batch. A regression M_i is fitted to the first i batches. The paper takes the first
// i whose modelling error is "clearly below" the earlier ones. The definite rule used here is the smallest i with
//
//   RMSE_m(i) < (1 - fall) min(RMSE_m(1) .. RMSE_m(i-1)),  fall = 0.1; all batches if there is none.
//
// Two alternatives are also computed. The first is the number of batches, at least 2, that is best in cross-validation:
// the 30 batches most similar to the job (by d_k below) are each left out, ranked and predicted in the same way; if all
// others are best, all batches are used. The second uses weights instead of a cut:
//
//   w_k = exp(-d_k^2 / (2 h^2)),  d_k^2 = sum_f ((f_job - f_k) / s_f)^2
//
// The features f are room temperature, mean and spread of the sensors at the start of the test, and the mean speed if
// logged. s_f is their standard deviation over the batches; h is chosen by the same cross-validation. Weights are
// relative to the largest; those below 0.05 are set to 0, except for the nearest three.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/predict/temperature_regression.hpp"

namespace ballbar {

struct ChoiceOptions {
  RegressionMethod method = RegressionMethod::pcr;
  std::optional<double> share;  // pcr: components by explained share; nullopt: by cross-validation over all batches
  double fall = 0.1;
};

struct RankedBatch {
  std::size_t batch = 0;  // index of the batch
  std::string name;
  double room_apart_K = 0.0;                // |T0 - Tk|
  double distance = 0.0;                    // d_k
  double weight = 0.0;                      // w_k
  double modelling_rmse_um = 0.0;           // RMSE_m of M_i, i = rank
  RegressionSettings settings;              // of M_i
  std::optional<double> predicted_rmse_um;  // RMSE_p, where the job was measured
};

enum class Take { paper, held_out, weights, all };
inline constexpr std::array<std::string_view, 4> kTakes{"paper", "held_out", "weights", "all"};
inline std::string_view name_of(Take take) { return kTakes.at(static_cast<std::size_t>(take)); }

// The training set by one of these rules.
struct BatchChoice {
  Take take = Take::all;
  std::size_t batches = 0;      // number with a weight above 0
  std::vector<double> weights;  // one per batch
  RegressionSettings settings;
  std::optional<double> predicted_rmse_um;  // RMSE_p, where the job was measured
};

struct HeldOutNumber {
  std::size_t batches = 0;
  double rmse_um = 0.0;  // over batches similar to the job
};

struct BatchRanking {
  std::vector<RankedBatch> ranked;  // by room_apart_K
  bool paper_found = false;         // false: no such fall; all batches are used
  std::vector<HeldOutNumber> held_out;
  double bandwidth = 0.0;              // h; infinite: equal weights
  std::array<BatchChoice, 4> choices;  // as Take
  const BatchChoice& choice(Take take) const { return choices.at(static_cast<std::size_t>(take)); }
};

// Uses the start conditions of `job`. `measured`: the moments of the job for RMSE_p, or nullptr. Throws Error for fewer
// than 3 batches.
BatchRanking batch_ranking(std::span<const Batch> batches, const BatchStart& job, const Moments* measured,
                           const ChoiceOptions& options = {});

// Random choices of as many batches, as a baseline for a choice.
struct RandomChoices {
  std::size_t batches = 0;                // in each choice: the effective number of the compared choice
  std::vector<double> predicted_rmse_um;  // sorted
  double share_worse = 0.0;               // share of random choices that are worse than the compared choice
};
struct RandomOptions {
  std::size_t choices = 100;
  std::uint64_t seed = 1;
};
// `than`: the compared choice, with its RMSE_p. share: as in ChoiceOptions, applied to each random choice.
RandomChoices random_choices(std::span<const Batch> batches, const Moments& measured, const BatchChoice& than,
                             const std::optional<double>& share, const RandomOptions& options = {});

}  // namespace ballbar
