#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

Model model_of(std::string target, std::string effect, std::vector<std::string> columns, double gain) {
  Model model;
  model.targets = {std::move(target)};
  model.terms = {term_of(effect, std::move(columns))};
  model.terms[0].settings[0].start = gain;
  return model;
}

CompensationLimits quick() {
  CompensationLimits limits;
  limits.rate_um_per_s = 100.0;
  limits.step_um = 100.0;
  limits.spike_K = 100.0;
  return limits;
}

// z = 2 um/K (T_a - T_a0), y = 3 um/K (T_b - T_b0), x = 0.5 z: each its own columns of one row.
TEST(CompensatedAxes, ReadTheirOwnColumnsAndWhatAnAxisBeforePredicts) {
  CompensatedAxes axes({{"z", model_of("z_um", "expansion", {"T_a_degC"}, 2.0)},
                        {"y", model_of("y_um", "expansion", {"T_b_degC"}, 3.0)},
                        {"x", model_of("x_um", "axial_crosstalk", {"z_um"}, 0.5)}},
                       quick());
  ASSERT_EQ(std::vector<std::string>(axes.columns().begin(), axes.columns().end()),
            (std::vector<std::string>{"T_a_degC", "T_b_degC"}));
  axes.next(0.0, {{20.0, 30.0}});
  const auto offsets = axes.next(1.0, {{21.0, 32.0}});
  EXPECT_EQ(offsets[0].counts, -20);
  EXPECT_EQ(offsets[1].counts, -60);
  EXPECT_EQ(offsets[2].counts, -10);
  EXPECT_EQ(axes.name(2), "x");
}

TEST(CompensatedAxes, HoldWithTheAxisTheyRead) {
  CompensatedAxes axes({{"z", model_of("z_um", "expansion", {"T_a_degC"}, 2.0)},
                        {"y", model_of("y_um", "expansion", {"T_b_degC"}, 3.0)},
                        {"x", model_of("x_um", "axial_crosstalk", {"z_um"}, 0.5)}},
                       quick());
  axes.next(0.0, {{20.0, 30.0}});
  const auto offsets = axes.next(1.0, {{std::numeric_limits<double>::quiet_NaN(), 31.0}});
  EXPECT_EQ(offsets[0].hold, Hold::no_value);
  EXPECT_EQ(offsets[1].hold, Hold::none);
  EXPECT_EQ(offsets[1].counts, -30);
  EXPECT_EQ(offsets[2].hold, Hold::no_value);
}

TEST(CompensatedAxes, SayWhichAxisIsWrong) {
  const auto expect_error = [](const std::vector<CompensatedAxis>& axes, const std::string& message) {
    try {
      const CompensatedAxes made(axes, quick());
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  expect_error({}, "expected at least one axis to compensate, found none.");
  const CompensatedAxis z{"z", model_of("z_um", "expansion", {"T_a_degC"}, 2.0)};
  expect_error({z, z}, "expected each axis once, found z again.");
  Model two = z.model;
  two.targets.emplace_back("y_um");
  expect_error({{"z", two}}, "z: expected a model of one target, found 2: each axis has a compensator of its own.");
}

}  // namespace
}  // namespace ballbar
