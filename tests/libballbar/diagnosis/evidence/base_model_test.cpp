// A model as a straight line: its slopes, what moving its inputs adds, and parameters found again.
#include "diagnosis/evidence/base_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "diagnosis/evidence/shape_fit.hpp"
#include "diagnosis/signatures/thresholds.hpp"

namespace ballbar {
namespace {

// 160 rows of 30 s: a speed in steps, a room in waves, a target at every second row.
struct Made {
  Series data;
  LoggedInputs logged;
  Model model;
  std::vector<std::size_t> rows;
  Eigen::VectorXd y;
  std::vector<double> truth;  // constant first
};

std::unique_ptr<Made> made(bool constant_held = false) {
  auto result = std::make_unique<Made>();
  Series& data = result->data;
  Column speed{"n_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}};
  const double rpm[] = {0, 6000, 2000, 9000, 0, 4000};
  for (std::size_t i = 0; i < 160; ++i) {
    data.time_s.push_back(30.0 * static_cast<double>(i));
    speed.values.push_back(rpm[i / 29 % 6]);
    room.values.push_back(21.0 + std::sin(data.time_s.back() / 700.0));
    if (i % 2 == 0) result->rows.push_back(i);
  }
  data.columns = {speed, room};
  result->logged = logged_inputs(data, {"z_um"});
  result->model.targets = {"z_um"};
  result->model.terms = {term_of("speed_heating", {"n_rpm"}), term_of("lagged_expansion", {"T_room_degC"}),
                         term_of("centrifugal_shift", {"n_rpm"})};
  result->truth = {4.0, 0.7, 900.0, 5.0 / 3.0, 3.0, 400.0, -0.05, 2.0};
  if (constant_held) result->model.constant_um = 4.0;
  const ModelRows rows(result->model, result->logged.series, result->rows);
  result->y = rows.sum(Eigen::VectorXd::Map(result->truth.data(), 8), nullptr);
  return result;
}

BaseModel base_of(const Made& made) { return {made.model, made.logged, made.y, made.rows}; }

// Every column is the central difference of the model by its parameter, times its scale; what remains of y is what the
// line does not make.
void expect_slopes(const Made& made, const std::vector<double>& at, const std::vector<std::size_t>& free,
                   std::size_t columns) {
  const BaseModel base = base_of(made);
  const BaseColumns found = base.at(at, free);
  ASSERT_EQ(found.columns.size(), columns);
  const ModelRows rows(made.model, made.logged.series, made.rows);
  const auto sum = [&](const std::vector<double>& parameters) {
    return Eigen::VectorXd(rows.sum(Eigen::VectorXd::Map(parameters.data(), 8), nullptr));
  };
  Eigen::VectorXd by_line = found.y;
  for (std::size_t k = 0; k < columns; ++k) {
    const BaseColumn& column = found.columns[k];
    std::vector<double> more = at, less = at;
    const double step = 1e-5 * std::max(1.0, std::abs(at[column.parameter]));
    more[column.parameter] += step;
    less[column.parameter] -= step;
    const Eigen::VectorXd slope = (sum(more) - sum(less)) / (2.0 * step) * column.scale;
    const auto values = found.values.col(static_cast<Eigen::Index>(k));
    EXPECT_LT((values - slope).cwiseAbs().maxCoeff(), 1e-6 * (1.0 + slope.cwiseAbs().maxCoeff())) << column.parameter;
    if (column.is_flat()) by_line -= values * (at[column.parameter] / column.scale);
    // A free column but the constant has deviation 1.
    if (column.kind != BaseColumn::Kind::gain) continue;
    EXPECT_NEAR((values.array() - values.mean()).square().mean(), 1.0, 1e-9);
  }
  EXPECT_LT((by_line - (made.y - sum(at))).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(BaseColumns, are_the_slopes_of_the_model) {
  const auto rows = made();
  expect_slopes(*rows, {1.0, 0.5, 1200.0, 5.0 / 3.0, 2.0, 300.0, 0.1, 2.0}, {}, 6);
  expect_slopes(*rows, rows->truth, {}, 6);
}

// A held exponent that is set free.
TEST(BaseColumns, of_a_held_shape_set_free) {
  const auto rows = made();
  expect_slopes(*rows, {1.0, 0.5, 1200.0, 1.5, 2.0, 300.0, 0.1, 2.3}, {3, 7}, 8);
}

TEST(BaseColumns, of_a_constant_that_is_held) {
  const auto rows = made(true);
  std::vector<double> at{4.0, 0.5, 1200.0, 5.0 / 3.0, 2.0, 300.0, 0.1, 2.0};
  const BaseColumns found = base_of(*rows).at(at);
  ASSERT_EQ(found.columns.size(), 5U);
  for (const BaseColumn& column : found.columns) EXPECT_NE(column.kind, BaseColumn::Kind::constant);
  expect_slopes(*rows, at, {}, 5);
}

// A gain of nothing has no shape.
TEST(BaseColumns, of_a_gain_of_zero_has_no_shape) {
  const auto rows = made();
  const BaseColumns found = base_of(*rows).at({1.0, 0.0, 1200.0, 5.0 / 3.0, 2.0, 300.0, 0.1, 2.0});
  EXPECT_EQ(found.columns.size(), 5U);
}

// A reach: a time constant goes by a factor of e, an exponent by half of itself and at most by 0.5.
TEST(BaseColumns, reach_of_shapes) {
  const Effect& heating = *find_effect("speed_heating", Level::series);
  EXPECT_EQ(reach_of(heating.parameters[1], 700.0), 700.0);
  EXPECT_EQ(reach_of(heating.parameters[1], 20.0), 180.0);  // a tenth of 1800 s
  EXPECT_EQ(reach_of(heating.parameters[2], 5.0 / 3.0), 0.5);
  EXPECT_EQ(reach_of(heating.parameters[2], 0.7), 0.35);
}

// A shift of gain n^2, n in krpm, steps from row i to row i + 1 of which both are read: had it come sooner the first
// would be the new value, later the second the old one. Between the two rows: half of that, by
// the sd of when, and together with all others by that of the clock.
TEST(BaseColumns, times_of_a_shift_by_hand) {
  auto rows = made();
  rows->model.terms = {term_of("centrifugal_shift", {"n_rpm"})};
  rows->rows.resize(160);
  std::iota(rows->rows.begin(), rows->rows.end(), std::size_t{0});
  rows->y = Eigen::VectorXd::Zero(160);
  const Eigen::MatrixXd times = base_of(*rows).delays_at({0.0, 0.1, 2.0}, {}, 1);
  const double squares[] = {0.0, 3.6, 0.4, 8.1, 0.0, 1.6};  // 0.1 n^2, um
  ASSERT_EQ(times.cols(), 6);                               // the clock, then five changes by their size
  Eigen::VectorXd together = Eigen::VectorXd::Zero(160);
  for (Eigen::Index jump = 0; jump < 5; ++jump) {
    const double step_um = squares[jump + 1] - squares[jump];
    const Eigen::Index first = 29 * (jump + 1) - 1;
    together[first] += Tuning{}.clock_delay * 0.5 * step_um;
    together[first + 1] += Tuning{}.clock_delay * 0.5 * step_um;
  }
  EXPECT_LT((times.col(0) - together).cwiseAbs().maxCoeff(), 1e-9);
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(160);
  largest[115] = largest[116] = Tuning{}.jump_delay * 0.5 * -8.1;
  EXPECT_LT((times.col(1) - largest).cwiseAbs().maxCoeff(), 1e-9);
  for (Eigen::Index k = 2; k < 6; ++k) EXPECT_LE(times.col(k).norm(), times.col(k - 1).norm() + 1e-12);
}

// A room of 20 degC and 1e-6 K/s^2, late by its clock: gain times slope times its sd, but for what it is taken
// from, the first row's.
TEST(BaseColumns, time_of_a_clock_by_hand) {
  auto rows = made();
  for (std::size_t i = 0; i < 160; ++i) {
    rows->logged.series.columns[1].values[i] = 20.0 + 1e-6 * rows->data.time_s[i] * rows->data.time_s[i];
  }
  rows->model.terms = {term_of("expansion", {"T_room_degC"})};
  rows->y = Eigen::VectorXd::Zero(80);
  const Eigen::MatrixXd times = base_of(*rows).delays_at({0.0, 2.0}, {}, 1);
  ASSERT_EQ(times.cols(), 1);
  const auto slope_um = [&](Eigen::Index i) {
    return Tuning{}.clock_delay * 30.0 * 2.0 * 2e-6 * 60.0 * static_cast<double>(i);
  };
  double worst_um = 0.0;
  for (Eigen::Index i = 2; i < 79; ++i)
    worst_um = std::max(worst_um, std::abs(times(i, 0) - times(2, 0) - slope_um(i) + slope_um(2)));
  EXPECT_LT(worst_um, 1e-9);
}

TEST(ShapeFit, finds_the_parameters_again) {
  const auto rows = made();
  const BaseModel base = base_of(*rows);
  std::vector<double> time_s;
  for (const std::size_t row : rows->rows) time_s.push_back(rows->data.time_s[row]);
  const Whitening filter(Covariance{0.5, 0.5, 200.0}, time_s);
  const std::vector<double> start{0.0, 0.3, 1400.0, 5.0 / 3.0, 1.0, 250.0, 0.0, 2.0};
  const Eigen::MatrixXd none(80, 0);
  const ShapeFit found = shape_fit(base, start, {}, none, filter, {}, {60});
  for (std::size_t k = 0; k < rows->truth.size(); ++k)
    EXPECT_NEAR(found.parameters[k], rows->truth[k], 2e-3 * std::max(1.0, std::abs(rows->truth[k]))) << k;
  EXPECT_LT(found.variance, 1e-4);
}

TEST(ShapeFit, finds_a_held_exponent_again) {
  auto rows = made();
  rows->model.terms.pop_back();
  rows->truth = {4.0, 0.7, 900.0, 1.0, 3.0, 400.0};
  rows->y =
      ModelRows(rows->model, rows->logged.series, rows->rows).sum(Eigen::VectorXd::Map(rows->truth.data(), 6), nullptr);
  const BaseModel base = base_of(*rows);
  std::vector<double> time_s;
  for (const std::size_t row : rows->rows) time_s.push_back(rows->data.time_s[row]);
  const Whitening filter(Covariance{}, time_s);
  const ShapeFit found =
      shape_fit(base, {4.0, 0.7, 900.0, 5.0 / 3.0, 3.0, 400.0}, {3}, Eigen::MatrixXd(80, 0), filter, {}, {60});
  EXPECT_NEAR(found.parameters[3], 1.0, 0.01);
  EXPECT_NEAR(found.parameters[2], 900.0, 10.0);
}

// Shapes stay within their bounds, wherever the line points.
TEST(ShapeFit, stays_within_the_bounds) {
  auto rows = made();
  rows->model.terms[0].settings[1].lower = 1100.0;
  const BaseModel base = base_of(*rows);
  std::vector<double> time_s;
  for (const std::size_t row : rows->rows) time_s.push_back(rows->data.time_s[row]);
  const ShapeFit found = shape_fit(base, {0.0, 0.3, 1400.0, 5.0 / 3.0, 1.0, 250.0, 0.0, 2.0}, {},
                                   Eigen::MatrixXd(80, 0), Whitening(Covariance{}, time_s), {}, {30});
  EXPECT_NEAR(found.parameters[2], 1100.0, 1e-9);
}

}  // namespace
}  // namespace ballbar
