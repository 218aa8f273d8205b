#include "machine_errors/gain_maps.hpp"

namespace ballbar {

GainMaps::GainMaps(const GainStages& stages)
    : stages_(stages), p_(stages.together->size()), c_(stages.cyclic->size()), e_(stages.extra->size()) {
  const Eigen::Index n = stages.rows->size();
  Eigen::MatrixXd columns(n, p_ + e_);
  columns.leftCols(p_) = stages.together->values;
  columns.rightCols(e_) = stages.extra->values;
  z_.resize(n, 2 * (p_ + e_) + c_);
  z_.leftCols(p_ + e_) = stages.far->asDiagonal() * columns;
  z_.rightCols(p_ + e_) = stages.rows->count.asDiagonal() * columns;
  const auto products = [&](const auto& weighted) {
    return Products{columns.transpose() * weighted, weighted.transpose() * stages.cyclic->values};
  };
  far_rows_ = products(z_.leftCols(p_ + e_));
  all_rows_ = products(z_.rightCols(p_ + e_));
  // G (C' y - C' M b), b = N^-1 M' y of the first fit.
  Eigen::MatrixXd t_first = Eigen::MatrixXd::Zero(p_, z_.cols());
  t_first.leftCols(p_) = stages.first->inverse;
  const Block& cyclic = *stages.cyclic_block;
  z_.middleCols(p_ + e_, c_) = cyclic.weighted;
  t_cyclic_ = -cyclic.inverse * (cyclic.weighted.transpose() * stages.together->values) * t_first;
  t_cyclic_.middleCols(p_ + e_, c_) += cyclic.inverse;
}

GainMap GainMaps::of(const Indices& chosen, bool with_reversals, bool with_prior) const {
  const Eigen::MatrixXd prior = with_prior ? *stages_.precision : Eigen::MatrixXd::Zero(p_, p_);
  const Eigen::Index first_column = with_reversals ? p_ + e_ + c_ : 0;
  Indices in_z;
  in_z.reserve(chosen.size());
  for (const Eigen::Index k : chosen) in_z.push_back(first_column + k);
  const Products& products = with_reversals ? all_rows_ : far_rows_;
  const Eigen::MatrixXd normal = products.normal(chosen, chosen);
  const Eigen::MatrixXd inverse = inverse_of(normal, prior);
  GainMap map{Eigen::MatrixXd::Zero(inverse.rows(), z_.cols()), {}};
  map.t(Eigen::all, in_z) = inverse;
  map.t -= inverse * products.cyclic(chosen, Eigen::all) * t_cyclic_;
  // What the prior leaves open: N^-1 L T L N^-1 with L T = s^2. The ridge is one too: without it, a combination that no
  // reading sees would have the sigma of its sum alone, or of rounding.
  Eigen::MatrixXd precision = (kRidge * normal.diagonal()).asDiagonal();
  precision.topLeftCorner(p_, p_) += prior;
  map.open = stages_.slow_variance_um2 * inverse * precision * inverse;
  return map;
}

GainMap GainMaps::joined(const GainMap& whole, const Indices& chosen, const GainMap& own) const {
  const Eigen::Index all = p_ + c_ + e_;
  GainMap map{Eigen::MatrixXd(all, z_.cols()), Eigen::MatrixXd::Zero(all, all)};
  map.t.middleRows(p_, c_) = t_cyclic_;
  map.t.bottomRows(e_) = whole.t.bottomRows(e_);
  Indices places;
  places.reserve(chosen.size());
  for (const Eigen::Index k : chosen) places.push_back(k < p_ ? k : k + c_);
  map.t(places, Eigen::all) = own.t;
  map.open(places, places) = own.open;
  return map;
}

}  // namespace ballbar
