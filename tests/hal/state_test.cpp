#include "state.hpp"

#include <gtest/gtest.h>

#include <array>

#include "ballbar/error.hpp"
#include "ballbar/formats/model_toml.hpp"

namespace ballbar::hal {
namespace {

Model model(const std::string& column) {
  return read_model(
      "format = \"ballbar-model 1\"\ntarget = \"z_um\"\nconstant_um = 0.0\n[[effect]]\nname = \"lagged_expansion\"\n"
      "temperature = \"" +
          column + "\"\ngain_um_per_K = 2.0\ntime_constant_s = 600\n",
      "live.toml");
}

std::string fault(const std::string& text, const std::string& column, double resolution_um) {
  CompensationLimits limits;
  limits.resolution_um = resolution_um;
  Compensator compensator(model(column), limits);
  try {
    resume(compensator, text, "z.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(HalState, GoesOnAsIfItHadNotStopped) {
  Compensator through(model("T_degC"), {}), before(model("T_degC"), {}), after(model("T_degC"), {});
  const auto T_degC = [](int row) { return std::array{20.0 + 0.3 * row}; };
  for (int row = 0; row < 5; ++row) {
    through.next(10.0 * row, T_degC(row));
    before.next(10.0 * row, T_degC(row));
  }
  resume(after, write_state(before), "z.json");
  EXPECT_EQ(write_state(after), write_state(before));
  for (int row = 5; row < 20; ++row) {
    const Offset want = through.next(10.0 * row, T_degC(row)), found = after.next(10.0 * row, T_degC(row));
    EXPECT_EQ(found.counts, want.counts);
    EXPECT_EQ(found.predicted_um, want.predicted_um);  // to the last bit
  }
  EXPECT_NE(after.state().counts, 0);
}

TEST(HalState, BeforeTheFirstRow) {
  Compensator before(model("T_degC"), {}), after(model("T_degC"), {});
  resume(after, write_state(before), "z.json");
  EXPECT_EQ(after.next(0.0, std::array{20.0}).counts, 0);
}

TEST(HalState, Faults) {
  const std::string good = write_state(Compensator(model("T_degC"), {}));
  EXPECT_EQ(fault(good, "T_degC", 0.1), "none");
  EXPECT_EQ(fault(good, "T_oil_degC", 0.1), "z.json: this is the state of a model of other columns: [\"T_degC\"].");
  EXPECT_EQ(fault(good, "T_degC", 0.2), "z.json: expected the state of a resolution of 0.2 um, found one of 0.1 um.");
  EXPECT_EQ(fault("{\"format\": \"x\"}", "T_degC", 0.1), "z.json: expected format \"ballbar-hal-state 1\".");
  EXPECT_EQ(fault("{}", "T_degC", 0.1).substr(0, 57), "z.json: expected a state that ballbar-hal wrote: [json.ex");
  EXPECT_EQ(fault(good.substr(0, 40), "T_degC", 0.1).substr(0, 50),
            "z.json: expected a state that ballbar-hal wrote: [");
}

}  // namespace
}  // namespace ballbar::hal
