// The candidates of a diagnosis, the model and the set-up as columns over the rows of the data and of a test.
//
// The columns are, in this order: the free parameters of the model; the constant of the test (recordings: circles),
// which is 0 in the data; and for every competitor its fitted curve, the derivatives by its free parameters there, and
// those by its gains at points of the grid and on the bounds of its shapes, because a large change of a shape is not
// linear.
//
// They give the distance of one signal from a space of columns over several runs. With X the columns of all candidates
// over the rows of one run and W the whitening of its noise, only the triangular factor R of W X is kept
// (R' R = X' W' W X), with as many rows as X has columns. Runs with independent noise are stacked. For a signal a and
// columns B among those of X,
//
//   d = |(I - P_B) R a|
//
// is the root of the fall of chi^2 when a is true and B is fitted instead.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/next_test/planned_test.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

struct Competitor {
  BoundEffect bound;
  std::vector<double> parameters;           // all of the effect
  std::vector<std::vector<double>> points;  // the same, shapes from the grid
  std::vector<std::size_t> free;            // of these
  std::vector<std::size_t> gains;           // of these
  bool only_once = false;                   // it does not occur again in a test
};

// Uses up to `most_points` shapes. nullopt: the candidate does not suit the data.
std::optional<Competitor> competitor_of(const Candidate& candidate, const Series& data, std::size_t most_points);

struct DiscriminationMatrix {
  const Model* model = nullptr;
  const Series* data = nullptr;
  const Fit* base = nullptr;
  std::vector<Competitor> competitors;
};

struct Places {
  std::vector<Eigen::Index> shared;  // columns of the model and of the test
  std::vector<Eigen::Index> signal;  // one per competitor
  // A competitor, a point: where it was fitted, then `points`.
  std::vector<std::vector<std::vector<Eigen::Index>>> free;
};

// own: number of columns of the test.
Places places_of(const DiscriminationMatrix& candidates, Eigen::Index own);

// n rows of the data where the target has a value; nullopt where a value is not finite.
std::optional<Eigen::MatrixXd> columns_in_data(const DiscriminationMatrix& candidates, Eigen::Index own);

// The columns of the test: a constant. On recordings a circle for each new recording; if the model has one circle for
// all, one for all with a new set-up, and none otherwise.
Eigen::MatrixXd own_columns(const DiscriminationMatrix& candidates, const PlannedTest& test);

// Effects without inputs continue after the data unless the set-up is new; the test begins 12 h after the end of the
// data.
std::optional<Eigen::MatrixXd> columns_in_test(const DiscriminationMatrix& candidates, const PlannedTest& test,
                                               const Eigen::MatrixXd& own);

// n by m columns -> at most m rows.
Eigen::MatrixXd whitened_factor(const Eigen::MatrixXd& columns, const Whitening& whitening);

// The factor of two runs together; both have the same columns.
Eigen::MatrixXd both(const Eigen::MatrixXd& first, const Eigen::MatrixXd& columns, const Whitening& whitening);

double distance(const Eigen::MatrixXd& factor, Eigen::Index signal, const std::vector<Eigen::Index>& columns);

}  // namespace ballbar
