#include "lasting_fault.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ballbar::hal {
namespace {

using Said = std::optional<std::string>;

// The size of the state is another one every row.
void full_disk() {
  static int size = 0;
  throw std::runtime_error("full: " + std::to_string(++size));
}
void nothing() {}

TEST(HalLastingFault, SaidOnceUntilItIsGone) {
  LastingFault fault(10.0);
  EXPECT_EQ(fault.of(100.0, nothing), Said());
  EXPECT_EQ(fault.of(101.0, full_disk), "full: 1");
  EXPECT_EQ(fault.of(102.0, full_disk), Said());
  EXPECT_EQ(fault.of(103.0, nothing), Said());  // nothing was tried: ten seconds have not gone by
  EXPECT_EQ(fault.of(104.0, full_disk), Said());
  EXPECT_EQ(fault.of(114.0, nothing), Said());  // not yet more than ten
  EXPECT_EQ(fault.of(115.0, full_disk), Said());
  EXPECT_EQ(fault.of(125.5, nothing), Said());  // tried, and gone
  EXPECT_EQ(fault.of(126.0, full_disk), "full: 5");
}

TEST(HalLastingFault, TriedEveryTime) {
  LastingFault fault(0.0);
  EXPECT_EQ(fault.of(1.0, full_disk)->substr(0, 4), "full");
  EXPECT_EQ(fault.of(2.0, full_disk), Said());
  EXPECT_EQ(fault.of(3.0, nothing), Said());
  EXPECT_EQ(fault.of(4.0, full_disk)->substr(0, 4), "full");
}

}  // namespace
}  // namespace ballbar::hal
