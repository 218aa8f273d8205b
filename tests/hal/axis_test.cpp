// From what is wanted to changes of counts; a count is 0.1 um, a row brings at most 1 um, the model 2 um/K from 20
// degC.
#include "hal/axis.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "ballbar/formats/models/model_toml.hpp"

namespace ballbar::hal {
namespace {

constexpr double kNotConnected = std::numeric_limits<double>::quiet_NaN();

Model model() {
  return read_model(
      "format = \"ballbar-model 1\"\ntarget = \"z_um\"\nconstant_um = 0.0\n[[effect]]\nname = \"expansion\"\n"
      "temperature = \"T_degC\"\ngain_um_per_K = 2.0\n",
      "live.toml");
}

// A control that adds changes of counts while it is on, as LinuxCNC does.
struct Control {
  CompensationLimits limits{.step_um = 1.0};
  Compensator compensator{model(), limits};
  Axis axis{limits};
  Pins pins{.enable = true, .applied_mm = 0.0};
  double time_s = 0.0;

  Step row(double T_degC) {
    axis.begin(pins, compensator);
    const Step step = axis.end(compensator.next(time_s, std::array{T_degC}), compensator);
    const bool known = std::abs(pins.applied_mm) * 1000.0 <= limits.largest_um;
    EXPECT_TRUE(!known || compensator.state().counts == step.offset.counts);  // which is what is stored
    time_s += 10.0;
    pins.applied_mm += static_cast<double>(step.change) * axis.scale_mm();
    return step;
  }
};

TEST(HalAxis, WalksToWhatIsWanted) {
  Control control;
  EXPECT_EQ(control.row(20.0).change, 0);
  EXPECT_EQ(control.row(20.7).change, -10);  // of -14
  const Step step = control.row(20.7);
  EXPECT_EQ(step.change, -4);
  EXPECT_EQ(step.offset.counts, -14);
  EXPECT_DOUBLE_EQ(step.offset.offset_um, -1.4);
  EXPECT_EQ(control.row(20.7).change, 0);
  EXPECT_NEAR(control.pins.applied_mm, -0.0014, 1e-12);
}

TEST(HalAxis, EnablesARowLaterAndDisablesAtOnce) {
  Control control;
  const Step first = control.row(20.0);
  EXPECT_FALSE(first.enable);
  EXPECT_EQ(first.reason, Reason::disabled);
  EXPECT_TRUE(control.row(20.5).enable);
  control.pins.enable = false;
  const Step off = control.row(22.0);
  EXPECT_FALSE(off.enable);
  EXPECT_EQ(off.change, 0);
  EXPECT_EQ(off.reason, Reason::disabled);
}

TEST(HalAxis, GoesOnFromWhatTheControlHas) {
  Control control;
  control.pins.applied_mm = -0.0004;  // of a component that was killed
  EXPECT_EQ(control.row(20.0).change, 0);
  EXPECT_EQ(control.row(20.0).change, 4);
  EXPECT_NEAR(control.pins.applied_mm, 0.0, 1e-12);
}

TEST(HalAxis, HoldsUntilTheControlsOffsetIsConnected) {
  Control control;
  control.pins.applied_mm = kNotConnected;
  control.row(20.0);
  for (int row = 0; row < 3; ++row) {
    const Step step = control.row(20.5);
    EXPECT_EQ(step.reason, Reason::control);
    EXPECT_EQ(step.change, 0);
  }
  control.pins.applied_mm = 0.0;
  EXPECT_EQ(control.row(20.5).change, -10);
}

TEST(HalAxis, BeginsAtZeroWithAControlThatWasTurnedOff) {
  Control control;
  control.row(20.0);
  control.row(20.5);
  EXPECT_NEAR(control.pins.applied_mm, -0.001, 1e-12);
  control.pins.applied_mm = 0.0;
  const Step doubt = control.row(20.5);
  EXPECT_EQ(doubt.reason, Reason::control);
  EXPECT_EQ(doubt.change, 0);
  EXPECT_EQ(control.row(20.5).change, -10);
  EXPECT_EQ(control.row(20.5).change, 0);
  EXPECT_NEAR(control.pins.applied_mm, -0.001, 1e-12);
}

TEST(HalAxis, GivesTheControlOneRowToTakeAChangeUp) {
  Control control;
  control.row(20.0);
  control.row(21.0);
  control.pins.applied_mm = 0.0;  // as read before the control's next period
  EXPECT_EQ(control.row(21.0).reason, Reason::control);
  control.pins.applied_mm = -0.001;
  const Step step = control.row(21.0);
  EXPECT_EQ(step.reason, Reason::none);
  EXPECT_EQ(step.change, -10);
  EXPECT_NEAR(control.pins.applied_mm, -0.002, 1e-12);
}

TEST(HalAxis, HoldsWhileAnotherOffsetIsLargerThanOursCanBe) {
  Control control;
  control.pins.applied_mm = 0.3;  // 300 um; ours is at most 200
  control.row(20.0);
  for (int row = 0; row < 3; ++row) {
    const Step step = control.row(20.0 + 0.5 * row);
    EXPECT_EQ(step.reason, Reason::control);
    EXPECT_EQ(step.change, 0);
  }
  control.pins.applied_mm = std::numeric_limits<double>::infinity();
  EXPECT_EQ(control.row(21.0).reason, Reason::control);
}

TEST(HalAxis, TheLargestOffsetIsNoHoldWhereItsChangesAddUpToMore) {
  Control control;
  for (int change = 0; change < 200; ++change) control.pins.applied_mm += 10.0 * control.axis.scale_mm();
  EXPECT_GT(control.pins.applied_mm, 0.2);  // 0.20000000000000015
  control.row(20.0);
  const Step step = control.row(20.0);
  EXPECT_EQ(step.reason, Reason::none);
  EXPECT_EQ(step.change, -10);
}

// 200.05 um are 2000 whole counts; a control with 200.05 um has 2000.5, which is read as 2001.
TEST(HalAxis, HoldsWhereTheNearestCountIsLargerThanOursCanBe) {
  Control control{.limits = {.step_um = 1.0, .largest_um = 200.05}};
  control.pins.applied_mm = 0.20005;
  control.row(20.0);
  EXPECT_EQ(control.row(20.0).reason, Reason::control);
  control.pins.applied_mm = -0.20005;
  EXPECT_EQ(control.row(20.0).reason, Reason::control);
  control.pins.applied_mm = 0.20003;
  control.row(20.0);
  EXPECT_EQ(control.row(20.0).reason, Reason::none);
}

// To a double 0.3 / 0.1 is less than 3, and 3 times 0.1 more than 0.3.
TEST(HalAxis, GoesOnFromTheLargestOffsetWhateverItsRounding) {
  Control control{.limits = {.step_um = 1.0, .largest_um = 0.3}};
  for (const double applied_mm : {0.0003, -0.0003}) {
    control.pins.applied_mm = applied_mm;
    control.row(20.0);
    const Step step = control.row(20.0);
    EXPECT_EQ(step.reason, Reason::none);
    EXPECT_EQ(step.offset.counts, 0);
  }
}

TEST(HalAxis, HoldsForASensorFirst) {
  Control control;
  control.row(20.0);
  control.pins.enable = false;
  EXPECT_EQ(control.row(kNotConnected).reason, Reason::no_value);
  control.pins.enable = true;
  EXPECT_EQ(control.row(60.0).reason, Reason::spike);
  EXPECT_EQ(control.row(20.5).change, -10);
}

TEST(HalAxis, ReasonsKeepTheirNumbersAndNames) {
  for (const Hold hold : {Hold::none, Hold::no_value, Hold::spike, Hold::stuck, Hold::out_of_range, Hold::clock_back,
                          Hold::clock_gap, Hold::model, Hold::no_time}) {
    EXPECT_EQ(name_of(reason_of(hold)), name_of(hold));
    EXPECT_EQ(reason_of(hold) == Reason::none, hold == Hold::none);
  }
  EXPECT_STREQ(name_of(Reason::disabled), "disabled");
  EXPECT_STREQ(name_of(Reason::control), "control");
}

}  // namespace
}  // namespace ballbar::hal
