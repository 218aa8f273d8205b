// The columns that a regression on effects is made of: what a unit of an effect's gain adds at definite shapes, and
// what that is at the rows where the target is known.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct EffectRegression;

struct Predictor {
  std::shared_ptr<const Effect> effect;
  std::vector<std::string> columns;  // as effect->inputs
  std::vector<double> parameters;    // the first gain is 1
};

// Its parameters with this gain.
std::vector<double> with_gain(const Predictor& predictor, double gain);

// What the regression gives a gain of its own, scaled by its standard deviation: one predictor, or one less another.
struct PredictorSum {
  std::size_t plus = 0;
  std::optional<std::size_t> minus = std::nullopt;
};

struct PredictorFamily {
  PredictorKind kind = PredictorKind::source;
  std::vector<PredictorSum> members;
};

struct Predictors {
  std::vector<Predictor> each;
  std::vector<PredictorFamily> families;  // one an effect
  std::vector<std::size_t> named;         // of `each`: terms of a model, which are of no family
  std::vector<std::string> left_out;      // columns that suit and stand still, or have gaps, in one of the runs
};

// Every effect with a PredictorRule on every choice of columns that it accepts; with several runs temperatures at the
// start of each as well. Throws Error where a run lacks a column of the first, and where there is no predictor at all.
Predictors predictors_of(std::span<const Series> runs, const std::string& target, const Catalogue& catalogue);

inline constexpr std::size_t kMostDesignRows = 20'000;

// What is known of the gains before there are rows: of predictors `at`, for a unit of each.
struct GainPrior {
  std::vector<std::size_t> at;
  Eigen::VectorXd mean, sd;    // sd: of the predictor, where it was trained
  Eigen::MatrixXd covariance;  // over sigma_um^2
  double sigma_um = 0.0;
};

// n rows, run by run in the order of time.
struct Design {
  Predictors predictors;
  Eigen::MatrixXd values;     // n by predictors, um of a gain of 1
  Eigen::VectorXd target_um;  // n
  std::vector<double> time_s;
  std::vector<std::size_t> run, row;  // of the runs, of its series
  std::size_t runs = 0;
  std::optional<GainPrior> prior;
};

// Of more than kMostDesignRows values of the target every second, third ... of a run. Throws Error as predictors_of and
// where the target is missing or has fewer than 40 values.
Design design_of(std::span<const Series> runs, const std::string& target, const Catalogue& catalogue);

// Whether each of its effects has one gain and reads a column.
bool can_be_named(const Model& model);

// A model of one target held at its fit to these runs. Throws Error as fit, and where it cannot be named.
Model fitted(Model model, std::span<const Series> runs);

// The design with the terms of a held model as named predictors, in the place of those it has.
Design with_named(Design design, const Model& held, std::span<const Series> runs);

// The same with the gains of a regression as their prior. Throws Error where a run lacks a column of it, or has gaps
// in one.
Design with_start(Design design, const EffectRegression& start, std::span<const Series> runs);

// first, first + 1 ... to before end
std::vector<std::size_t> rows_between(std::size_t first, std::size_t end);

// Every k-th of these rows, so that at most `most` (at least one) are left.
std::vector<std::size_t> thinned(const std::vector<std::size_t>& rows, std::size_t most);

}  // namespace ballbar
