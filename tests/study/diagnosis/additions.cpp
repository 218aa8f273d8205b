#include "additions.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "numerics/orthonormal.hpp"

namespace ballbar::study {

std::vector<double> falls(const SignatureLibrary& library, const Projected& seen, const Eigen::MatrixXd& beside,
                          const Eigen::VectorXd& target) {
  constexpr double kNothing = 1e-6;
  const Eigen::VectorXd along = seen.columns.transpose() * target;
  const Eigen::MatrixXd inside = beside.transpose() * seen.columns;
  std::vector<double> result;
  for (const Signature& signature : library.signatures) {
    const Eigen::VectorXd c = along.segment(signature.first, signature.width);
    const auto b = inside.middleCols(signature.first, signature.width);
    const Eigen::MatrixXd g = Eigen::MatrixXd::Identity(signature.width, signature.width) - b.transpose() * b;
    const Eigen::LDLT<Eigen::MatrixXd> solver(g);
    const bool is_new = solver.vectorD().minCoeff() > kNothing;
    result.push_back(is_new ? std::min(c.dot(solver.solve(c)), target.squaredNorm()) : 0.0);
  }
  return result;
}

Eigen::MatrixXd with_signature(const Eigen::MatrixXd& beside, const Projected& seen, const Signature& signature) {
  Eigen::MatrixXd all(beside.rows(), beside.cols() + signature.width);
  all << beside, seen.columns.middleCols(signature.first, signature.width);
  return orthonormal(all);
}

std::size_t freedom_of(const Effect& effect) {
  return static_cast<std::size_t>(std::count_if(
      effect.parameters.begin(), effect.parameters.end(),
      [](const Parameter& parameter) { return parameter.kind == ParameterKind::gain || !parameter.held; }));
}

}  // namespace ballbar::study
