#include "ballbar/formats/models/effect_regression_json.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"

namespace ballbar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kModel = R"({
  "format": "ballbar-effect-regression 1",
  "target": "z_um",
  "dictionary": ["sources of heat", "temperatures"],
  "prior_variance": 0.1,
  "sigma_um": 1.25,
  "length_s": 7200.0,
  "interval_scale": 1.5,
  "rows": 812,
  "runs": 1,
  "rmse_um": 0.75,
  "forecasts": {"count": 3, "error_um": 0.8, "rmse_um": 1.1, "held_um": 2.5, "within_share": 0.95},
  "columns": [
    {"name": "speed_rpm", "role": "speed", "low": 0.0, "high": 6000.0},
    {"name": "T_oil_degC", "role": "coolant", "low": 20.5, "high": 38.9}
  ],
  "left_out": ["T_hall_degC"],
  "constant_um": -3.125,
  "terms": [
    {"effect": "centrifugal_shift", "columns": ["speed_rpm"], "parameters": [-0.5, 2.0], "mean_um": 5.5, "sd_um": 2.0},
    {"effect": "lagged_expansion", "columns": ["T_oil_degC"], "parameters": [2.2, 600.0], "mean_um": 4.5, "sd_um": 3.0}
  ],
  "factor_um": [
    [0.125],
    [0, 0.25],
    [0.01, -0.02, 0.5],
    [0, 0, 0.1, 1e-05]
  ],
  "end": {
    "time_s": 28800.0,
    "step_s": 10.0,
    "discrepancy_um": -0.4,
    "rows": 3,
    "times_s": [0.0, 28790.0, 28800.0],
    "inputs": [0.0, 3000.0, 3000.0, 20.5, 31.0, 31.5],
    "kept": [1.0, 2.0, 3.0, 4.0, 5.0]
  }
}
)";

std::string changed(const std::string& from, const std::string& to) {
  if (from == "*") return to;
  std::string text = kModel;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good text lacks what a row changes: " + from);
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  try {
    read_effect_regression(text, "m.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

struct Bad {
  std::string from, to;
  std::string message;  // behind the file's name
};

void expect_messages(const std::vector<Bad>& cases) {
  for (const Bad& bad : cases) {
    EXPECT_EQ(complaint(changed(bad.from, bad.to)), "m.json:" + bad.message)
        << "for " << bad.from.substr(0, 100) << " -> " << bad.to.substr(0, 100);
  }
}

TEST(effect_regression_json, every_key) {
  const EffectRegression read = read_effect_regression(kModel, "m.json");
  EXPECT_EQ(read.model.targets, std::vector<std::string>{"z_um"});
  EXPECT_EQ(dictionary_text(read), "sources of heat, temperatures");
  EXPECT_EQ(read.prior_variance, 0.1);
  EXPECT_EQ(read.sigma_um, 1.25);
  EXPECT_EQ(read.length_s, 7200.0);
  EXPECT_EQ(read.interval_scale, 1.5);
  EXPECT_EQ(read.rows, 812U);
  EXPECT_EQ(read.runs, 1U);
  EXPECT_EQ(read.rmse_um, 0.75);
  ASSERT_TRUE(read.forecasts);
  EXPECT_EQ(read.forecasts->count, 3U);
  EXPECT_EQ(read.forecasts->error_um, 0.8);
  EXPECT_EQ(read.forecasts->rmse_um, 1.1);
  EXPECT_EQ(read.forecasts->held_um, 2.5);
  EXPECT_EQ(read.forecasts->within_share, 0.95);
  ASSERT_EQ(read.model.trained.size(), 2U);
  EXPECT_EQ(read.model.trained[1].column, "T_oil_degC");
  EXPECT_EQ(read.model.trained[1].low, 20.5);
  EXPECT_EQ(read.model.trained[1].high, 38.9);
  EXPECT_EQ(read.roles, (std::vector<Role>{Role::speed, Role::coolant}));
  EXPECT_EQ(read.left_out, std::vector<std::string>{"T_hall_degC"});
  EXPECT_EQ(read.model.constant_um, -3.125);
  ASSERT_EQ(read.model.terms.size(), 2U);
  EXPECT_EQ(label_of(read.model.terms[0]), "centrifugal_shift(speed_rpm)");
  EXPECT_EQ(read.model.terms[1].settings[1].start, 600.0);
  EXPECT_FALSE(has_free(read.model));
  EXPECT_EQ(read.mean_um, Eigen::Vector2d(5.5, 4.5));
  EXPECT_EQ(read.sd_um, Eigen::Vector2d(2.0, 3.0));
  Eigen::Matrix4d factor;
  factor << 0.125, 0, 0, 0, 0, 0.25, 0, 0, 0.01, -0.02, 0.5, 0, 0, 0, 0.1, 1e-5;
  EXPECT_EQ(read.factor_um, factor);
  EXPECT_EQ(read.end_s, 28800.0);
  EXPECT_EQ(read.end_step_s, 10.0);
  EXPECT_EQ(read.end_discrepancy_um, -0.4);
  EXPECT_EQ(read.end.rows, 3U);
  EXPECT_EQ(read.end.time_s, (std::array<double, 3>{0.0, 28790.0, 28800.0}));
  EXPECT_EQ(read.end.inputs, (std::vector<double>{0.0, 3000.0, 3000.0, 20.5, 31.0, 31.5}));
  EXPECT_EQ(read.end.kept, (std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0}));
}

TEST(effect_regression_json, written_as_it_was_read) {
  EXPECT_EQ(write_effect_regression(read_effect_regression(kModel, "m.json")), kModel);
  for (const auto& [from, to] :
       {std::pair("\"held_um\": 2.5", "\"held_um\": null"),
        std::pair("{\"count\": 3, \"error_um\": 0.8, \"rmse_um\": 1.1, \"held_um\": 2.5, \"within_share\": 0.95}",
                  "null"),
        std::pair("[\"T_hall_degC\"]", "[]")}) {
    const std::string text = changed(from, to);
    EXPECT_EQ(write_effect_regression(read_effect_regression(text, "m.json")), text);
  }
}

TEST(effect_regression_json, what_is_not_finite_is_not_written) {
  const EffectRegression good = read_effect_regression(kModel, "m.json");
  EffectRegression in_factor = good, in_state = good;
  in_factor.factor_um(3, 2) = kNaN;
  in_state.end.kept[1] = -std::numeric_limits<double>::infinity();
  for (const auto& [bad, found] : {std::pair(in_factor, "nan"), std::pair(in_state, "-inf")}) {
    try {
      write_effect_regression(bad);
      ADD_FAILURE() << "written";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), fmt::format("A model file holds finite numbers only: expected one, found {}.", found));
    }
  }
}

TEST(effect_regression_json, told_by_its_head) {
  EXPECT_TRUE(is_effect_regression_json(kModel));
  EXPECT_TRUE(is_effect_regression_json(std::string_view(kModel).substr(0, 50)));
  EXPECT_FALSE(is_effect_regression_json(R"({"format": "ballbar-batch-model 1"})"));
  EXPECT_FALSE(is_effect_regression_json("format = \"ballbar-effect-regression 1\""));
  EXPECT_FALSE(is_effect_regression_json(""));
}

// A spindle of two temperatures and a speed, which the target follows slowly.
Series made(double begin_s, std::size_t rows) {
  Series series;
  std::mt19937 random(7);
  Column speed{"speed_rpm", Role::speed, {}}, oil{"T_oil_degC", Role::coolant, {}},
      air{"T_air_degC", Role::ambient, {}}, z{"z_um", Role::measured, {}};
  double heat = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = begin_s + 60.0 * static_cast<double>(i), noise = std::ldexp(static_cast<double>(random()), -32);
    series.time_s.push_back(t);
    speed.values.push_back(std::fmod(t, 9000.0) < 5000.0 ? 3000.0 : 0.0);
    oil.values.push_back(22.0 + 3.0 * std::sin(t / 2000.0));
    air.values.push_back(20.0 + std::sin(t * 2.0 * std::numbers::pi / 40000.0));
    heat += (speed.values.back() / 300.0 - heat) * 0.05;
    z.values.push_back(heat + 2.0 * oil.values.back() - 1.5 * air.values.back() + noise);
  }
  series.columns = {speed, oil, air, z};
  return series;
}

void expect_same(const RegressionPrediction& a, const RegressionPrediction& b) {
  EXPECT_EQ(a.goes_on, b.goes_on);
  EXPECT_EQ(a.holds, b.holds);
  ASSERT_EQ(a.predicted_um.size(), b.predicted_um.size());
  for (std::size_t i = 0; i < a.predicted_um.size(); ++i) {
    ASSERT_TRUE(std::isfinite(a.predicted_um[i]));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.predicted_um[i]), std::bit_cast<std::uint64_t>(b.predicted_um[i])) << i;
    EXPECT_NEAR(b.half_width_um[i], a.half_width_um[i], 1e-6 * a.half_width_um[i]) << i;
  }
  ASSERT_EQ(a.drivers.size(), b.drivers.size());
  for (std::size_t d = 0; d < a.drivers.size(); ++d) {
    EXPECT_EQ(a.drivers[d].column, b.drivers[d].column);
    EXPECT_EQ(a.drivers[d].role, b.drivers[d].role);
    EXPECT_EQ(a.drivers[d].share_um, b.drivers[d].share_um);
  }
  EXPECT_EQ(a.outside.size(), b.outside.size());
}

TEST(effect_regression_json, what_was_trained_predicts_the_same) {
  EffectRegressionOptions options;
  options.forecasts = false;
  const std::vector<Series> one{made(0.0, 200)}, two{made(0.0, 60), made(1e5, 60)};
  for (const std::vector<Series>& runs : {one, two}) {
    const EffectRegression trained = effect_regression(runs, "z_um", options);
    const std::string written = write_effect_regression(trained);
    const EffectRegression again = read_effect_regression(written, "m.json");
    EXPECT_EQ(write_effect_regression(again), written);
    EXPECT_EQ(again.model.terms.size(), trained.model.terms.size());
    const Series fresh = made(5e5, 50), next = made(runs.back().time_s.back() + 60.0, 50);
    expect_same(predict(trained, fresh), predict(again, fresh));
    expect_same(predict(trained, next), predict(again, next));
    EXPECT_TRUE(predict(again, next).goes_on);
    expect_same(predict(trained, runs.back()), predict(again, runs.back()));
    EXPECT_TRUE(predict(again, runs.back()).holds);
  }
}

TEST(effect_regression_json, bad_text_that_is_no_json) {
  expect_messages({
      {"*", "", "1:1: expected text, found an empty file."},
      {"*", "{\"format\": \"ball", "1:17: expected JSON, found the end of the file."},
      {"-3.125", "NaN", "18:18: expected JSON, found \"NaN\"."},
      {"-3.125", "1e999", "18:18: expected a number that a double can hold, found \"1e999\"."},
  });
}

TEST(effect_regression_json, bad_keys) {
  expect_messages({
      {"*", "[]", " expected an object, found an array."},
      {"*", "{}", " expected the key format, found none."},
      {"regression 1", "regression 2",
       " expected \"ballbar-effect-regression 1\" at format, found the text \"ballbar-effect-regression 2\"."},
      {"sigma_um", "sigma",
       " expected one of the keys format, target, dictionary, prior_variance, sigma_um, length_s, interval_scale, "
       "rows, runs, rmse_um, forecasts, columns, left_out, constant_um, terms, factor_um, end, found \"sigma\"; the "
       "nearest is sigma_um."},
      {"  \"runs\": 1,\n", "", " expected the key runs, found none."},
      {"\"runs\"", "\"rows\"", " expected each key once, found \"rows\" again."},
      {"\"count\": 3, ", "", " expected the key count in forecasts, found none."},
      {"\"role\": \"speed\", ", "", " expected the key role in columns[0], found none."},
      {", \"sd_um\": 3.0", "", " expected the key sd_um in terms[1], found none."},
      {"\"step_s\"", "\"steps\"",
       " expected one of the keys time_s, step_s, discrepancy_um, rows, times_s, inputs, kept in end, found "
       "\"steps\"; the nearest is step_s."},
  });
}

// Of the catalogue in its order those of one gain that read a column, and that of a run's start.
constexpr const char* kEffects =
    "expansion, lagged_expansion, speed_heating, centrifugal_shift, cooling_asymmetry, viscosity_feedback, "
    "load_heating, follows, gradient_bending, bearing_rings, bearing_clearance, preload_loss, axial_crosstalk, "
    "play_hysteresis, "
    "bar_temperature, clock_offset, start";

TEST(effect_regression_json, bad_names) {
  expect_messages({
      {"\"z_um\"", "\"z_mm\"", " expected a name that ends in _um, or in no unit at target, found the text \"z_mm\"."},
      {"\"z_um\"", "[\"z_um\"]", " expected a printable text at target, found an array."},
      {"\"sources of heat\"", "7", " expected a printable text at dictionary[0], found the integer 7."},
      {"\"T_hall_degC\"", "null", " expected a printable text at left_out[0], found null."},
      {"{\"name\": \"T_oil_degC\"", "{\"name\": \"z_um\"",
       " expected another column than the target at columns[1].name, found the text \"z_um\"."},
      {"{\"name\": \"T_oil_degC\"", "{\"name\": \"speed_rpm\"",
       " expected each column once at columns[1].name, found the text \"speed_rpm\"."},
      {"\"coolant\"", "\"water\"", " expected a role of a column at columns[1].role, found the text \"water\"."},
      {"\"centrifugal_shift\"", "\"centrifugal_shifts\"",
       fmt::format(" expected one of the effects {} at terms[0].effect, found \"centrifugal_shifts\"; the nearest is "
                   "centrifugal_shift.",
                   kEffects)},
      {"\"lagged_expansion\"", "\"expansion\"",
       " expected an array of 1 number (one for each parameter of expansion) at terms[1].parameters, found an array of "
       "2."},
      {"\"lagged_expansion\"", "\"linear_drift\"",
       fmt::format(" expected one of the effects {} at terms[1].effect, found \"linear_drift\"; the nearest is start.",
                   kEffects)},
      {"[\"T_oil_degC\"], \"par", "[\"T_oik_degC\"], \"par",
       " expected one of the names in columns at terms[1].columns[0], found \"T_oik_degC\"; the nearest is "
       "T_oil_degC."},
      {"[\"T_oil_degC\"], \"par", "[\"speed_rpm\"], \"par",
       " expected a column in degC or K for temperature at terms[1].columns[0], found the text \"speed_rpm\"."},
      {"    {\"name\": \"speed_rpm\"",
       "    {\"name\": \"T_a_K\", \"role\": \"structure\", \"low\": 1, \"high\": 2},\n    {\"name\": \"speed_rpm\"",
       " expected a column that a term reads at columns[0].name, found the text \"T_a_K\"."},
  });
}

TEST(effect_regression_json, bad_numbers) {
  expect_messages({
      {"\"prior_variance\": 0.1", "\"prior_variance\": -0.1",
       " expected a number not below 0 at prior_variance, found the number -0.1."},
      {"1.25", "-1.25", " expected a number not below 0 at sigma_um, found the number -1.25."},
      {"7200.0", "-7200.0", " expected a number not below 0 at length_s, found the number -7200."},
      {"\"interval_scale\": 1.5", "\"interval_scale\": 0.5",
       " expected a number not below 1 at interval_scale, found the number 0.5."},
      {"812", "0", " expected a whole number from 1 to 1000000000 at rows, found the integer 0."},
      {"\"runs\": 1", "\"runs\": 1.5", " expected a whole number from 1 to 1000000000 at runs, found the number 1.5."},
      {"0.75", "null", " expected a number not below 0 at rmse_um, found null."},
      {"{\"count\": 3, \"error_um\": 0.8, \"rmse_um\": 1.1, \"held_um\": 2.5, \"within_share\": 0.95}", "3",
       " expected an object or null at forecasts, found the integer 3."},
      {"2.5", "-2.5", " expected a number not below 0 at forecasts.held_um, found the number -2.5."},
      {"0.95", "1.05", " expected a share from 0 to 1 at forecasts.within_share, found the number 1.05."},
      {"38.9", "20.0", " expected a number not above 20 of high at columns[1].low, found the number 20.5."},
      {"-3.125", "\"-3.125\"", " expected a number at constant_um, found the text \"-3.125\"."},
      {"600.0", "-600.0",
       " expected a time_constant_s from 0 to 200000 at terms[1].parameters[1], found the number -600."},
      {"600.0", "200001",
       " expected a time_constant_s from 0 to 200000 at terms[1].parameters[1], found the integer 200001."},
      {"\"sd_um\": 3.0", "\"sd_um\": 0.0", " expected a number above 0 at terms[1].sd_um, found the number 0."},
      {"\"step_s\": 10.0", "\"step_s\": -10.0", " expected a number not below 0 at end.step_s, found the number -10."},
      {"\"rows\": 3", "\"rows\": 4", " expected a whole number from 0 to 3 at end.rows, found the integer 4."},
  });
}

TEST(effect_regression_json, bad_shapes) {
  const std::string columns = kModel;
  const auto between = [&](const std::string& from, const std::string& to) {
    const std::size_t begin = columns.find(from) + from.size();
    return columns.substr(begin, columns.find(to, begin) - begin);
  };
  expect_messages({
      {between("\"columns\": ", ",\n  \"left"), "[]", " expected at least one column at columns, found none."},
      {between("\"terms\": ", ",\n  \"factor"), "[]", " expected at least one term at terms, found none."},
      {between("\"terms\": ", ",\n  \"factor"), "{}", " expected an array at terms, found an object."},
      {"[\"T_oil_degC\"], \"par", "[], \"par",
       " expected an array of 1 (one for each input of lagged_expansion) at terms[1].columns, found an array of 0."},
      {"[\"T_oil_degC\"], \"par", "[\"T_oil_degC\", \"T_oil_degC\"], \"par",
       " expected an array of 1 (one for each input of lagged_expansion) at terms[1].columns, found an array of 2."},
      {"[2.2, 600.0]", "[2.2]",
       " expected an array of 2 numbers (one for each parameter of lagged_expansion) at terms[1].parameters, found an "
       "array of 1."},
      {"[2.2, 600.0]", "[2.2, null]", " expected a number at terms[1].parameters[1], found null."},
      {"    [0.125],\n", "", " expected 4 arrays (two more than terms) at factor_um, found 3."},
      {"[0, 0.25]", "[0.25]",
       " expected an array of 2 numbers (a row of a lower triangle) at factor_um[1], found an array of 1."},
      {"[0, 0.25]", "0.25",
       " expected an array of 2 numbers (a row of a lower triangle) at factor_um[1], found the number 0.25."},
      {"[0, 0.25]", "[0, true]", " expected a number at factor_um[1][1], found true."},
      {"[0.0, 28790.0, 28800.0]", "[0.0, 28800.0]",
       " expected an array of 3 numbers (first, last but one, last) at end.times_s, found an array of 2."},
      {"[0.0, 28790.0, 28800.0]", "[0.0, 28800.0, 28800.0]",
       " expected a state of at most 3 rows whose times rise, found another."},
      {"[0.0, 3000.0, 3000.0, 20.5, 31.0, 31.5]", "[0.0, 3000.0, 3000.0]",
       " expected the state of this model, 6 inputs and 5 numbers that its effects keep, found 3 and 5."},
      {"[1.0, 2.0, 3.0, 4.0, 5.0]", "[1.0, 2.0, 3.0, 4.0]",
       " expected the state of this model, 6 inputs and 5 numbers that its effects keep, found 6 and 4."},
      {"[1.0, 2.0, 3.0, 4.0, 5.0]", "[1.0, 2.0, 3.0, 4.0, {}]", " expected a number at end.kept[4], found an object."},
  });
}

// No room is made for a square of 100 000 rows that the file does not hold.
TEST(effect_regression_json, many_terms_with_an_empty_factor) {
  const std::string term =
      R"({"effect":"centrifugal_shift","columns":["speed_rpm"],"parameters":[1,2],"mean_um":0,"sd_um":1})";
  std::string terms, empty;
  for (int i = 0; i < 100'000; ++i) {
    terms += term + ',';
    empty += "[],";
  }
  std::string text = changed("  \"terms\": [", "  \"terms\": [" + terms);
  text.replace(text.find("    [0.125]"), 11, empty + "[0.125]");
  EXPECT_EQ(complaint(text),
            "m.json: expected an array of 1 number (a row of a lower triangle) at factor_um[0], found an array of 0.");
}

// A prediction takes the first gain alone, a compensation the whole model: they must be one.
TEST(effect_regression_json, a_second_gain_is_refused) {
  Effect both = *find_effect("lagged_expansion", Level::series);
  both.parameters[1].kind = ParameterKind::gain;
  Catalogue catalogue{std::make_shared<const Effect>(both)};
  catalogue.insert(catalogue.end(), built_in_catalogue().begin(), built_in_catalogue().end());
  try {
    read_effect_regression(kModel, "m.json", catalogue);
    ADD_FAILURE() << "read";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "m.json: expected 0 for time_constant_s, its second gain at terms[1].parameters[1], found the number "
                 "600.");
  }
}

}  // namespace
}  // namespace ballbar
