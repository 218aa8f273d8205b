// Regressions that predict a thermal error without naming its cause, and what is needed for them: batches of tests and
// their moments, errors of left-out batches, the choice of sensors.
//
//   trained_regression()      all effects of the catalogue on the columns of one or several runs: for one machine
//   temperature_regression()  principal components or ridge on temperatures over batches: for many tests of a machine
//   sensor_choice()           which thermometers the first of these needs
//   predictability()          whether what a model does not explain can be predicted
//   LivePrediction            row by row, as signals arrive
//
// A regression claims no cause: correlated temperatures share the gains. Use diagnose() to name one. Its accuracy is
// therefore stated by rows that took no part in the training: forecasts of later rows, or left-out runs and batches.
// Every figure called held out, left out or forecast repeats all choices (inputs, penalty, components) without these
// rows.
//
// Units: temperatures in the unit of the column (degC or K), rises in K, errors in um.
//
// Batches of thermal tests are reduced to the moments that a regression over many of them needs. A regression of the
// error y on m inputs x reads each batch once. The mean and the scatter
//
//   S = sum_t (v_t - mean v) (v_t - mean v)',   v = (x, y)
//
// merge exactly with those of other batches (Chan, Golub, LeVeque 1983). Every least squares fit over any choice of
// batches, and its error on any batch, follows from them. Memory: O(m^2) per batch.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/predict/predict.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The inputs that a temperature gives to the regression: its value, its rise since the start of the batch, or both.
// Values depend on the season, rises do not.
enum class InputKind { temperature, rise, both };
std::string_view name_of(InputKind kind);

// The column of that name. Throws Error with the nearest name.
const Column& column_of(const Series& series, const std::string& name);

// Whether the column is in degC or K and was not computed from the measurement.
bool is_sensor(const Column& column);

struct BatchColumns {
  std::vector<std::string> sensors;  // temperature columns
  InputKind kind = InputKind::temperature;
  std::string target;
  std::string room;                  // empty: none, or several candidates
  std::optional<std::string> speed;  // nullopt: not logged

  bool operator==(const BatchColumns&) const = default;
};

// The columns of the first batch. Every column in degC or K is a sensor. The room is the one of role ambient, or with
// room, ambient or air in its name. The speed is the only column of role speed. `room` and `target` are the user's
// choice. Throws Error with the existing columns: no temperature, no such target.
BatchColumns batch_columns(const Series& first, InputKind kind, const std::string& target,
                           const std::optional<std::string>& room);

// Throws Error without a room temperature, which is needed to rank batches.
void expect_room(const BatchColumns& columns);

// The inputs, n rows by m: temperatures, then rises. Throws Error for a missing column or a gap, with its name.
Eigen::MatrixXd inputs_of(const Series& series, const BatchColumns& columns);

// The names of the inputs in the order of inputs_of(): "T_front_degC", for a rise "T_front_degC rise".
std::vector<std::string> input_names(const BatchColumns& columns);

// The start conditions and the mean speed of a test, by which the similarity of batches is judged.
struct BatchStart {
  double room_first_degC = 0.0;    // NaN: no room temperature
  double room_mean_degC = 0.0;     // likewise
  double sensors_mean_degC = 0.0;  // over all sensors in the first row
  double sensors_spread_K = 0.0;   // standard deviation over the sensors in the first row
  double speed_mean_rpm = 0.0;     // over the whole batch; NaN: not logged
};

struct Moments {
  double weight = 0.0;      // sum of the rows times the weights of their batches
  Eigen::VectorXd mean;     // inputs, then target: m + 1
  Eigen::MatrixXd scatter;  // (m + 1) by (m + 1)
};
Moments merged(const Moments& a, const Moments& b);

struct TargetStep {
  double time_s = 0.0;
  double um = 0.0;
};

struct Batch {
  std::string name;
  std::size_t rows = 0;
  BatchStart start;
  Moments moments;
  Eigen::VectorXd sensor_first_degC, sensor_mean_degC;  // per sensor: in the first row; mean over all rows
  // Jumps of the target that a machine cannot make: changes from row to row of more than 10 times their robust spread,
  // 0.3 of the range and 1 um, between rows at most three usual steps apart. At most 5.
  std::vector<TargetStep> steps;
};

// Throws Error as inputs_of() does, for fewer than 3 rows, and for a target with gaps.
Batch batch_of(const std::string& name, const Series& series, const BatchColumns& columns);

// The moments of all batches, each row weighted by the weight of its batch (empty: 1). At least one batch.
Moments merged(std::span<const Batch> batches, std::span<const double> weights = {});

// A sensor whose readings in some batches do not fit those of the others. Its mean in a batch, minus that of the median
// sensor, is modelled as linear in the spread of the sensors (median absolute difference, a measure of the heat). The
// line is fitted by the least median of residuals, so that nearly half of the batches may be wrong. A deviation counts
// if it exceeds 8 times the robust spread of all residuals, and 5 K; the limit rises in proportion to the heat above
// that of the median batch. Returns none for fewer than 8 batches or 6 sensors.
struct BrokenSensor {
  std::string sensor;
  std::vector<std::string> batches;  // batches with deviations
  double off_K = 0.0;                // median deviation in these
};
std::vector<BrokenSensor> broken_sensors(std::span<const Batch> batches, const BatchColumns& columns);

// Sensors with one constant reading in all rows of all batches.
std::vector<std::string> constant_sensors(std::span<const Batch> batches, const BatchColumns& columns);

// Leaves these sensors out. Throws Error if none remains.
void leave_out_sensors(std::vector<Batch>& batches, BatchColumns& columns, const std::vector<std::string>& sensors);

// ---- Errors of predictions of left-out batches, comparable for all kinds of models, and for no model.

struct HeldOutErrors {
  double rms_um = 0.0;    // root of the mean square over batches of each one's RMSE
  double worst_um = 0.0;  // the largest RMSE
  std::size_t worst = 0;  // index of that batch
};

// From the RMSE of each batch; at least one.
HeldOutErrors held_out_errors(std::span<const double> batch_rmse_um);

// For the first target of a model of effects: fits all batches but one (joined_batches) and predicts that one, for each
// in turn. Calls before_fit with the left-out batch. At least 2 batches. Throws Error as joined_batches() and fit() do.
HeldOutErrors held_out_errors(const Model& model, std::span<const Series> batches, const FitOptions& options,
                              const std::function<void(std::size_t batch)>& before_fit = {});

// The same rms for a prediction of 0 um, as a baseline.
double rms_without_model_um(std::span<const Batch> batches);

// Joins batches into one series, so that a model of effects can be fitted to all of them together. The temperatures of
// each batch are rises since its first row. Between two batches are 10 days in which the machine rests at its start
// temperature without measurements (gaps of the target). The thermal history before a batch is unknown and assumed to
// be none. Only the columns of the model are kept. At least one batch; throws Error if a batch lacks a column.
Series joined_batches(std::span<const Series> batches, const Model& model);

// ---- A regression that predicts without naming causes: all suitable effects of the catalogue, on every accepted
// column and at a few shapes each, in one ridge regression with a correlated discrepancy.
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
// Rasmussen, Williams 2006, chapter 2 and 5.

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

// ---- Regression of thermal error on temperatures over batches of tests, by principal components (PCR; Tan 2024, eq. 1
// to 8) or ridge. Inputs are centred, not scaled, as there.
//
//   PCR    y = b0 + sum_j g_j x_j with g = L_p D_p^-1 L_p' S_xy: the first p eigenvectors L and eigenvalues D of S_xx
//   ridge  g = (S_xx + n k I)^-1 S_xy, k in K^2; 0 along eigenvectors of less than 1e-12 of the largest eigenvalue
//
// p and k are chosen by leaving out one batch at a time, or p by the explained share of the inputs' variance. All
// components, or k = 0, are ordinary least squares.

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

// ---- Which temperature sensors a regression on effects needs, the benefit of each, and possible substitutes.
//
// Forward selection with exchanges. The sensor that gives the best set of k joins the k - 1 earlier ones. Then the
// sensor of the set whose loss costs least is exchanged for the best other one, if that improves the set. The criterion
// is the largest ln L (ridge.hpp), with five or more runs the smallest mean square error of left-out runs; dictionary,
// v and l are those of all sensors. The search is greedy: the set need not be the best of its size. Columns that are
// not temperatures are always kept.
//
// Errors are those of train.hpp, of forecasts or left-out runs. For each of them the sensors are chosen
// again from the rows that it predicts from, so that no row is predicted by sensors chosen with it. Dictionary, v and l
// are also chosen again for every set; with five or more runs once for each size, from all runs.
//
// A difference of two errors has a standard error: with d_f that of fold f (a forecast or a run), w_f its share of the
// rows and F folds, d = sum_f w_f d_f, sigma^2 = F/(F-1) sum_f w_f^2 (d_f - d)^2. One set is as good as another if its
// error is larger by at most 2 %, or by at most 10 % and sigma.
//
// Source of the method: forward selection and sequential replacement, Miller 2002, Subset Selection in Regression,
// chapter 3; the one-standard-error rule, Breiman, Friedman, Olshen, Stone 1984, section 3.4.3.

struct SensorSet {
  std::vector<std::string> sensors;  // chosen from all rows, the newest last
  Forecasts forecasts;               // with the sensors that each fold chooses
  double interval_scale = 1.0;       // from these
  double buys_um = 0.0;              // fall of the mean absolute error from the set with one sensor less
  double sigma_buys_um = 0.0;        // its standard error; NaN: fewer than two folds
};

// A sensor of the largest set. Errors are those of this fixed set, at its dictionary, v and l.
struct ChosenSensor {
  std::string sensor;
  std::size_t folds = 0;                 // number of folds that choose it too
  double without_um = 0.0;               // increase of the mean absolute error without it
  double sigma_um = 0.0;                 // its standard error
  bool needed = false;                   // the set is not as good without it
  std::vector<std::string> substitutes;  // the set is as good with one of these instead; empty if not needed
};

struct SensorChoice {
  std::size_t folds = 0;                  // F
  bool forecasts_ahead = false;           // true: forecasts of one record; false: left-out runs
  std::size_t rated = 0;                  // number of sensors to choose from
  std::vector<SensorSet> sets;            // of 0, 1 .. most sensors
  SensorSet all;                          // of all sensors; buys_um is relative to the largest set
  std::size_t enough = 0;                 // smallest number, 0 .. most, that is as good as the best of sets and all
  std::vector<ChosenSensor> chosen;       // of the largest set, the most important first
  std::vector<std::string> kept;          // columns that are not temperatures
  std::optional<HeldOutErrors> left_out;  // of the largest set; only with five or more runs
};

// most: at least 1. Calls `progress` before each longer step. Throws Error as trained_regression() does, for fewer
// temperatures than `most`, for none, and for too few rows for a forecast.
SensorChoice sensor_choice(std::span<const Series> runs, const std::string& target, std::size_t most,
                           const std::function<void(const std::string& what)>& progress = {},
                           const Catalogue& catalogue = built_in_catalogue());

// ---- Whether an unexplained part can be predicted although no effect is named: compares the forecasts of a regression
// on all effects (train.hpp) with those of the model, on the same rows.

struct Predictability {
  Forecasts forecasts;      // of the regression: later rows of one run, or left-out runs
  double model_um = 0.0;    // RMSE of the model, fitted to the earlier rows or the other runs
  bool with_model = false;  // the effects of the model were available to the regression
  bool is_better = false;   // better than the model, than the last value, and than a random walk by chance
};

// For the first target of the model, as `train` does it. Returns nullopt if no regression can be trained or tested: too
// few rows, or only constant columns. Throws Error as fit() does.
std::optional<Predictability> predictability(const Model& model, const Series& data,
                                             const std::function<void(const std::string& what)>& progress = {},
                                             const Catalogue& catalogue = built_in_catalogue());

// Whether the forecasts are better than holding the last value, and than a random walk by chance.
bool is_predicted(const EffectRegression& regression);

}  // namespace ballbar
