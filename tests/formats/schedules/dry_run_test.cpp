#include "ballbar/formats/schedules/dry_run.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

// G04 of Fanuc counts in milliseconds where there is no point, X without one in micrometres.
TEST(dry_run, fanuc_counts_in_its_least_step) {
  const DryRun run = dry_run_of(
      "%\nO1\nS100 M03\nG04 X5000\nG04 X5.\nG04 P250\nM05\nG54\nM00\nG01 X100000 Y0. F500\n"
      "G03 I-100. J0.\nM30\n",
      Dialect::fanuc);
  EXPECT_EQ(run.duration_s, 10.25);
  ASSERT_EQ(run.circles.size(), 1u);
  EXPECT_EQ(run.circles[0].radius_mm, 100.0);
}

TEST(dry_run, what_it_does_not_know_or_must_not_be) {
  struct Row {
    Dialect dialect;
    const char *program, *message;
  };
  const Dialect fanuc = Dialect::fanuc, siemens = Dialect::siemens, linuxcnc = Dialect::linuxcnc,
                heidenhain = Dialect::heidenhain;
  const Row table[] = {
      {fanuc, "", "program:1:1: expected text, found an empty file."},
      {fanuc, "M05\n", "program:2:1: expected M30 or M2, found the end of the text."},
      {fanuc, "G00 X1.\nM30\n", "program:1:1: expected a G function of such a program, found G0."},
      {fanuc, "M06\nM30\n", "program:1:1: expected an M function of such a program, found M6."},
      {fanuc, "S100 M03 T7\nM30\n", "program:1:1: expected words of such a program, found T."},
      {fanuc, "S1 S2 M03\nM30\n", "program:1:4: expected each word once in a block, found S again."},
      {fanuc, "M03\nM30\n", "program:1:1: expected a speed before the spindle is started, found none."},
      {fanuc, "S100 M03\nM00\nM30\n",
       "program:2:1: expected the spindle at rest at a programmed stop, found it turning."},
      {fanuc, "S100 M03\nM19\nM30\n",
       "program:2:1: expected the spindle at rest where it is oriented, found it turning."},
      {fanuc, "S100 M03\nG54\nG01 X1. F5\nM30\n",
       "program:3:1: expected the spindle at rest before a move, found it turning."},
      {fanuc, "M00\nG01 X1. F5\nM30\n", "program:2:1: expected the workpiece's zero (G54) before a move, found none."},
      {fanuc, "G54\nM00\nG01 X1.\nM30\n", "program:3:1: expected a feed before a move, found none."},
      {fanuc, "G54\nG01 X1. F5\nM30\n", "program:2:1: expected a stop for the operator before a move, found none."},
      {fanuc, "G54\nM00\nG01 X100. F5\nG03 X90. Y0. I-100. J0.\nM30\n",
       "program:4:1: expected an arc that ends where it begins, found another."},
      {fanuc, "G54\nM00\nG01 X100. F5\nG03 I0.\nM30\n", "program:4:1: expected a radius above 0, found 0 mm."},
      {fanuc, "G54\nM00\nG01 X100. F0\nM30\n", "program:3:1: expected a feed above 0, found 0."},
      {fanuc, "G54\nM00\nG01 X1000000. F5\nM30\n", "program:3:1: expected a place within 100 m, found X1000000 Y0."},
      {fanuc, "G04 X100000.\nM30\n", "program:1:1: expected a dwell of 0 to 99999.999 s, found 100000."},
      {fanuc, "G04 F5.\nM30\n", "program:1:1: expected X with the time of G4, found none."},
      {siemens, "G4 X5\nM30\n", "program:1:1: expected F with the time of G4, found none."},
      {linuxcnc, "G4 X5\nM2\n", "program:1:1: expected P with the time of G4, found none."},
      {linuxcnc, "G4 P-1\nM2\n", "program:1:1: expected a dwell of 0 to 1000000000 s, found -1."},
      {linuxcnc, "(a (b)\nM2\n", "program:1:1: expected no ( in a comment, found one."},
      {linuxcnc, "(a\nM2\n", "program:1:1: expected a comment to end on its line, found no )."},
      {linuxcnc, "M5 hello\nM2\n", "program:1:4: expected a word such as X100, found \"hello\"."},
      {linuxcnc, "S2000000 M3\nM2\n", "program:1:1: expected a speed of 0 to 1000000 rpm, found 2000000."},
      {heidenhain, "0 BEGIN PGM A INCH\n", "program:1:1: expected BEGIN PGM NAME MM, found \"BEGIN PGM A INCH\"."},
      {heidenhain, "0 BEGIN PGM A MM\n2 M5\n", "program:2:1: expected block 1, found \"2 M5\"."},
      {heidenhain, "0 BEGIN PGM A MM\n1 M5\n", "program:3:1: expected M30, found the end of the text."},
      {heidenhain, "0 BEGIN PGM A MM\n1 LBL 1\n", "program:2:1: expected a block of such a program, found \"LBL 1\"."},
      {heidenhain, "0 BEGIN PGM A MM\n1 M8\n", "program:2:1: expected an M function of such a program, found M8."},
      {heidenhain, "0 BEGIN PGM A MM\n1 M5 M9\n", "program:2:1: expected the end of the block, found \" M9\"."},
      {heidenhain, "0 BEGIN PGM A MM\n1 CYCL DEF 9.0 DWELL TIME\n2 M5\n",
       "program:3:1: expected CYCL DEF 9.1, found another block."},
      {heidenhain, "0 BEGIN PGM A MM\n1 CYCL DEF 9.0 DWELL TIME\n2 CYCL DEF 9.1 DWELL 3601\n",
       "program:3:1: expected a dwell of 0 to 3600 s, found 3601."},
      {heidenhain, "0 BEGIN PGM A MM\n1 L X+1 Z+5 R0 F9\n", "program:2:1: expected Y, found \" Z+5 R0 F9\"."},
      {heidenhain, "0 BEGIN PGM A MM\n1 M0\n2 L X+1 Y+0 R0 F9\n3 C X+1 Y+0\n",
       "program:4:1: expected DR+ or DR-, found \"\"."},
      {heidenhain, "0 BEGIN PGM A MM\n1 TOOL CALL Z SX\n", "program:2:1: expected a number, found \"X\"."},
  };
  for (const Row& row : table) {
    try {
      dry_run_of(row.program, row.dialect);
      ADD_FAILURE() << row.program << ": no message";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), row.message);
    }
  }
}

}  // namespace
}  // namespace ballbar
