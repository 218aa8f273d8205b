// The identities that a single effect may have, with the columns of each of their shapes.
//
// An identity is an effect on its columns (a family of the library), an input in any form, or a wrong held value of the
// model: the curve at another value minus the curve at the held one. For an effect that jumps at a moment, every row is
// a shape; these columns are not stored (noise/whitening.hpp).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "diagnosis/posterior/linearisation.hpp"
#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

inline constexpr std::size_t kNoSignature = static_cast<std::size_t>(-1);

// One shape: adjacent columns, one per gain.
struct Shape {
  std::size_t identity = 0;
  Eigen::Index first = 0, width = 1;     // columns of Identities::columns; for a jump after these, one per row
  double log_prior = 0.0;                // within its identity
  std::size_t signature = kNoSignature;  // index into the library; none for a jump or a held value
  double value = 0.0;                    // for a held value: the other value
};

struct Identities {
  std::size_t families = 0;               // number in the library; held values follow, in the order of Problem::held
  std::vector<double> log_prior;          // of each
  Eigen::MatrixXd columns;                // n by C, each with standard deviation 1
  std::vector<Shape> shapes;              // grouped by identity
  std::vector<std::size_t> first, count;  // per identity: its range in `shapes`
  std::optional<std::size_t> jump;        // the identity that can jump at any row
  bool is_held_value(std::size_t identity) const { return identity >= families; }
  Eigen::Index size() const { return columns.cols() + (jump ? columns.rows() : 0); }  // with one jump column per row
};

// The sum of columns with these coefficients, jumps among them.
Eigen::VectorXd combination_of(const Identities& identities,
                               const std::vector<std::pair<Eigen::Index, double>>& coefficients);

// With held values evaluated at the parameters of the linearisation. fitted_values: of each held value the one that a
// fit finds in its place.
Identities identities_of(const Problem& problem, const Linearisation& linearisation,
                         const std::vector<double>& fitted_values);

// Keeps only these identities; the others keep their indices but have no shapes.
Identities restricted(const Identities& all, const std::vector<std::size_t>& identities);

// The signature of a jump at this row, added to the library if needed; nullopt: the jump has no effect.
std::optional<std::size_t> signature_of_jump(Problem& problem, const Identities& identities, std::size_t row);

}  // namespace ballbar
