#include "ballbar/internal/diagnosis/injection/injection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/range.hpp"

namespace ballbar {
namespace {

Series data() {
  Series series;
  series.time_s = {0.0, 100.0, 200.0, 300.0};
  series.columns = {{"T_air_degC", Role::ambient, {20.0, 21.0, 23.0, 22.0}},
                    {"T_still_degC", Role::ambient, {20.0, 20.0, 20.0, 20.0}},
                    {"T_gap_degC", Role::ambient, {20.0, NAN, 20.5, 20.0}},
                    {"z_um", Role::measured, {1.0, 1.0, NAN, 1.0}}};
  return series;
}

BoundEffect expansion(const std::string& column) { return {find_effect("expansion", Level::series), {column}}; }

std::string complaint(const std::string& target, const std::string& column) {
  try {
    injected(data(), target, injection_of(expansion(column), data()), 1.0);
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

// The rise 0, 1, 3, 2 K has a range of 3 K: 6 um are 2 um/K.
TEST(Inject, TheRangeIsTheAmplitude) {
  const Series changed = injected(data(), "z_um", injection_of(expansion("T_air_degC"), data()), 6.0);
  const std::vector<double>& z = find_column(changed, "z_um")->values;
  EXPECT_DOUBLE_EQ(z[0], 1.0);
  EXPECT_DOUBLE_EQ(z[1], 3.0);
  EXPECT_TRUE(std::isnan(z[2]));
  EXPECT_DOUBLE_EQ(z[3], 5.0);
  EXPECT_EQ(find_column(changed, "T_air_degC")->values, find_column(data(), "T_air_degC")->values);
}

TEST(Inject, AStepIsPutToTheMiddle) {
  const Injection step = injection_of({find_effect("step", Level::series), {}}, data());
  EXPECT_DOUBLE_EQ(range_of(signal_of(step, data())), 1.0);
}

TEST(Inject, BadInputsAreNamed) {
  EXPECT_EQ(complaint("z_um", "T_oil_degC"), "expected the column T_oil_degC for expansion, found none.");
  EXPECT_EQ(complaint("z_um", "T_still_degC"),
            "expected columns that change for expansion(T_still_degC), found constant ones.");
  EXPECT_EQ(complaint("z_um", "T_gap_degC"),
            "expected columns without gaps for expansion(T_gap_degC), found a gap in them.");
  EXPECT_EQ(complaint("y_um", "T_air_degC"), "expected the column y_um, found none.");
}

TEST(Inject, SightIsWhatTheDiagnosisSays) {
  const BoundEffect one = expansion("T_air_degC"), other = expansion("T_still_degC");
  Diagnosis diagnosis;
  EXPECT_EQ(sight_of(diagnosis, one), Sight::undetected);
  diagnosis.verdict = Verdict::unexplained;
  EXPECT_EQ(sight_of(diagnosis, one), Sight::unexplained);
  diagnosis.candidates = {{.bound = one, .in_best_set = true}};
  EXPECT_EQ(sight_of(diagnosis, one), Sight::candidate);
  EXPECT_EQ(sight_of(diagnosis, other), Sight::unexplained);
  diagnosis.verdict = Verdict::driver;
  diagnosis.drivers = {{other.columns.front(), 0.95}};
  EXPECT_EQ(sight_of(diagnosis, other), Sight::driver);
  diagnosis.drivers.front().p = 0.6;
  EXPECT_EQ(sight_of(diagnosis, other), Sight::undetected);
  diagnosis.verdict = Verdict::probable;
  diagnosis.probable = {other};
  EXPECT_EQ(sight_of(diagnosis, other), Sight::probable);
  diagnosis.probable.clear();
  diagnosis.verdict = Verdict::equivalent;
  diagnosis.equivalent = {{one, other}};
  EXPECT_EQ(sight_of(diagnosis, other), Sight::in_set);
  diagnosis.verdict = Verdict::named;
  diagnosis.named = {one};
  EXPECT_EQ(sight_of(diagnosis, one), Sight::named);
  diagnosis.verdict = Verdict::nothing;
  diagnosis.named.clear();
  diagnosis.equivalent.clear();
  EXPECT_EQ(sight_of(diagnosis, one), Sight::undetected);
}

// White noise of 1 um and a model that is a constant: d^2 = sum (g - mean g)^2; the rises 0, 1, 3, 2 have mean 1.5 and
// d^2 = 2.25 + 0.25 + 2.25 + 0.25 = 5 of 14.
TEST(Inject, SurvivalIsWhatTheModelCannotMake) {
  Fit fit;
  fit.row = {0, 1, 2, 3};
  fit.time_s = data().time_s;
  fit.parameters.resize(1);
  fit.jacobian = Eigen::MatrixXd::Ones(4, 1);
  const Survival survival = survival_of(std::vector<double>{0.0, 1.0, 3.0, 2.0}, fit, {.white_um = 1.0});
  EXPECT_NEAR(survival.d, std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(survival.share, 5.0 / 14.0, 1e-12);
}

}  // namespace
}  // namespace ballbar
