#include "machine_errors/error_design.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <numeric>
#include <utility>

namespace ballbar {
namespace {

constexpr double kRidge = 1e-9;       // share of the square of a column that suffices to determine it
constexpr double kLeast = 1e-12;      // a column of zeros has an inverse too
constexpr double kAbsent = 1e-5;      // mean square of a unit's curve: not in these readings
constexpr double kOfSpike = 0.3;      // of its height
constexpr double kDetermined = 0.05;  // singular value; of curves that nothing else explains all are near 1

// Of columns of an effect those that say something: these are their squares in the rows that are fitted.
Indices present_of(const Eigen::VectorXd& squares, const Eigen::MatrixXd& fine) {
  Indices kept;
  for (Eigen::Index k = 0; k < squares.size(); ++k) {
    if (squares[k] > kAbsent || squares[k] > kAbsent * fine.col(k).cwiseAbs().maxCoeff()) kept.push_back(k);
  }
  return kept;
}

}  // namespace

ErrorFit kind_of(const ErrorColumn& column) {
  return column.effect == nullptr ? ErrorFit::together : column.effect->rules.error_fit;
}

Indices columns_of(const ErrorDesign& design, std::initializer_list<ErrorFit> kinds) {
  Indices columns;
  for (std::size_t k = 0; k < design.x.columns.size(); ++k) {
    const bool is_one = std::find(kinds.begin(), kinds.end(), kind_of(design.x.columns[k])) != kinds.end();
    if (is_one) columns.push_back(static_cast<Eigen::Index>(k));
  }
  return columns;
}

Indices all_of(const ErrorDesign& design) {
  Indices all(static_cast<std::size_t>(design.x.size()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return all;
}

Eigen::VectorXd far_weight(const ErrorRows& rows) {
  return rows.count.array() * (rows.from_reversal_deg.array() > kAtReversal_deg).cast<double>();
}

EffectDesign weighted(FittedEffect effect, ErrorColumns x, const Eigen::VectorXd& weight) {
  EffectDesign one;
  one.effect = std::move(effect);
  one.z = weight.asDiagonal() * x.values;
  one.x = std::move(x);
  return one;
}

void add(ErrorDesign& design, const std::vector<EffectDesign>& effects) {
  Indices added;
  for (const EffectDesign& one : effects) {
    if (one.x.size() == 0) continue;
    FittedEffect effect = one.effect;
    for (const ErrorColumn& column : one.x.columns) {
      effect.columns.push_back(static_cast<Eigen::Index>(design.x.columns.size()));
      design.x.columns.push_back(column);
    }
    added.insert(added.end(), effect.columns.begin(), effect.columns.end());
    if (effect.effect != nullptr) design.effects.push_back(std::move(effect));
  }
  if (added.empty()) return;
  Eigen::Index at = added.front();
  for (const EffectDesign& one : effects) {
    if (one.x.size() == 0) continue;
    if (at == added.front()) {
      const auto all = static_cast<Eigen::Index>(design.x.columns.size());
      design.x.values.conservativeResize(one.x.values.rows(), all);
      design.x.fine.conservativeResize(one.x.fine.rows(), all);
      design.z.conservativeResize(one.x.values.rows(), all);
    }
    design.x.values.middleCols(at, one.x.size()) = one.x.values;
    design.x.fine.middleCols(at, one.x.size()) = one.x.fine;
    design.z.middleCols(at, one.x.size()) = one.z;
    at += one.x.size();
  }
  refresh(design, added);
}

void remove_last(ErrorDesign& design, ErrorFit kind) {
  while (!design.x.columns.empty() && kind_of(design.x.columns.back()) == kind) design.x.columns.pop_back();
  const auto left = static_cast<Eigen::Index>(design.x.columns.size());
  for (Eigen::MatrixXd* all : {&design.x.values, &design.x.fine, &design.z})
    all->conservativeResize(Eigen::NoChange, left);
  design.products.conservativeResize(left, left);
  std::erase_if(design.effects, [&](const FittedEffect& one) { return one.effect->rules.error_fit == kind; });
}

void refresh(ErrorDesign& design, const Indices& changed) {
  const Indices spikes = columns_of(design, {ErrorFit::at_reversals});
  design.products.conservativeResize(design.x.size(), design.x.size());
  // Matrices of their own, for whose products Eigen has kernels.
  const Eigen::MatrixXd z = design.z(Eigen::all, changed), of_changed = z.transpose() * design.x.values;
  design.products(changed, Eigen::all) = of_changed;
  const bool is_all = static_cast<Eigen::Index>(changed.size()) == design.x.size();
  if (!is_all && changed != spikes) {
    const Eigen::MatrixXd values = design.x.values(Eigen::all, changed), of_all = design.z.transpose() * values;
    design.products(Eigen::all, changed) = of_all;
  }
  const Indices others = columns_of(design, {ErrorFit::together, ErrorFit::along_the_travel, ErrorFit::where_it_shows});
  design.products(others, spikes).setZero();
}

GainEstimate gain_estimate(const ErrorDesign& design, const Indices& columns, const Eigen::MatrixXd& prior) {
  const auto size = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd equations = design.products(columns, columns);
  Indices cyclic, others;  // places
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const ErrorFit kind = kind_of(design.x.columns[static_cast<std::size_t>(columns[static_cast<std::size_t>(k)])]);
    (kind == ErrorFit::along_the_travel ? cyclic : others).push_back(k);
    if (kind == ErrorFit::together || kind == ErrorFit::where_it_shows) held(k, k) = kRidge * equations(k, k) + kLeast;
  }
  const auto of_prior = std::lower_bound(columns.begin(), columns.end(), prior.rows());
  const Indices first(columns.begin(), of_prior);
  held.topLeftCorner(of_prior - columns.begin(), of_prior - columns.begin()) += prior(first, first);
  equations += held;
  GainEstimate estimate{columns, Eigen::MatrixXd::Zero(size, design.z.cols()), {}, {}};
  Eigen::MatrixXd inverse = equations.partialPivLu().inverse();
  // The cyclic errors' equations without the others have the inverse of this block. Their least singular value is at
  // least 1 / its norm.
  if (!cyclic.empty()) {
    const Eigen::VectorXd scale = equations.diagonal()(cyclic).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd of_cyclic = inverse(cyclic, cyclic);
    const Eigen::MatrixXd unscaled = scale.cwiseInverse().asDiagonal() * of_cyclic * scale.cwiseInverse().asDiagonal();
    if (!(unscaled.norm() < 1.0 / kDetermined)) {
      const Eigen::MatrixXd between = equations(cyclic, others);
      const Eigen::MatrixXd of_others =
          Eigen::MatrixXd(equations(others, others)).partialPivLu().solve(Eigen::MatrixXd(equations(others, cyclic)));
      const Eigen::MatrixXd alone = Eigen::MatrixXd(equations(cyclic, cyclic)) - between * of_others;
      const Eigen::MatrixXd scaled = scale.asDiagonal() * alone * scale.asDiagonal();
      const Eigen::JacobiSVD<Eigen::MatrixXd> solved(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Eigen::Index determined = (solved.singularValues().array() >= kDetermined).count();
      // T = right (left' A right)^-1 left': the others, then the determined combinations.
      const auto combinations = [&](const Eigen::MatrixXd& vectors) {
        Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size, size - vectors.rows() + determined);
        for (std::size_t k = 0; k < others.size(); ++k) all(others[k], static_cast<Eigen::Index>(k)) = 1.0;
        const Eigen::MatrixXd scaled_vectors = scale.asDiagonal() * vectors.leftCols(determined);
        all(cyclic, Eigen::lastN(determined)) = scaled_vectors;
        return all;
      };
      const Eigen::MatrixXd left = combinations(solved.matrixU()), right = combinations(solved.matrixV());
      const Eigen::MatrixXd combined = left.transpose() * equations * right;
      inverse = right * combined.partialPivLu().solve(Eigen::MatrixXd(left.transpose()));
      estimate.held = solved.matrixV().rightCols(alone.cols() - determined);
    }
  }
  estimate.t(Eigen::all, columns) = inverse;
  // T L T', with T L = s^2 of the prior. The ridge is one too: without it a combination that no reading sees would have
  // the sigma of rounding.
  estimate.open = inverse * held * inverse.transpose();
  return estimate;
}

Eigen::MatrixXd inverse_of(Eigen::MatrixXd normal) {
  normal.diagonal() = (1.0 + kRidge) * normal.diagonal().array() + kLeast;
  return normal.llt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
}

ErrorColumns present(const ErrorColumns& all, const Eigen::VectorXd& weight) {
  const Eigen::VectorXd squares = (all.values.array().square().colwise() * weight.array()).colwise().sum().transpose() /
                                  std::max(weight.sum(), 1.0);
  Indices kept = present_of(squares, all.fine);
  std::erase_if(kept, [&](Eigen::Index k) {
    const bool is_spike = kind_of(all.columns[static_cast<std::size_t>(k)]) == ErrorFit::at_reversals;
    return is_spike && all.fine.col(k).cwiseAbs().maxCoeff() < kOfSpike;
  });
  ErrorColumns columns{{}, all.values(Eigen::all, kept), all.fine(Eigen::all, kept)};
  for (const Eigen::Index k : kept) columns.columns.push_back(all.columns[static_cast<std::size_t>(k)]);
  return columns;
}

double best_shape(const Effect& effect, const std::vector<double>& shapes, const ErrorRows& rows,
                  const Eigen::VectorXd& left, const Eigen::VectorXd& weight, const ErrorDesign* design,
                  const GainEstimate* beside) {
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
    if (beside != nullptr) {
      const Eigen::MatrixXd values = design->x.values(Eigen::all, beside->columns);
      const Eigen::MatrixXd of_columns = weighted.transpose() * values;
      normal -= of_columns * (beside->t * (design->z.transpose() * columns));
    }
    normal.diagonal() *= 1.0 + kRidge;
    const Eigen::VectorXd products = weighted.transpose() * left, right = products(kept);
    const double lowers = right.dot(Eigen::MatrixXd(normal(kept, kept)).ldlt().solve(right));
    if (lowers > most) most = lowers, best = shape;
  }
  return best;
}

}  // namespace ballbar
