// Data that a fitted model predicts: a part of the run of the fit, what follows it, or another run.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "model/model_options.hpp"

namespace ballbar {

struct OtherData {
  static constexpr std::size_t kBefore = std::numeric_limits<std::size_t>::max();

  ModelData data;                     // n rows, as they are predicted
  std::shared_ptr<const Series> run;  // what the effects run over: with the rows of the fit, if the data are of its run
  std::vector<std::size_t> row;       // n rows of `run`; kBefore: before the first row of the fit
};

// The data of `options`, against those that `model` was fitted to: `fitted`, opened from the sources `of_fit`. Says, as
// a remark, where the data are of another run, begin before the fit, or begin after a pause.
OtherData open_other(const ModelOptions& options, const Model& model, const ModelData& fitted,
                     const std::vector<Source>& of_fit);

// The same of the data of the fit itself, or of a model that is all held: a run of its own.
OtherData of_its_own(ModelData data);

// predict() at the rows of `other`; NaN before the first row of the fit.
Prediction predict(const Model& model, const std::vector<FittedParameter>& parameters, const OtherData& other,
                   const Eigen::MatrixXd* covariance = nullptr);

}  // namespace ballbar
