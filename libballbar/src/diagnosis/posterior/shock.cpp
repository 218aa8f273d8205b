#include "diagnosis/posterior/shock.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr double kStays = 4.4;  // chi^2

// The onset of an effect of time alone; nullopt: none.
std::optional<double> onset_s(const Problem& problem, std::size_t signature) {
  const Signature& one = problem.library.signatures[signature];
  const Effect& effect = *problem.library.families[one.family].bound.effect;
  if (!effect.time_only || effect.level != Level::series) return std::nullopt;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (effect.parameters[k].shape_of == ShapeOf::onset) return one.point[k];
  }
  return std::nullopt;
}

}  // namespace

bool may_be_shock(const Problem& problem, const Posterior& posterior, const EffectSet& set, const SetRegression& at,
                  std::size_t member) {
  const std::optional<double> onset = onset_s(problem, set.signatures[member]);
  const Point& point = posterior.points[set.point];
  const std::vector<double>& time_s = problem.time_s;
  if (!onset || !(point.covariance.correlated > 0.0)) return false;
  if (!std::is_sorted(time_s.begin(), time_s.end())) return false;  // several runs
  const std::ptrdiff_t after = std::upper_bound(time_s.begin(), time_s.end(), *onset) - time_s.begin();
  const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, after - 1),
                       end = std::min<std::ptrdiff_t>(std::ssize(time_s), after + 2);
  Eigen::MatrixXd dying = Eigen::MatrixXd::Zero(at.y.size(), end - first);
  for (std::ptrdiff_t row = first; row < end; ++row) {
    for (Eigen::Index i = row; i < dying.rows(); ++i) {
      const double since_s = time_s[static_cast<std::size_t>(i)] - time_s[static_cast<std::size_t>(row)];
      dying(i, row - first) = std::exp(-since_s / point.covariance.time_s);
    }
  }
  const Eigen::MatrixXd basis = orthonormal(at.white_columns_but(member));
  const Eigen::VectorXd left = orthogonal_part(at.white_y, basis);
  const auto fall = [&](const Eigen::VectorXd& white) {
    const double square = white.squaredNorm();
    return square > 0.0 ? std::pow(white.dot(left), 2) / square / at.variance : 0.0;
  };
  double most = 0.0;
  const Eigen::MatrixXd white = orthogonal_part(at.white(point.filter, dying), basis);
  for (Eigen::Index k = 0; k < white.cols(); ++k) most = std::max(most, fall(white.col(k)));
  const Eigen::VectorXd jump = at.white_members.col(at.first[member]);
  return fall(orthogonal_part(jump, basis)) < most + kStays;
}

}  // namespace ballbar
