#include "ballbar/compensation/compensation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "allocations.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

// z = 2 um/K (T_a - T_a0)
Model expansion() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_a_degC"})};
  model.terms[0].settings[0].start = 2.0;
  model.trained = {{"T_a_degC", 20.0, 30.0}};
  return model;
}

CompensationLimits quick() {
  CompensationLimits limits;
  limits.rate_um_per_s = 100.0;
  limits.step_um = 100.0;
  limits.hysteresis = 0.0;
  limits.spike_K = 100.0;
  return limits;
}

Offset one(Compensator& compensator, double time_s, double value) { return compensator.next(time_s, {{value}}); }

TEST(Compensation, IsTheNegativeOfTheErrorSinceTheFirstRow) {
  Compensator compensator(expansion(), quick());
  EXPECT_EQ(one(compensator, 0.0, 22.0).counts, 0);
  const Offset offset = one(compensator, 1.0, 23.5);  // 2 um/K 1.5 K = 3 um, 30 increments of 0.1 um
  EXPECT_EQ(offset.counts, -30);
  EXPECT_DOUBLE_EQ(offset.offset_um, -3.0);
  EXPECT_DOUBLE_EQ(offset.predicted_um, 3.0);
  EXPECT_EQ(offset.hold, Hold::none);
  EXPECT_FALSE(offset.limited);
}

TEST(Compensation, NeverChangesFasterThanItsRateNorByMoreThanItsStep) {
  CompensationLimits limits = quick();
  limits.rate_um_per_s = 0.5;
  limits.step_um = 1.0;
  Compensator compensator(expansion(), limits);
  one(compensator, 0.0, 22.0);
  Offset offset = one(compensator, 1.0, 25.0);  // -6 um wanted, 0.5 um in 1 s
  EXPECT_EQ(offset.counts, -5);
  EXPECT_TRUE(offset.limited);
  offset = one(compensator, 101.0, 25.0);  // 50 um by the rate, 1 um by the step
  EXPECT_EQ(offset.counts, -15);
  for (int i = 0; i < 5; ++i) offset = one(compensator, 111.0 + 10.0 * i, 25.0);
  EXPECT_EQ(offset.counts, -60);
  EXPECT_FALSE(offset.limited);
}

// Counts stay while the offset is within (1/2 + hysteresis) of them: about the edge between two counts, at 2.5
// increments, noise of 0.2 increments changes nothing once, and at most once with 0.25 of hysteresis.
TEST(Compensation, DoesNotChatterAboutTheEdgeOfAnIncrement) {
  const auto changes = [](double hysteresis) {
    CompensationLimits limits = quick();
    limits.hysteresis = hysteresis;
    Compensator compensator(expansion(), limits);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise_increments(-0.2, 0.2);
    one(compensator, 0.0, 22.0);
    std::int64_t counts = 0;
    int changed = 0;
    for (int i = 1; i < 1000; ++i) {
      const double error_um = 0.1 * (2.5 + noise_increments(random));
      const Offset offset = one(compensator, i, 22.0 + error_um / 2.0);
      changed += offset.counts != counts ? 1 : 0;
      counts = offset.counts;
    }
    return changed;
  };
  EXPECT_GT(changes(0.0), 300);
  EXPECT_EQ(changes(0.25), 1);
}

TEST(Compensation, StopsAtTheLargestOffset) {
  CompensationLimits limits = quick();
  limits.largest_um = 4.05;
  Compensator compensator(expansion(), limits);
  one(compensator, 0.0, 22.0);
  const Offset offset = one(compensator, 1.0, 29.0);
  EXPECT_EQ(offset.counts, -40);
  EXPECT_TRUE(offset.limited);
}

// Holds row by row: what is held stays, what comes back is followed again.
struct Row {
  double time_s, value;
  Hold hold;
  std::int64_t counts;
};

void expect_rows(const CompensationLimits& limits, const std::vector<Row>& rows) {
  Compensator compensator(expansion(), limits);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Offset offset = one(compensator, rows[i].time_s, rows[i].value);
    EXPECT_EQ(name_of(offset.hold), name_of(rows[i].hold)) << "row " << i;
    EXPECT_EQ(offset.counts, rows[i].counts) << "row " << i;
    EXPECT_EQ(std::isnan(offset.predicted_um), offset.hold != Hold::none) << "row " << i;
  }
}

TEST(Compensation, HoldsWhereASensorGivesNothing) {
  expect_rows(quick(), {{0, kGap, Hold::no_value, 0},
                        {1, 22.0, Hold::none, 0},
                        {2, 22.5, Hold::none, -10},
                        {3, kGap, Hold::no_value, -10},
                        {4, std::numeric_limits<double>::infinity(), Hold::no_value, -10},
                        {5, 23.0, Hold::none, -20}});
}

// Trained from 20 to 30 degC, 10 % of the span more at either end: 19 to 31.
TEST(Compensation, HoldsOutsideOfTheTrainedRange) {
  expect_rows(quick(), {{0, 22.0, Hold::none, 0},
                        {1, 31.0, Hold::none, -180},
                        {2, 31.01, Hold::out_of_range, -180},
                        {3, 18.99, Hold::out_of_range, -180},
                        {4, 19.0, Hold::none, 60}});
}

// 2 K at once and 0.1 K/s: 25 degC is a spike 1 s after 22, and likely after 30 s.
TEST(Compensation, HoldsASpikeUntilTheTimeMakesItLikely) {
  CompensationLimits limits = quick();
  limits.spike_K = 2.0;
  limits.heating_K_per_s = 0.1;
  expect_rows(limits, {{0, 22.0, Hold::none, 0},
                       {1, 25.0, Hold::spike, 0},
                       {2, 22.2, Hold::none, -4},
                       {3, 25.0, Hold::spike, -4},
                       {9, 25.0, Hold::spike, -4},
                       {11, 25.0, Hold::none, -60}});  // 2.8 K after 9 s: 2 + 0.9
}

// One wrong reading at the start is not the zero for ever: two rows after it contradict it.
TEST(Compensation, AFirstRowThatTheNextTwoContradictIsNotTheZero) {
  CompensationLimits limits = quick();
  limits.spike_K = 2.0;
  expect_rows(limits, {{0, 25.0, Hold::none, 0},
                       {1, 22.5, Hold::spike, 0},
                       {2, 22.5, Hold::none, 0},  // the zero now
                       {3, 23.0, Hold::none, -10},
                       {4, 26.0, Hold::spike, -10},
                       {5, 26.0, Hold::spike, -10},
                       {6, 23.5, Hold::none, -20}});
}

TEST(Compensation, AnOutageIsNotATimeInWhichASensorIsStuck) {
  CompensationLimits limits = quick();
  limits.stuck_s = 100.0;
  limits.gap_s = 10.0;
  expect_rows(limits, {{0, 22.0, Hold::none, 0},
                       {5, 22.5, Hold::none, -10},
                       {5000, 22.5, Hold::clock_gap, -10},
                       {5005, 22.5, Hold::none, -10},
                       {5010, 22.5, Hold::none, -10}});
}

// A logger that is slower than gap_s: its second row is held, its pace is believed then.
TEST(Compensation, BelievesASlowPace) {
  CompensationLimits limits = quick();
  limits.gap_s = 600.0;
  expect_rows(limits, {{0, 22.0, Hold::none, 0},
                       {900, 22.5, Hold::clock_gap, 0},
                       {1800, 23.0, Hold::none, -20},
                       {2700, 23.5, Hold::none, -30},
                       {3600, 24.0, Hold::none, -40},
                       {9000, 24.5, Hold::clock_gap, -40}});
}

TEST(Compensation, HoldsWhatIsStuckUntilItMoves) {
  CompensationLimits limits = quick();
  limits.stuck_s = 10.0;
  expect_rows(limits, {{0, 22.0, Hold::none, 0},
                       {1, 22.5, Hold::none, -10},
                       {11, 22.5, Hold::none, -10},
                       {11.5, 22.5, Hold::stuck, -10},
                       {12, 22.6, Hold::none, -12},
                       {13, 22.5, Hold::none, -10}});
}

TEST(Compensation, HoldsWhenTheClockGoesBackAndBelievesItOnceItGoesOn) {
  expect_rows(quick(), {{100, 22.0, Hold::none, 0},
                        {101, 22.1, Hold::none, -2},
                        {101, 22.2, Hold::clock_back, -2},  // the same time again
                        {102, 22.3, Hold::none, -6},
                        {5, 22.4, Hold::clock_back, -6},  // one wrong stamp
                        {103, 22.5, Hold::none, -10},
                        {5, 22.6, Hold::clock_back, -10},  // set back for good
                        {6, 22.7, Hold::none, -14},
                        {7, 22.8, Hold::none, -16}});
}

TEST(Compensation, HoldsAfterAGapUntilASecondRowFollows) {
  CompensationLimits limits = quick();
  limits.gap_s = 10.0;
  expect_rows(limits, {{0, 22.0, Hold::none, 0},
                       {500, 22.5, Hold::clock_gap, 0},  // one wrong stamp
                       {1, 22.5, Hold::none, -10},
                       {500, 23.0, Hold::clock_gap, -10},
                       {501, 23.5, Hold::none, -30},
                       {kGap, 23.5, Hold::no_time, -30},
                       {502, 23.5, Hold::none, -30}});
}

// A stamp that no clock has is not the first row's time, which all others would be before.
TEST(Compensation, DoesNotBelieveATimeFarFromAll) {
  expect_rows(quick(), {{1e300, 22.0, Hold::no_time, 0},
                        {-1.1e12, 22.0, Hold::no_time, 0},
                        {1.0, 22.0, Hold::none, 0},
                        {2.0, 22.5, Hold::none, -10},
                        {1e13, 22.7, Hold::no_time, -10},
                        {3.0, 23.0, Hold::none, -20}});
}

// Near 1e12 s doubles are 1.2e-4 s apart: a clock set back to steps of 1e-5 s moves on once they sum up to that. The
// model's times rise, so that the state can be gone on from.
TEST(Compensation, TimesOfTheModelRiseWhateverTheClock) {
  Compensator compensator(expansion(), quick());
  one(compensator, 1e12, 22.0);
  int believed = 0;
  for (int i = 0; i < 100; ++i) {
    believed += one(compensator, 1e-5 * i, 22.0).hold == Hold::none ? 1 : 0;
    const LiveModel::State& live = compensator.model().state();
    for (std::size_t k = 1; k < live.rows; ++k) ASSERT_GT(live.time_s[k], live.time_s[k - 1]) << i;
  }
  EXPECT_GT(believed, 0);
  Compensator from(expansion(), quick());
  EXPECT_NO_THROW(from.resume(compensator.state(), compensator.model().state()));
}

// A low pass sees no time while its clock is set back: 1 s from 102 s to 5 s, whatever the stamps say.
TEST(Compensation, ClocksThatAreSetBackMakeNoTime) {
  Model model = expansion();
  model.terms = {term_of("lagged_expansion", {"T_a_degC"})};
  model.terms[0].settings[0].start = 2.0;
  model.terms[0].settings[1].start = 50.0;
  Compensator set_back(model, quick()), steady(model, quick());
  one(set_back, 100.0, 22.0);
  one(steady, 100.0, 22.0);
  one(set_back, 5.0, 24.0);  // held
  EXPECT_EQ(one(set_back, 6.0, 24.0).predicted_um, one(steady, 101.0, 24.0).predicted_um);
  EXPECT_EQ(one(set_back, 8.0, 25.0).predicted_um, one(steady, 103.0, 25.0).predicted_um);
}

TEST(Compensation, SaysWhichColumnHolds) {
  Model model = expansion();
  model.terms.push_back(term_of("speed_heating", {"speed_rpm"}));
  Compensator compensator(model, quick());
  compensator.next(0.0, {{22.0, 3000.0}});
  const Offset offset = compensator.next(1.0, {{22.0, kGap}});
  EXPECT_EQ(offset.hold, Hold::no_value);
  EXPECT_EQ(compensator.columns()[offset.column], "speed_rpm");
}

// Speed may jump: spikes and stuck values are looked for in temperatures alone.
TEST(Compensation, SpeedMayJumpAndStay) {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("centrifugal_shift", {"speed_rpm"})};
  model.terms[0].settings[0].start = 1.0;
  CompensationLimits limits;
  limits.stuck_s = 1.0;
  Compensator compensator(model, limits);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(one(compensator, i, i < 50 ? 0.0 : 12000.0).hold, Hold::none) << i;
}

// Any rows at all: the offset never moves by more than its step or beyond its largest, and held rows move nothing.
TEST(Compensation, IsSafeWhateverComes) {
  CompensationLimits limits;
  limits.step_um = 0.35;
  limits.largest_um = 12.0;
  limits.rate_um_per_s = 5.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    Compensator compensator(expansion(), limits);
    double time_s = 0.0, value = 22.0;
    std::int64_t counts = 0;
    for (int i = 0; i < 5000; ++i) {
      time_s += 0.1 * pick(20);
      value += 0.2 * (pick(11) - 5);
      const double stamp_s = pick(50) == 0 ? 1000.0 * pick(10) : pick(60) == 0 ? kGap : time_s;
      const double read = pick(40) == 0 ? kGap : pick(30) == 0 ? 1e300 : value;
      const Offset offset = one(compensator, stamp_s, read);
      ASSERT_LE(std::abs(offset.counts - counts), 3) << seed << ", " << i;
      ASSERT_LE(std::abs(offset.offset_um), 12.0) << seed << ", " << i;
      if (offset.hold != Hold::none) {
        ASSERT_EQ(offset.counts, counts) << seed << ", " << i;
      }
      counts = offset.counts;
    }
  }
}

TEST(Compensation, GoesOnFromItsStateWithoutAJump) {
  Model model = expansion();
  model.terms.push_back(term_of("lagged_expansion", {"T_a_degC"}));
  model.terms[1].settings[0].start = 1.0;
  const auto value_at = [](int i) { return 24.0 + 2.0 * std::sin(0.01 * i); };
  Compensator all_the_time(model, {}), until(model, {}), from(model, {});
  for (int i = 0; i < 300; ++i) {
    one(all_the_time, i, value_at(i));
    one(until, i, value_at(i));
  }
  from.resume(until.state(), until.model().state());
  for (int i = 300; i < 600; ++i) {
    const Offset wanted = one(all_the_time, i, value_at(i)), found = one(from, i, value_at(i));
    ASSERT_EQ(found.counts, wanted.counts) << i;
    ASSERT_EQ(found.predicted_um, wanted.predicted_um) << i;
  }
}

TEST(Compensation, RefusesTheStateOfAnotherMachine) {
  Compensator compensator(expansion(), {});
  one(compensator, 0.0, 22.0);
  using State = Compensator::State;
  for (const auto& spoil : std::vector<std::function<void(State&)>>{
           [](State& state) { state.sensors.clear(); }, [](State& state) { state.resolution_um = 1.0; },
           [](State& state) { state.counts = 3000; }, [](State& state) { state.counts = 1900; },
           [](State& state) { state.offset_um = kGap; }, [](State& state) { state.origin_um = kGap; },
           [](State& state) { state.time_s = kGap; }}) {
    State state = compensator.state();
    spoil(state);
    EXPECT_THROW(compensator.resume(state, compensator.model().state()), Error);
  }
  LiveModel::State later = compensator.model().state();
  later.time_s[0] = 1.0;  // the last row was at 0 s
  EXPECT_THROW(compensator.resume(compensator.state(), later), Error);
  EXPECT_NO_THROW(compensator.resume(compensator.state(), compensator.model().state()));
}

TEST(Compensation, RefusesLimitsThatMakeNoSense) {
  const auto expect_error = [](const std::function<void(CompensationLimits&)>& set, const std::string& message) {
    CompensationLimits limits;
    set(limits);
    try {
      const Compensator compensator(expansion(), limits);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  expect_error([](auto& limits) { limits.resolution_um = 0.0; },
               "resolution: expected a least increment above 0 um, found 0.");
  expect_error([](auto& limits) { limits.step_um = 0.05; },
               "step: expected at least the resolution of 0.1 um, found 0.05.");
  expect_error([](auto& limits) { limits.rate_um_per_s = kGap; }, "rate: expected above 0 um/s, found nan.");
  expect_error([](auto& limits) { limits.hysteresis = -1.0; }, "hysteresis: expected 0 to 10 increments, found -1.");
  Model two = expansion();
  two.targets.emplace_back("y_um");
  EXPECT_THROW(Compensator(two, {}), Error);
  Model temperature = expansion();
  temperature.targets = {"T_b_degC"};
  EXPECT_THROW(Compensator(temperature, {}), Error);
  Model misspelt = expansion();
  misspelt.trained[0].column = "T_A_degC";
  EXPECT_THROW(Compensator(misspelt, {}), Error);
}

TEST(Compensation, TakesNoMemoryARow) {
  Model model = expansion();
  model.terms.push_back(term_of("lagged_expansion", {"T_a_degC"}));
  model.terms.push_back(term_of("speed_heating", {"speed_rpm"}));
  Compensator compensator(model, {});
  std::vector<double> values{22.0, 3000.0};
  compensator.next(0.0, values);
  const std::size_t before = allocations();
  for (int i = 1; i < 1000; ++i) {
    values[0] = i % 7 == 0 ? kGap : 22.0 + 0.01 * i;
    compensator.next(i % 11 == 0 ? 3.0 : i, values);
  }
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace ballbar
