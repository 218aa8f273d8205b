// Table 3 of Tan, Xu, Li, Li, Du 2024 (doi 10.19650/j.cnki.cjsi.J2412798): the error of three tests of a lathe,
// predicted by a regression on batches that are chosen by the temperature of the room.
//
// The method: batches k are ranked by |T0 - Tk|, the room at the start of the test against its mean in the batch. M_i
// is a regression by principal components on the first i batches. The first i whose modelling error is "clearly below"
// the earlier ones is taken, and compared with all batches and with 100 random choices of as many.
//
// From the paper: kTable3, and the reductions and counts beside it. It prints no readings, and its modelling errors as
// a picture alone (fig. 6), so that the rule cannot be run on its numbers. It leaves open what "clearly" is and how
// much variance the components explain ("high enough").
//
// Simulated: the readings of sample-runs/batches-tan2024, with the plan of the tests from the paper. What the method
// makes of them is no evidence for it, because they were chosen for it: of 20 draws of the plans of the batches only
// this one has a fall of 10 % in all three tests. In the 60 tests of the draws the rule found 18 falls, 17 of which
// lowered the error of y by at least 30 %; in the other 42 it takes all batches and gains nothing. On 29 measured runs
// of a lathe in a climate chamber, each in turn the test, it found 4 falls for z and 1 for x; the errors are 4 % larger
// than by all batches for z, and equal for x (geometric means).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/predict/train.hpp"

namespace ballbar {
namespace {

// What the paper leaves open.
constexpr double kFall = 0.1;
constexpr double kShare = 0.99;  // of the variance that the components explain

std::vector<std::size_t> ranking(const std::vector<Batch>& batches, const BatchStart& job) {
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto apart_K = [&](std::size_t k) { return std::abs(job.room_first_degC - batches[k].start.room_mean_degC); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return apart_K(a) < apart_K(b); });
  return order;
}

Regression by_components(const Moments& moments) {
  return regress(moments, {RegressionMethod::pcr, components_for(moments, kShare), 0.0});
}

struct ModelErrors {
  std::vector<double> modelling_um, predicted_um;  // RMSE_m and RMSE_p of M_1, M_2 ...
};

ModelErrors errors_of(const std::vector<Batch>& batches, const std::vector<std::size_t>& order, const Moments& job) {
  ModelErrors errors;
  Moments moments;
  for (const std::size_t k : order) {
    moments = merged(moments, batches[k].moments);
    const Regression model = by_components(moments);
    errors.modelling_um.push_back(rmse_um(moments, model));
    errors.predicted_um.push_back(rmse_um(job, model));
  }
  return errors;
}

// The first number with a modelling error below (1 - fall) times the least of the earlier ones; all if there is none.
std::size_t chosen_number(const std::vector<double>& modelling_um, double fall) {
  double least_um = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < modelling_um.size(); ++i) {
    if (i > 0 && modelling_um[i] < (1.0 - fall) * least_um) return i + 1;
    least_um = std::min(least_um, modelling_um[i]);
  }
  return modelling_um.size();
}

std::vector<double> random_um(const std::vector<Batch>& batches, const Moments& job, std::size_t number,
                              std::size_t choices) {
  std::mt19937_64 random(1);
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> um;
  for (std::size_t r = 0; r < choices; ++r) {
    Moments moments;
    for (std::size_t i = 0; i < number; ++i) {
      std::swap(order[i], order[i + random() % (order.size() - i)]);
      moments = merged(moments, batches[order[i]].moments);
    }
    um.push_back(rmse_um(job, by_components(moments)));
  }
  return um;
}

std::size_t count_above(const auto& um, double limit_um) {
  return static_cast<std::size_t>(std::count_if(um.begin(), um.end(), [&](double one) { return one > limit_um; }));
}

double percent_less(double um, double than_um) { return 100.0 * (1.0 - um / than_um); }

// Of one test. The paper prints 6 of its 100 random choices.
struct Printed {
  std::array<double, 6> random_um;  // choices 1, 2, 3, 98, 99, 100
  double random_mean_um, all_um, chosen_um;
  double percent_less;        // abstract: of chosen_um than all_um
  std::size_t random_higher;  // section 2.2: of the 100
};

constexpr std::array<Printed, 3> kTable3 = {{{{3.0, 2.0, 3.5, 1.0, 2.5, 1.0}, 2.4, 2.4, 1.7, 29.2, 68},
                                             {{1.1, 1.2, 0.9, 4.3, 4.3, 2.0}, 2.9, 2.8, 1.7, 39.3, 80},
                                             {{3.3, 0.9, 3.5, 1.3, 2.1, 3.3}, 2.6, 2.5, 0.9, 64.0, 95}}};

TEST(Tan2024Table3, ReductionsFollowFromTheLastTwoRows) {
  for (const Printed& test : kTable3) {
    EXPECT_NEAR(percent_less(test.chosen_um, test.all_um), test.percent_less, 0.05);
  }
}

// To their one digit, random choices are on the average no better than all batches; 4, 3 and 5 of the printed 6 are
// above the choice, where 68, 80 and 95 of all 100 are said to be. By the six alone the choice of test 2 is an average
// one.
TEST(Tan2024Table3, RandomChoicesAreOnTheAverageAsAllBatches) {
  constexpr std::array<std::size_t, 3> kAbove{4, 3, 5};
  for (std::size_t i = 0; i < kTable3.size(); ++i) {
    const Printed& test = kTable3[i];
    EXPECT_NEAR(test.random_mean_um, test.all_um, 0.1 + 1e-9);
    EXPECT_GE(test.random_mean_um, test.all_um);
    EXPECT_LT(test.chosen_um, test.all_um);
    EXPECT_EQ(count_above(test.random_um, test.chosen_um), kAbove[i]);
    EXPECT_GT(test.random_higher, 50U);
  }
}

TEST(Tan2024Rule, TakesTheFirstClearFall) {
  const std::vector<double> twice{2.83, 2.83, 2.45, 2.12, 1.90};  // 0.866 of the least before at the third
  EXPECT_EQ(chosen_number(twice, 0.1), 3U);
  EXPECT_EQ(chosen_number(twice, 0.2), 5U);                           // no such fall: all
  EXPECT_EQ(chosen_number({1.41, 3.16, 2.58, 2.24, 2.00}, 0.1), 5U);  // falls, but never below the first
  EXPECT_EQ(chosen_number({2.83, 2.83, 2.83, 2.45, 2.53}, 0.1), 4U);
  EXPECT_EQ(chosen_number({2.83, 2.00, 1.63, 1.41, 1.26}, 0.1), 2U);
}

// Moments of one input, the room, that is 0.5 K about its mean; the target is as far from 0.
Batch batch_in(double room_degC, double um = 0.0) {
  Batch batch;
  batch.start = {room_degC, room_degC, room_degC, 0.0, std::numeric_limits<double>::quiet_NaN()};
  batch.moments.weight = 4.0;
  batch.moments.mean = Eigen::Vector2d(room_degC, um);
  batch.moments.scatter = Eigen::Vector2d(1.0, 0.0).asDiagonal();
  return batch;
}

// 21, 19 and 21 degC are as far from 20 degC: in the order given.
TEST(Tan2024Rule, RanksByTheRoom) {
  const std::vector<Batch> batches{batch_in(21.0), batch_in(19.0), batch_in(23.0), batch_in(21.0), batch_in(20.0)};
  EXPECT_EQ(ranking(batches, batch_in(20.0).start), (std::vector<std::size_t>{4, 0, 1, 3, 2}));
}

// One batch of 8 each: all errors come up. An eighth of 800 choices, 100, has a standard deviation of 9.4; five are
// allowed.
TEST(Tan2024Rule, RandomChoicesAreAllAlikeLikely) {
  std::vector<Batch> batches;
  for (std::size_t k = 0; k < 8; ++k) batches.push_back(batch_in(20.0, static_cast<double>(k)));
  const std::vector<double> um = random_um(batches, batch_in(20.0).moments, 1, 800);
  for (std::size_t k = 0; k < 8; ++k) {
    const auto count =
        std::count_if(um.begin(), um.end(), [&](double one) { return std::abs(one - static_cast<double>(k)) < 1e-9; });
    EXPECT_NEAR(static_cast<double>(count), 100.0, 5.0 * 9.4) << k;
  }
}

Series read(const std::filesystem::path& file) {
  return read_series(read_bytes(file, kLargestTable), file.filename().string());
}

// The rows of table 3 of the simulated readings of y.
struct Simulated {
  std::vector<std::string> chosen;
  double random_mean_um = 0.0, all_um = 0.0, chosen_um = 0.0;
  std::size_t random_higher = 0;  // of 100
};

Simulated simulated(const std::string& test) {
  const std::filesystem::path folder = std::filesystem::path(BALLBAR_SAMPLE_RUNS) / "batches-tan2024";
  const Series series = read(folder / (test + ".csv"));
  const BatchColumns columns = batch_columns(series, InputKind::temperature, "y_um", {});
  const Batch job = batch_of(test, series, columns);
  std::vector<Batch> batches;
  for (const ListedRun& run : open_runs(folder / "runs.csv").runs) {
    batches.push_back(batch_of(run.name, read(run.file), columns));
  }
  const std::vector<std::size_t> order = ranking(batches, job.start);
  const ModelErrors errors = errors_of(batches, order, job.moments);
  const std::size_t number = chosen_number(errors.modelling_um, kFall);
  const std::vector<double> random = random_um(batches, job.moments, number, 100);
  Simulated result;
  for (std::size_t i = 0; i < number; ++i) result.chosen.push_back(batches[order[i]].name);
  result.random_mean_um = std::accumulate(random.begin(), random.end(), 0.0) / static_cast<double>(random.size());
  result.all_um = errors.predicted_um.back();
  result.chosen_um = errors.predicted_um[number - 1];
  result.random_higher = count_above(random, result.chosen_um);
  return result;
}

TEST(Tan2024Simulated, TheChoicePredictsBetterThanAllBatches) {
  struct Expected {
    const char* test;
    Simulated rows;
  };
  const std::vector<Expected> expected{{"test1", {{"b09", "b10"}, 8.05, 3.63, 0.86, 91}},
                                       {"test2", {{"b08", "b17", "b18"}, 4.55, 3.50, 0.38, 100}},
                                       {"test3", {{"b18", "b07", "b19", "b06", "b17"}, 3.60, 3.14, 0.88, 99}}};
  for (const auto& [test, rows] : expected) {
    const Simulated found = simulated(test);
    EXPECT_EQ(found.chosen, rows.chosen) << test;
    EXPECT_NEAR(found.random_mean_um, rows.random_mean_um, 0.005) << test;
    EXPECT_NEAR(found.all_um, rows.all_um, 0.005) << test;
    EXPECT_NEAR(found.chosen_um, rows.chosen_um, 0.005) << test;
    EXPECT_EQ(found.random_higher, rows.random_higher) << test;
  }
}

}  // namespace
}  // namespace ballbar
