// The single effect regression (SER): the posterior of one effect, which is nothing, or one identity with one of its
// shapes and its gains (Wang, Sarkar, Carbonetto and Stephens 2020, J. R. Stat. Soc. B 82, 1273, section 2.2).
//
// pi: prior of each identity. alpha: its posterior. The sizes of the gains are integrated out.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnosis/posterior/projected_columns.hpp"

namespace ballbar {

struct SinglePrior {  // ln pi
  double log_none = 0.0;
  std::vector<double> log_identity;
  std::size_t shape = kNoSignature;  // the only one of Identities::shapes; else all of the identities
};

struct SingleEffect {
  double log_odds = kLogZero;          // ln of the weight of any identity relative to none
  std::vector<double> alpha;           // of each identity; the remainder is that of nothing
  std::vector<std::size_t> likeliest;  // most likely shape of each identity, index into Identities::shapes
  std::vector<double> log_weight;      // ln of the weight of that shape, for an alpha that underflows
  std::vector<std::pair<Eigen::Index, double>> mean;  // coefficients of columns
  ProjectedColumns::Curve curve;                      // of the mean
  double expected_square = 0.0;                       // of its curve, in units of the scatter
  double kl = 0.0;                                    // divergence of the posterior from the prior
  double p_any() const;
  double p_none() const;  // accurate even if far below 1
};

// Some identities: their shapes, and the columns of these.
struct IdentitySubset {
  std::vector<std::size_t> shapes;
  std::vector<ColumnSpan> columns;
};
IdentitySubset subset_of(const Identities& identities, const std::vector<char>& is_chosen);

// r: products of the columns with the residual of the other effects.
SingleEffect single_effect_regression(ProjectedColumns& at, const Identities& identities, const IdentitySubset& among,
                                      const SinglePrior& prior, const Eigen::VectorXd& r, double variance);

}  // namespace ballbar
