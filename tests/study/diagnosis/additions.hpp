// What each signature of a library would explain beside columns that are there already.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/signatures/signature_library.hpp"

namespace ballbar::study {

// Fall of |target|^2 by each signature with its gains free. beside: orthonormal columns (n by m, m may be 0) that are
// free too; target: freed of them. With U the orthonormal columns of a signature and B those beside it,
//   c = U' t,  G = I - (B' U)' (B' U),  fall = c' G^-1 c
std::vector<double> falls(const SignatureLibrary& library, const Projected& seen, const Eigen::MatrixXd& beside,
                          const Eigen::VectorXd& target);

// `beside` and the columns of one more signature, orthonormal.
Eigen::MatrixXd with_signature(const Eigen::MatrixXd& beside, const Projected& seen, const Signature& signature);

// Free parameters of an effect: gains and the shapes that a search moves.
std::size_t freedom_of(const Effect& effect);

}  // namespace ballbar::study
