#include "axis_letters.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ballbar/error.hpp"

namespace ballbar::hal {
namespace {

std::string found(const std::string& name, const std::string& target) {
  CompensatedAxis axis{name, {}};
  axis.model.targets = {target};
  try {
    return letters_of(std::vector{axis});
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(HalAxisLetters, LinearAxes) {
  std::vector<CompensatedAxis> axes;
  for (const char* name : {"x", "y", "z", "u", "v", "w"}) {
    axes.push_back({name, {}});
    axes.back().model.targets = {std::string(name) + "_um"};
  }
  EXPECT_EQ(letters_of(axes), "xyzuvw");
}

TEST(HalAxisLetters, Faults) {
  for (const std::string name : {"a", "b", "c", "xy", "spindle", ""}) {
    EXPECT_EQ(found(name, "z_um"), "--to: expected the letter of a linear axis, one of x y z u v w, found '" + name +
                                       "': an offset is a length, which the angles a b c cannot take.");
  }
  EXPECT_EQ(found("z", "z_mm"), "z: expected a target in um, of which its offset is made, found 'z_mm'.");
  EXPECT_EQ(found("z", "z"), "z: expected a target in um, of which its offset is made, found 'z'.");
  EXPECT_EQ(found("z", "tilt_urad"), "z: expected a target in um, of which its offset is made, found 'tilt_urad'.");
}

}  // namespace
}  // namespace ballbar::hal
