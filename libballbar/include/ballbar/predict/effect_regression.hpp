// A regression that predicts without naming causes: all suitable effects of the catalogue, on every accepted column and
// at a few shapes each, in one ridge regression with a correlated discrepancy.
//
//   y = b + sum_k g_k x_k + e,   e ~ N(0, s^2 (0.98 exp(-|dt| / l) + 0.02))
//
// Three choices maximise the restricted likelihood of every k-th training row, at most 830, or with five or more runs
// minimise the error of left-out runs (ridge.hpp): the dictionary of effects (sources of heat, temperatures, feedback
// of a source, differences of temperatures, and with several runs their start temperatures), the ridge penalty, and l
// in {0, 1800, 7200, 30 000 s}. The gains are not physical constants, because correlated temperatures share them.
//
// Known effects, those of a given model, join the regression with gains that are not penalised. They are kept if the
// forecasts, or with five or more runs the predictions of left-out runs, are better with them.
//
// A regression of other machines can be a start. With its gains g0, their covariance C0 and its s0 the prior is
//
//   g ~ N(g0, C0 + s^2 v (P + C0 / s0^2))
//
// where v, the variation between machines, maximises the likelihood of the new rows: a two-level hierarchical model
// (Gelman and others 2013, Bayesian Data Analysis, chapter 5). v = 0: the machines are equal.
//
// The accuracy is tested by forecasts, for which the whole procedure is repeated on earlier rows only. If a record ends
// in a drift that no column drives, these forecasts show that holding the last value is as good.
//
// Accuracy: measured record of a spindle over 28 h (sample-runs/spindle-46h), forecasts up to 8 h from three origins:
// mean absolute error 1.0, 1.2, 2.1, 1.8, 1.8 um of its five channels, 94 % within the interval of 95 %.
//
// Source of the method: ridge regression as the posterior mean of a Gaussian process with restricted likelihood,
// Rasmussen, Williams 2006, chapter 2 and 5; no paper's equations.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/model/live_model.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/predict/held_out.hpp"
#include "ballbar/predict/prediction.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Errors of forecasts of rows outside the training data, averaged over all these rows.
struct Forecasts {
  std::size_t count = 0;  // number of origins, or of left-out runs
  double error_um = 0.0;  // mean absolute
  double rmse_um = 0.0;
  double held_um =
      0.0;  // RMSE where the last value before is held, or their mean: the better one; of runs where 0 um is taken
  double within_share = 0.0;  // within the interval of 95 %, before interval_scale
};

struct DriverStability {
  DriverShare share;
  double low_um = 0.0, high_um = 0.0;
  bool stable = false, flips = false;  // flips: the sign changes, with more than a twentieth of the range
};

struct CancellingColumns {
  std::string first, second;
  double first_um = 0.0, second_um = 0.0, sum_um = 0.0;  // ranges
};

// How far the contributions of the columns can be interpreted.
//
//   low, high        range of a share over refits, each without one cycle of speed or one run
//   stable           the same sign in all refits, and the largest at most three times the smallest
//   not needed       ln L (ridge.hpp) falls by less than 1 without the column
//   interchangeable  columns that are not needed and have |correlation| of at least 0.98: any one of them is enough
//   cancelling       two columns with opposite contributions (correlation below -0.9), each with more than twice the
//                    range of their sum: they cannot be interpreted separately
struct DriverReport {
  double range_um = 0.0;  // of the prediction on the training rows
  std::size_t refits = 0;
  std::vector<DriverStability> drivers;  // the largest share first
  std::vector<std::string> not_needed;
  std::vector<std::vector<std::string>> interchangeable;
  std::vector<CancellingColumns> cancelling;  // at most 5, the largest first
};

struct EffectRegression {
  Model model;  // one target, constant and all parameters held, `trained` for every column
  // Mean and standard deviation of each term for a gain of 1, over the training rows.
  Eigen::VectorXd mean_um, sd_um;
  std::size_t named = 0;                // number of its last terms that come from a given model
  std::vector<std::string> dictionary;  // kinds of effects as printed: "sources", "temperatures" ...
  double prior_variance = 0.0;          // v, of a family's scaled gains over s^2
  double sigma_um = 0.0;                // s
  double length_s = 0.0;                // l; 0: no memory
  Eigen::MatrixXd factor_um;       // lower, m + 2: its square is the covariance of the constant at the means, of the
                                   // scaled gains, and of the discrepancy at the end
  double interval_scale = 1.0;     // of the interval, from the forecasts; at least 1
  std::size_t rows = 0, runs = 0;  // number of training rows and runs
  double rmse_um = 0.0;            // on the training rows, without the discrepancy
  std::optional<Forecasts> forecasts;  // nullopt: too few rows before and after an origin
  std::vector<Role> roles;             // roles of the columns in model.trained
  std::vector<std::string> left_out;   // columns with gaps and constant columns

  // The state at the end of training. A record that continues from there is predicted as one.
  double end_s = 0.0;
  double end_step_s = 0.0;  // median of its rows
  double end_discrepancy_um = 0.0;
  LiveModel::State end;
};

// The contribution of the effects of a given model, and whether they improve the prediction.
struct NamedEffect {
  std::string label;
  double share_um = 0.0, sigma_um = 0.0;  // as in DriverShare; sigma: from its gain alone
};
struct NamedEffects {
  std::vector<NamedEffect> effects;  // empty: left out
  double rest_um = 0.0;              // share of all other effects
  // RMSE of forecasts with and without them; nullopt where the choice was made by the likelihood or by left-out runs.
  std::optional<double> with_um, without_um;
};

// The use of another regression as a start.
struct Start {
  bool used = false;      // false: not used, because forecasts are better without it
  double own_um = 0.0;    // share of the prediction that differs from the start
  double start_um = 0.0;  // share of the prediction that comes from the start
  // Share, 0 to 1, of the variance of the start that the new rows do not reduce: the borrowed part.
  double borrowed = 0.0;
  // RMSE of forecasts with the start and without it; nullopt without forecasts, or with five or more runs.
  std::optional<double> adapted_um, alone_um;
};

struct EffectRegressionOptions {
  std::function<void(const std::string& what)> progress = {};  // called before each longer step
  bool few = false;  // the mean of nine small selections of effects instead of the whole dictionary
  // A model whose effects join the regression with free gains, if that improves the prediction.
  std::optional<Model> named = std::nullopt;
  // A regression of other machines: its gains, covariance and spread are the prior of the gains.
  const EffectRegression* start = nullptr;
  bool forecasts = true, report = true;
};

struct TrainedRegression {
  EffectRegression regression;
  DriverReport drivers;
  std::optional<HeldOutErrors> left_out;  // of left-out runs; only with five or more runs
  NamedEffects named;
  std::optional<Start> start;
};

// Trains on runs, each of which starts from its own thermal state. Throws Error: no such target, fewer than 40 values,
// a column of the first run that another one lacks, no usable column.
TrainedRegression trained_regression(std::span<const Series> runs, const std::string& target,
                                     const EffectRegressionOptions& options = {},
                                     const Catalogue& catalogue = built_in_catalogue());

// The same without the report.
EffectRegression effect_regression(std::span<const Series> runs, const std::string& target,
                                   const EffectRegressionOptions& options = {},
                                   const Catalogue& catalogue = built_in_catalogue());

// The effects that a regression may use: those of the catalogue with one gain and an input, and the effect of the start
// of a run, which is not in the catalogue.
Catalogue predictor_effects(const Catalogue& catalogue = built_in_catalogue());

// A term with every parameter held at its value, as in the model of a regression. One value per parameter.
Term held_term(std::shared_ptr<const Effect> effect, std::vector<std::string> columns,
               const std::vector<double>& parameters);

// "speeds and temperatures"
std::string dictionary_text(const EffectRegression& regression);

// Predicts row by row, as signals arrive.
class LivePrediction {
 public:
  explicit LivePrediction(const EffectRegression& regression);  // which must outlive it

  struct At {
    double predicted_um = 0.0;
    double half_width_um = 0.0;  // of the 95 % interval from gains, discrepancy and noise
    bool outside = false;        // a column is outside its trained range by more than a tenth of that range
  };

  std::span<const std::string> columns() const { return live_.columns(); }

  // As LiveModel::next(). Allocates no memory. NaN if the row gives no finite value.
  At next(double time_s, std::span<const double> values);

  // The columns to which contributions are assigned: the first column of each term, each once.
  std::span<const std::string> drivers() const { return drivers_; }
  std::span<const Eigen::Index> driver_of_term() const { return driver_of_; }

  // n rows of a series: times, n values of each of columns(), and the places of the results.
  struct Rows {
    std::span<const double> time_s;
    std::vector<std::span<const double>> values;
    std::span<double> predicted_um, half_width_um;
    Eigen::Ref<Eigen::MatrixXd> drivers_um;  // n by drivers(), to which contributions are added
  };

  // Many rows at once, on all cores, with the same results bit by bit. Returns false and changes nothing if a result
  // may not be finite; pass the rows one by one then.
  bool next(const Rows& rows);

  // Continues with the next row from the end of training.
  void go_on();
  // Starts again with the first row of the last training run.
  void begin_training_again();
  // Restores the state of an earlier prediction. `since_end`: it continued from the end of training.
  void resume(const LiveModel::State& state, bool since_end);
  const LiveModel::State& state() const { return live_.state(); }
  bool goes_on() const { return goes_on_; }

  // Contributions to the last row that was passed by itself, in the order of the terms.
  std::span<const double> contributions_um() const { return contributions_um_; }
  double discrepancy_um() const { return discrepancy_um_; }

 private:
  double forgotten(double time_s) const;
  double half_width_um(const Eigen::Ref<const Eigen::VectorXd>& scaled, Eigen::VectorXd& room) const;

  const EffectRegression& of_;
  LiveModel live_;                                // with gains of 1
  std::vector<double> gains_, mean_um_, per_sd_;  // of every term
  std::vector<double> low_, high_;                // as columns()
  std::vector<double> contributions_um_;
  std::vector<std::string> drivers_;
  std::vector<Eigen::Index> driver_of_;  // of every term
  Eigen::VectorXd scaled_, room_;
  std::vector<double> units_;
  double discrepancy_um_ = 0.0;
  bool goes_on_ = false;
};

// from: the state of an earlier prediction, before all rows of the series. Without it the series begins a run, or
// continues from training if its times say so. Throws Error for a missing column (with the nearest name), or if `from`
// is of another model.
RegressionPrediction predict(const EffectRegression& regression, const Series& series,
                             const std::optional<PredictionState>& from = std::nullopt);

}  // namespace ballbar
