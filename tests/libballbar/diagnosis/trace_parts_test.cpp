// Cycles and surrogates of recordings.
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
  EXPECT_EQ(folds_of(trace, all_rows(trace)), expected);
}

TEST(CyclesOfRecordings, are_quarters_of_a_sweep_that_is_alone) {
  const Series trace = circles(made::one_way(), 8);
  const std::vector<std::size_t> expected{0, 0, 1, 1, 2, 2, 3, 3};
  EXPECT_EQ(folds_of(trace, all_rows(trace)), expected);
}

// A gain that one recording alone knows cannot be predicted from the other.
TEST(CyclesOfRecordings, are_quarters_of_all_sweeps_for_a_gain_of_one_recording) {
  const Series trace = circles(made::both_ways(), 8);
  const std::vector<std::size_t> fold = folds_of(trace, all_rows(trace));
  const std::vector<std::size_t> quarters{0, 0, 1, 1, 2, 2, 3, 3, 0, 0, 1, 1, 2, 2, 3, 3};
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(16, 1);
  EXPECT_EQ(folds_that_tell(trace, all_rows(trace), fold, columns), fold);
  columns.bottomRows(8).setZero();
  EXPECT_EQ(folds_that_tell(trace, all_rows(trace), fold, columns), quarters);
}

// 2 and 4 um about 0: each recording's own constant is no prediction of the other's.
TEST(CrossValidation, fits_what_belongs_to_the_recording_left_out_to_it) {
  LinearisedFit linearised;
  linearised.time_s = {0, 1, 2, 3};
  linearised.residual_um = Eigen::Vector4d(2.0, 4.0, 7.0, 5.0);
  linearised.model = Eigen::MatrixXd::Zero(4, 2);
  linearised.model.topLeftCorner(2, 1).setOnes();
  linearised.model.bottomRightCorner(2, 1).setOnes();
  EXPECT_NEAR(cross_validation(linearised, {1.0, 0.0, 0.0, 0.0}, {0, 0, 1, 1}, true).rmse_um, 1.0, 1e-12);
}

// 360 readings in a sweep of 18.8 s, or every third: 19.1 or 6.4 a second. Above half of that a vibration passes for a
// slow one, and for the form of the path.
TEST(SignatureLibraryOfRecordings, has_no_frequency_above_half_the_rate_of_the_rows) {
  const Series all = circles(made::both_ways(), 360);
  const Effect* vibration = find_effect("vibration", Level::recording);
  const auto highest_Hz = [&](std::size_t most) {
    const Series trace = subsampled(all, "deviation_um", most);
    const SignatureLibrary library = signature_library_of(built_in_catalogue(), recording_base_model(trace), trace,
                                                          fit(recording_base_model(trace), trace));
    double highest = 0.0;
    for (const Signature& signature : library.signatures) {
      if (library.families[signature.family].bound.effect == vibration) highest = std::max(highest, signature.point[4]);
    }
    return highest;
  };
  EXPECT_NEAR(highest_Hz(720), 9.5, 0.1);
  EXPECT_NEAR(highest_Hz(240), 3.2, 0.1);
}

struct Replaced {
  std::optional<BestSurrogate> surrogate;
  double own = 0.0;  // fall of chi^2 by the effect itself
};

// The residual: `scale` times what the effect adds, and noise of 1 um; nothing else is in the model.
Replaced source(const char* effect, const std::vector<made::Sweep>& sweeps, double scale) {
  const Series trace = circles(sweeps, 120);
  const Term term = term_of(effect, {}, Level::recording);
  std::vector<double> parameters;
  for (const Parameter& parameter : term.effect->parameters) {
    parameters.push_back(parameter.kind == ParameterKind::gain ? 1.0 : parameter.start);
  }
  const Eigen::VectorXd added = made::added_um(term, parameters, trace).normalized();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  LinearisedFit linearised;
  linearised.time_s = trace.time_s;
  linearised.residual_um = scale * added;
  for (double& value : linearised.residual_um) value += normal(random);
  linearised.model = Eigen::MatrixXd(added.size(), 0);
  const SurrogateSource traced{{term.effect.get(), term.columns}, {parameters}, added};
  return {best_recording_surrogate(traced, trace, all_rows(trace), linearised, {1.0, 0.0, 0.0, 0.0}, 200, 1),
          std::pow(linearised.residual_um.dot(added), 2)};
}

TEST(SurrogateRecordings, of_an_effect_that_is_there_do_worse) {
  const Replaced found = source("reversal_spike_a", made::both_ways(), 10.0);
  ASSERT_TRUE(found.surrogate);
  EXPECT_LT(found.surrogate->gain, 0.9 * found.own);
  EXPECT_GT(found.surrogate->gain, 0.1 * found.own);
}

TEST(SurrogateRecordings, of_an_effect_that_is_not_there_do_better) {
  const Replaced found = source("reversal_spike_a", made::both_ways(), 0.0);
  ASSERT_TRUE(found.surrogate);
  EXPECT_GT(found.surrogate->gain, found.own);
}

TEST(SurrogateRecordings, of_one_wave_are_the_effect_itself) {
  EXPECT_FALSE(source("scale_mismatch", made::two_feeds(), 10.0).surrogate);
  EXPECT_FALSE(source("servo_mismatch", made::one_way(), 10.0).surrogate);
  EXPECT_FALSE(source("lobing", made::both_ways(), 10.0).surrogate);
}

// In each direction and at each feed another curve: to be right in all of them takes more than luck.
TEST(SurrogateRecordings, of_a_wave_that_changes_with_direction_and_feed_can_be_tried) {
  const Replaced found = source("servo_mismatch", made::two_feeds(), 10.0);
  ASSERT_TRUE(found.surrogate);
  EXPECT_LT(found.surrogate->gain, found.own);
}

}  // namespace
}  // namespace ballbar
