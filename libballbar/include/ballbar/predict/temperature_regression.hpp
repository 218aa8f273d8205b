// Regression of thermal error on temperatures over batches of tests, by principal components (PCR; Tan 2024, eq. 1 to
// 8) or ridge. Inputs are centred, not scaled, as there.
//
//   PCR    y = b0 + sum_j g_j x_j with g = L_p D_p^-1 L_p' S_xy: the first p eigenvectors L and eigenvalues D of S_xx
//   ridge  g = (S_xx + n k I)^-1 S_xy, k in K^2; 0 along eigenvectors of less than 1e-12 of the largest eigenvalue
//
// p and k are chosen by leaving out one batch at a time, or p by the explained share of the inputs' variance. All
// components, or k = 0, are ordinary least squares.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/predict/batch.hpp"
#include "ballbar/predict/prediction.hpp"

namespace ballbar {

enum class RegressionMethod { pcr, ridge };
inline constexpr RegressionMethod kRegressionMethods[] = {RegressionMethod::pcr, RegressionMethod::ridge};
std::string_view name_of(RegressionMethod method);

struct RegressionSettings {
  RegressionMethod method = RegressionMethod::pcr;
  std::size_t components = 0;  // pcr: 1 to m
  double penalty_K2 = 0.0;     // ridge: k >= 0

  bool operator==(const RegressionSettings&) const = default;
};

// "pcr, 5 components", "ridge, penalty 0.01 K^2"
std::string label_of(const RegressionSettings& settings);

// y = intercept + slope' x
struct Regression {
  Eigen::VectorXd slope_um_per_K;
  double intercept_um = 0.0;
};

// Throws Error: more components than inputs, or none.
Regression regress(const Moments& moments, const RegressionSettings& settings);

// All of a method's settings at one go: the decomposition is done once.
std::vector<Regression> regress(const Moments& moments, std::span<const RegressionSettings> settings);

// Root mean square error over the rows of the moments: from them, no reading is looked at again.
double rmse_um(const Moments& moments, const Regression& regression);

// The fewest components that explain `share` (0 to 1) of the inputs' variance.
std::size_t components_for(const Moments& moments, double share);

// Settings worth trying: 1 to min(m, 20) components, or 19 penalties from 1e-6 to 1e3 K^2.
std::vector<RegressionSettings> settings_of(RegressionMethod method, std::size_t inputs);

// Every batch predicted by a regression to all the others, by their weights: batches by settings, um. Throws Error
// below 2 batches. O(batches settings m^2) and one decomposition a batch.
Eigen::MatrixXd held_out_um(std::span<const Batch> batches, std::span<const RegressionSettings> settings,
                            std::span<const double> weights = {});

// Those of settings_of with the least mean square of held_out_um over batches.
RegressionSettings best_settings(std::span<const Batch> batches, RegressionMethod method);

// What the training data span. A row x has the scores z = L_p' (x - mean); then
//   T2 = sum z_j^2 / d_j  (Hotelling; d_j the variance of z_j),   Q = |x - mean - L_p z|^2  (what no component draws)
struct TrainedRange {
  Eigen::VectorXd mean_degC;                  // m
  Eigen::MatrixXd loadings;                   // m by p: what explains 99.9 % of the variance
  Eigen::VectorXd variance_K2;                // p
  Eigen::VectorXd score_low_K, score_high_K;  // p: over all training rows
  Eigen::VectorXd low_degC, high_degC;        // m: of each input
  double largest_T2 = 0.0;
  double largest_Q_K2 = 0.0;
};
TrainedRange range_of(const Moments& moments);
// The same, widened to hold these rows (n by m).
TrainedRange widened(const TrainedRange& range, const Eigen::MatrixXd& inputs);

struct TrainedBatch {
  std::string name;
  std::size_t rows = 0;
  double weight = 1.0;
  double rmse_um = 0.0;
  double held_out_um = 0.0;  // NaN: not left out
};

// A regression with what it was trained on, as a model file holds it.
struct TemperatureRegression {
  BatchColumns columns;
  RegressionSettings settings;
  Regression regression;
  TrainedRange range;
  double rmse_um = 0.0;
  double held_out_rmse_um = 0.0;
  // 95 % of the errors of batches left out are smaller, if each is normal with its batch's RMSE
  double half_width_um = 0.0;
  std::vector<TrainedBatch> batches;
};

// At least 2 batches of weight above 0. `series_of` reads a batch again (for the trained range); called once for each
// of them, in order.
TemperatureRegression temperature_regression(std::span<const Batch> batches, std::span<const double> weights,
                                             const BatchColumns& columns, const RegressionSettings& settings,
                                             const std::function<Series(std::size_t)>& series_of);

// Within it lie 95 % of a mixture of normal distributions about 0, one for each sigma, in the shares of the weights.
double half_width_95_um(std::span<const double> sigma_um, std::span<const double> weights = {});

// As many batches of one weight: (sum w)^2 / sum w^2 (Kish).
double effective_batches(std::span<const double> weights);

// Throws Error as inputs_of.
RegressionPrediction predict(const TemperatureRegression& model, const Series& series);

}  // namespace ballbar
