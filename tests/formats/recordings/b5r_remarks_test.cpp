// What a `.b5r` can do without: a remark with its place, and the file is read.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bad_text.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"

namespace ballbar {
namespace {

struct Remarked {
  std::string_view kind, from, to;
  std::vector<std::string> remarks;
};

const Remarked kRemarked[] = {
    {"b5r", "old", "old", {"file:22:4: expected a CCW and a CW run, found one CW run."}},
    {"both",
     "20250904-161049",
     "03/04/2026",
     {"file:45:17: expected a date such as 20250904-161049 or 2025-09-04T16:10:49 for DATE_STARTED, found "
      "\"03/04/2026\"; the test is read without a date."}},
    {"both",
     "20250904-161049",
     "20250230-161049",
     {"file:45:17: expected a date such as 20250904-161049 or 2025-09-04T16:10:49 for DATE_STARTED, found "
      "\"20250230-161049\"; the test is read without a date."}},
    {"both", "20250904-161049", "2025-09-04T16:10:49Z", {}},
    {"both",
     "20250904-161149",
     "4 Sept",
     {"file:46:19: expected a date such as 20250904-161049 or 2025-09-04T16:10:49 for DATE_COMPLETED, found \"4 "
      "Sept\"; it is ignored."}},
    {"both",
     "20240416",
     "spring 2024",
     {"file:55:24: expected a date such as 20250904-161049 or 2025-09-04T16:10:49 for LAST_CALIBRATED, found \"spring "
      "2024\"; it stays as it is."}},
    {"both",
     "<PROGRAMMED_FEEDRATE>1500",
     "<PROGRAMMED_FEEDRATE>0",
     {"file:7:30: expected PROGRAMMED_FEEDRATE above 0, found \"0\"; it is ignored."}},
    {"both",
     "<PROGRAMMED_FEEDRATE>1500",
     "<PROGRAMMED_FEEDRATE>-1500",
     {"file:7:30: expected PROGRAMMED_FEEDRATE above 0, found \"-1500\"; it is ignored."}},
    {"both",
     "<PROGRAMMED_FEEDRATE>1500",
     "<PROGRAMMED_FEEDRATE>F1500",
     {"file:7:30: expected a finite number for PROGRAMMED_FEEDRATE, decimals with a point, found \"F1500\"; it is "
      "ignored."}},
    {"both", "<PROGRAMMED_FEEDRATE>1500", "<PROGRAMMED_FEEDRATE>-", {}},
    {"both",
     "50.0031",
     "50,0031",
     {"file:61:26: expected a finite number for CALIBRATED_LENGTH, decimals with a point, found \"50,0031\"; it is "
      "ignored."}},
    {"both",
     " A. Meier ",
     "<NAME>A. Meier</NAME>",
     {"file:42:4: expected plain text in OPERATOR, found elements; it is ignored."}},
    {"both",
     "<LOWER_LIMIT>-0.1",
     "<LOWER_LIMIT>low",
     {"file:21:28: expected a finite number for LOWER_LIMIT, decimals with a point, found \"low\"; it is ignored."}},
    {"both",
     "<LOWER_LIMIT>-0.1",
     "<LOWER_LIMIT>0.3",
     {"file:20:14: expected a LOWER_LIMIT at or below UPPER_LIMIT 0.1 for AF_OFFSET_A, found 0.3; the limits are left "
      "out."}},
    {"both",
     "\"AF_OFFSET_A\" DT=\"UT_LENGTH_MM\"",
     "\"AF_OFFSET_A\"",
     {"file:19:12: expected a FEATURE_SPEC with NAME and DT, found one without; the limits are left out."}},
    {"both",
     "    <SIMULATION NAME=\"AF_SIMULATED_READINGS_CW\">+0.04004 0.06006</SIMULATION>\n",
     "",
     {"file:93:4: expected the curve AF_SIMULATED_READINGS_CW beside the values of RENISHAW_DIAGNOSTICS, found none; "
      "the stored values stand without it."}},
    {"both",
     "0.01001 -0.02002 0.03003",
     "0.01001 -0.02002",
     {"file:95:6: expected 3 values in AF_SIMULATED_READINGS_CCW, as many as the CCW run has used readings, found 2; "
      "the curve is left out."}},
    {"both",
     "0.01001 -0.02002 0.03003",
     "",
     {"file:95:6: expected 3 values in AF_SIMULATED_READINGS_CCW, as many as the CCW run has used readings, found 0; "
      "the curve is left out."}},
    {"both",
     "0.01001 -0.02002 0.03003",
     "0.01001 nan 0.03003",
     {"file:95:58: expected a finite number for AF_SIMULATED_READINGS_CCW, decimals with a point, found \"nan\"; the "
      "curve is left out."}},
    {"both",
     "<READINGS>+0.05 +0.01 -0.02 +0.03 +0.05</READINGS>",
     "",
     {"file:72:6: No readings in the CCW run; showing the results stored by the instrument software.",
      "file:95:6: expected readings of the CCW run for the curve AF_SIMULATED_READINGS_CCW, found none; the curve is "
      "left out."}},
    {"both",
     "READINGS>",
     "OTHER>",
     {"file:71:4: No readings in this file; showing the results stored by the instrument software."}},
    {"both",
     "<RUN_DIRECTION>CCW</RUN_DIRECTION>\n      <RUN_T",
     "<RUN_DIRECTION>CW</RUN_DIRECTION>\n      <RUN_T",
     {"file:81:6: expected a CCW and a CW run, found two CW runs.",
      "file:95:6: expected readings of the CCW run for the curve AF_SIMULATED_READINGS_CCW, found none; the curve is "
      "left out.",
      "file:96:6: expected 3 values in AF_SIMULATED_READINGS_CW, as many as the CW run has used readings, found 2; the "
      "curve is left out."}},
    {"both",
     "BALLBAR_RUN",
     "OTHER_RUN",
     {"file:71:4: No readings in this file; showing the results stored by the instrument software."}},
    {"both",
     "RUN_RESULTS",
     "OTHER_RESULTS",
     {"file:2:2: No readings in this file; showing the results stored by the instrument software."}},
};

TEST(b5r_remarks, say_what_is_at_fault_and_what_becomes_of_it) {
  for (const Remarked& one : kRemarked) {
    EXPECT_EQ(read_b5r(changed(one.kind, one.from, one.to), "file").remarks, one.remarks)
        << one.from << " as " << one.to;
  }
}

TEST(b5r_remarks, are_not_more_than_twenty) {
  std::string limits;
  for (int i = 0; i < 100; ++i) limits += "<LOWER_LIMIT>x</LOWER_LIMIT></TOLERANCE><TOLERANCE>";
  const B5r test = read_b5r(changed("both", "<LOWER_LIMIT>-</LOWER_LIMIT>", limits), "file");
  EXPECT_EQ(test.remarks.size(), 20u);
  EXPECT_EQ(test.limits.size(), 2u);  // the third would stand behind the faults
}

TEST(b5r_remarks, neither_readings_nor_results_are_an_error) {
  std::string text = changed("b5r", "FEATURE", "OTHER");
  const std::string_view readings = "+0.00900 +0.00100 -0.00200 0.00300 +0.00900";
  text.erase(text.find(readings), readings.size());
  try {
    read_b5r(text, "file");
    ADD_FAILURE() << "no complaint";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "file:22:4: expected READINGS or stored results, found neither.");
  }
}

}  // namespace
}  // namespace ballbar
