// A drift that is the input of an effect, between its tests.
#include "model/measured_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

// Lines from 2 at 20 s to 6 at 40 s and 0 at 100 s; at 25 s: 2 + 4 * 5 / 20, at 70 s: 6 - 6 * 30 / 60.
TEST(measured_input, is_a_line_between_its_values_and_constant_outside) {
  const Series data{{0.0, 20.0, 25.0, 40.0, 70.0, 100.0, 900.0},
                    {{"z_um", Role::measured, {kGap, 2.0, kGap, 6.0, kGap, 0.0, kGap}}},
                    std::nullopt};
  EXPECT_EQ(input_values(data, data.columns[0]), (std::vector<double>{2.0, 2.0, 3.0, 6.0, 3.0, 0.0, 0.0}));
}

TEST(measured_input, signals_and_whole_columns_stay_as_they_are) {
  const Series data{{0.0, 10.0, 20.0},
                    {{"T_degC", Role::structure, {1.0, kGap, 3.0}},
                     {"z_um", Role::measured, {1.0, 2.0, 4.0}},
                     {"y_um", Role::measured, {kGap, kGap, kGap}}},
                    std::nullopt};
  EXPECT_TRUE(std::isnan(input_values(data, data.columns[0])[1]));
  EXPECT_EQ(input_values(data, data.columns[1]), data.columns[1].values);
  EXPECT_TRUE(std::isnan(input_values(data, data.columns[2])[0]));
}

// Tests every 10 min, a signal every 10 s; z warms up and x is 0.03 of it, with 2 um more from a room.
Series session(double gain) {
  Series drift, signals;
  drift.columns = {{"x_um", Role::measured, {}}, {"z_um", Role::measured, {}}};
  signals.columns = {{"T_room_degC", Role::ambient, {}}};
  const auto room = [](double time_s) { return 20.0 + 0.001 * time_s; };
  for (int test = 0; test < 15; ++test) {
    const double time_s = 600.0 * test + 30.0;
    const double z_um = 40.0 * (1.0 - std::exp(-time_s / 2000.0));
    drift.time_s.push_back(time_s);
    drift.columns[0].values.push_back(gain * z_um + 0.2 * room(time_s));
    drift.columns[1].values.push_back(z_um);
  }
  for (double time_s = 0.0; time_s <= 9000.0; time_s += 10.0) {
    signals.time_s.push_back(time_s);
    signals.columns[0].values.push_back(room(time_s));
  }
  return merged({drift, signals}, 600.0);
}

Model model_of(std::vector<Term> terms) { return {Level::series, {"x_um"}, std::move(terms), std::nullopt}; }

// The tests stand at known values of z, so that lines between them do not matter to an effect without a memory.
TEST(measured_input, crosstalk_of_a_session_is_recovered) {
  const Series data = session(0.03);
  const Model model = model_of({term_of("axial_crosstalk", {"z_um"}), term_of("expansion", {"T_room_degC"})});
  EXPECT_EQ(measured_inputs_with_gaps(model, data), std::vector<std::string>{"z_um"});
  const Fit found = fit(model, data);
  ASSERT_EQ(found.row.size(), 15u);
  EXPECT_NEAR(found.parameters[1].value, 0.03, 1e-9);
  EXPECT_NEAR(found.parameters[2].value, 0.2, 1e-7);
  EXPECT_LT(found.rmse_um, 1e-7);
  const Prediction prediction = predict(model, found.parameters, data);
  ASSERT_EQ(prediction.predicted_um.size(), data.time_s.size());
  for (std::size_t i = 0; i < found.row.size(); ++i) {
    EXPECT_NEAR(prediction.predicted_um[found.row[i]], found.measured_um[i], 1e-6);
  }
}

TEST(measured_input, a_formula_reads_it_too) {
  const Parameter k{.name = "k", .unit = "1", .lower = -10.0, .upper = 10.0};
  const Fit found =
      fit(model_of({expression_term("k * z_um", {k}), term_of("expansion", {"T_room_degC"})}), session(0.05));
  EXPECT_NEAR(found.parameters[1].value, 0.05, 1e-9);
}

TEST(measured_input, a_signal_with_a_gap_is_refused) {
  Series data = session(0.03);
  for (Column& column : data.columns) {
    if (column.name == "T_room_degC") column.values[4] = kGap;
  }
  try {
    fit(model_of({term_of("axial_crosstalk", {"z_um"}), term_of("expansion", {"T_room_degC"})}), data);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "expected a value of T_room_degC at every time, found a gap at 40 s.");
  }
}

// A recording's readings are whole: no lines there.
TEST(measured_input, not_on_recordings) {
  Model model = model_of({term_of("axial_crosstalk", {"z_um"})});
  model.level = Level::recording;
  EXPECT_TRUE(measured_inputs_with_gaps(model, session(0.03)).empty());
}

}  // namespace
}  // namespace ballbar
