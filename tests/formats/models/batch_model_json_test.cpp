#include "ballbar/formats/models/batch_model_json.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kModel = R"({
  "format": "ballbar-batch-model 1",
  "target": "x_um",
  "room": "T_room_degC",
  "speed": "speed_rpm",
  "sensors": ["T_front_degC", "T_rear_K"],
  "inputs": "temperature",
  "method": "pcr",
  "components": 1,
  "penalty_K2": 0.25,
  "intercept_um": -12.5,
  "slope_um_per_K": [1.5, -0.1],
  "trained_range": {
    "mean_degC": [25.0, 26.0],
    "loadings": [[0.6, 0.8]],
    "variance_K2": [4.0],
    "score_low_K": [-3.0],
    "score_high_K": [5.0],
    "low_degC": [20.0, 21.0],
    "high_degC": [30.0, 31.0],
    "largest_T2": 9.0,
    "largest_Q_K2": 0.1
  },
  "rmse_um": 1.0,
  "held_out_rmse_um": 1.5,
  "half_width_um": 3.0,
  "batches": [
    {"name": "20200615", "rows": 515, "weight": 1.0, "rmse_um": 0.9, "held_out_um": 1.4},
    {"name": "20200617", "rows": 607, "weight": 0.5, "rmse_um": 1.1, "held_out_um": null}
  ]
}
)";

TEST(batch_model, every_key) {
  const TemperatureRegression model = read_batch_model(kModel, "m.json");
  EXPECT_EQ(model.columns.target, "x_um");
  EXPECT_EQ(model.columns.room, "T_room_degC");
  EXPECT_EQ(model.columns.speed, "speed_rpm");
  EXPECT_EQ(model.columns.sensors, (std::vector<std::string>{"T_front_degC", "T_rear_K"}));
  EXPECT_EQ(model.columns.kind, InputKind::temperature);
  EXPECT_EQ(model.settings.method, RegressionMethod::pcr);
  EXPECT_EQ(model.settings.components, 1u);
  EXPECT_EQ(model.settings.penalty_K2, 0.25);
  EXPECT_EQ(model.regression.intercept_um, -12.5);
  EXPECT_EQ(model.regression.slope_um_per_K, Eigen::Vector2d(1.5, -0.1));
  EXPECT_EQ(model.range.mean_degC, Eigen::Vector2d(25.0, 26.0));
  EXPECT_EQ(model.range.loadings.cols(), 1);
  EXPECT_EQ(model.range.loadings, Eigen::Vector2d(0.6, 0.8));
  EXPECT_EQ(model.range.variance_K2[0], 4.0);
  EXPECT_EQ(model.range.score_low_K[0], -3.0);
  EXPECT_EQ(model.range.score_high_K[0], 5.0);
  EXPECT_EQ(model.range.low_degC, Eigen::Vector2d(20.0, 21.0));
  EXPECT_EQ(model.range.high_degC, Eigen::Vector2d(30.0, 31.0));
  EXPECT_EQ(model.range.largest_T2, 9.0);
  EXPECT_EQ(model.range.largest_Q_K2, 0.1);
  EXPECT_EQ(model.rmse_um, 1.0);
  EXPECT_EQ(model.held_out_rmse_um, 1.5);
  EXPECT_EQ(model.half_width_um, 3.0);
  ASSERT_EQ(model.batches.size(), 2u);
  EXPECT_EQ(model.batches[0].name, "20200615");
  EXPECT_EQ(model.batches[0].rows, 515u);
  EXPECT_EQ(model.batches[1].weight, 0.5);
  EXPECT_EQ(model.batches[1].rmse_um, 1.1);
  EXPECT_EQ(model.batches[0].held_out_um, 1.4);
  EXPECT_TRUE(std::isnan(model.batches[1].held_out_um));
}

TEST(batch_model, written_as_it_was_read) { EXPECT_EQ(write_batch_model(read_batch_model(kModel, "m.json")), kModel); }

// The bits; infinities and NaN are not to be written.
double any_finite() {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return std::isfinite(value) ? value : -0.0;
}

Eigen::MatrixXd any_matrix(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd result(rows, columns);
  for (double& value : result.reshaped()) value = any_finite();
  return result;
}

bool same_bits(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
  return left.rows() == right.rows() && left.cols() == right.cols() &&
         (left.size() == 0 ||
          std::memcmp(left.data(), right.data(), sizeof(double) * static_cast<std::size_t>(left.size())) == 0);
}

bool same_bits(double left, double right) { return std::memcmp(&left, &right, sizeof left) == 0; }

TemperatureRegression any_model() {
  TemperatureRegression model;
  model.columns.target = *rc::gen::element<std::string>("x_um", "a \"b\"\\_um", "\xE6\xB8\xA9_um");
  model.columns.room = "T_room_degC";
  if (*rc::gen::arbitrary<bool>()) model.columns.speed = "speed_rpm";
  const auto sensors = *rc::gen::inRange<Eigen::Index>(1, 6);
  for (Eigen::Index i = 0; i < sensors; ++i) model.columns.sensors.push_back(fmt::format("T{}_degC", i));
  model.columns.kind = *rc::gen::element(InputKind::temperature, InputKind::rise, InputKind::both);
  const Eigen::Index m = model.columns.kind == InputKind::both ? 2 * sensors : sensors;
  const auto p = *rc::gen::inRange<Eigen::Index>(0, m + 1);
  model.settings.method = *rc::gen::element(RegressionMethod::pcr, RegressionMethod::ridge);
  model.settings.components = *rc::gen::inRange<std::size_t>(1, static_cast<std::size_t>(m) + 1);
  model.settings.penalty_K2 = std::abs(any_finite());
  model.regression = {any_matrix(m, 1), any_finite()};
  TrainedRange& range = model.range;
  range.mean_degC = any_matrix(m, 1);
  range.loadings = any_matrix(m, p);
  range.variance_K2 = any_matrix(p, 1).cwiseAbs();
  range.score_low_K = any_matrix(p, 1);
  range.score_high_K = range.score_low_K.cwiseAbs();
  range.low_degC = any_matrix(m, 1);
  range.high_degC = range.low_degC.cwiseAbs();
  range.largest_T2 = std::abs(any_finite());
  range.largest_Q_K2 = std::abs(any_finite());
  model.rmse_um = std::abs(any_finite());
  model.held_out_rmse_um = std::abs(any_finite());
  model.half_width_um = std::abs(any_finite());
  for (int i = *rc::gen::inRange(1, 4); i > 0; --i) {
    const double held_out_um = *rc::gen::arbitrary<bool>() ? kNaN : std::abs(any_finite());
    model.batches.push_back(
        {fmt::format("{}", i), static_cast<std::size_t>(i), 0.1 * i, std::abs(any_finite()), held_out_um});
  }
  return model;
}

TEST(batch_model, written_and_read_again_is_the_same_to_the_bit) {
  const bool passed = rc::check([] {
    const TemperatureRegression model = any_model();
    const TemperatureRegression again = read_batch_model(write_batch_model(model), "m.json");
    RC_ASSERT(again.columns == model.columns);
    RC_ASSERT(again.settings == model.settings);
    RC_ASSERT(same_bits(again.settings.penalty_K2, model.settings.penalty_K2));
    RC_ASSERT(same_bits(again.regression.slope_um_per_K, model.regression.slope_um_per_K));
    RC_ASSERT(same_bits(again.regression.intercept_um, model.regression.intercept_um));
    RC_ASSERT(same_bits(again.range.mean_degC, model.range.mean_degC));
    RC_ASSERT(same_bits(again.range.loadings, model.range.loadings));
    RC_ASSERT(same_bits(again.range.variance_K2, model.range.variance_K2));
    RC_ASSERT(same_bits(again.range.score_low_K, model.range.score_low_K));
    RC_ASSERT(same_bits(again.range.score_high_K, model.range.score_high_K));
    RC_ASSERT(same_bits(again.range.low_degC, model.range.low_degC));
    RC_ASSERT(same_bits(again.range.high_degC, model.range.high_degC));
    RC_ASSERT(same_bits(again.range.largest_T2, model.range.largest_T2));
    RC_ASSERT(same_bits(again.range.largest_Q_K2, model.range.largest_Q_K2));
    RC_ASSERT(same_bits(again.rmse_um, model.rmse_um));
    RC_ASSERT(same_bits(again.held_out_rmse_um, model.held_out_rmse_um));
    RC_ASSERT(same_bits(again.half_width_um, model.half_width_um));
    RC_ASSERT(again.batches.size() == model.batches.size());
    for (std::size_t i = 0; i < model.batches.size(); ++i) {
      RC_ASSERT(again.batches[i].name == model.batches[i].name);
      RC_ASSERT(again.batches[i].rows == model.batches[i].rows);
      RC_ASSERT(same_bits(again.batches[i].weight, model.batches[i].weight));
      RC_ASSERT(same_bits(again.batches[i].rmse_um, model.batches[i].rmse_um));
      RC_ASSERT(std::isnan(again.batches[i].held_out_um) == std::isnan(model.batches[i].held_out_um));
      RC_ASSERT(std::isnan(model.batches[i].held_out_um) ||
                same_bits(again.batches[i].held_out_um, model.batches[i].held_out_um));
    }
  });
  EXPECT_TRUE(passed);
}

std::string complaint(const std::string& text) {
  try {
    read_batch_model(text, "m.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string changed(const std::string& from, const std::string& to) {
  if (from == "*") return to;
  std::string text = kModel;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good text lacks what a row changes: " + from);
  return text.replace(at, from.size(), to);
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

TEST(batch_model, integers_order_and_mark_do_not_matter) {
  EXPECT_EQ(complaint("\xEF\xBB\xBF" + changed("25.0, 26.0", "25, -26")), "accepted");
  std::string text = changed("\"format\": \"ballbar-batch-model 1\",\n", "");
  text.replace(text.rfind("\n}"), 2, ",\r\n \"format\": \"ballbar-batch-model 1\"}");
  EXPECT_EQ(complaint(text), "accepted");
  EXPECT_EQ(complaint(changed("\"speed_rpm\"", "null")), "accepted");
  EXPECT_EQ(complaint(changed("\"T_room_degC\"", "null")), "accepted");  // of batches that are not ranked
  EXPECT_EQ(complaint(changed("\"room\": \"T_room_degC\"", "\"room\": \"hall\"")), "accepted");
}

TEST(batch_model, what_is_not_finite_is_not_written) {
  TemperatureRegression model = read_batch_model(kModel, "m.json");
  model.range.low_degC[1] = -std::numeric_limits<double>::infinity();
  try {
    write_batch_model(model);
    ADD_FAILURE() << "written";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "A model file holds finite numbers only: expected one, found -inf.");
  }
}

TEST(batch_model, a_name_that_is_not_utf8_is_written_and_read) {
  TemperatureRegression model = read_batch_model(kModel, "m.json");
  model.batches[0].name = "caf\xE9";
  EXPECT_EQ(read_batch_model(write_batch_model(model), "m.json").batches[0].name, "caf\xEF\xBF\xBD");
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

TEST(batch_model, bad_text_that_is_no_json) {
  using namespace std::string_literals;
  expect_messages({
      {"*", "", "1:1: expected text, found an empty file."},
      {"*", "{\"a\0\"}"s, "1:4: expected text, found a NUL byte; this is a binary file."},
      {"*", "\xFF\xFE{\0"s, "1:1: expected UTF-8, found UTF-16. Save the file as UTF-8."},
      {"x_um", "\xE9_um", "3:14: expected UTF-8, found the byte \"\\xE9\". Save the file as UTF-8."},
      {"*", " \n", "2:1: expected JSON, found the end of the file."},
      {"*", "{\"format\": \"ball", "1:17: expected JSON, found the end of the file."},
      {"*", "{\"format\": tru", "1:15: expected JSON, found the end of the file."},
      {"*", "[[1, 2], ", "1:10: expected JSON, found the end of the file."},
      {"*", "time_s,x_um\n0,1\n", "1:1: expected JSON, found \"time_s\"."},
      {"\"pcr\",", "\"pcr\"", "9:3: expected JSON, found \"\"components\": 1\"."},
      {"\"pcr\"", "'pcr'", "8:13: expected JSON, found \"'pcr'\"."},
      {"-12.5", "NaN", "11:19: expected JSON, found \"NaN\"."},
      {"-12.5", "-Infinity", "11:19: expected JSON, found \"-Infinity\"."},
      {"-12.5", "-12,5", "11:23: expected JSON, found \"5\"."},
      {"-12.5", "1e999", "11:19: expected a number that a double can hold, found \"1e999\"."},
      {"pcr", "p\ncr", "8:15: expected JSON, found the end of the line."},
      {"pcr", "\\ud800", "8:20: expected JSON, found \"\"\"."},
      {"  ]\n}\n", "  ]\n}\n}", "32:1: expected JSON, found \"}\"."},
      {"  ]\n}\n", "  ],\n}\n", "31:1: expected JSON, found \"}\"."},
      {"*", "[1 unexpected string literal\"", "1:4: expected JSON, found \"unexpected string literal\"\"."},
      {"*", "unexpected string literal\"", "1:1: expected JSON, found \"unexpected string literal\"\"."},
      {"*", "\xC3\xA9", "1:1: expected JSON, found \"\xC3\xA9\"."},
      {"\"pcr\"", "\"pcr\" \"a\\\\\\\"b\"", "8:19: expected JSON, found \"\"a\\\\\\\"b\"\"."},
  });
}

TEST(batch_model, bad_text_that_would_cost_memory_or_stack) {
  expect_messages({
      {"*", repeated("[", 21),
       " expected at most 20 levels of arrays and objects, found more at " + repeated("[0]", 20) + "."},
      {"*", repeated("[", 1 << 20),
       " expected at most 20 levels of arrays and objects, found more at " + repeated("[0]", 20) + "."},
      {"x_um\"", "x_um\", \"a\": " + repeated("{\"b\":", 1 << 20),
       " expected at most 20 levels of arrays and objects, found more at a" + repeated(".b", 19) + "."},
      {"*", "[[" + repeated("0,", 4'000'000), " expected at most 4000000 values, found more at [0][3999998]."},
      {"*", "{\"format\": \"" + std::string(1 << 20, 'a') + "\"}",
       " expected \"ballbar-batch-model 1\" at format, found the text \"" + std::string(40, 'a') + "...\"."},
      {"\"room\"", "\"" + std::string(1 << 20, 'a') + "\"",
       " expected one of the keys format, target, room, speed, sensors, inputs, method, components, penalty_K2, "
       "intercept_um, slope_um_per_K, trained_range, rmse_um, held_out_rmse_um, half_width_um, batches, found \"" +
           std::string(40, 'a') + "...\"; the nearest is trained_range."},
  });
}

// No room is made for 20 000 by 20 000 loadings that the file does not hold.
TEST(batch_model, empty_loadings_of_many_sensors) {
  std::string sensors, zeros, empty;
  for (int i = 0; i < 20000; ++i) {
    sensors += fmt::format(",\"T{}_degC\"", i);
    zeros += ",0";
    empty += ",[]";
  }
  std::string text = changed("[\"T_front_degC\", \"T_rear_K\"]", "[" + sensors.substr(1) + "]");
  for (const std::string old : {"[1.5, -0.1]", "[25.0, 26.0]", "[20.0, 21.0]", "[30.0, 31.0]"}) {
    text.replace(text.find(old), old.size(), "[" + zeros.substr(1) + "]");
  }
  text.replace(text.find("[[0.6, 0.8]]"), 12, "[" + empty.substr(1) + "]");
  EXPECT_EQ(
      complaint(text),
      "m.json: expected an array of 20000 numbers (one for each input) at trained_range.loadings[0], found an array of "
      "0.");
}

TEST(batch_model, bad_keys) {
  const std::string keys =
      "format, target, room, speed, sensors, inputs, method, components, penalty_K2, intercept_um, slope_um_per_K, "
      "trained_range, rmse_um, held_out_rmse_um, half_width_um, batches";
  expect_messages({
      {"*", "[]", " expected an object, found an array."},
      {"*", "1.5", " expected an object, found the number 1.5."},
      {"*", "{}", " expected the key format, found none."},
      {"model 1", "model 2",
       " expected \"ballbar-batch-model 1\" at format, found the text \"ballbar-batch-model 2\"."},
      {"\"ballbar-batch-model 1\"", "1", " expected \"ballbar-batch-model 1\" at format, found the integer 1."},
      {"penalty_K2", "penalty",
       " expected one of the keys " + keys + ", found \"penalty\"; the nearest is penalty_K2."},
      {"  \"rmse_um\": 1.0,\n", "", " expected the key rmse_um, found none."},
      {"\"low_degC\"", "\"low\"",
       " expected one of the keys mean_degC, loadings, variance_K2, score_low_K, score_high_K, low_degC, high_degC, "
       "largest_T2, largest_Q_K2 in trained_range, found \"low\"; the nearest is low_degC."},
      {"    \"largest_T2\": 9.0,\n", "", " expected the key largest_T2 in trained_range, found none."},
      {"\"rows\": 607", "\"row\": 607",
       " expected one of the keys name, rows, weight, rmse_um, held_out_um in batches[1], found \"row\"; the nearest "
       "is "
       "rows."},
      {"\"rows\": 607, ", "", " expected the key rows in batches[1], found none."},
      {"\"room\"", "\"target\"", " expected each key once, found \"target\" again."},
      {"\"score_low_K\"", "\"loadings\"", " expected each key once in trained_range, found \"loadings\" again."},
      {"\"rows\": 607", "\"na\\u006De\": 607", " expected each key once in batches[1], found \"name\" again."},
      {"\"x_um\"", "{\"a b\": [0, {\"c\": 1, \"c\": 2}]}",
       " expected each key once in target[\"a b\"][1], found \"c\" again."},
  });
}

TEST(batch_model, bad_names_and_choices) {
  expect_messages({
      {"\"x_um\"", "7", " expected a printable text at target, found the integer 7."},
      {"\"x_um\"", "\"x_mm\"", " expected a name that ends in _um at target, found the text \"x_mm\"."},
      {"\"T_room_degC\"", "\"\"", " expected a printable text at room, found the text \"\"."},
      {"\"speed_rpm\"", "\"\\u001b[2J\"", " expected a printable text at speed, found the text \"\\x1B[2J\"."},
      {"\"speed_rpm\"", "false", " expected a printable text or null at speed, found false."},
      {"[\"T_front_degC\", \"T_rear_K\"]", "\"T_front_degC\"",
       " expected an array at sensors, found the text \"T_front_degC\"."},
      {"[\"T_front_degC\", \"T_rear_K\"]", "[]", " expected at least one sensor at sensors, found none."},
      {"T_rear_K", "T_front_degC", " expected each sensor once at sensors[1], found the text \"T_front_degC\"."},
      {"T_rear_K", "load_A", " expected a name that ends in _degC or _K at sensors[1], found the text \"load_A\"."},
      {"\"T_rear_K\"", "{}", " expected a printable text at sensors[1], found an object."},
      {"\"temperature\"", "\"rises\"",
       " expected one of \"temperature\", \"rise\", \"both\" at inputs, found the text \"rises\"."},
      {"\"pcr\"", "\"lasso\"", " expected one of \"pcr\", \"ridge\" at method, found the text \"lasso\"."},
      {"\"pcr\"", "true", " expected one of \"pcr\", \"ridge\" at method, found true."},
      {"\"pcr\"", "\"pls\"",
       " expected \"pcr\" or \"ridge\" at method, found \"pls\" of an older version. Train the model again."},
      {"\"20200617\"", "[\"20200617\"]", " expected a printable text at batches[1].name, found an array."},
  });
}

TEST(batch_model, bad_numbers) {
  expect_messages({
      {"\"components\": 1", "\"components\": 0",
       " expected a whole number from 1 to 2 at components, found the integer 0."},
      {"\"components\": 1", "\"components\": 3",
       " expected a whole number from 1 to 2 at components, found the integer 3."},
      {"\"components\": 1", "\"components\": -1",
       " expected a whole number from 1 to 2 at components, found the integer -1."},
      {"\"components\": 1", "\"components\": 1.5",
       " expected a whole number from 1 to 2 at components, found the number 1.5."},
      {"\"pcr\",\n  \"components\": 1", "\"ridge\",\n  \"components\": 3",
       " expected a whole number from 0 to 2 at components, found the integer 3."},
      {"0.25", "-0.25", " expected a number not below 0 at penalty_K2, found the number -0.25."},
      {"-12.5", "\"-12.5\"", " expected a number at intercept_um, found the text \"-12.5\"."},
      {"-12.5", "null", " expected a number at intercept_um, found null."},
      {"\"rmse_um\": 1.0", "\"rmse_um\": -1", " expected a number not below 0 at rmse_um, found the integer -1."},
      {"\"held_out_rmse_um\": 1.5", "\"held_out_rmse_um\": null",
       " expected a number not below 0 at held_out_rmse_um, found null."},
      {"\"half_width_um\": 3.0", "\"half_width_um\": []",
       " expected a number not below 0 at half_width_um, found an array."},
      {"\"largest_T2\": 9.0", "\"largest_T2\": -9.0",
       " expected a number not below 0 at trained_range.largest_T2, found the number -9."},
      {"\"largest_Q_K2\": 0.1", "\"largest_Q_K2\": \"0.1\"",
       " expected a number not below 0 at trained_range.largest_Q_K2, found the text \"0.1\"."},
      {"[4.0]", "[-4.0]", " expected a number not below 0 at trained_range.variance_K2[0], found the number -4."},
      {"[-3.0]", "[5.5]",
       " expected a number not above 5 of score_high_K at trained_range.score_low_K[0], found the number 5.5."},
      {"[20.0, 21.0]", "[20.0, 31.5]",
       " expected a number not above 31 of high_degC at trained_range.low_degC[1], found the number 31.5."},
      {"\"rows\": 607", "\"rows\": 0",
       " expected a whole number from 1 to 1000000000 at batches[1].rows, found the integer 0."},
      {"\"rows\": 607", "\"rows\": 99999999999999999999",
       " expected a whole number from 1 to 1000000000 at batches[1].rows, found the number 1e+20."},
      {"\"weight\": 0.5", "\"weight\": -0.5",
       " expected a number not below 0 at batches[1].weight, found the number -0.5."},
      {"\"held_out_um\": 1.4", "\"held_out_um\": -1.4",
       " expected a number not below 0 at batches[0].held_out_um, found the number -1.4."},
  });
}

TEST(batch_model, bad_shapes) {
  expect_messages({
      {"[1.5, -0.1]", "1.5",
       " expected an array of 2 numbers (one for each input) at slope_um_per_K, found the number 1.5."},
      {"[1.5, -0.1]", "[1.5]",
       " expected an array of 2 numbers (one for each input) at slope_um_per_K, found an array of 1."},
      {"[1.5, -0.1]", "[1.5, null]", " expected a number at slope_um_per_K[1], found null."},
      {"\"temperature\"", "\"both\"",
       " expected an array of 4 numbers (one for each input) at slope_um_per_K, found an array of 2."},
      {"[25.0, 26.0]", "[25.0, 26.0, 27.0]",
       " expected an array of 2 numbers (one for each input) at trained_range.mean_degC, found an array of 3."},
      {"[[0.6, 0.8]]", "0.6", " expected an array at trained_range.loadings, found the number 0.6."},
      {"[[0.6, 0.8]]", "[0.6, 0.8]",
       " expected an array of 2 numbers (one for each input) at trained_range.loadings[0], found the number 0.6."},
      {"[[0.6, 0.8]]", "[[0.6, 0.8], [0.8]]",
       " expected an array of 2 numbers (one for each input) at trained_range.loadings[1], found an array of 1."},
      {"[[0.6, 0.8]]", "[[0.6, {}]]", " expected a number at trained_range.loadings[0][1], found an object."},
      {"[[0.6, 0.8]]", "[[1, 0], [0, 1], [1, 1]]",
       " expected at most 2 arrays (one for each input) at trained_range.loadings, found 3."},
      {"[[0.6, 0.8]]", "[]",
       " expected an array of 0 numbers (one for each of the loadings) at trained_range.variance_K2, found an array of "
       "1."},
      {"[5.0]", "[5.0, 6.0]",
       " expected an array of 1 number (one for each of the loadings) at trained_range.score_high_K, found an array of "
       "2."},
      {"\"batches\": [", "\"batches\": 1, \"b\": [",
       " expected one of the keys format, target, room, speed, sensors, inputs, method, components, penalty_K2, "
       "intercept_um, slope_um_per_K, trained_range, rmse_um, held_out_rmse_um, half_width_um, batches, found \"b\"; "
       "the nearest is room."},
      {"\"trained_range\": {", "\"trained_range\": [], \"b\": {",
       " expected one of the keys format, target, room, speed, sensors, inputs, method, components, penalty_K2, "
       "intercept_um, slope_um_per_K, trained_range, rmse_um, held_out_rmse_um, half_width_um, batches, found \"b\"; "
       "the nearest is room."},
      {"\"batches\": [", "\"batches\": [3, ", " expected an object at batches[0], found the integer 3."},
  });
  std::string no_batch = kModel;
  no_batch.replace(no_batch.find("\"batches\""), std::string::npos, "\"batches\": []}");
  EXPECT_EQ(complaint(no_batch), "m.json: expected at least one batch of weight above 0 at batches, found none.");
  no_batch.replace(no_batch.find("[]}"), 3,
                   "[{\"name\": \"a\", \"rows\": 3, \"weight\": 0, \"rmse_um\": 1, \"held_out_um\": null}]}");
  EXPECT_EQ(complaint(no_batch), "m.json: expected at least one batch of weight above 0 at batches, found none.");
}

}  // namespace
}  // namespace ballbar
