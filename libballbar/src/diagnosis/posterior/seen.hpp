// Signatures at one covariance: what is left of them beside the model, and the evidence of sets of them by it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

// Some signatures of the library, their columns side by side.
struct Chosen {
  std::vector<std::size_t> signatures;
  std::vector<Eigen::Index> first, width;  // of each, of `columns`
  RowMajorMatrix columns;                  // n by all of theirs
};
Chosen chosen_of(const Problem& problem, std::vector<std::size_t> signatures);

// Of the grid of a family about so many, spread evenly, and all shapes between its points.
std::vector<std::size_t> thinned_shapes(const Family& family, std::size_t most);

// Columns of signatures, white, what the line makes of them taken off.
struct Seen {
  Solved base;
  Eigen::VectorXd whole;  // square of each column before
  Eigen::MatrixXd left;   // products with one another; empty unless asked for

  bool survives(Eigen::Index column) const;  // nearly nothing left: nothing to be weighed
};
Seen seen_at(const Problem& problem, const Point& point, const Variant& variant, const RowMajorMatrix& columns);
Seen seen_with_products(const Problem& problem, const Point& point, const Variant& variant,
                        const RowMajorMatrix& columns);

// ln of the evidence of one signature, of one gain or several, whose columns stand from `first` on.
double log_evidence_of_curve(const Problem& problem, const Point& point, const Solved& base,
                             const RowMajorMatrix& columns, Eigen::Index first, std::size_t signature);
// The same, kLogZero where it does not survive; a single column by what has been seen of it.
double log_evidence_of_seen(const Problem& problem, const Point& point, const Seen& seen, const RowMajorMatrix& columns,
                            Eigen::Index first, std::size_t signature);

// ln of the evidence of some of the chosen together, by their places; their products have been asked for.
double log_evidence_of_set(const Chosen& chosen, const Seen& seen, const std::vector<std::size_t>& places);
double log_evidence_of_pair(const Chosen& chosen, const Seen& seen, std::size_t i, std::size_t j);

}  // namespace ballbar
