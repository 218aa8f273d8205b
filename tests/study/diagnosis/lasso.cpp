#include "lasso.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar::study {
namespace {

constexpr int kPenalties = 40, kFolds = 5, kMostSweeps = 100;
constexpr double kLeastPenalty = 1e-3;  // of the largest
constexpr double kSettled = 1e-3;       // of the largest coefficient's change, in lambda

double shrunk(double value, double by) { return value > by ? value - by : value < -by ? value + by : 0.0; }

struct Path {
  Eigen::MatrixXd coefficients;  // p by penalties
};

Path path_of(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const Eigen::VectorXd& penalties) {
  Path path{Eigen::MatrixXd::Zero(x.cols(), penalties.size())};
  const Eigen::VectorXd square = x.colwise().squaredNorm().transpose();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(x.cols()), left = y;
  std::vector<Eigen::Index> active;
  const auto sweep = [&](double lambda) {
    double change = 0.0;
    for (const Eigen::Index k : active) {
      const double next = shrunk(x.col(k).dot(left) + square[k] * b[k], lambda) / square[k];
      if (next == b[k]) continue;
      left -= (next - b[k]) * x.col(k);
      change = std::max(change, std::abs(next - b[k]));
      b[k] = next;
    }
    return change;
  };
  for (Eigen::Index l = 0; l < penalties.size(); ++l) {
    for (int round = 0; round < 5; ++round) {
      for (int k = 0; k < kMostSweeps && sweep(penalties[l]) > kSettled * penalties[l]; ++k) continue;
      const Eigen::VectorXd along = x.transpose() * left;
      const std::size_t before = active.size();
      for (Eigen::Index k = 0; k < x.cols(); ++k) {
        const bool in = std::find(active.begin(), active.end(), k) != active.end();
        if (!in && square[k] > 0.0 && std::abs(along[k]) > penalties[l] * (1.0 + 1e-9)) active.push_back(k);
      }
      if (active.size() == before) break;
    }
    path.coefficients.col(l) = b;
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
    const Path path = path_of(kept, y_kept, penalties * (static_cast<double>(kept.rows()) / static_cast<double>(n)));
    const Eigen::MatrixXd predicted = x.middleRows(from, to - from) * path.coefficients;
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
  const Path path = path_of(x, y, penalties.head(chosen + 1));
  std::vector<Eigen::Index> selection;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    if (path.coefficients(k, chosen) != 0.0) selection.push_back(k);
  }
  return selection;
}

}  // namespace ballbar::study
