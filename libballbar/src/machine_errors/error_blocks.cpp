#include "machine_errors/error_blocks.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace ballbar {
namespace {

constexpr double kAbsent = 1e-5;  // mean square of a unit's curve: not in these readings
constexpr double kOfSpike = 0.3;  // of its height
constexpr double kLeast = 1e-12;  // a column of zeros has an inverse too

// Of columns of an effect those that say something: these are their squares in the rows that are fitted.
Indices present_of(const Eigen::VectorXd& squares, const Eigen::MatrixXd& fine) {
  Indices kept;
  kept.reserve(static_cast<std::size_t>(squares.size()));
  for (Eigen::Index k = 0; k < squares.size(); ++k) {
    if (squares[k] > kAbsent || squares[k] > kAbsent * fine.col(k).cwiseAbs().maxCoeff()) kept.push_back(k);
  }
  return kept;
}

// The lower half of X' Y, which is symmetric.
Eigen::MatrixXd lower_product(const Eigen::MatrixXd& x, const Eigen::Ref<const Eigen::MatrixXd>& y) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(x.cols(), x.cols());
  product.triangularView<Eigen::Lower>() = x.transpose() * y;
  return product;
}

}  // namespace

Indices range_of(Eigen::Index first, Eigen::Index count) {
  Indices indices(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = first + static_cast<Eigen::Index>(i);
  return indices;
}

Eigen::MatrixXd inverse_of(Eigen::MatrixXd normal, const Eigen::MatrixXd& precision) {
  normal.diagonal() *= 1.0 + kRidge;
  normal.topLeftCorner(precision.rows(), precision.cols()) += precision;
  normal.diagonal().array() += kLeast;
  return normal.llt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
}

Block block_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weight, const Eigen::MatrixXd& precision) {
  Block block;
  block.weighted = weight.asDiagonal() * columns;
  block.normal = lower_product(columns, block.weighted);
  block.inverse = inverse_of(block.normal, precision);
  return block;
}

ErrorColumns present(const ErrorColumns& all, const Eigen::VectorXd& weight) {
  const Eigen::VectorXd squares = (all.values.array().square().colwise() * weight.array()).colwise().sum().transpose() /
                                  std::max(weight.sum(), 1.0);
  Indices kept = present_of(squares, all.fine);
  std::erase_if(kept, [&](Eigen::Index k) {
    const Effect* effect = all.columns[static_cast<std::size_t>(k)].effect;
    const bool is_spike = effect != nullptr && effect->rules.error_fit == ErrorFit::at_reversals;
    return is_spike && all.fine.col(k).cwiseAbs().maxCoeff() < kOfSpike;
  });
  ErrorColumns columns;
  columns.values = all.values(Eigen::all, kept);
  columns.fine = all.fine(Eigen::all, kept);
  columns.columns.reserve(kept.size());
  for (const Eigen::Index k : kept) columns.columns.push_back(all.columns[static_cast<std::size_t>(k)]);
  return columns;
}

double best_shape(const Effect& effect, const std::vector<double>& shapes, const ErrorRows& rows, const Base& base,
                  const Eigen::VectorXd& left, const Eigen::VectorXd& weight) {
  double best = shapes.front(), most = -1.0;
  if (shapes.size() == 1 || rows.size() == 0) return best;
  UnitCurves curves(effect, rows.fine);
  const double readings = std::max(weight.sum(), 1.0);
  for (const double shape : shapes) {
    const Eigen::MatrixXd& fine = curves.at(shape);
    const Eigen::MatrixXd columns = rows.means(fine), weighted = weight.asDiagonal() * columns;
    Eigen::MatrixXd normal = columns.transpose().lazyProduct(weighted);  // few columns
    const Indices kept = present_of(normal.diagonal() / readings, fine);
    if (kept.empty()) continue;
    if (base.columns != nullptr) {
      const Eigen::MatrixXd shared = base.fit->weighted.transpose() * columns;
      normal -= shared.transpose() * base.fit->inverse * shared;
    }
    normal.diagonal() *= 1.0 + kRidge;
    const Eigen::VectorXd right = (weighted.transpose() * left)(kept);
    const double lowers = right.dot(normal(kept, kept).ldlt().solve(right));
    if (lowers > most) most = lowers, best = shape;
  }
  return best;
}

GainMaps::GainMaps(const GainStages& stages)
    : stages_(stages),
      p_(stages.together->size()),
      c_(stages.cyclic->size()),
      e_(stages.extra->size()),
      s_(stages.spikes->size()) {
  const Eigen::Index n = stages.rows->size();
  Eigen::MatrixXd columns(n, p_ + e_);
  columns.leftCols(p_) = stages.together->values;
  columns.rightCols(e_) = stages.extra->values;
  z_.resize(n, p_ + e_ + c_ + s_);
  z_.leftCols(p_ + e_) = stages.far->asDiagonal() * columns;
  z_.middleCols(p_ + e_, c_) = stages.cyclic_block->weighted;
  z_.rightCols(s_) = *stages.filters;
  normal_ = lower_product(columns, z_.leftCols(p_ + e_)).selfadjointView<Eigen::Lower>();
  with_cyclic_.resize(p_ + e_, c_);
  with_cyclic_.topRows(p_) = *stages.together_of_cyclic;
  with_cyclic_.bottomRows(e_) = z_.middleCols(p_, e_).transpose() * stages.cyclic->values;
  spike_squares_ = (stages.filters->array() * stages.spikes->values.array()).colwise().sum().max(1e-12).transpose();
  const Eigen::MatrixXd per_square = *stages.filters * spike_squares_.cwiseInverse().asDiagonal();
  spikes_of_ = per_square.transpose() * columns;
  spikes_of_cyclic_ = per_square.transpose() * stages.cyclic->values;
  // G (C' y - C' M b), b = N^-1 M' y of the first fit.
  const Eigen::MatrixXd& inverse = stages.cyclic_block->inverse;
  t_cyclic_ = Eigen::MatrixXd::Zero(c_, z_.cols());
  t_cyclic_.leftCols(p_) = -inverse * *stages.cyclic_of_together * stages.first->inverse;
  t_cyclic_.middleCols(p_ + e_, c_) = inverse;
}

GainMap GainMaps::of(const Indices& chosen, const Eigen::MatrixXd& precision) const {
  const Eigen::MatrixXd normal = normal_(chosen, chosen);
  const Eigen::MatrixXd inverse = inverse_of(normal, precision);
  GainMap map{Eigen::MatrixXd::Zero(inverse.rows(), z_.cols()), {}};
  map.t(Eigen::all, chosen) = inverse;
  map.t -= inverse * with_cyclic_(chosen, Eigen::all) * t_cyclic_;
  // What the prior leaves open: N^-1 L T L N^-1 with L T = s^2. The ridge is one too: without it, a combination that no
  // reading sees would have the sigma of its sum alone, or of rounding.
  Eigen::MatrixXd held = (kRidge * normal.diagonal()).asDiagonal();
  held.topLeftCorner(precision.rows(), precision.cols()) += precision;
  // The rounding of the inverse is along the open combinations. With the inverse as the left factor on both sides, the
  // variance of a determined combination has none of it.
  map.open = stages_.slow_variance_um2 * inverse * held * inverse.transpose();
  return map;
}

GainMap GainMaps::joined(const GainMap& whole, const Indices& chosen, const GainMap& own) const {
  const Eigen::Index before = p_ + c_ + e_, all = before + s_;
  GainMap map{Eigen::MatrixXd::Zero(all, z_.cols()), Eigen::MatrixXd::Zero(all, all)};
  map.t.middleRows(p_, c_) = t_cyclic_;
  map.t.middleRows(p_ + c_, e_) = whole.t.bottomRows(e_);
  Indices places;
  places.reserve(chosen.size());
  for (const Eigen::Index k : chosen) places.push_back(k < p_ ? k : k + c_);
  map.t(places, Eigen::all) = own.t;
  map.open(places, places) = own.open;
  // (F' y - F' X b - F' C g) / f' s
  const Eigen::MatrixXd of_chosen = spikes_of_(Eigen::all, chosen);
  map.t.bottomRows(s_) = -of_chosen * own.t - spikes_of_cyclic_ * t_cyclic_;
  map.t.bottomRightCorner(s_, s_) += spike_squares_.cwiseInverse().asDiagonal().toDenseMatrix();
  const Eigen::MatrixXd crossed = -of_chosen * own.open;
  for (std::size_t k = 0; k < places.size(); ++k) {
    map.open.bottomRows(s_).col(places[k]) = crossed.col(static_cast<Eigen::Index>(k));
    map.open.rightCols(s_).row(places[k]) = crossed.col(static_cast<Eigen::Index>(k)).transpose();
  }
  map.open.bottomRightCorner(s_, s_) = -crossed * of_chosen.transpose();
  return map;
}

}  // namespace ballbar
