// Columns whitened together.
#include "noise/whitening.hpp"

#include <gtest/gtest.h>

#include <random>

namespace ballbar {
namespace {

// 19 columns, 300 rows: two groups of eight, blocks of rows, and what is left over.
TEST(Whitening, many_columns_are_each_as_alone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> time_s;
  for (int i = 0; i < 300; ++i) time_s.push_back(60.0 * i + (i % 7 == 0 ? 5.0 : 0.0));
  const Whitening whitening(Noise{0.3, 0.5, 400.0, 0.0}, time_s, {});
  const Eigen::MatrixXd columns = Eigen::MatrixXd::NullaryExpr(300, 19, [&] { return normal(random); });
  const Eigen::MatrixXd together = whitened(whitening, columns);
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const Eigen::MatrixXd alone = whitened(whitening, columns.col(k));
    EXPECT_LT((together.col(k) - alone).cwiseAbs().maxCoeff(), 1e-12) << k;
  }
}

}  // namespace
}  // namespace ballbar
