// The candidates of a diagnosis, the model and the set-up as columns over the rows of the data and of a test.
//
// Columns of both, in this order: those that the model was free in; the test's own constant (recordings: circles), 0 in
// the data; for every competitor what it adds with its fitted parameters, its derivatives by its free parameters there,
// and those by its gains at points of the grid and on the bounds of its shapes, as a shape that moves far leaves the
// straight line.
//
// How far one signal is from a space of columns, over several runs.
//
// X = columns of all candidates over the rows of one run, W the whitening of its noise. W X is kept by its triangular
// factor R (R' R = X' W' W X), which has all that is needed, in as many rows as X has columns; runs whose noise does
// not remember each other are put on top of each other. For signal a and columns B among those of X,
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
  bool only_once = false;                   // it does not come again in a test
};

// With up to `most_points` shapes. nullopt where the candidate does not suit the data.
std::optional<Competitor> competitor_of(const Candidate& candidate, const Series& data, std::size_t most_points);

struct DiscriminationMatrix {
  const Model* model = nullptr;
  const Series* data = nullptr;
  const Fit* base = nullptr;
  std::vector<Competitor> competitors;
};

struct Places {
  std::vector<Eigen::Index> shared;  // model and the test's own
  std::vector<Eigen::Index> signal;  // one a competitor
  // A competitor, a point: where it was fitted, then `points`.
  std::vector<std::vector<std::vector<Eigen::Index>>> free;
};

// own: number of columns of the test's own.
Places places_of(const DiscriminationMatrix& candidates, Eigen::Index own);

// n rows of the data where the target has a value; nullopt where a value is not finite.
std::optional<Eigen::MatrixXd> columns_in_data(const DiscriminationMatrix& candidates, Eigen::Index own);

// The test's own columns: a constant; on recordings a circle for each new one, or for all where the model has one for
// all and the set-up is new, or none where it is not.
Eigen::MatrixXd own_columns(const DiscriminationMatrix& candidates, const PlannedTest& test);

// Effects without inputs go on after the data as long as nothing is set up anew: the test begins 12 h after their
// end.
std::optional<Eigen::MatrixXd> columns_in_test(const DiscriminationMatrix& candidates, const PlannedTest& test,
                                               const Eigen::MatrixXd& own);

// n by m columns -> at most m rows.
Eigen::MatrixXd whitened_factor(const Eigen::MatrixXd& columns, const Whitening& whitening);

// Of the run with the factor `first` and another together; same columns.
Eigen::MatrixXd both(const Eigen::MatrixXd& first, const Eigen::MatrixXd& columns, const Whitening& whitening);

double distance(const Eigen::MatrixXd& factor, Eigen::Index signal, const std::vector<Eigen::Index>& columns);

}  // namespace ballbar
