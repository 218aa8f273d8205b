// The columns that a regression on effects is made of: what a unit of an effect's gain adds at definite shapes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

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
  std::vector<std::string> left_out;      // columns that suit and stand still, or have gaps, in one of the runs
};

// Every effect with a PredictorRule on every choice of columns that it accepts; with several runs temperatures at the
// start of each as well. Throws Error where a run lacks a column of the first, and where there is no predictor at all.
Predictors predictors_of(std::span<const Series> runs, const std::string& target, const Catalogue& catalogue);

}  // namespace ballbar
