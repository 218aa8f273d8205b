// Surrogates of effects on recordings.
#include "diagnosis/surrogates/surrogate_recordings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "../made_recordings.hpp"
#include "diagnosis/surrogates/surrogate_series.hpp"

namespace ballbar {
namespace {

struct WithSurrogate {
  std::optional<BestSurrogate> surrogate;
  double own = 0.0;  // fall of chi^2 by the effect itself
};

// The residual: `scale` times what the effect adds, and noise of 1 um; nothing else is in the model.
WithSurrogate with_surrogate(const char* effect, const std::vector<made::Sweep>& sweeps, double scale) {
  const Series trace = made::circles(sweeps, 120);
  const Term term = term_of(effect, {}, Level::recording);
  std::vector<double> parameters;
  for (const Parameter& parameter : term.effect->parameters) {
    parameters.push_back(parameter.kind == ParameterKind::gain ? 1.0 : parameter.start);
  }
  const Eigen::VectorXd added = made::added_um(term, parameters, trace).normalized();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Eigen::VectorXd residual_um = scale * added;
  for (double& value : residual_um) value += normal(random);
  Background background;
  background.row.resize(trace.time_s.size());
  std::iota(background.row.begin(), background.row.end(), std::size_t{0});
  background.whiten = [](const Eigen::MatrixXd& columns) { return columns; };
  background.white = background.plain = {Eigen::MatrixXd(added.size(), 0), residual_um};
  const SurrogateSource traced{{term.effect.get(), term.columns}, {parameters}, added};
  return {best_recording_surrogate(traced, trace, made::all_rows(trace), background, 200, 1),
          std::pow(residual_um.dot(added), 2)};
}

TEST(SurrogateRecordings, of_an_effect_that_is_there_do_worse) {
  const WithSurrogate found = with_surrogate("reversal_spike_a", made::both_ways(), 10.0);
  ASSERT_TRUE(found.surrogate);
  EXPECT_LT(found.surrogate->gain, 0.9 * found.own);
  EXPECT_GT(found.surrogate->gain, 0.1 * found.own);
}

TEST(SurrogateRecordings, of_an_effect_that_is_not_there_do_better) {
  const WithSurrogate found = with_surrogate("reversal_spike_a", made::both_ways(), 0.0);
  ASSERT_TRUE(found.surrogate);
  EXPECT_GT(found.surrogate->gain, found.own);
}

TEST(SurrogateRecordings, of_one_wave_are_the_effect_itself) {
  EXPECT_FALSE(with_surrogate("scale_mismatch", made::two_feeds(), 10.0).surrogate);
  EXPECT_FALSE(with_surrogate("servo_mismatch", made::one_way(), 10.0).surrogate);
  EXPECT_FALSE(with_surrogate("lobing", made::both_ways(), 10.0).surrogate);
}

// In each direction and at each feed another curve: to be right in all of them takes more than luck.
TEST(SurrogateRecordings, of_a_wave_that_changes_with_direction_and_feed_can_be_tried) {
  const WithSurrogate found = with_surrogate("servo_mismatch", made::two_feeds(), 10.0);
  ASSERT_TRUE(found.surrogate);
  EXPECT_LT(found.surrogate->gain, found.own);
}

}  // namespace
}  // namespace ballbar
