// Which batches to train on.
#include "ballbar/predict/batch_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "ballbar/error.hpp"
#include "made_batches.hpp"

namespace ballbar {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// One sensor, the room's: T - 1, T, T + 1. The target is 2 um/K of it and c (1, -2, 1), which neither a constant nor
// the temperature draws.
Batch three_rows(double room_degC, double c_um) {
  const Series series{{0.0, 10.0, 20.0},
                      {{"T_room_degC", Role::structure, {room_degC - 1.0, room_degC, room_degC + 1.0}},
                       {"z_um",
                        Role::measured,
                        {2.0 * room_degC - 2.0 + c_um, 2.0 * room_degC - 2.0 * c_um, 2.0 * room_degC + 2.0 + c_um}}},
                      std::nullopt};
  return batch_of("", series, batch_columns(series, InputKind::temperature, "z_um", {}));
}

BatchStart room_at(double degC) { return {degC, degC, degC, 0.0, std::numeric_limits<double>::quiet_NaN()}; }

// Rooms of 21, 22, 23 ... degC, a job of 20 degC: ranked in the order of `c_um`.
BatchRanking ranked(const std::vector<double>& c_um, double fall) {
  std::vector<Batch> batches;
  for (const double c : c_um) batches.push_back(three_rows(21.0 + static_cast<double>(batches.size()), c));
  ChoiceOptions options;
  options.fall = fall;
  return batch_ranking(batches, room_at(20.0), nullptr, options);
}

// The mean square of (1, -2, 1) is 2: RMSE_m(i)^2 = 2 mean(c_1^2 .. c_i^2).
//   c = 2, 2, 1, 0, 0: squares 8, 8, 6, 4.5, 3.6; the roots 2.83, 2.83, 2.45 (0.866 of the least before: a fall of
//   0.1),
//                      2.12 (0.866), 1.90 (0.894). No fall of 0.2.
//   c = 1, 3, 0, 0, 0: squares 2, 10, 6.7, 5, 4: falls from the one before, never below the first. All are taken.
//   c = 2, 2, 2, 0, 2: squares 8, 8, 8, 6, 6.4: 0.866 at the fourth.
TEST(batch_choice, the_papers_rule_on_given_modelling_errors) {
  struct Case {
    std::vector<double> c_um, square_um2;
    double fall;
    std::size_t number;
    bool found;
  };
  const std::vector<Case> cases{{{2, 2, 1, 0, 0}, {8.0, 8.0, 6.0, 4.5, 3.6}, 0.1, 3, true},
                                {{2, 2, 1, 0, 0}, {8.0, 8.0, 6.0, 4.5, 3.6}, 0.2, 5, false},
                                {{1, 3, 0, 0, 0}, {2.0, 10.0, 20.0 / 3.0, 5.0, 4.0}, 0.1, 5, false},
                                {{2, 2, 2, 0, 2}, {8.0, 8.0, 8.0, 6.0, 6.4}, 0.1, 4, true},
                                {{2, 0, 0, 0, 0}, {8.0, 4.0, 8.0 / 3.0, 2.0, 1.6}, 0.1, 2, true}};
  for (const Case& one : cases) {
    const BatchRanking found = ranked(one.c_um, one.fall);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(found.ranked[i].batch, i);
      EXPECT_EQ(found.ranked[i].room_apart_K, 1.0 + static_cast<double>(i));
      EXPECT_NEAR(found.ranked[i].modelling_rmse_um, std::sqrt(one.square_um2[i]), 1e-12);  // rounding
      EXPECT_FALSE(found.ranked[i].predicted_rmse_um);
    }
    EXPECT_EQ(found.choice(Take::paper).batches, one.number);
    EXPECT_EQ(found.paper_found, one.found);
    for (const BatchChoice& choice : found.choices) EXPECT_FALSE(choice.predicted_rmse_um);
  }
}

// 21, 19 and 21 degC are as far from 20 degC: in the order they are given.
TEST(batch_choice, equal_rooms_are_ranked_in_the_order_given) {
  const std::vector<Batch> batches{three_rows(21.0, 1.0), three_rows(19.0, 2.0), three_rows(23.0, 0.0),
                                   three_rows(21.0, 3.0), three_rows(20.0, 1.0)};
  const BatchRanking found = batch_ranking(batches, room_at(20.0), nullptr);
  std::vector<std::size_t> order;
  for (const RankedBatch& ranked : found.ranked) order.push_back(ranked.batch);
  EXPECT_EQ(order, (std::vector<std::size_t>{4, 0, 1, 3, 2}));
  EXPECT_EQ(found.choice(Take::weights).weights[4], found.ranked[0].weight);
  EXPECT_EQ(found.choice(Take::weights).weights[2], found.ranked[4].weight);
}

// First rows of 19, 21 and 23 degC where the rooms' means are 20, 22, 24: standard deviation 2 K of the first feature
// and 2 K of the second, the others alike. A job that begins at 20 degC is 0.5, 0.5 and 1.5 of it away in each:
// d = sqrt(2) times that; w = exp(-(d^2 - least d^2) / (2 h^2)).
TEST(batch_choice, distances_and_weights_by_hand) {
  std::vector<Batch> batches{three_rows(20.0, 1.0), three_rows(22.0, 1.0), three_rows(24.0, 1.0)};
  const BatchRanking found = batch_ranking(batches, room_at(20.0), nullptr);
  const std::vector<double> apart_K{0.0, 2.0, 4.0}, away{0.5, 0.5, 1.5};
  ASSERT_EQ(found.ranked.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(found.ranked[k].batch, k);
    EXPECT_EQ(found.ranked[k].room_apart_K, apart_K[k]);
    EXPECT_NEAR(found.ranked[k].distance, std::sqrt(2.0) * away[k], 1e-12);
    const double d2 = 2.0 * (away[k] * away[k] - 0.25);
    const double h2 = found.bandwidth * found.bandwidth;
    EXPECT_NEAR(found.ranked[k].weight, std::isfinite(h2) ? std::exp(-d2 / (2.0 * h2)) : 1.0, 1e-12);
  }
}

TEST(batch_choice, messages) {
  const std::vector<Batch> batches{three_rows(21.0, 1.0), three_rows(19.0, 2.0)};
  for (std::size_t n = 0; n < 3; ++n) {
    try {
      (void)batch_ranking(std::span(batches.data(), n), room_at(20.0), nullptr);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), fmt::format("expected at least 3 batches to choose from, found {}.", n));
    }
  }
}

struct World {
  std::vector<Batch> batches;
  BatchStart job;
  Moments measured;
};

// 40 batches of rooms from 10 to 30 degC and a job; um/K of the fast rise as `gain` says of the room.
World world(const std::string& seed, double job_degC, const made::Batches& plan,
            const std::function<double(double)>& gain) {
  std::mt19937_64 random(made::seed_of(seed));
  std::uniform_real_distribution<double> uniform;
  std::vector<Series> all;
  for (std::size_t k = 0; k < 40; ++k) {
    const double room = 10.0 + 20.0 * uniform(random), heat = 15.0 + 20.0 * uniform(random);
    all.push_back(made::warm_up(plan, room, heat, gain(room), random));
  }
  const BatchColumns columns = made::columns_of(all);
  const Series job = made::warm_up(plan, job_degC, 25.0, gain(job_degC), random);
  const Batch of_job = batch_of("job", job, columns);
  return {made::batches_of(all, columns), of_job.start, of_job.moments};
}

// 0.4 um/K at 10 degC, 1.2 at 30 degC: one slope for all batches is wrong at either end by some 0.3 um/K times 25 K.
double changing(double room_degC) { return 0.04 * room_degC; }

TEST(batch_choice, where_the_slope_depends_on_the_room_near_batches_predict_better) {
  for (const double job_degC : {12.0, 28.0}) {
    const World made = world("near_batches", job_degC, {}, changing);
    const BatchRanking found = batch_ranking(made.batches, made.job, &made.measured);
    const double all_um = *found.choice(Take::all).predicted_rmse_um;
    EXPECT_LT(*found.choice(Take::weights).predicted_rmse_um, 0.7 * all_um) << job_degC;
    EXPECT_LT(*found.choice(Take::held_out).predicted_rmse_um, 0.7 * all_um) << job_degC;
    EXPECT_LT(found.choice(Take::held_out).batches, 40U) << job_degC;
    EXPECT_LT(found.bandwidth, kInfinite) << job_degC;
  }
}

// What is said of a selection follows from what it holds.
TEST(batch_choice, its_parts_agree) {
  const World made = world("parts_agree", 14.0, {}, changing);
  const BatchRanking found = batch_ranking(made.batches, made.job, &made.measured);
  ASSERT_EQ(found.ranked.size(), 40U);
  const RegressionSettings settings = best_settings(made.batches, RegressionMethod::pcr);
  std::vector<Batch> first;
  for (std::size_t i = 0; i < 40; ++i) {
    const RankedBatch& ranked = found.ranked[i];
    first.push_back(made.batches[ranked.batch]);
    const Moments moments = merged(first);
    const Regression one = regress(moments, settings);
    EXPECT_EQ(ranked.settings, settings);
    EXPECT_NEAR(ranked.modelling_rmse_um, rmse_um(moments, one), 1e-12);
    EXPECT_NEAR(*ranked.predicted_rmse_um, rmse_um(made.measured, one), 1e-12);
    EXPECT_EQ(ranked.room_apart_K,
              std::abs(made.job.room_first_degC - made.batches[ranked.batch].start.room_mean_degC));
    EXPECT_GE(ranked.room_apart_K, found.ranked[i > 0 ? i - 1 : 0].room_apart_K);
  }
  for (const Take take : {Take::paper, Take::held_out, Take::all}) {
    const BatchChoice& choice = found.choice(take);
    EXPECT_EQ(*choice.predicted_rmse_um, *found.ranked[choice.batches - 1].predicted_rmse_um);
    for (std::size_t i = 0; i < 40; ++i) {
      EXPECT_EQ(choice.weights[found.ranked[i].batch], i < choice.batches ? 1.0 : 0.0);
    }
  }
  EXPECT_EQ(found.choice(Take::all).batches, 40U);
  const BatchChoice& weighed = found.choice(Take::weights);
  const Regression weighted = regress(merged(made.batches, weighed.weights), weighed.settings);
  EXPECT_EQ(*weighed.predicted_rmse_um, rmse_um(made.measured, weighted));
  const auto least = std::min_element(found.held_out.begin(), found.held_out.end(),
                                      [](const auto& a, const auto& b) { return a.rmse_um < b.rmse_um; });
  EXPECT_EQ(found.choice(Take::held_out).batches, least->batches);
  EXPECT_EQ(found.held_out.front().batches, 2U);
  EXPECT_EQ(found.held_out.back().batches, 39U);  // all but the one left out
}

TEST(batch_choice, components_by_share) {
  const World made = world("by_share", 14.0, {}, changing);
  ChoiceOptions options;
  options.share = 0.99;
  const BatchRanking found = batch_ranking(made.batches, made.job, nullptr, options);
  std::vector<Batch> first;
  for (const RankedBatch& ranked : found.ranked) {
    first.push_back(made.batches[ranked.batch]);
    EXPECT_EQ(ranked.settings.components, components_for(merged(first), 0.99));
  }
}

// Rooms 1 K apart, the target by turns 1 um above and below the law: a batch left out is the opposite of those beside
// it, the less so the more batches count.
TEST(batch_choice, weights_of_an_infinite_bandwidth_are_all_batches) {
  std::vector<Batch> batches;
  for (std::size_t k = 0; k < 40; ++k) {
    batches.push_back(three_rows(20.0 + static_cast<double>(k), 1.0));
    batches.back().moments.mean[1] += k % 2 == 0 ? 1.0 : -1.0;
  }
  const BatchRanking found = batch_ranking(batches, room_at(40.0), nullptr);
  ASSERT_EQ(found.bandwidth, kInfinite);
  EXPECT_EQ(found.choice(Take::weights).weights, std::vector<double>(40, 1.0));
}

// 8 batches, each with an intercept of its own.
std::vector<Batch> with_intercepts() {
  std::vector<Batch> batches;
  for (std::size_t k = 0; k < 8; ++k) {
    batches.push_back(three_rows(21.0 + static_cast<double>(k), 1.0));
    batches.back().moments.mean[1] += static_cast<double>(k * 7 % 11);  // um
  }
  return batches;
}

BatchChoice first_batches(std::size_t number, double predicted_rmse_um) {
  std::vector<double> weights(8, 0.0);
  std::fill_n(weights.begin(), number, 1.0);
  return {Take::paper, number, weights, {RegressionMethod::pcr, 1}, predicted_rmse_um};
}

TEST(batch_choice, random_choices_are_the_same_by_seed) {
  const std::vector<Batch> batches = with_intercepts();
  const Moments measured = three_rows(20.0, 0.0).moments;
  RandomOptions options;
  const auto choices = [&] {
    return random_choices(batches, measured, first_batches(3, 4.0), {}, options).predicted_rmse_um;
  };
  const std::vector<double> um = choices();
  EXPECT_EQ(um.size(), 100U);
  EXPECT_TRUE(std::is_sorted(um.begin(), um.end()));
  EXPECT_EQ(choices(), um);
  options.seed = 2;
  EXPECT_NE(choices(), um);
  options.choices = 7;
  EXPECT_EQ(choices().size(), 7U);
}

// Of one batch each: every choice is one of 8 errors, all of them come up, and a share of them is above the fourth. An
// eighth each, 800 choices: the standard deviation of a count of 100 is 9.4, of five are looked at.
TEST(batch_choice, random_choices_of_one_batch_are_all_alike_likely) {
  const std::vector<Batch> batches = with_intercepts();
  const Moments measured = three_rows(20.0, 0.0).moments;
  std::vector<double> each;
  for (const Batch& batch : batches) {
    each.push_back(rmse_um(measured, regress(batch.moments, {RegressionMethod::pcr, 1})));
  }
  std::sort(each.begin(), each.end());
  const RandomChoices found = random_choices(batches, measured, first_batches(1, each[3]), {}, {800, 1});
  EXPECT_EQ(found.batches, 1U);
  std::size_t above = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    const auto count = std::count(found.predicted_rmse_um.begin(), found.predicted_rmse_um.end(), each[k]);
    EXPECT_NEAR(static_cast<double>(count), 100.0, 5.0 * 9.4) << k;
    above += k > 3 ? static_cast<std::size_t>(count) : 0U;
  }
  EXPECT_EQ(found.share_worse, static_cast<double>(above) / 800.0);
}

}  // namespace
}  // namespace ballbar
