// Which of the recorded batches to train on for the job at hand.
//
// Tan 2024: batches k are ranked by |T0 - Tk|, the room temperature as the job begins against the mean room temperature
// of the batch; a regression M_i is fitted to the first i. The paper takes the first whose modelling error is "clearly
// below" those before it. As a definite rule here: the least i with
//
//   RMSE_m(i) < (1 - fall) min(RMSE_m(1) .. RMSE_m(i-1)),  fall = 0.1; all batches where there is none.
//
// Beside it: the number of batches, at least 2, for which batches like this job (the 30 nearest by d_k below), each
// left out and ranked and predicted in the same way, come out best; all batches where that is all the others; and
// weights instead of a cut:
//
//   w_k = exp(-d_k^2 / (2 h^2)),  d_k^2 = sum_f ((f_job - f_k) / s_f)^2
//
// over the features f: room and mean of the sensors as the test begins, spread of the sensors then, mean speed where it
// is logged; s_f is their standard deviation over the batches; h is chosen by the same batches left out. Weights are
// over the largest; below 0.05 they are 0, but for the nearest three.
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
  std::optional<double> share;  // pcr: components by explained share; nothing: by batches left out, over all batches
  double fall = 0.1;
};

struct RankedBatch {
  std::size_t batch = 0;  // of the given ones
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

// What is trained on by one of these rules.
struct BatchChoice {
  Take take = Take::all;
  std::size_t batches = 0;      // of a weight above 0
  std::vector<double> weights;  // of the given batches
  RegressionSettings settings;
  std::optional<double> predicted_rmse_um;  // RMSE_p, where the job was measured
};

struct HeldOutNumber {
  std::size_t batches = 0;
  double rmse_um = 0.0;  // of batches like the job
};

struct BatchRanking {
  std::vector<RankedBatch> ranked;  // by room_apart_K
  bool paper_found = false;         // false: no fall, all are taken
  std::vector<HeldOutNumber> held_out;
  double bandwidth = 0.0;              // h; infinite: all alike
  std::array<BatchChoice, 4> choices;  // as Take
  const BatchChoice& choice(Take take) const { return choices.at(static_cast<std::size_t>(take)); }
};

// `job`: its room and its start are used, its target only for RMSE_p, where it was measured (`measured`). At least 3
// batches; throws Error.
BatchRanking batch_ranking(std::span<const Batch> batches, const BatchStart& job, const Moments* measured,
                           const ChoiceOptions& options = {});

// As many batches by chance, again and again: what a choice must be better than.
struct RandomChoices {
  std::size_t batches = 0;                // in each choice: as many of one weight as the choice that they are held to
  std::vector<double> predicted_rmse_um;  // sorted
  double share_worse = 0.0;               // than that choice
};
struct RandomOptions {
  std::size_t choices = 100;
  std::uint64_t seed = 1;
};
// `than`: with its RMSE_p. share: as ChoiceOptions, for each choice anew.
RandomChoices random_choices(std::span<const Batch> batches, const Moments& measured, const BatchChoice& than,
                             const std::optional<double>& share, const RandomOptions& options = {});

}  // namespace ballbar
