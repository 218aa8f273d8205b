#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/internal/model/run_terms.hpp"
#include "diagnosis/outcome.hpp"

namespace ballbar {
namespace {

// Two runs of a bed that follows the room at once, noise of 0.2 um; in the second with another gain.
Series two_days(double second_um_per_K) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.2);
  Series data;
  std::vector<double> room, z;
  for (int run = 0; run < 2; ++run) {
    for (int i = 0; i < 300; ++i) {
      data.time_s.push_back(60.0 * i);
      room.push_back(20.0 + std::sin(i / (run == 0 ? 40.0 : 27.0)) + 0.01 * i);
      z.push_back((run == 0 ? 3.0 : second_um_per_K) * room.back() - 40.0 * run + noise(random));
    }
  }
  data.columns = {{"T_room_degC", Role::ambient, room}, {"z_um", Role::measured, z}};
  data.runs = {{"monday.csv", RunStart::rest}, {"tuesday.csv", RunStart::rest}};
  return data;
}

Diagnosis found_in(const Series& data) {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_room_degC"})};
  return diagnose(with_run_terms(model, data), data);
}

TEST(gains_by_run, a_machine_that_changed_is_told) {
  const Diagnosis found = found_in(two_days(4.0));
  ASSERT_EQ(found.gains_by_run.size(), 1U);
  const GainByRun& gain = found.gains_by_run.front();
  EXPECT_EQ(gain.effect, "expansion(T_room_degC)");
  EXPECT_EQ(gain.unit, "um/K");
  ASSERT_EQ(gain.gain.size(), 2U);
  EXPECT_NEAR(gain.gain[0], 3.0, 5.0 * gain.sigma[0]);
  EXPECT_NEAR(gain.gain[1], 4.0, 5.0 * gain.sigma[1]);
  EXPECT_LT(gain.sigma[1], 0.1);
  EXPECT_LT(gain.p, 1e-6);
}

TEST(gains_by_run, one_that_did_not_is_not) { EXPECT_TRUE(found_in(two_days(3.0)).gains_by_run.empty()); }

// An effect that two runs show together, each with a set-up of its own: neither run's zero is taken for drift.
TEST(gains_by_run, an_effect_is_named_from_two_runs) {
  const Series data = two_days(3.0);
  Model model;
  model.targets = {"z_um"};
  const Diagnosis found = diagnose(with_run_terms(model, data), data);
  ASSERT_EQ(found.named.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(label_of(found.named.front()), "expansion(T_room_degC)");
}

}  // namespace
}  // namespace ballbar
