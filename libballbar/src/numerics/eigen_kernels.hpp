// What Eigen makes of a MatrixXd: decompositions and products. Each is compiled once, in eigen_kernels.cpp, and
// declared here for all other files, for a JacobiSVD takes 5 s to compile, a QR 4 s and a product 1 s, in every file
// that has one.
#pragma once

#include <Eigen/Dense>

#ifndef BALLBAR_EIGEN_KERNEL
#define BALLBAR_EIGEN_KERNEL extern template
#endif

namespace Eigen {

BALLBAR_EIGEN_KERNEL class JacobiSVD<MatrixXd>;
BALLBAR_EIGEN_KERNEL class HouseholderQR<MatrixXd>;
BALLBAR_EIGEN_KERNEL void HouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
BALLBAR_EIGEN_KERNEL void HouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
BALLBAR_EIGEN_KERNEL class ColPivHouseholderQR<MatrixXd>;
BALLBAR_EIGEN_KERNEL void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
BALLBAR_EIGEN_KERNEL void ColPivHouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
BALLBAR_EIGEN_KERNEL class PartialPivLU<MatrixXd>;
BALLBAR_EIGEN_KERNEL SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
BALLBAR_EIGEN_KERNEL LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
BALLBAR_EIGEN_KERNEL void LDLT<MatrixXd>::_solve_impl_transposed<true>(const VectorXd&, VectorXd&) const;
BALLBAR_EIGEN_KERNEL void LDLT<MatrixXd>::_solve_impl_transposed<true>(const MatrixXd&, MatrixXd&) const;
BALLBAR_EIGEN_KERNEL LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
BALLBAR_EIGEN_KERNEL void LLT<MatrixXd>::_solve_impl_transposed<true>(const VectorXd&, VectorXd&) const;
BALLBAR_EIGEN_KERNEL void LLT<MatrixXd>::_solve_impl_transposed<true>(const MatrixXd&, MatrixXd&) const;

namespace internal {

BALLBAR_EIGEN_KERNEL bool ldlt_inplace<Lower>::unblocked(MatrixXd&, LDLT<MatrixXd>::TranspositionType&,
                                                         LDLT<MatrixXd>::TmpMatrixType&, SignMatrix&);
BALLBAR_EIGEN_KERNEL Index llt_inplace<double, Lower>::blocked(MatrixXd&);

using KernelTraits = gebp_traits<double, double>;
using KernelResult = blas_data_mapper<double, Index, ColMajor, Unaligned, 1>;
using KernelColumns = const_blas_data_mapper<double, Index, ColMajor>;
using KernelRows = const_blas_data_mapper<double, Index, RowMajor>;
BALLBAR_EIGEN_KERNEL struct gebp_kernel<double, double, Index, KernelResult, KernelTraits::mr, KernelTraits::nr, false,
                                        false>;
BALLBAR_EIGEN_KERNEL struct gemm_pack_lhs<double, Index, KernelColumns, KernelTraits::mr, KernelTraits::LhsProgress,
                                          KernelTraits::LhsPacket4Packing, ColMajor>;
BALLBAR_EIGEN_KERNEL struct gemm_pack_lhs<double, Index, KernelRows, KernelTraits::mr, KernelTraits::LhsProgress,
                                          KernelTraits::LhsPacket4Packing, RowMajor>;
BALLBAR_EIGEN_KERNEL struct gemm_pack_rhs<double, Index, KernelColumns, KernelTraits::nr, ColMajor>;
BALLBAR_EIGEN_KERNEL struct gemm_pack_rhs<double, Index, KernelRows, KernelTraits::nr, RowMajor>;
BALLBAR_EIGEN_KERNEL struct general_matrix_matrix_product<Index, double, ColMajor, false, double, ColMajor, false,
                                                          ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct general_matrix_matrix_product<Index, double, RowMajor, false, double, ColMajor, false,
                                                          ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct general_matrix_matrix_product<Index, double, ColMajor, false, double, RowMajor, false,
                                                          ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct general_matrix_matrix_product<Index, double, RowMajor, false, double, RowMajor, false,
                                                          ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct general_matrix_vector_product<Index, double, KernelColumns, ColMajor, false, double,
                                                          KernelColumns, false>;
BALLBAR_EIGEN_KERNEL struct general_matrix_vector_product<Index, double, KernelColumns, ColMajor, false, double,
                                                          KernelRows, false>;
BALLBAR_EIGEN_KERNEL struct general_matrix_vector_product<Index, double, KernelRows, RowMajor, false, double,
                                                          KernelColumns, false>;
BALLBAR_EIGEN_KERNEL struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, ColMajor, ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, RowMajor, ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct triangular_solve_matrix<double, Index, OnTheLeft, UnitUpper, false, RowMajor, ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct triangular_solve_matrix<double, Index, OnTheRight, Upper, false, RowMajor, ColMajor, 1>;
BALLBAR_EIGEN_KERNEL struct triangular_solve_matrix<double, Index, OnTheRight, Upper, false, ColMajor, ColMajor, 1>;

}  // namespace internal
}  // namespace Eigen
