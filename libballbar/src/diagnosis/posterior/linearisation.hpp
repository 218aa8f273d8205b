// The model linearised about some parameters.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

struct Linearisation {
  std::optional<std::size_t> freed;  // index into Problem::held; nullopt: the unchanged model
  std::vector<double> parameters;
  Eigen::MatrixXd open;  // n by k: delays of inputs, levels of the target
  LinearModel linear;    // with the readings, and the open columns last
};

// open: by default those at the parameters.
Linearisation linearisation_at(const Problem& problem, std::optional<std::size_t> freed,
                               std::vector<double> parameters);
Linearisation linearisation_at(const Problem& problem, std::optional<std::size_t> freed, std::vector<double> parameters,
                               Eigen::MatrixXd open);

// The index of the parameter that is set free, for BaseModel::at(); empty: none.
std::vector<std::size_t> free_of(const Problem& problem, std::optional<std::size_t> freed);

// Each input in any form as open columns.
LinearModel with_any_forms(const Problem& problem, LinearModel linear);

// These signatures as flat columns.
LinearModel with_signatures(const Problem& problem, LinearModel linear, const std::vector<std::size_t>& signatures);

}  // namespace ballbar
