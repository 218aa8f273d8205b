// A set as columns where it is most likely; inputs of any form.
#include "diagnosis/posterior/set_regression.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "diagnosis/evidence/dense.hpp"
#include "diagnosis/made_drift.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/signatures/any_form.hpp"
#include "effects/low_pass.hpp"

namespace ballbar {
namespace {

const Inference& warm_room() {
  static const Inference found = [] {
    ProblemOptions options;
    options.search.catalogue = built_in_catalogue();
    return inference(made::by_speed(), made::drift({3.0, 1, 150}), 0, options);
  }();
  return found;
}

// The scatter and what is left, by the whole matrix: known columns as a part of it, with the scatter that is found.
TEST(SetRegression, is_the_set_by_the_whole_matrix) {
  const Inference& found = warm_room();
  const Problem& problem = *found.problem;
  ASSERT_GE(found.posterior.sets.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const EffectSet& set = found.posterior.sets[k];
    const SetRegression at = set_regression(problem, found.posterior, set);
    const Covariance& covariance = found.posterior.filters[set.filter].covariance;
    std::vector<Eigen::Index> flat, known;
    for (Eigen::Index j = 0; j < at.size(); ++j)
      (at.model.is_flat[static_cast<std::size_t>(j)] != 0 ? flat : known).push_back(1 + j);
    const Eigen::VectorXd y = at.model.columns.col(0);
    const Eigen::MatrixXd x = at.model.columns(Eigen::all, flat), e = at.model.columns(Eigen::all, known);
    Eigen::MatrixXd c = dense::matrix_of(covariance, problem.time_s, problem.relative_variance);
    c += e * e.transpose() / at.solution.variance;
    const double square = dense::flat(y, x, c).square;
    EXPECT_NEAR(at.solution.degrees, static_cast<double>(y.size() - x.cols()), 0.0);
    // 2 %: the scatter and the prior by turns, three times.
    EXPECT_NEAR(square / at.solution.degrees, at.solution.variance, 0.02 * at.solution.variance) << k;
    EXPECT_NEAR(at.solution.square, square, 0.02 * square) << k;
    ASSERT_EQ(at.first.size(), set.signatures.size());
    Eigen::Index next =
        static_cast<Eigen::Index>(found.posterior.linearisations[set.linearisation].linear.is_flat.size());
    for (std::size_t m = 0; m < set.signatures.size(); ++m) {
      EXPECT_EQ(at.first[m], next);
      next += at.width[m];
    }
    EXPECT_EQ(next, at.size());
  }
}

// Share of the square of a curve, about its mean, that no sum of the columns makes.
double left_share(const Eigen::VectorXd& curve, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd all(curve.size(), columns.cols() + 1);
  all << Eigen::VectorXd::Ones(curve.size()), columns;
  const Eigen::VectorXd about = curve.array() - curve.mean();
  return (about - all * all.completeOrthogonalDecomposition().solve(about)).squaredNorm() / about.squaredNorm();
}

// What any effect of one input adds is nearly a sum of its forms: lags between those of the columns, powers, a kink.
TEST(AnyForm, makes_nearly_what_any_effect_of_its_input_does) {
  const Problem& problem = *warm_room().problem;
  std::map<std::string, Eigen::MatrixXd> forms;
  for (std::size_t f = problem.effects; f < problem.library.families.size(); ++f) {
    const Family& family = problem.library.families[f];
    EXPECT_EQ(family.bound.effect, &any_form());
    const Signature& signature = problem.library.signatures[family.first];
    forms[family.bound.columns.front()] = problem.library.columns.middleCols(signature.first, signature.width);
  }
  ASSERT_EQ(forms.size(), 3U);  // speed, room, bearing
  const std::map<std::string, double> most{
      {"expansion", 1e-9}, {"lagged_expansion", 0.02}, {"centrifugal_shift", 0.05}, {"cooling_asymmetry", 0.1}};
  for (std::size_t f = 0; f < problem.effects; ++f) {
    const Family& family = problem.library.families[f];
    const auto limit = most.find(family.bound.effect->name);
    if (limit == most.end() || family.bound.columns.size() != 1) continue;
    for (std::size_t i = family.first; i < family.first + family.count; ++i) {
      const Eigen::VectorXd curve = problem.library.columns.col(problem.library.signatures[i].first);
      EXPECT_LE(left_share(curve, forms.at(family.bound.columns.front())), limit->second)
          << label_of(family.bound) << " " << i - family.first;
    }
  }
}

// Inputs that never change, and those with gaps that are no line, have no forms.
TEST(AnyForm, of_inputs_that_say_nothing_are_none) {
  SignatureLibrary library;
  Series data = made::drift({0.0, 1, 50});
  std::fill(data.columns[1].values.begin(), data.columns[1].values.end(), 22.0);
  std::fill(data.columns[2].values.begin(), data.columns[2].values.end(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::size_t> rows(50);
  for (std::size_t i = 0; i < 50; ++i) rows[i] = i;
  library.columns.resize(50, 0);
  for (const char* name : {"T_room_degC", "T_bearing_degC"})
    library.families.push_back({{find_effect("expansion", Level::series), {name}}, 0, 0});
  add_any_forms(library, data, rows);
  EXPECT_EQ(library.families.size(), 2U);
  EXPECT_EQ(library.columns.cols(), 0);
}

}  // namespace
}  // namespace ballbar
