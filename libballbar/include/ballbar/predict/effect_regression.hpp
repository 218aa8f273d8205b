// A model that predicts without naming causes: every effect of the catalogue that can, on every column that it accepts,
// at a few shapes each, in one ridge regression beside a discrepancy that remembers.
//
//   y = b + sum_k g_k x_k + e,   e ~ N(0, s^2 (0.98 exp(-|dt| / l) + 0.02))
//
// Which effects (sources of heat, temperatures, feedback of a source, differences of temperatures, and of several runs
// the temperatures that they start from), how far gains are held near 0, and l in {0, 1800, 7200, 30 000 s} are those
// of the largest restricted likelihood of every k-th training row, at most 830; of five or more runs those that predict
// a run best from the others (ridge.hpp). Gains are no physical constants: temperatures that move together share them.
//
// Effects that are known to act, those of a model, join the regression: their gains are no longer held near 0 with the
// others. They stay where forecasts, or of five or more runs those left out, are better with them than without.
//
// A regression of other machines is a start: with its gains g0, their covariance C0 and its s0 the gains are
//
//   g ~ N(g0, C0 + s^2 v (P + C0 / s0^2))
//
// where v, how far machines are apart, is that of the largest likelihood of the new rows: a hierarchy of two levels
// (Gelman and others 2013, Bayesian Data Analysis, chapter 5). 0: the machines are alike.
//
// How far it can be relied on is tested by forecasts, the whole procedure done again on earlier rows alone; a record
// that ends in a drift which none of its columns drives shows there that to hold the last value is as good.
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
#include "ballbar/numerics/lower_factor.hpp"
#include "ballbar/predict/held_out.hpp"
#include "ballbar/predict/prediction.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Forecasts of rows that the training did not have, on all of which these are means.
struct Forecasts {
  std::size_t count = 0;  // of origins, or of runs left out
  double error_um = 0.0;  // mean absolute
  double rmse_um = 0.0;
  double held_um =
      0.0;  // RMSE where the last value before is held, or their mean: the better one; of runs where 0 um is taken
  double within_share = 0.0;  // within the interval of 95 %, before interval_scale
};

struct DriverStability {
  DriverShare share;
  double low_um = 0.0, high_um = 0.0;
  bool stable = false, flips = false;  // flips: its sign, where it makes more than a twentieth of the range
};

struct CancellingColumns {
  std::string first, second;
  double first_um = 0.0, second_um = 0.0, sum_um = 0.0;  // ranges
};

// What may be said of the columns, and what not.
//
//   low, high        of a share over refits, each without one cycle of speed or one run
//   stable           the same sign in all of them, and the largest at most three times the smallest
//   not needed       ln L (ridge.hpp) falls by less than 1 without the column
//   interchangeable  columns that are not needed and go together, |correlation| at least 0.98: any of them will do
//   cancelling       two columns whose contributions go against each other, correlation below -0.9, each more than
//   twice
//                    as far as their sum: neither may be read by itself
struct DriverReport {
  double range_um = 0.0;  // of what is predicted on the training rows
  std::size_t refits = 0;
  std::vector<DriverStability> drivers;  // the largest share first
  std::vector<std::string> not_needed;
  std::vector<std::vector<std::string>> interchangeable;
  std::vector<CancellingColumns> cancelling;  // at most 5, the largest first
};

struct EffectRegression {
  Model model;  // one target, constant and all parameters held; `trained` of every column
  // Of each term for a gain of 1, over the training rows.
  Eigen::VectorXd mean_um, sd_um;
  std::size_t named = 0;                // of its last terms: effects of a model that was given
  std::vector<std::string> dictionary;  // kinds of effects, as printed: "sources", "temperatures" ...
  double prior_variance = 0.0;          // v, of a family's scaled gains over s^2
  double sigma_um = 0.0;                // s
  double length_s = 0.0;                // l; 0: no memory
  Eigen::MatrixXd factor_um;       // lower, m + 2: its square is the covariance of the constant at the means, of the
                                   // scaled gains, and of the discrepancy at the end
  double interval_scale = 1.0;     // of the interval, from the forecasts; at least 1
  std::size_t rows = 0, runs = 0;  // trained on
  double rmse_um = 0.0;            // of them, without the discrepancy
  std::optional<Forecasts> forecasts;  // none: too few rows before and after an origin
  std::vector<Role> roles;             // of model.trained, as the data state them
  std::vector<std::string> left_out;   // columns with gaps or that stand still

  // Where training ended: a record that goes on from there is predicted as one.
  double end_s = 0.0;
  double end_step_s = 0.0;  // median of its rows
  double end_discrepancy_um = 0.0;
  LiveModel::State end;
};

// What the effects of a model add beside all others, and whether they help.
struct NamedEffect {
  std::string label;
  double share_um = 0.0, sigma_um = 0.0;  // as a driver's share; sigma: of its gain alone
};
struct NamedEffects {
  std::vector<NamedEffect> effects;  // empty: left out
  double rest_um = 0.0;              // share of all others
  // RMSE of forecasts with them and without; one is not known where the likelihood had chosen, or of five or more runs
  // those left out.
  std::optional<double> with_um, without_um;
};

// A regression that another one started from.
struct Start {
  bool used = false;      // false: forecasts are better without it
  double own_um = 0.0;    // share of what is predicted that departs from it
  double start_um = 0.0;  // and that is its own
  // Of the variance that it leaves open, what the new rows do not settle either; 0 to 1. That much is borrowed.
  double borrowed = 0.0;
  // RMSE of forecasts with it and of these rows alone; not known without forecasts, or of five or more runs.
  std::optional<double> adapted_um, alone_um;
};

struct EffectRegressionOptions {
  std::function<void(const std::string& what)> progress = {};  // told before each longer part
  bool few = false;  // a few effects, of nine selections the mean, in place of the whole dictionary
  // Its effects are among those of the regression, their gains free, where that predicts better than without them.
  std::optional<Model> named = std::nullopt;
  // Of other machines: its gains, with their covariance and a spread, are where the gains of this one start.
  const EffectRegression* start = nullptr;
  bool forecasts = true, report = true;
};

struct TrainedRegression {
  EffectRegression regression;
  DriverReport drivers;
  std::optional<HeldOutErrors> left_out;  // the runs, of five or more
  NamedEffects named;
  std::optional<Start> start;
};

// From records that each begin with a machine as it then is. Throws Error: no such target, fewer than 40 values, a
// column of the first that another lacks, no column to train on.
TrainedRegression trained_regression(std::span<const Series> runs, const std::string& target,
                                     const EffectRegressionOptions& options = {},
                                     const Catalogue& catalogue = built_in_catalogue());

// The same without the report.
EffectRegression effect_regression(std::span<const Series> runs, const std::string& target,
                                   const EffectRegressionOptions& options = {},
                                   const Catalogue& catalogue = built_in_catalogue());

// The effects that may be its terms: of the catalogue those with one gain that read a column, and that of a run's
// start, which no catalogue has.
Catalogue predictor_effects(const Catalogue& catalogue = built_in_catalogue());

// As the terms of its model are: every parameter held at its value, of which there is one each.
Term held_term(std::shared_ptr<const Effect> effect, std::vector<std::string> columns,
               const std::vector<double>& parameters);

// "speeds and temperatures"
std::string dictionary_text(const EffectRegression& regression);

// Row by row, as signals arrive.
class LivePrediction {
 public:
  explicit LivePrediction(const EffectRegression& regression);  // which must outlive it

  struct At {
    double predicted_um = 0.0;
    double half_width_um = 0.0;  // of a 95 % interval: gains, discrepancy and noise
    bool outside = false;        // a column leaves its trained range by more than a tenth of it
  };

  std::span<const std::string> columns() const { return live_.columns(); }

  // As LiveModel::next; takes no memory. NaN where the row gives no finite value.
  At next(double time_s, std::span<const double> values);

  // Columns that contributions are counted for: the first of each term, each once.
  std::span<const std::string> drivers() const { return drivers_; }
  std::span<const Eigen::Index> driver_of_term() const { return driver_of_; }

  // n rows of a series: their times, n values of each of columns(), and what they give.
  struct Rows {
    std::span<const double> time_s;
    std::vector<std::span<const double>> values;
    std::span<double> predicted_um, half_width_um;
    Eigen::Ref<Eigen::MatrixXd> drivers_um;  // n by drivers(), to which contributions are added
  };

  // Many rows at once, shared out among the cores: each as if it came alone, to the last bit. False, and nothing has
  // changed, where a row may give no finite value: then they are to come one by one.
  bool next(const Rows& rows);

  // The next row goes on from the end of training.
  void go_on();
  // The next row is the first of the last training run, which goes on after its end.
  void begin_training_again();
  // The state of an earlier prediction; `since_end`: it went on from training.
  void resume(const LiveModel::State& state, bool since_end);
  const LiveModel::State& state() const { return live_.state(); }
  bool goes_on() const { return goes_on_; }

  // Of the last row that came alone, in the order of the model's terms.
  std::span<const double> contributions_um() const { return contributions_um_; }
  double discrepancy_um() const { return discrepancy_um_; }

 private:
  double forgotten(double time_s) const;
  double half_width_um(double known_um2, double forgotten) const;

  const EffectRegression& of_;
  LiveModel live_;                                // with gains of 1
  std::vector<double> gains_, mean_um_, per_sd_;  // of every term
  std::vector<double> low_, high_;                // as columns()
  std::vector<double> contributions_um_;
  std::vector<std::string> drivers_;
  std::vector<Eigen::Index> driver_of_;  // of every term
  LowerFactor factor_;
  std::vector<double> scaled_, room_, units_;
  double discrepancy_um_ = 0.0;
  bool goes_on_ = false;
};

// from: where an earlier prediction stood, all rows after it; without it the series begins a run, or goes on from the
// training where its times say so. Throws Error where a column is missing (with the nearest), or where `from` is of
// another model.
RegressionPrediction predict(const EffectRegression& regression, const Series& series,
                             const std::optional<PredictionState>& from = std::nullopt);

}  // namespace ballbar
