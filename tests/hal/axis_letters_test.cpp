#include <gtest/gtest.h>

#include <vector>

#include "ballbar/error.hpp"
#include "hal/hal_names.hpp"

namespace ballbar::hal {
namespace {

std::string found(const std::string& name) {
  try {
    return letters_of(std::vector{CompensatedAxis{name, {}}});
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(HalAxisLetters, LinearAxes) {
  std::vector<CompensatedAxis> axes;
  for (const char* name : {"x", "y", "z", "u", "v", "w"}) {
    axes.push_back({name, {}});
  }
  EXPECT_EQ(letters_of(axes), "xyzuvw");
}

TEST(HalAxisLetters, Faults) {
  for (const std::string name : {"a", "b", "c", "xy", "spindle", ""}) {
    EXPECT_EQ(found(name), "--to: expected the letter of a linear axis, one of x y z u v w, found '" + name +
                               "': an offset is a length, which the angles a b c cannot take.");
  }
}

}  // namespace
}  // namespace ballbar::hal
