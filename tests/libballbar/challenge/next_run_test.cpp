// The set's machine once more: what is the same, and what is another day's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "ballbar/diagnosis/injection/injection.hpp"
#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/lab/challenge/blind.hpp"
#include "ballbar/numerics/range.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

constexpr BlindKind kAll[] = {BlindKind::nothing, BlindKind::one,         BlindKind::two,
                              BlindKind::outside, BlindKind::inseparable, BlindKind::spindle};

const std::vector<double>& values(const Series& series, std::string_view column) {
  return find_column(series, column)->values;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Schedule staircase() {
  Schedule schedule;
  schedule.dwells = {{1800.0, 0.0}, {5400.0, 8000.0}, {3600.0, 3000.0}, {5400.0, 14000.0}, {3600.0, 0.0}};
  return schedule;
}

TEST(NextRun, HasTheColumnsOfTheSetAndTheRowsOfTheSchedule) {
  for (const BlindKind kind : kAll) {
    const BlindSet set = blind_set(kind, 5);
    const Series run = next_run(kind, 5, staircase(), 2);
    ASSERT_EQ(run.columns.size(), set.data.columns.size()) << name_of(kind);
    for (std::size_t k = 0; k < run.columns.size(); ++k) {
      EXPECT_EQ(run.columns[k].name, set.data.columns[k].name);
      EXPECT_EQ(run.columns[k].role, set.data.columns[k].role);
      EXPECT_EQ(run.columns[k].values.size(), run.time_s.size());
    }
    ASSERT_EQ(run.time_s.size(), 331U);
    EXPECT_EQ(run.time_s.front(), 0.0);
    EXPECT_EQ(run.time_s.back(), 19800.0);
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {  // stretches end at a row, changes come just behind it
      EXPECT_EQ(values(run, "speed_rpm")[i], dwell_at(staircase(), std::max(0.0, run.time_s[i] - 0.1)).speed_rpm);
    }
  }
}

TEST(NextRun, TheSameNumberIsTheSameRun) {
  const auto target = [](std::uint64_t seed, std::uint64_t number) {
    return next_run(BlindKind::one, seed, staircase(), number).columns.back().values;
  };
  EXPECT_EQ(target(3, 2), target(3, 2));
  EXPECT_NE(target(3, 2), target(3, 3));
  EXPECT_NE(target(3, 2), target(4, 2));
}

// What model and hidden effects leave of a run, whitened by the set's noise: mean square, and mean product of
// neighbours. Gains and shapes are those that the set gives without its noise; nothing where the fit stops at another
// minimum.
struct Left {
  double square = 0.0, neighbours = 0.0;
};
std::optional<Left> left_of(BlindKind kind, std::uint64_t seed, const Schedule& schedule) {
  const BlindSet set = blind_set(kind, seed);
  Model whole = set.model;
  for (const BoundEffect& bound : set.answer.hidden) {
    whole.terms.push_back(term_of(bound.effect->name, bound.columns, Level::series));
  }
  Series exact = set.data;
  exact.columns.back().values = set.clean_um;
  for (const std::vector<double>& hidden : set.hidden_um) {
    for (std::size_t i = 0; i < hidden.size(); ++i) exact.columns.back().values[i] += hidden[i];
  }
  const Fit learned = fit(whole, exact, 0, {.white = true});
  if (learned.rmse_um > 1e-3) return std::nullopt;

  const Series run = next_run(kind, seed, schedule, 2);
  std::vector<double> rest = run.columns.back().values;
  const std::vector<double> predicted_um = predict(whole, learned.parameters, run).predicted_um;
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= predicted_um[i];
  const double offset_um = mean(rest);
  EXPECT_LT(std::abs(offset_um), 27.0);  // 20 of the set-up, 5 of the model's constant, noise
  for (double& value : rest) value -= offset_um;
  const Whitening whitening(set.noise, run.time_s, {});
  whitening.apply(rest.data(), 1, rest.data(), 1);
  Left left;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    left.square += rest[i] * rest[i] / static_cast<double>(rest.size());
    if (i > 0) left.neighbours += rest[i] * rest[i - 1] / static_cast<double>(rest.size());
  }
  return left;
}

// 0.25: 330 rows scatter by 0.08, those of a Student's t by more.
TEST(NextRun, ModelAndHiddenEffectsOfTheSetLeaveNoise) {
  std::size_t tried = 0;
  for (const BlindKind kind : {BlindKind::nothing, BlindKind::one, BlindKind::two}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const std::optional<Left> left = left_of(kind, seed, staircase());
      if (!left) continue;
      EXPECT_NEAR(left->square, 1.0, 0.25) << name_of(kind) << " " << seed;
      EXPECT_NEAR(left->neighbours, 0.0, 0.25) << name_of(kind) << " " << seed;
      ++tried;
    }
  }
  EXPECT_GE(tried, 8U);
}

// What no diagnosis could tell in the set no schedule of speeds tells either.
TEST(NextRun, TheInseparableStaysSo) {
  std::size_t sensors = 0, loads = 0, rooms = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Series run = next_run(BlindKind::inseparable, seed, staircase(), 2);
    const std::vector<double>& room = values(run, "T_room_degC");
    if (find_column(run, "T_head_2_degC") != nullptr) {
      EXPECT_EQ(values(run, "T_head_2_degC"), values(run, "T_head_degC"));
      ++sensors;
    } else if (std::all_of(room.begin(), room.end(), [&](double degC) { return degC == room.front(); })) {
      EXPECT_EQ(room.front(), values(blind_set(BlindKind::inseparable, seed).data, "T_room_degC").front());
      ++rooms;
    } else {
      const std::vector<double>&load_W = values(run, "load_W"), &speed_rpm = values(run, "speed_rpm");
      for (std::size_t i = 0; i < load_W.size(); ++i) {
        EXPECT_NEAR(load_W[i] * 8000.0, load_W[100] * speed_rpm[i], 1e-6);
      }
      EXPECT_GT(load_W[100], 0.0);
      ++loads;
    }
  }
  EXPECT_GT(sensors, 0U);
  EXPECT_GT(loads, 0U);
  EXPECT_GT(rooms, 0U);
}

// Means of the last hour of a rest. The tank's chiller swings by 0.5 K about its set point; the room of another draw
// would differ, that of the same one does not.
TEST(NextRun, RoomAndCoolantMoveAsTheScheduleSays) {
  std::uint64_t seed = 1;
  while (find_column(blind_set(BlindKind::one, seed).data, "T_coolant_degC") == nullptr) ++seed;
  Schedule still, moved;
  still.dwells = {{7200.0, 0.0}, {14400.0, 0.0}};
  moved.dwells = {{7200.0, 0.0}, {14400.0, 0.0, 1.0, 4.0, 2.0}};
  const auto late = [](const Series& run, std::string_view column) {
    const std::vector<double>& all = values(run, column);
    return mean({all.end() - 60, all.end()});
  };
  const Series a = next_run(BlindKind::one, seed, still, 2), b = next_run(BlindKind::one, seed, moved, 2);
  EXPECT_NEAR(late(b, "T_room_degC") - late(a, "T_room_degC"), 4.0, 0.02);
  EXPECT_NEAR(late(b, "T_coolant_degC") - late(a, "T_coolant_degC"), 2.0, 0.8);
  EXPECT_EQ(values(a, "T_room_degC").front(), values(b, "T_room_degC").front());
}

TEST(NextRun, TheLoadIsTheMeanOfTheSetAtThatSpeed) {
  std::uint64_t seed = 1;
  while (find_column(blind_set(BlindKind::one, seed).data, "load_W") == nullptr) ++seed;
  const Series set = blind_set(BlindKind::one, seed).data;
  std::map<double, std::vector<double>> loads_W;
  for (std::size_t i = 0; i + 1 < set.time_s.size(); ++i) {
    loads_W[values(set, "speed_rpm")[i]].push_back(values(set, "load_W")[i]);
  }
  const auto& [speed_rpm, there_W] = *loads_W.rbegin();
  Schedule schedule;
  schedule.dwells = {{3600.0, speed_rpm, 1.0}, {3600.0, speed_rpm, 2.0}, {3600.0, 0.0, 2.0}};
  const std::vector<double> load_W = values(next_run(BlindKind::one, seed, schedule, 2), "load_W");
  EXPECT_NEAR(load_W[10], mean(there_W), 0.02 * mean(there_W));  // stretches end between rows
  EXPECT_NEAR(load_W[70], 2.0 * load_W[10], 1e-9);
  EXPECT_EQ(load_W[150], 0.0);
}

// Begun warm, the machine is not at the room's temperature, and goes on from there without a jump.
TEST(NextRun, BegunWarmItGoesOn) {
  std::uint64_t seed = 1;
  while (values(blind_set(BlindKind::one, seed).data, "speed_rpm").back() == 0.0) ++seed;
  Schedule schedule = staircase();
  const Series cold = next_run(BlindKind::one, seed, schedule, 2);
  schedule.starts_warm = true;
  const Series warm = next_run(BlindKind::one, seed, schedule, 2);
  EXPECT_EQ(warm.time_s, cold.time_s);
  EXPECT_EQ(values(warm, "speed_rpm"), values(cold, "speed_rpm"));
  EXPECT_GT(values(warm, "T_front_degC").front(), values(cold, "T_front_degC").front() + 1.0);
  EXPECT_LT(values(warm, "T_front_degC")[25], values(warm, "T_front_degC")[0]);  // it cools at rest
}

// The noise has its memory in time, not from row to row.
TEST(NextRun, ASlowerReadingHasTheSameNoise) {
  Schedule schedule = staircase();
  schedule.reading_s = 300.0;
  for (Dwell& dwell : schedule.dwells) dwell.duration_s *= 5.0;
  EXPECT_EQ(next_run(BlindKind::nothing, 2, schedule, 2).time_s.size(), 331U);
  std::size_t tried = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::optional<Left> left = left_of(BlindKind::nothing, seed, schedule);
    if (!left) continue;
    EXPECT_NEAR(left->neighbours, 0.0, 0.25) << seed;
    ++tried;
  }
  EXPECT_GE(tried, 3U);
  schedule.reading_s = 0.0;
  const Series data = blind_set(BlindKind::nothing, 2).data;
  EXPECT_EQ(next_run(BlindKind::nothing, 2, schedule, 2).time_s[1], data.time_s[1] - data.time_s[0]);
}

TEST(NextRun, AScheduleOfNothingIsRefused) {
  for (const double lasts_s : {0.0, 59.0}) {
    Schedule schedule;
    if (lasts_s > 0.0) schedule.dwells = {{lasts_s, 1000.0}};
    try {
      (void)next_run(BlindKind::one, 1, schedule, 2);
      ADD_FAILURE() << lasts_s;
    } catch (const Error& error) {
      EXPECT_EQ(
          std::string(error.what()),
          fmt::format("schedule: expected at least as long as from reading to reading, 60 s, found {:g} s.", lasts_s));
    }
  }
}

VirtualSpindle milling_spindle() {
  VirtualSpindle machine;
  machine.plan = {.time_s = {0.0, 3600.0}, .speed_rpm = {0.0, 9000.0}, .end_s = 7200.0};
  machine.plan.room_time_s = {0.0, 3600.0, 7200.0};
  machine.plan.room_degC = {20.0, 23.0, 21.0};
  machine.measurement.not_logged = {"load_W"};
  return machine;
}

// The room stays within its curve and comes back at its end without a jump: 3 K in an hour are 0.05 K a row, and the
// sensor has steps of 0.1 K and a noise of 0.03 K.
TEST(NextRun, AVirtualSpindleRunsAgain) {
  const Series run = next_run(milling_spindle(), staircase(), 1, 2);
  EXPECT_EQ(run.time_s.size(), 331U);
  EXPECT_EQ(find_column(run, "load_W"), nullptr);
  const std::vector<double>& room = values(run, "T_room_degC");
  for (std::size_t i = 1; i < room.size(); ++i) {
    EXPECT_NEAR(room[i], 21.5, 1.8);
    EXPECT_LT(std::abs(room[i] - room[i - 1]), 0.36) << i;
  }
  EXPECT_GT(range_of(room), 2.0);
  EXPECT_GT(range_of(values(run, "T_front_degC")), 5.0);
  const std::vector<double> first = values(run, "y_um"),
                            again = values(next_run(milling_spindle(), staircase(), 1, 2), "y_um"),
                            other = values(next_run(milling_spindle(), staircase(), 1, 3), "y_um");
  EXPECT_EQ(first, again);
  EXPECT_GT(std::abs(first[0] - other[0]), 1.0);  // another set-up
  VirtualSpindle still = milling_spindle();
  still.plan.room_time_s.clear();
  still.plan.room_degC.clear();
  EXPECT_NEAR(mean(values(next_run(still, staircase(), 1, 2), "T_room_degC")), 20.0, 0.02);
}

}  // namespace
}  // namespace ballbar
