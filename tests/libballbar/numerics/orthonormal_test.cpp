#include "numerics/orthonormal.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

// (1, 1, 0), (2, 2, 0) and (0, 0, 3) span two directions.
TEST(Orthonormal, has_as_many_columns_as_the_rank) {
  Eigen::MatrixXd columns(3, 3);
  columns << 1, 2, 0, 1, 2, 0, 0, 0, 3;
  const Eigen::MatrixXd basis = orthonormal(columns);
  ASSERT_EQ(basis.cols(), 2);
  EXPECT_NEAR((basis.transpose() * basis - Eigen::MatrixXd::Identity(2, 2)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(orthogonal_part(columns, basis).norm(), 0.0, 1e-14);
}

TEST(Orthonormal, of_no_columns_has_none) { EXPECT_EQ(orthonormal(Eigen::MatrixXd(3, 0)).cols(), 0); }

// (1, 2, 3) less its mean 2.
TEST(OrthogonalPart, of_a_constant) {
  const Eigen::MatrixXd basis = orthonormal(Eigen::MatrixXd::Ones(3, 1));
  const Eigen::VectorXd left = orthogonal_part(Eigen::VectorXd(Eigen::Vector3d(1, 2, 3)), basis);
  EXPECT_NEAR((left - Eigen::Vector3d(-1, 0, 1)).norm(), 0.0, 1e-15);
}

// The second column has (0, 2) left of (3, 2), 4 of 13; the third nothing.
TEST(Orthonormalise, tells_the_squares_that_are_left) {
  Eigen::MatrixXd columns(2, 3);
  columns << 2, 3, 5, 0, 2, 7;
  const Eigen::RowVectorXd before = columns.colwise().squaredNorm();
  const Eigen::RowVectorXd left = orthonormalise(columns, before, 1e-8);
  EXPECT_NEAR(left[0], 4.0, 1e-15);
  EXPECT_NEAR(left[1], 4.0, 1e-15);
  EXPECT_NEAR(left[2], 0.0, 1e-15);
  EXPECT_EQ(columns.col(1), Eigen::Vector2d(0, 1));
  EXPECT_EQ(columns.col(2), Eigen::Vector2d(0, 0));
}

}  // namespace
}  // namespace ballbar
