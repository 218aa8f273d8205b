// Whether what fits a residual is a cause: whether it is the same in every cycle and not made by a few readings alone.
#pragma once

#include <vector>

#include "diagnosis/statistics/likelihood_ratio.hpp"

namespace ballbar {

// Of the residual freed of the model's columns.
double chi2(const LinearisedFit& linearised, const Noise& noise);

// Chance of gains as different from cycle to cycle as these: chi^2 of one gain for each cycle against one for all.
// columns: of the candidate alone, n by its gains; linearised.model the rest.
double p_same_gain(const LinearisedFit& linearised, const Eigen::MatrixXd& columns, const Noise& noise,
                   const std::vector<std::size_t>& fold);

// Largest share of one cycle in the square of the columns, whitened and freed of the model.
double share_of_one_fold(const LinearisedFit& linearised, const Eigen::MatrixXd& columns, const Noise& noise,
                         const std::vector<std::size_t>& fold);

// Fall of chi^2 by the columns beside the model; where what they leave has heavy tails, no whitened reading counts for
// more than 4 sigma.
double gain_of_many(const LinearisedFit& linearised, const Eigen::MatrixXd& columns, const Noise& noise);

}  // namespace ballbar
