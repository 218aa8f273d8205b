// Effects hidden in made recordings: what two directions and two feeds tell apart, and what one does not.
#include <gtest/gtest.h>

#include <algorithm>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "diagnosis/outcome.hpp"
#include "made_recordings.hpp"

namespace ballbar {
namespace {

made::Plan plan_of(std::vector<made::Sweep> sweeps, std::size_t readings) {
  made::Plan plan;
  plan.sweeps = std::move(sweeps);
  plan.readings = readings;
  plan.detectability = 15.0;
  return plan;
}

DiagnosisOptions linear_axes() {
  DiagnosisOptions options;
  options.search.motion = Motion::linear_axes;
  return options;
}

Diagnosis of(const made::Plan& plan, const char* effect, std::uint64_t seed = 1) {
  const Effect* hidden = effect == nullptr ? nullptr : find_effect(effect, Level::recording);
  const Series trace = made::recordings(plan, hidden, seed);
  return diagnose(recording_base_model(trace), trace, 0, linear_axes());
}

std::string named(const Diagnosis& found) {
  std::string names;
  for (const BoundEffect& bound : found.named) names += (names.empty() ? "" : " ") + label_of(bound);
  return names;
}

bool is_in(const std::vector<std::vector<BoundEffect>>& groups, std::string_view effect) {
  return std::any_of(groups.begin(), groups.end(), [&](const std::vector<BoundEffect>& group) {
    return std::any_of(group.begin(), group.end(), [&](const BoundEffect& b) { return b.effect->name == effect; });
  });
}

TEST(DiagnosisOfRecordings, two_feeds_name_squareness) {
  EXPECT_EQ(named(of(plan_of(made::two_feeds(), 60), "squareness")), "squareness");
}

TEST(DiagnosisOfRecordings, two_feeds_name_a_servo_mismatch) {
  EXPECT_EQ(named(of(plan_of(made::two_feeds(), 60), "servo_mismatch")), "servo_mismatch");
}

// It moves the radius alone: at one feed set-up does the same. Disabled: P = 0.2 to 0.3 at d = 15 under white noise,
// the rest nothing. The noise of recordings is what the poor model leaves, and a long memory takes the four changes of
// feed.
TEST(DiagnosisOfRecordings, DISABLED_two_feeds_name_dynamic_contraction) {
  EXPECT_EQ(named(of(plan_of(made::two_feeds(), 60), "dynamic_contraction")), "dynamic_contraction");
}

TEST(DiagnosisOfRecordings, one_feed_cannot_show_dynamic_contraction) {
  const Diagnosis found = of(plan_of(made::both_ways(), 120), "dynamic_contraction");
  EXPECT_EQ(found.verdict, Verdict::nothing);
  const auto at =
      std::find_if(found.detectability.begin(), found.detectability.end(),
                   [](const Detectability& detectable) { return detectable.effect->name == "dynamic_contraction"; });
  ASSERT_NE(at, found.detectability.end());
  EXPECT_NE(at->testability, Testability::testable);
}

TEST(DiagnosisOfRecordings, both_ways_name_backlash) {
  EXPECT_EQ(named(of(plan_of(made::both_ways(), 120), "backlash_a")), "backlash_a");
}

TEST(DiagnosisOfRecordings, both_ways_name_a_scale_mismatch) {
  EXPECT_EQ(named(of(plan_of(made::both_ways(), 120), "scale_mismatch")), "scale_mismatch");
}

// Angle, direction, feed and radius of a recording are no inputs that drive.
TEST(DiagnosisOfRecordings, of_one_direction_nothing_drives) {
  const Series trace = made::recordings(plan_of(made::one_way(), 200), find_effect("squareness", Level::recording), 1);
  const Diagnosis found = diagnose(recording_base_model(trace), trace, 0, linear_axes());
  EXPECT_EQ(found.verdict, Verdict::equivalent) << made::outcome_of(found);
  EXPECT_TRUE(found.drivers.empty());
}

TEST(DiagnosisOfRecordings, one_direction_never_tells_squareness_from_a_servo_mismatch) {
  for (const char* effect : {"squareness", "servo_mismatch"}) {
    const Series trace = made::recordings(plan_of(made::one_way(), 200), find_effect(effect, Level::recording), 1);
    const Diagnosis found = diagnose(recording_base_model(trace), trace, 0, linear_axes());
    EXPECT_TRUE(found.named.empty() && found.probable.empty()) << effect;
    EXPECT_TRUE(is_in(found.equivalent, "squareness")) << effect;
    EXPECT_TRUE(is_in(found.equivalent, "servo_mismatch")) << effect;
    const std::vector<ShapedEffect> both{{find_effect("squareness", Level::recording)},
                                         {find_effect("servo_mismatch", Level::recording)}};
    const std::optional<NextMeasurement> next = next_measurement(trace, both);
    ASSERT_TRUE(next) << effect;
    EXPECT_EQ(next->measurement, Measurement::other_direction) << effect;
  }
}

TEST(DiagnosisOfRecordings, nothing_hidden_is_nothing) {
  int called = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Diagnosis found = of(plan_of(made::both_ways(), 100), nullptr, seed);
    EXPECT_TRUE(found.named.empty()) << seed;
    called += found.verdict == Verdict::nothing ? 0 : 1;
  }
  EXPECT_EQ(called, 0);
}

TEST(RecordingBaseModel, has_one_radius_at_several_feeds) {
  const auto radii = [](const std::vector<made::Sweep>& sweeps) {
    made::Plan plan;
    plan.sweeps = sweeps;
    plan.readings = 36;
    const Model model = recording_base_model(made::circles(plan));
    return std::count_if(model.terms.begin(), model.terms.end(),
                         [](const Term& term) { return !term.settings.at(2).held; });
  };
  EXPECT_EQ(radii(made::both_ways()), 2);
  EXPECT_EQ(radii(made::two_feeds()), 1);
}

}  // namespace
}  // namespace ballbar
