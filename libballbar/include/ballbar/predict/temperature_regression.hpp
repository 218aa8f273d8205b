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

// The regressions of several settings of one method; the decomposition is done once.
std::vector<Regression> regress(const Moments& moments, std::span<const RegressionSettings> settings);

// Root mean square error over the rows of the moments, computed without the readings.
double rmse_um(const Moments& moments, const Regression& regression);

// The smallest number of components that explains `share` (0 to 1) of the variance of the inputs.
std::size_t components_for(const Moments& moments, double share);

// The settings to try: 1 to min(m, 20) components, or 19 penalties from 1e-6 to 1e3 K^2.
std::vector<RegressionSettings> settings_of(RegressionMethod method, std::size_t inputs);

// RMSE in um of each batch, predicted by a weighted regression on all others: a matrix of batches by settings. Throws
// Error for fewer than 2 batches. O(batches settings m^2), and one decomposition per batch.
Eigen::MatrixXd held_out_um(std::span<const Batch> batches, std::span<const RegressionSettings> settings,
                            std::span<const double> weights = {});

// The settings of settings_of() with the smallest mean square of held_out_um() over the batches.
RegressionSettings best_settings(std::span<const Batch> batches, RegressionMethod method);

// The range of the training data. A row x has the scores z = L_p' (x - mean); then
//   T2 = sum z_j^2 / d_j  (Hotelling; d_j the variance of z_j),   Q = |x - mean - L_p z|^2  (outside the components)
struct TrainedRange {
  Eigen::VectorXd mean_degC;                  // m
  Eigen::MatrixXd loadings;                   // m by p: the components that explain 99.9 % of the variance
  Eigen::VectorXd variance_K2;                // p
  Eigen::VectorXd score_low_K, score_high_K;  // p: over all training rows
  Eigen::VectorXd low_degC, high_degC;        // m: of each input
  double largest_T2 = 0.0;
  double largest_Q_K2 = 0.0;
};
TrainedRange range_of(const Moments& moments);
// The range, widened to include these rows (n by m).
TrainedRange widened(const TrainedRange& range, const Eigen::MatrixXd& inputs);

struct TrainedBatch {
  std::string name;
  std::size_t rows = 0;
  double weight = 1.0;
  double rmse_um = 0.0;
  double held_out_um = 0.0;  // RMSE when left out; NaN: was not left out
};

// A regression with a record of its training, as in a model file.
struct TemperatureRegression {
  BatchColumns columns;
  RegressionSettings settings;
  Regression regression;
  TrainedRange range;
  double rmse_um = 0.0;
  double held_out_rmse_um = 0.0;
  // 95 % of the errors of left-out batches are smaller, if the errors of each are normal with its RMSE
  double half_width_um = 0.0;
  std::vector<TrainedBatch> batches;
};

// Needs at least 2 batches with a weight above 0. `series_of` reads a batch again, for the trained range; it is called
// once for each of them, in order.
TemperatureRegression temperature_regression(std::span<const Batch> batches, std::span<const double> weights,
                                             const BatchColumns& columns, const RegressionSettings& settings,
                                             const std::function<Series(std::size_t)>& series_of);

// The half width that contains 95 % of a mixture of normal distributions about 0, one per sigma, with these weights.
double half_width_95_um(std::span<const double> sigma_um, std::span<const double> weights = {});

// The effective number of equally weighted batches: (sum w)^2 / sum w^2 (Kish).
double effective_batches(std::span<const double> weights);

// Throws Error as inputs_of.
RegressionPrediction predict(const TemperatureRegression& model, const Series& series);

}  // namespace ballbar
