// Cycles and fakes of recordings.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/statistics/cross_validation.hpp"
#include "diagnosis/surrogates/surrogate_recordings.hpp"
#include "diagnosis/surrogates/surrogate_series.hpp"
#include "made_recordings.hpp"
#include "series/folds.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

std::vector<std::size_t> all_rows(const Series& data) {
  std::vector<std::size_t> rows(data.time_s.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  return rows;
}

Series circles(std::vector<made::Sweep> sweeps, std::size_t readings) {
  made::Plan plan;
  plan.sweeps = std::move(sweeps);
  plan.readings = readings;
  return made::circles(plan);
}

TEST(CyclesOfRecordings, are_the_recordings) {
  const Series trace = circles(made::both_ways(), 8);
  const std::vector<std::size_t> expected{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(cycles_of(trace, all_rows(trace)), expected);
}

TEST(CyclesOfRecordings, are_quarters_of_a_sweep_that_is_alone) {
  const Series trace = circles(made::one_way(), 8);
  const std::vector<std::size_t> expected{0, 0, 1, 1, 2, 2, 3, 3};
  EXPECT_EQ(cycles_of(trace, all_rows(trace)), expected);
}

// A gain that one recording alone knows cannot be predicted from the other.
TEST(CyclesOfRecordings, are_quarters_of_all_sweeps_for_a_gain_of_one_recording) {
  const Series trace = circles(made::both_ways(), 8);
  const std::vector<std::size_t> cycle = cycles_of(trace, all_rows(trace));
  const std::vector<std::size_t> quarters{0, 0, 1, 1, 2, 2, 3, 3, 0, 0, 1, 1, 2, 2, 3, 3};
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(16, 1);
  EXPECT_EQ(cycles_that_tell(trace, all_rows(trace), cycle, columns), cycle);
  columns.bottomRows(8).setZero();
  EXPECT_EQ(cycles_that_tell(trace, all_rows(trace), cycle, columns), quarters);
}

// 2 and 4 um about 0: each recording's own constant is no prediction of the other's.
TEST(HeldOut, fits_what_belongs_to_the_recording_left_out_to_it) {
  Leftover leftover;
  leftover.time_s = {0, 1, 2, 3};
  leftover.residual_um = Eigen::Vector4d(2.0, 4.0, 7.0, 5.0);
  leftover.model = Eigen::MatrixXd::Zero(4, 2);
  leftover.model.topLeftCorner(2, 1).setOnes();
  leftover.model.bottomRightCorner(2, 1).setOnes();
  EXPECT_NEAR(held_out(leftover, {1.0, 0.0, 0.0, 0.0}, {0, 0, 1, 1}, true).rmse_um, 1.0, 1e-12);
}

// 360 readings in a sweep of 18.8 s, or every third: 19.1 or 6.4 a second. Above half of that a vibration passes for a
// slow one, and for the form of the path.
TEST(BankOfRecordings, has_no_frequency_above_half_the_rate_of_the_rows) {
  const Series all = circles(made::both_ways(), 360);
  const Effect* vibration = find_effect("vibration", Level::recording);
  const auto highest_Hz = [&](std::size_t most) {
    const Series trace = thinned(all, "deviation_um", most);
    const Bank bank = bank_of(built_in_catalogue(), circles_of(trace), trace, fit(circles_of(trace), trace));
    double highest = 0.0;
    for (const Signature& signature : bank.signatures) {
      if (bank.families[signature.family].bound.effect == vibration) highest = std::max(highest, signature.point[4]);
    }
    return highest;
  };
  EXPECT_NEAR(highest_Hz(720), 9.5, 0.1);
  EXPECT_NEAR(highest_Hz(240), 3.2, 0.1);
}

struct Faked {
  std::optional<BestFake> fake;
  double own = 0.0;  // fall of chi^2 by the effect itself
};

// The residual: `scale` times what the effect adds, and noise of 1 um; nothing else is in the model.
Faked faked(const char* effect, const std::vector<made::Sweep>& sweeps, double scale) {
  const Series trace = circles(sweeps, 120);
  const Term term = term_of(effect, {}, Level::recording);
  std::vector<double> parameters;
  for (const Parameter& parameter : term.effect->parameters) {
    parameters.push_back(parameter.kind == ParameterKind::gain ? 1.0 : parameter.start);
  }
  const Eigen::VectorXd added = made::added_um(term, parameters, trace).normalized();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Leftover leftover;
  leftover.time_s = trace.time_s;
  leftover.residual_um = scale * added;
  for (double& value : leftover.residual_um) value += normal(random);
  leftover.model = Eigen::MatrixXd(added.size(), 0);
  const FakedEffect traced{{term.effect.get(), term.columns}, {parameters}, added};
  return {best_trace_fake(traced, trace, all_rows(trace), leftover, {1.0, 0.0, 0.0, 0.0}, 200, 1),
          std::pow(leftover.residual_um.dot(added), 2)};
}

TEST(TraceFakes, of_an_effect_that_is_there_do_worse) {
  const Faked found = faked("reversal_spike_a", made::both_ways(), 10.0);
  ASSERT_TRUE(found.fake);
  EXPECT_LT(found.fake->gain, 0.9 * found.own);
  EXPECT_GT(found.fake->gain, 0.1 * found.own);
}

TEST(TraceFakes, of_an_effect_that_is_not_there_do_better) {
  const Faked found = faked("reversal_spike_a", made::both_ways(), 0.0);
  ASSERT_TRUE(found.fake);
  EXPECT_GT(found.fake->gain, found.own);
}

TEST(TraceFakes, of_one_wave_are_the_effect_itself) {
  EXPECT_FALSE(faked("scale_mismatch", made::two_feeds(), 10.0).fake);
  EXPECT_FALSE(faked("servo_mismatch", made::one_way(), 10.0).fake);
  EXPECT_FALSE(faked("lobing", made::both_ways(), 10.0).fake);
}

// In each direction and at each feed another curve: to be right in all of them takes more than luck.
TEST(TraceFakes, of_a_wave_that_changes_with_direction_and_feed_can_be_tried) {
  const Faked found = faked("servo_mismatch", made::two_feeds(), 10.0);
  ASSERT_TRUE(found.fake);
  EXPECT_LT(found.fake->gain, found.own);
}

}  // namespace
}  // namespace ballbar
