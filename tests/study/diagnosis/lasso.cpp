#include "lasso.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar::study {
namespace {

constexpr int kPenalties = 30, kFolds = 5, kMostSweeps = 40;
constexpr double kLeastPenalty = 1e-2;  // of the largest
constexpr double kSettled = 1e-2;       // largest change of a coefficient, in lambda

double shrunk(double value, double by) { return value > by ? value - by : value < -by ? value + by : 0.0; }

// Columns whose coefficients may differ from 0, with their products.
class Active {
 public:
  Active(const Eigen::MatrixXd& x, const Eigen::VectorXd& y) : x_(x), y_(y), in_(x.cols(), false) {}

  bool has(Eigen::Index column) const { return in_[static_cast<std::size_t>(column)]; }

  void add(Eigen::Index column) {
    const Eigen::Index m = size();
    in_[static_cast<std::size_t>(column)] = true;
    columns_.push_back(column);
    if (m == products_.cols()) {
      products_.conservativeResize(2 * m + 16, 2 * m + 16);
      along_.conservativeResize(2 * m + 16);
      b_.conservativeResize(2 * m + 16);
    }
    for (Eigen::Index k = 0; k <= m; ++k) {
      products_(k, m) = products_(m, k) = x_.col(columns_[static_cast<std::size_t>(k)]).dot(x_.col(column));
    }
    along_[m] = x_.col(column).dot(y_);
    b_[m] = 0.0;
  }

  // Each coefficient in turn; returns the largest change.
  double sweep(double lambda) {
    const Eigen::Index m = size();
    double change = 0.0;
    for (Eigen::Index k = 0; k < m; ++k) {
      const double rest = along_[k] - products_.col(k).head(m).dot(b_.head(m)) + products_(k, k) * b_[k];
      const double next = shrunk(rest, lambda) / products_(k, k);
      change = std::max(change, std::abs(next - b_[k]));
      b_[k] = next;
    }
    return change;
  }

  Eigen::VectorXd left() const {
    Eigen::VectorXd left = y_;
    for (Eigen::Index k = 0; k < size(); ++k) left -= b_[k] * x_.col(columns_[static_cast<std::size_t>(k)]);
    return left;
  }

  Eigen::VectorXd coefficients() const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(x_.cols());
    for (Eigen::Index k = 0; k < size(); ++k) all[columns_[static_cast<std::size_t>(k)]] = b_[k];
    return all;
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(columns_.size()); }

  const Eigen::MatrixXd& x_;
  const Eigen::VectorXd& y_;
  std::vector<bool> in_;
  std::vector<Eigen::Index> columns_;
  Eigen::MatrixXd products_;
  Eigen::VectorXd along_, b_;
};

// p by penalties
Eigen::MatrixXd path_of(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const Eigen::VectorXd& penalties) {
  Eigen::MatrixXd path(x.cols(), penalties.size());
  const Eigen::VectorXd square = x.colwise().squaredNorm().transpose();
  Active active(x, y);
  for (Eigen::Index l = 0; l < penalties.size(); ++l) {
    for (bool settled = false; !settled;) {
      for (int k = 0; k < kMostSweeps && active.sweep(penalties[l]) > kSettled * penalties[l]; ++k) continue;
      settled = true;
      const Eigen::VectorXd along = x.transpose() * active.left();
      for (Eigen::Index k = 0; k < x.cols(); ++k) {
        if (active.has(k) || !(square[k] > 0.0) || std::abs(along[k]) <= penalties[l] * (1.0 + 1e-6)) continue;
        active.add(k);
        settled = false;
      }
    }
    path.col(l) = active.coefficients();
  }
  return path;
}

}  // namespace

std::vector<Eigen::Index> lasso_selection(const Eigen::MatrixXd& x, const Eigen::VectorXd& y) {
  const Eigen::Index n = x.rows();
  const double largest = (x.transpose() * y).cwiseAbs().maxCoeff();
  Eigen::VectorXd penalties(kPenalties);
  for (int l = 0; l < kPenalties; ++l) penalties[l] = largest * std::pow(kLeastPenalty, l / (kPenalties - 1.0));
  Eigen::MatrixXd errors(kFolds, kPenalties);
  for (int fold = 0; fold < kFolds; ++fold) {
    const Eigen::Index from = n * fold / kFolds, to = n * (fold + 1) / kFolds;
    Eigen::MatrixXd kept(n - (to - from), x.cols());
    kept << x.topRows(from), x.bottomRows(n - to);
    Eigen::VectorXd y_kept(kept.rows());
    y_kept << y.head(from), y.tail(n - to);
    const Eigen::MatrixXd path =
        path_of(kept, y_kept, penalties * (static_cast<double>(kept.rows()) / static_cast<double>(n)));
    const Eigen::MatrixXd predicted = x.middleRows(from, to - from) * path;
    const Eigen::MatrixXd off = predicted.colwise() - y.segment(from, to - from);
    errors.row(fold) = off.colwise().squaredNorm() / static_cast<double>(to - from);
  }
  const Eigen::RowVectorXd mean = errors.colwise().mean();
  Eigen::Index best = 0;
  mean.minCoeff(&best);
  const double standard_error =
      std::sqrt((errors.col(best).array() - mean[best]).square().sum() / (kFolds - 1.0) / kFolds);
  Eigen::Index chosen = 0;
  while (mean[chosen] > mean[best] + standard_error) ++chosen;
  const Eigen::MatrixXd path = path_of(x, y, penalties.head(chosen + 1));
  std::vector<Eigen::Index> selection;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    if (path(k, chosen) != 0.0) selection.push_back(k);
  }
  return selection;
}

}  // namespace ballbar::study
