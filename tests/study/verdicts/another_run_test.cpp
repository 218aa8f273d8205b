// A machine that runs again: what stays the same, and what is another day's.
#include "another_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics.hpp"

namespace ballbar::verdicts {
namespace {

Schedule up_and_down() {
  Schedule schedule;
  schedule.dwells = {{900.0, 0.0}, {3600.0, 9000.0}, {1800.0, 4000.0}, {2700.0, 0.0}};
  return schedule;
}

Recipe recipe_of(Course course) {
  Recipe recipe;
  recipe.course = course;
  return recipe;
}

const std::vector<double>& column(const Series& series, const std::string& name) {
  return find_column(series, name)->values;
}

double mean(const Track& track) {
  double sum = 0.0;
  for (const double value : track) sum += value;
  return sum / static_cast<double>(track.size());
}

// With the gain and the shapes that it was drawn with, on the plan that it was drawn on.
TEST(AnotherRun, HiddenEffectsAreEvaluatedAgainAsTheyWere) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Bench bench = bench_of(recipe_of(seed % 2 == 0 ? Course::poor : Course::one_speed), "again", seed);
    for (const Hidden& hidden : bench.hidden) {
      EXPECT_EQ(added_by(hidden, bench.scene.plan, bench.scene.plan), hidden.unit) << hidden.effect;
    }
  }
}

TEST(AnotherRun, ThePlanIsTheSchedule) {
  Chance chance("plan", 1);
  const Plan first = rich_plan(chance);
  const Plan plan = plan_under(up_and_down(), first, chance);
  EXPECT_EQ(plan.span_s, 9000U);
  const Track& speed = plan[Quantity::speed];
  const auto late = static_cast<std::size_t>(std::find(speed.begin(), speed.end(), 9000.0) - speed.begin()) - 900U;
  EXPECT_LT(late, 60U);  // of a reading
  for (const std::size_t t : {0U, 899U, 900U, 4499U, 4500U, 6299U, 6300U, 8900U}) {
    EXPECT_EQ(speed[t + late], dwell_at(up_and_down(), static_cast<double>(t)).speed_rpm) << t;
  }
  // The mean of the cuts of the first plan, and 50 W and 0.02 W for each rpm.
  double cuts_W = 0.0, turning_s = 0.0;
  for (std::size_t i = 0; i < first.span_s; ++i) {
    if (!(first[Quantity::speed][i] > 0.0)) continue;
    cuts_W += first[Quantity::load][i] - 50.0 - 0.02 * first[Quantity::speed][i];
    turning_s += 1.0;
  }
  EXPECT_NEAR(plan[Quantity::load][1000], cuts_W / turning_s + 50.0 + 180.0, 1e-6);
  EXPECT_EQ(plan[Quantity::load][0], 0.0);
}

// The chiller keeps its set point, within its band and what the room does to it.
TEST(AnotherRun, TheMachineIsTheSame) {
  Chance chance("machine", 2);
  const Plan first = one_speed_plan(chance);
  const Plan plan = plan_under(up_and_down(), first, chance);
  const Bodies& bodies = first.bodies;
  for (std::size_t i = 0; i < 9000; i += 100) {
    const double set_degC =
        bodies.set_degC + bodies.follows_room * (plan[Quantity::room][i] - first[Quantity::room].front());
    EXPECT_NEAR(plan[Quantity::coolant][i], set_degC, bodies.band_degC + 0.3) << i;
  }
  EXPECT_NE(plan[Quantity::room][4000], first[Quantity::room][4000]);
  EXPECT_NEAR(mean(plan[Quantity::room]), plan.room.mean_degC, plan.room.swing_degC + 5.0);
}

// The same draws with and without the steps: after 2 h the room is warmer by 3 K, the coolant by 2 K within its cycle.
TEST(AnotherRun, RoomAndCoolantAreMoved) {
  Chance chance("moved", 3);
  const Plan first = rich_plan(chance);
  Schedule still, moved;
  still.dwells = {{3600.0, 0.0}, {7200.0, 0.0}};
  moved.dwells = {{3600.0, 0.0}, {7200.0, 0.0, 1.0, 3.0, 2.0}};
  Chance one("day", 1), other("day", 1);
  const Plan a = plan_under(still, first, one), b = plan_under(moved, first, other);
  EXPECT_EQ(a[Quantity::room][3600], b[Quantity::room][3600]);
  EXPECT_NEAR(b[Quantity::room][10700] - a[Quantity::room][10700], 3.0, 1e-3);
  const Track late_a(a[Quantity::coolant].begin() + 7200, a[Quantity::coolant].begin() + 10800);
  const Track late_b(b[Quantity::coolant].begin() + 7200, b[Quantity::coolant].begin() + 10800);
  EXPECT_NEAR(mean(late_b) - mean(late_a), 2.0 + 3.0 * first.bodies.follows_room, 2.0 * first.bodies.band_degC);
}

TEST(AnotherRun, BegunWarmItGoesOn) {
  Chance chance("warm", 4);
  const Plan first = one_speed_plan(chance);
  Schedule schedule = up_and_down();
  schedule.starts_warm = true;
  const Plan plan = plan_under(schedule, first, chance);
  EXPECT_EQ(plan.before_s, first.span_s);
  EXPECT_EQ(plan[Quantity::speed][first.span_s - 1], first[Quantity::speed][first.span_s - 1]);
  EXPECT_EQ(plan[Quantity::speed][first.span_s], 0.0);
  EXPECT_NEAR(plan[Quantity::bearing][first.span_s], plan[Quantity::bearing][first.span_s - 1], 0.1);
  EXPECT_GT(plan[Quantity::bearing][first.span_s], plan[Quantity::bearing][first.span_s + 880] + 0.5);
}

// What is left of the target without base model and hidden effects is an offset and the scene's noise: whitened, with
// variance 1. 0.3: of 150 rows; Student's t scatters more.
TEST(AnotherRun, TheTargetIsTracksAndNoise) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Recipe recipe = recipe_of(Course::poor);
    recipe.noise = Noise::ar90;
    const Bench bench = bench_of(recipe, "target", seed);
    Schedule schedule = up_and_down();
    for (Dwell& dwell : schedule.dwells) dwell.duration_s *= 4.0;
    Chance chance("target run", seed), again("target run", seed);
    const Series run = next_run(bench, schedule, Places::machine, chance);
    const Plan plan = plan_under(schedule, bench.scene.plan, again);
    Track sum = scaled(unit_track(bench.scene.base, plan, bench.scene.base.time_constant_s), bench.scene.base.gain);
    for (const Hidden& hidden : bench.hidden) {
      const Track added = added_by(hidden, plan, bench.scene.plan);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += added[i];
    }
    const std::vector<double> clean = at_rows(sum, run.time_s);
    const std::vector<double>& target = column(run, bench.scene.target);
    ASSERT_EQ(target.size(), 601U);
    Eigen::MatrixXd rest(601, 1);
    for (Eigen::Index i = 0; i < 601; ++i) {
      rest(i, 0) = target[static_cast<std::size_t>(i)] - clean[static_cast<std::size_t>(i)];
    }
    EXPECT_LT(std::abs(rest.mean()), 22.0);
    rest.array() -= rest.mean();
    EXPECT_NEAR(whitened(rest, run.time_s, bench.scene.scatter).squaredNorm() / 601.0, 1.0, 0.2) << seed;
  }
}

// Columns, their order, how late each clock is.
TEST(AnotherRun, TheLoggerIsTheSame) {
  Recipe recipe = recipe_of(Course::one_speed);
  recipe.most_late = 1.0;
  recipe.row_s = 60;
  const Bench bench = bench_of(recipe, "logger", 1);
  Chance chance("logger run", 1);
  const Series run = next_run(bench, up_and_down(), Places::machine, chance);
  ASSERT_EQ(run.columns.size(), bench.made.data.columns.size());
  for (std::size_t k = 0; k < run.columns.size(); ++k) {
    EXPECT_EQ(run.columns[k].name, bench.made.data.columns[k].name);
    EXPECT_EQ(run.columns[k].values.size(), run.time_s.size());
  }
  // Rows every 60 s: a clock that is late by as much shows all of it one row later.
  Bench prompt = bench, late = bench;
  prompt.made.late_s.fill(0.0);
  late.made.late_s.fill(60.0);
  Chance one("clocks", 1), other("clocks", 1);
  const std::string& name = bench.scene.name[0];
  const std::vector<double> early = column(next_run(prompt, up_and_down(), Places::machine, one), name);
  const std::vector<double> after = column(next_run(late, up_and_down(), Places::machine, other), name);
  EXPECT_EQ(std::vector<double>(early.begin(), early.end() - 1), std::vector<double>(after.begin() + 1, after.end()));
  EXPECT_NE(early, after);
}

// A kink that stays where it is is met sooner where the run begins warmer.
TEST(AnotherRun, AKinkStaysWhereItIs) {
  Hidden hidden{"preload_loss", {Quantity::bearing}, {{"gain_um_per_unit", 2.0, true}, {"threshold_unit", 5.0}}, {}};
  Plan first, second;
  first.tracks.fill(Track{20.0, 24.0, 26.0});
  second.tracks.fill(Track{22.0, 24.0, 26.0});
  EXPECT_EQ(added_by(hidden, first, first), (Track{0.0, 0.0, 2.0}));
  EXPECT_EQ(added_by(hidden, second, first), (Track{0.0, 0.0, 2.0}));
  EXPECT_EQ(added_by(hidden, second, second), (Track{0.0, 0.0, 0.0}));
  // Friction that is that of the first run's temperature, e^-0.1 less for each K.
  hidden = {"viscosity_feedback",
            {Quantity::speed, Quantity::bearing},
            {{"gain_um_per_krpm", 1.0, true}, {"time_constant_s", 1e-9}, {"viscosity_loss_per_K", 0.1}},
            {}};
  for (Plan* plan : {&first, &second}) (*plan)[Quantity::speed] = Track(3, 1000.0);
  EXPECT_NEAR(added_by(hidden, first, first)[1], 1.0, 1e-12);
  EXPECT_NEAR(added_by(hidden, second, first)[1], std::exp(-0.2), 1e-12);
  EXPECT_NEAR(added_by(hidden, second, first)[2], std::exp(-0.4), 1e-12);
}

}  // namespace
}  // namespace ballbar::verdicts
