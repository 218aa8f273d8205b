// All that one single effect may be, with the columns of each of its shapes.
//
// An identity is an effect on its columns (a family of the library), an input of any form, or a value that the model
// holds and that may be another one: the curve there less the curve at the held value. Of an effect that jumps at a
// moment every row is a shape; these columns are not written down (noise/whitening.hpp).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

inline constexpr std::size_t kNoSignature = static_cast<std::size_t>(-1);

// One shape: columns that stand together, a gain each.
struct Shape {
  std::size_t identity = 0;
  Eigen::Index first = 0, width = 1;     // of Identities::columns; of a jump behind these, one a row
  double log_prior = 0.0;                // in its identity
  std::size_t signature = kNoSignature;  // of the library; a jump and a held value have none
  double value = 0.0;                    // of a held value: another one
};

struct Identities {
  std::size_t families = 0;               // of the library; behind them held values, by their place in Problem::own
  std::vector<double> log_prior;          // of each
  Eigen::MatrixXd columns;                // n by C, each of deviation 1
  std::vector<Shape> shapes;              // those of an identity together
  std::vector<std::size_t> first, count;  // of each identity, of `shapes`
  std::optional<std::size_t> jump;        // the identity that jumps at any row
  bool is_own(std::size_t identity) const { return identity >= families; }
  Eigen::Index size() const { return columns.cols() + (jump ? columns.rows() : 0); }  // with a column for each row
};

// Whether this is an effect of a gain and a moment alone, on rows whose time only rises.
bool jumps(const Problem& problem, std::size_t family);

// Held values about the parameters of the variant.
Identities identities_of(const Problem& problem, const Variant& variant);

// These alone; the others keep their numbers and have no shapes.
Identities restricted(const Identities& all, const std::vector<std::size_t>& identities);

// The signature of a jump at this row, put into the library where it is not there yet; nothing: it adds nothing.
std::optional<std::size_t> signature_of_jump(Problem& problem, const Identities& identities, std::size_t row);

}  // namespace ballbar
