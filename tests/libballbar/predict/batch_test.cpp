// What a regression over many batches needs of each.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/predict/train.hpp"
#include "made_batches.hpp"

namespace ballbar {
namespace {

using made::expect_error;

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

// One sensor, 1, 2 and 6 degC; the target 0, 3 and 3 um.
Series three_rows() {
  return {{0.0, 10.0, 20.0},
          {{"T_room_degC", Role::structure, {1.0, 2.0, 6.0}}, {"z_um", Role::measured, {0.0, 3.0, 3.0}}},
          std::nullopt};
}

// Means 3 and 2; deviations -2, -1, 3 and -2, 1, 1: squares 4 + 1 + 9 = 14 and 4 + 1 + 1 = 6, products 4 - 1 + 3 = 6.
TEST(batch, moments_of_three_rows) {
  const Series series = three_rows();
  const Batch batch = batch_of("a", series, batch_columns(series, InputKind::temperature, "z_um", {}));
  EXPECT_EQ(batch.name, "a");
  EXPECT_EQ(batch.rows, 3U);
  EXPECT_EQ(batch.moments.weight, 3.0);
  EXPECT_EQ(batch.moments.mean, Eigen::Vector2d(3.0, 2.0));
  EXPECT_EQ(batch.moments.scatter, (Eigen::Matrix2d() << 14.0, 6.0, 6.0, 6.0).finished());
}

// Rises 0, 1 and 5 K: the mean 2, the same scatter. Both: 14 between the two as well.
TEST(batch, moments_of_rises) {
  const Series series = three_rows();
  const Moments rise = batch_of("a", series, batch_columns(series, InputKind::rise, "z_um", {})).moments;
  EXPECT_EQ(rise.mean, Eigen::Vector2d(2.0, 2.0));
  EXPECT_EQ(rise.scatter, (Eigen::Matrix2d() << 14.0, 6.0, 6.0, 6.0).finished());
  const Moments both = batch_of("a", series, batch_columns(series, InputKind::both, "z_um", {})).moments;
  EXPECT_EQ(both.mean, Eigen::Vector3d(3.0, 2.0, 2.0));
  EXPECT_EQ(both.scatter, (Eigen::Matrix3d() << 14.0, 14.0, 6.0, 14.0, 14.0, 6.0, 6.0, 6.0, 6.0).finished());
}

TEST(batch, inputs_and_their_names) {
  Series series = three_rows();
  series.columns.insert(series.columns.begin(), {"dT_K", Role::structure, {0.5, 1.5, 0.0}});
  BatchColumns columns = batch_columns(series, InputKind::both, "z_um", {});
  EXPECT_EQ(columns.sensors, (std::vector<std::string>{"dT_K", "T_room_degC"}));
  EXPECT_EQ(input_names(columns), (std::vector<std::string>{"dT_K", "T_room_degC", "dT_K rise", "T_room_degC rise"}));
  Eigen::MatrixXd both(3, 4);
  both << 0.5, 1.0, 0.0, 0.0, 1.5, 2.0, 1.0, 1.0, 0.0, 6.0, -0.5, 5.0;
  EXPECT_EQ(inputs_of(series, columns), both);
  columns.kind = InputKind::rise;
  EXPECT_EQ(input_names(columns), (std::vector<std::string>{"dT_K rise", "T_room_degC rise"}));
  EXPECT_EQ(inputs_of(series, columns), both.rightCols(2));
  columns.kind = InputKind::temperature;
  EXPECT_EQ(input_names(columns), columns.sensors);
  EXPECT_EQ(inputs_of(series, columns), both.leftCols(2));
  EXPECT_EQ(name_of(InputKind::temperature), "temperature");
  EXPECT_EQ(name_of(InputKind::rise), "rise");
  EXPECT_EQ(name_of(InputKind::both), "both");
}

// Two means 1 and 4 of weights 3 and 1, apart by 3: mean 1 + 3 / 4, scatter 2 + 5 + 3 * 1 / 4 * 9.
TEST(batch, two_moments_merged) {
  const auto of = [](double weight, double mean, double scatter) {
    return Moments{weight, Eigen::VectorXd::Constant(1, mean), Eigen::MatrixXd::Constant(1, 1, scatter)};
  };
  const Moments both = merged(of(3.0, 1.0, 2.0), of(1.0, 4.0, 5.0));
  EXPECT_EQ(both.weight, 4.0);
  EXPECT_EQ(both.mean[0], 1.75);
  EXPECT_EQ(both.scatter(0, 0), 13.75);
  EXPECT_EQ(merged(Moments{}, of(3.0, 1.0, 2.0)).mean[0], 1.0);
  EXPECT_EQ(merged(of(3.0, 1.0, 2.0), Moments{}).scatter(0, 0), 2.0);
}

// Relative to the largest: rounding of 960 rows is some 1e-14.
TEST(batch, merged_moments_are_those_of_the_stacked_rows) {
  const std::vector<Series> all = made::warm_ups(8, {}, "merged_moments");
  for (const InputKind kind : {InputKind::temperature, InputKind::rise, InputKind::both}) {
    const BatchColumns columns = made::columns_of(all, kind);
    const Moments found = merged(made::batches_of(all, columns));
    Eigen::MatrixXd rows(0, found.mean.size());
    for (const Series& series : all) {
      const Eigen::MatrixXd inputs = inputs_of(series, columns);
      const Eigen::Index before = rows.rows();
      rows.conservativeResize(before + inputs.rows(), Eigen::NoChange);
      rows.bottomRows(inputs.rows()) << inputs,
          Eigen::VectorXd::Map(find_column(series, "z_um")->values.data(), inputs.rows());
    }
    const Eigen::VectorXd mean = rows.colwise().mean();
    rows.rowwise() -= mean.transpose();
    const Eigen::MatrixXd scatter = rows.transpose() * rows;
    EXPECT_EQ(found.weight, 960.0);
    EXPECT_LT((found.mean - mean).norm(), 1e-12 * mean.norm());
    EXPECT_LT((found.scatter - scatter).norm(), 1e-12 * scatter.norm());
  }
}

TEST(batch, a_weight_of_0_leaves_out_and_one_of_2_counts_twice) {
  const std::vector<Series> all = made::warm_ups(3, {}, "weights");
  const std::vector<Batch> batches = made::batches_of(all, made::columns_of(all));
  const Moments found = merged(batches, std::vector<double>{1.0, 0.0, 1.0});
  const Moments left = merged(std::vector<Batch>{batches[0], batches[2]});
  EXPECT_EQ(found.weight, left.weight);
  EXPECT_EQ(found.mean, left.mean);
  EXPECT_EQ(found.scatter, left.scatter);
  const Moments twice = merged(batches, std::vector<double>{2.0, 0.0, 1.0});
  const Moments copied = merged(std::vector<Batch>{batches[0], batches[0], batches[2]});
  EXPECT_EQ(twice.weight, copied.weight);
  EXPECT_LT((twice.mean - copied.mean).norm(), 1e-13 * copied.mean.norm());  // rounding
  EXPECT_LT((twice.scatter - copied.scatter).norm(), 1e-13 * copied.scatter.norm());
}

// Sensors at 18, 20 and 25 begin at 21 on average; deviations -3, -1, 4: variance 26 / 3.
TEST(batch, start) {
  const Series series{{0.0, 10.0, 20.0},
                      {{"T_a_degC", Role::structure, {18.0, 20.0, 30.0}},
                       {"T_room_degC", Role::structure, {20.0, 21.0, 25.0}},
                       {"T_b_degC", Role::structure, {25.0, 25.0, 25.0}},
                       {"n_rpm", Role::speed, {0.0, 3000.0, 6000.0}},
                       {"z_um", Role::measured, {0.0, 1.0, 2.0}}},
                      std::nullopt};
  BatchColumns columns = batch_columns(series, InputKind::temperature, "z_um", {});
  ASSERT_EQ(columns.speed, "n_rpm");
  const BatchStart start = batch_of("a", series, columns).start;
  EXPECT_EQ(start.room_first_degC, 20.0);
  EXPECT_EQ(start.room_mean_degC, 22.0);
  EXPECT_EQ(start.sensors_mean_degC, 21.0);
  EXPECT_DOUBLE_EQ(start.sensors_spread_K, std::sqrt(26.0 / 3.0));
  EXPECT_EQ(start.speed_mean_rpm, 3000.0);
  columns.speed.reset();
  EXPECT_TRUE(std::isnan(batch_of("a", series, columns).start.speed_mean_rpm));
}

// Temperatures themselves, whatever goes into the regression: means 63 / 3, 66 / 3, 80 / 3.
TEST(batch, sensors_as_a_batch_begins_and_on_average) {
  const Series series{{0.0, 10.0, 20.0},
                      {{"T_a_degC", Role::structure, {18.0, 20.0, 25.0}},
                       {"T_room_degC", Role::structure, {20.0, 21.0, 25.0}},
                       {"T_b_degC", Role::structure, {25.0, 25.0, 30.0}},
                       {"z_um", Role::measured, {0.0, 1.0, 2.0}}},
                      std::nullopt};
  const Batch batch = batch_of("a", series, batch_columns(series, InputKind::rise, "z_um", {}));
  EXPECT_EQ(batch.sensor_first_degC, Eigen::Vector3d(18.0, 20.0, 25.0));
  EXPECT_DOUBLE_EQ(batch.sensor_mean_degC[0], 21.0);
  EXPECT_DOUBLE_EQ(batch.sensor_mean_degC[1], 22.0);
  EXPECT_DOUBLE_EQ(batch.sensor_mean_degC[2], 80.0 / 3.0);
}

TEST(batch, columns_of_a_series) {
  Series series = three_rows();
  series.columns.push_back({"T_oil_degC", Role::ambient, {1.0, 2.0, 3.0}});
  series.columns.push_back({"T_made_degC", Role::measured, {1.0, 2.0, 3.0}});  // no sensor: what is predicted
  BatchColumns expected{{"T_room_degC", "T_oil_degC"}, InputKind::rise, "z_um", "T_oil_degC", std::nullopt};
  EXPECT_EQ(batch_columns(series, InputKind::rise, "z_um", {}), expected);  // the role goes before the name
  expected.room = "T_room_degC";
  EXPECT_EQ(batch_columns(series, InputKind::rise, "z_um", "T_room_degC"), expected);
  for (const char* const name : {"T_Ambient_degC", "AIR_degC", "Room_degC"}) {
    series = three_rows();
    series.columns[0].name = name;
    EXPECT_EQ(batch_columns(series, InputKind::rise, "z_um", {}).room, name);
  }
}

TEST(batch, messages) {
  const Series good = three_rows();
  const BatchColumns columns = batch_columns(good, InputKind::temperature, "z_um", {});
  const auto columns_with = [](const Series& series, const std::string& target, std::optional<std::string> room) {
    return [=] { (void)batch_columns(series, InputKind::temperature, target, room); };
  };
  expect_error("expected a column z_mu, found none; the nearest is z_um.", columns_with(good, "z_mu", {}));
  expect_error("expected a column T_rom_degC, found none; the nearest is T_room_degC.",
               columns_with(good, "z_um", "T_rom_degC"));
  expect_error("expected a column z_um, found none.", columns_with({}, "z_um", {}));

  Series series = good;
  series.columns.erase(series.columns.begin());
  expect_error("expected columns of temperatures (_degC or _K), found none.", columns_with(series, "z_um", {}));
  series = good;
  series.columns[0].name = "T_nose_degC";
  series.columns.push_back({"T_oil_degC", Role::coolant, {1.0, 2.0, 3.0}});
  // Only what ranks batches needs a room.
  BatchColumns without_room = batch_columns(series, InputKind::temperature, "z_um", {});
  EXPECT_EQ(without_room.room, "");
  EXPECT_TRUE(std::isnan(batch_of("a", series, without_room).start.room_first_degC));
  expect_error(
      "expected one column of the room's temperature (role ambient, or room, ambient or air in its name), by which "
      "batches are ranked, found none or several; name it by --room, one of T_nose_degC, T_oil_degC.",
      [&] { expect_room(without_room); });
  series.columns[0].name = "T_room_degC";
  series.columns.back().name = "T_air_degC";
  EXPECT_EQ(batch_columns(series, InputKind::temperature, "z_um", {}).room, "");

  const auto batch_with = [&](const Series& one) { return [=] { (void)batch_of("a", one, columns); }; };
  series = good;
  series.columns[0].name = "T_roof_degC";
  const std::string missing = "expected a column T_room_degC, found none; the nearest is T_roof_degC.";
  expect_error(missing, batch_with(series));
  expect_error(missing, [&] { (void)inputs_of(series, columns); });
  series = good;
  series.columns[0].values[1] = kGap;
  const std::string gap = "expected a value in every row of T_room_degC, found a gap at 10 s.";
  expect_error(gap, batch_with(series));
  expect_error(gap, [&] { (void)inputs_of(series, columns); });
  series = good;
  series.columns[1].values[2] = kGap;
  expect_error("expected a value in every row of z_um, found a gap at 20 s.", batch_with(series));
  EXPECT_EQ(inputs_of(series, columns).rows(), 3);  // a job need not be measured
  series = {{0.0, 10.0}, {{"T_room_degC", Role::structure, {1.0, 2.0}}, {"z_um", Role::measured, {0.0, 3.0}}}, {}};
  expect_error("expected a batch of at least 3 rows, found 2.", batch_with(series));
  expect_error("expected sensors that are sound and not constant, found none.", [&] {
    std::vector<Batch> batches{batch_of("a", good, columns)};
    BatchColumns all = columns;
    leave_out_sensors(batches, all, {"T_room_degC"});
  });
}

TEST(batch, a_sensor_off_in_some_batches_is_broken) {
  std::vector<Series> all = made::warm_ups(8, {}, "broken_sensors");
  const BatchColumns columns = made::columns_of(all);
  EXPECT_TRUE(broken_sensors(made::batches_of(all, columns), columns).empty());
  for (const std::size_t k : {1U, 4U, 6U}) {
    for (double& degC : made::values_of(all[k], "T07_degC")) degC += 30.0;
  }
  const std::vector<BrokenSensor> broken = broken_sensors(made::batches_of(all, columns), columns);
  ASSERT_EQ(broken.size(), 1U);
  EXPECT_EQ(broken[0].sensor, "T07_degC");
  EXPECT_EQ(broken[0].batches, (std::vector<std::string>{"batch 2", "batch 5", "batch 7"}));
  EXPECT_NEAR(broken[0].off_K, 30.0, 5.0);  // its place among the others differs by some K from batch to batch
}

// A day at full load among days at rest: every sensor near the heat moves away from the middle one, and none is broken.
TEST(batch, a_batch_of_another_load_has_no_broken_sensor) {
  std::mt19937_64 random(made::seed_of("another_load"));
  for (const std::size_t hard : {1U, 4U}) {
    std::vector<Series> all;
    for (std::size_t k = 0; k < 12; ++k) all.push_back(made::warm_up({}, 20.0, k < hard ? 45.0 : 8.0, 0.8, random));
    const BatchColumns columns = made::columns_of(all);
    std::vector<std::string> named;
    for (const BrokenSensor& one : broken_sensors(made::batches_of(all, columns), columns)) named.push_back(one.sensor);
    EXPECT_EQ(named, std::vector<std::string>{}) << hard << " of 12";
  }
}

// 20.5 is a binary fraction, 20.1 is none: the mean of 600 of it is not 20.1 to the last bit.
TEST(batch, constant_sensors) {
  made::Batches plan;
  plan.rows = 600;
  std::vector<Series> all = made::warm_ups(3, plan, "constant_sensors");
  for (Series& series : all) made::values_of(series, "T02_degC").assign(600, 20.5);
  for (std::size_t k = 0; k < 3; ++k) {  // constant within each
    made::values_of(all[k], "T03_degC").assign(600, 20.5 + static_cast<double>(k));
  }
  const BatchColumns columns = made::columns_of(all);
  EXPECT_EQ(constant_sensors(made::batches_of(all, columns), columns), (std::vector<std::string>{"T02_degC"}));
}

TEST(batch, constant_sensors_of_a_decimal_fraction) {
  std::vector<Series> all = made::warm_ups(3, {}, "constant_sensors_of_a_decimal_fraction");
  for (Series& series : all) made::values_of(series, "T02_degC").assign(120, 20.1);
  const BatchColumns columns = made::columns_of(all);
  EXPECT_EQ(constant_sensors(made::batches_of(all, columns), columns), (std::vector<std::string>{"T02_degC"}));
}

// What is left is what the batches without these columns would be.
TEST(batch, leave_out_sensors) {
  std::vector<Series> all = made::warm_ups(2, {}, "without_sensors");
  for (double& degC : made::values_of(all[1], "T05_degC")) degC += 500.0;
  for (const InputKind kind : {InputKind::temperature, InputKind::rise, InputKind::both}) {
    BatchColumns columns = made::columns_of(all, kind), expected = columns;
    std::vector<Batch> batches = made::batches_of(all, columns);
    leave_out_sensors(batches, columns, {"T05_degC", "T20_degC"});
    std::erase(expected.sensors, "T05_degC");
    std::erase(expected.sensors, "T20_degC");
    EXPECT_EQ(columns, expected);
    const std::vector<Batch> direct = made::batches_of(all, expected);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LT((batches[k].moments.mean - direct[k].moments.mean).norm(), 1e-12);
      EXPECT_LT((batches[k].moments.scatter - direct[k].moments.scatter).norm(),
                1e-12 * direct[k].moments.scatter.norm());
      EXPECT_EQ(batches[k].sensor_first_degC, direct[k].sensor_first_degC);
      EXPECT_LT((batches[k].sensor_mean_degC - direct[k].sensor_mean_degC).norm(), 1e-12);
    }
  }
}

// A job without the sensor that is left out knows nothing of it: the two must stay comparable.
TEST(batch, leave_out_sensors_the_start_is_that_of_the_rest) {
  std::vector<Series> all = made::warm_ups(2, {}, "without_sensors_start");
  for (double& degC : made::values_of(all[1], "T05_degC")) degC += 500.0;
  BatchColumns columns = made::columns_of(all);
  std::vector<Batch> batches = made::batches_of(all, columns);
  leave_out_sensors(batches, columns, {"T05_degC"});
  for (std::size_t k = 0; k < 2; ++k) {
    const BatchStart start = batch_of("a", all[k], columns).start;
    EXPECT_NEAR(batches[k].start.sensors_mean_degC, start.sensors_mean_degC, 1e-9);  // rounding
    EXPECT_NEAR(batches[k].start.sensors_spread_K, start.sensors_spread_K, 1e-9);
  }
}

TEST(batch, steps) {
  std::vector<Series> all = made::warm_ups(1, {}, "steps");
  const BatchColumns columns = made::columns_of(all);
  EXPECT_TRUE(batch_of("a", all[0], columns).steps.empty());  // a smooth warm-up
  std::vector<double>& z_um = made::values_of(all[0], "z_um");
  const double before = z_um[60] - z_um[59];
  for (std::size_t i = 60; i < z_um.size(); ++i) z_um[i] += 20.0;
  const Batch batch = batch_of("a", all[0], columns);
  ASSERT_EQ(batch.steps.size(), 1U);
  EXPECT_EQ(batch.steps[0].time_s, 1800.0);  // row 60 of 30 s
  EXPECT_DOUBLE_EQ(batch.steps[0].um, before + 20.0);
  z_um.assign(z_um.size(), 1.0);
  EXPECT_TRUE(batch_of("a", all[0], columns).steps.empty());
}

// A row every 5 min, a time constant of 20 min: the first change is the largest, 22 % of all, and the next is like it.
TEST(batch, a_warm_up_of_few_rows_has_no_step) {
  for (const std::size_t rest : {0U, 30U}) {  // rows before it
    Series series{{}, {{"T_room_degC"}, {"z_um", Role::measured}}, {}};
    for (std::size_t i = 0; i < 60; ++i) {
      series.time_s.push_back(300.0 * static_cast<double>(i));
      series.columns[0].values.push_back(20.0);
      const double warm_s = i < rest ? 0.0 : 300.0 * static_cast<double>(i - rest);
      series.columns[1].values.push_back(50.0 * (1.0 - std::exp(-warm_s / 1200.0)));
    }
    EXPECT_TRUE(batch_of("a", series, made::columns_of({series})).steps.empty()) << rest << " rows of rest";
  }
}

}  // namespace
}  // namespace ballbar
