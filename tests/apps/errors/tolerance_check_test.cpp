#include "errors/tolerance_check.hpp"

#include <gtest/gtest.h>

#include "errors/stored_test.hpp"

namespace ballbar {
namespace {

using Texts = std::vector<std::string>;

TEST(tolerance_check, circularity_passes_up_to_the_tolerance) {
  const ToleranceCheck on_it{6.0, 6.0, {}, {}};
  EXPECT_EQ(passes(on_it), true);
  EXPECT_EQ(texts_of(tolerance_lines(on_it)),
            Texts{"circularity 6.0 um: passes the tolerance of 6 um (largest less smallest reading about the fitted "
                  "centre)"});
  // With one decimal it would be the tolerance.
  const ToleranceCheck beyond{6.0, 6.004, "run 1", {}};
  EXPECT_EQ(passes(beyond), false);
  EXPECT_EQ(texts_of(tolerance_lines(beyond)),
            Texts{"circularity 6.004 um, stored: fails the tolerance of 6 um (AF_CIRCULARITY of run 1)"});
}

TEST(tolerance_check, without_a_tolerance_or_a_circularity_nothing_passes) {
  EXPECT_FALSE(passes(ToleranceCheck{{}, 6.0, {}, {}}));
  EXPECT_TRUE(tolerance_lines(ToleranceCheck{{}, 6.0, {}, {}}).empty());
  EXPECT_FALSE(passes(ToleranceCheck{6.0, {}, {}, {}}));
}

TEST(tolerance_check, a_limit_in_the_file_fails_but_a_warning_does_not) {
  B5r file;
  file.limits = {{"A", "AF_SQUARENESS", "UT_SQUARENESS", "WARNING", -20.0, 20.0},
                 {"A", "AF_BACKLASH_A_POS", "UT_LENGTH_UM", "FAIL", -2.0, 2.0},
                 {"A", "AF_RMS", "UT_LENGTH_UM", "FAIL", {}, 2.0}};
  file.stored = {{"A 1", "AF_SQUARENESS", "UT_SQUARENESS", 25.0},
                 {"A 1", "AF_BACKLASH_A_POS", "UT_LENGTH_UM", 9.0, false},
                 {"A 1", "AF_RMS", "UT_LENGTH_UM", 1.0}};
  ToleranceCheck check{6.0, 5.0, {}, limit_checks(file)};
  EXPECT_EQ(passes(check), true);
  file.stored[1].valid = true;
  check.limits = limit_checks(file);
  EXPECT_EQ(passes(check), false);
  const Texts texts = texts_of(tolerance_lines(check));
  EXPECT_EQ(Texts(texts.begin() + 1, texts.end()),
            (Texts{"AF_SQUARENESS 25 um/m, stored (A 1): is beyond the warning limit in the file",
                   "AF_BACKLASH_A_POS 9 um, stored (A 1): fails the limit in the file",
                   "1 stored result passes the limits in the file"}));
}

TEST(tolerance_check, row_of_a_table) {
  MachineTest test;
  EXPECT_FALSE(passes(test, 6.0));
  test.quantities = {{"circularity", "um", 6.5}};
  EXPECT_EQ(passes(test, 7.0), true);
  EXPECT_EQ(passes(test, 6.0), false);
  test.beyond_limits = {"AF_RMS"};
  EXPECT_EQ(passes(test, 7.0), false);
}

TEST(tolerance_check, stored_circularity_is_that_of_the_diagnosis_else_the_larger_run) {
  B5r file;
  EXPECT_FALSE(stored_circularity(file));
  file.stored = {{"run 0", "AF_CIRCULARITY", "UT_LENGTH_MM", 0.0065},
                 {"run 1", "AF_CIRCULARITY", "UT_LENGTH_MM", 0.006}};
  ASSERT_TRUE(stored_circularity(file));
  EXPECT_DOUBLE_EQ(stored_circularity(file)->value, 6.5);
  EXPECT_EQ(stored_circularity(file)->parent, "run 0");
  file.stored.push_back({"RENISHAW_DIAGNOSTICS 2.1", "AF_CIRCULARITY", "UT_LENGTH_UM", 6.4});
  EXPECT_EQ(stored_circularity(file)->value, 6.4);
  const MachineTest test = stored_test(file);
  ASSERT_EQ(test.quantities.size(), 1u);
  EXPECT_EQ(test.quantities[0].value, 6.4);
}

}  // namespace
}  // namespace ballbar
