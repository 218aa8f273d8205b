// Plans and tallies of the study of next tests.
#include <gtest/gtest.h>

#include <set>

#include "next_test/adapter.hpp"
#include "next_test/plans.hpp"
#include "next_test/tally.hpp"

namespace ballbar::next_test {
namespace {

TEST(Plans, StaircasesFillTheirHoursAndBeginAtRest) {
  for (const double hours : {4.0, 12.0, 24.0}) {
    const Schedule schedule = staircase(hours, 12000.0, 7);
    EXPECT_NEAR(duration_s(schedule), 3600.0 * hours, 1e-6);
    EXPECT_EQ(schedule.dwells.front().speed_rpm, 0.0);
    for (std::size_t k = 1; k < schedule.dwells.size(); ++k) {
      EXPECT_NE(schedule.dwells[k].speed_rpm, schedule.dwells[k - 1].speed_rpm);
      EXPECT_LE(schedule.dwells[k].speed_rpm, 12000.0);
    }
  }
  EXPECT_EQ(staircase(4.0, 12000.0, 7).dwells[2].speed_rpm, staircase(24.0, 12000.0, 7).dwells[2].speed_rpm);
  EXPECT_NE(staircase(4.0, 12000.0, 7).dwells[2].speed_rpm, staircase(4.0, 12000.0, 8).dwells[2].speed_rpm);
}

// 6000 rpm kept for 20 min, 9000 for 5 min alone: the widest gap is from 0 to 6000.
TEST(Plans, FixedPlansRunAtTheSpeedsOfTheData) {
  Series data;
  data.columns = {{"n_rpm", Role::speed, {}}};
  for (int i = 0; i < 60; ++i) {
    data.time_s.push_back(60.0 * i);
    data.columns[0].values.push_back(i < 20 ? 0.0 : i < 40 ? 6000.0 : i < 45 ? 9000.0 : 0.0);
  }
  const std::vector<FixedPlan> once = fixed_plans(data, 0.0, 18000.0), full = fixed_plans(data, 12.0, 18000.0);
  ASSERT_EQ(once.size(), 10U);
  std::set<double> speeds;
  for (const FixedPlan& plan : once) {
    EXPECT_EQ(plan.schedule.dwells.front().speed_rpm, 0.0) << plan.name;
    for (const Dwell& dwell : plan.schedule.dwells) speeds.insert(dwell.speed_rpm);
  }
  EXPECT_EQ(speeds, (std::set<double>{0.0, 3000.0, 6000.0}));
  EXPECT_NEAR(duration_s(once[3].schedule), 600.0 + 3.0 * 3600.0, 1e-6);  // stop and go
  for (const FixedPlan& plan : full) EXPECT_NEAR(duration_s(plan.schedule), 12.0 * 3600.0, 1e-6) << plan.name;
}

TEST(Joined, HasTheRowsOfBothRunsAndAnOffset) {
  Series first;
  first.time_s = {0.0, 60.0};
  first.columns = {{"n_rpm", Role::speed, {0.0, 8000.0}},
                   {"T_degC", Role::structure, {20.0, 30.0}},
                   {"z_um", Role::measured, {1.0, 2.0}}};
  Series second = first;
  second.columns[2].values = {3.0, 5.0};
  Model model;
  model.targets = {"z_um"};
  EXPECT_TRUE(joined(model, {first}).model.terms.empty());
  const Joined both = joined(model, {first, second});
  EXPECT_EQ(find_column(both.data, "z_um")->values, (std::vector<double>{1.0, 2.0, 3.0, 5.0}));
  EXPECT_EQ(both.model.terms.size(), 1U);
}

Looped set_of(const std::vector<bool>& right, const std::vector<double>& promised) {
  Looped set;
  for (std::size_t k = 0; k < right.size(); ++k) {
    Stage stage;
    stage.is_tested = k > 0;
    stage.judged.right = right[k];
    stage.promised = k > 0 ? promised[k - 1] : 0.0;
    stage.hours = 12.0 * static_cast<double>(k);
    set.stages.push_back(stage);
  }
  return set;
}

// Of two tests that promised 0.9 one was right: 40 points off; of the two that promised 0.5 both: 50 points.
TEST(Tally, PromisesAreHeldAgainstWhatCame) {
  const std::vector<Looped> sets{set_of({false, true}, {0.92}), set_of({false, false}, {0.9}),
                                 set_of({false, true}, {0.5}), set_of({true, true}, {0.52})};
  const std::string text = reliability(sets);
  EXPECT_NE(text.find("0.9 to 1.0, mean 0.910      2       50.0 (9.5-90.5)  more than 10 points off\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("0.5 to 0.6, mean 0.510      2    100.0 (34.2-100.0)  more than 10 points off\n"),
            std::string::npos)
      << text;
  const std::string rows = rows_of("cell", "design", sets);
  EXPECT_NE(rows.find("25.0 (4.6-69.9)"), std::string::npos) << rows;  // one of four before any test
  EXPECT_NE(rows.find("75.0 (30.1-95.4)"), std::string::npos) << rows;
}

}  // namespace
}  // namespace ballbar::next_test
