// A high-speed spindle to 24 000 rpm, axial: what the catalogue finds in two measured recordings.
#include <gtest/gtest.h>

#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

Term heating(const char* name) {
  Term term = term_of(name, {"speed_rpm"});
  term.settings.back().held = false;  // the exponent
  return term;
}

Model model_of(const char* heat) {
  Model model;
  model.targets = {"z_um"};
  model.terms = {heating(heat), heating("centrifugal_shift")};
  return model;
}

Series data_of(const std::filesystem::path& folder, const char* set) {
  return *open_model_data({folder / "spindle-24krpm" / set}, {}, 600.0).series;
}

TEST(spindle_24krpm, centrifugal_shift_goes_with_about_the_square_of_the_speed) {
  REQUIRE_EXTERNAL_DATA(folder);
  for (const char* set : {"set-02.csv", "set-04.csv"}) {
    const Fit found = fit(model_of("cooling_asymmetry"), data_of(folder, set));
    const FittedParameter& gain = found.parameters[found.parameters.size() - 2];
    const FittedParameter& exponent = found.parameters.back();
    EXPECT_GT(gain.value, 0.0) << set;
    EXPECT_GT(exponent.value, 1.3) << set;
    EXPECT_LT(exponent.value, 2.3) << set;
  }
}

// Least squares for both: the fits by generalised least squares weigh different parts of the misfit.
TEST(spindle_24krpm, cooling_is_slower_at_rest) {
  REQUIRE_EXTERNAL_DATA(folder);
  const Series data = data_of(folder, "set-04.csv");
  FitOptions least_squares;
  least_squares.white = true;
  const Fit symmetric = fit(model_of("speed_heating"), data, 0, least_squares);
  const Fit asymmetric = fit(model_of("cooling_asymmetry"), data, 0, least_squares);
  EXPECT_LT(asymmetric.rmse_um, 0.5 * symmetric.rmse_um);
  EXPECT_GT(asymmetric.parameters[3].value, 3.0 * asymmetric.parameters[2].value);  // at rest, turning
}

}  // namespace
}  // namespace ballbar
