#include "ballbar/formats/recordings/recording_file.hpp"

#include <gtest/gtest.h>

#include "bad_text.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

TEST(recording_file, is_known_by_content_not_by_name) {
  const ScratchFolder folder;
  const RecordingFile b5r = open_recording(
      folder.write("a.csv", "\xEF\xBB\xBF \n" + good_text("b5r").substr(good_text("b5r").find("<TEST"))));
  EXPECT_EQ(b5r.recordings.size(), 1u);
  ASSERT_TRUE(b5r.b5r);
  EXPECT_EQ(b5r.b5r->ballbar_model, "QC20-W");
  EXPECT_TRUE(b5r.b5r->runs.empty());
  const RecordingFile log = open_recording(folder.write("b.b5r", "\xEF\xBB\xBF" + good_text("log")));
  EXPECT_EQ(log.recordings.size(), 1u);
  EXPECT_FALSE(log.b5r);
}

TEST(recording_file, says_what_it_found_instead) {
  const ScratchFolder folder;
  const auto opening = [&](std::string_view bytes) {
    const auto file = folder.write("f", bytes);
    return complaint(folder, [&] { open_recording(file); });
  };
  const std::string expected =
      "DIR/f:1:1: expected a recording, which is a Renishaw .b5r file (XML), a ballbar log (a table whose first lines "
      "say # format = \"ballbar-log 1\") or a table whose numbers are a circle (angle and radius, or two coordinates), "
      "found ";
  EXPECT_EQ(opening(""), expected + "an empty file.");
  EXPECT_EQ(opening("\xEF\xBB\xBF\n \n"), expected + "an empty file.");
  EXPECT_EQ(opening(std::string_view("PK\3\4\0\0", 6)),
            "DIR/f:1: expected a whole workbook (.xlsx), found a damaged archive.");
  EXPECT_EQ(opening(std::string_view("\x7F\0\1", 3)), expected + "a binary file.");
  EXPECT_EQ(opening(good_text("series")), expected + "a series of columns over time.");
  EXPECT_EQ(opening("time_min,x_um\n0,1\n"), expected + "a series of columns over time.");
  EXPECT_EQ(opening(good_text("session")), expected + "a session.");
  EXPECT_EQ(opening("format = 'ballbar-model 1'\n"), expected + "a model.");
  EXPECT_EQ(opening("# made by hand\ntime_s,angle_deg,length_mm\n0,0,100\n"),
            expected + "a ballbar log without its header (# format = \"ballbar-log 1\" and so on).");
  EXPECT_EQ(opening("hello"), expected + "text of no known format.");
  EXPECT_EQ(opening("#"), expected + "text of no known format.");
  EXPECT_EQ(complaint(folder, [&] { open_recording(folder.path()); }), "DIR: expected a file, found a directory.");
}

TEST(recording_file, xml_over_its_limit_is_refused_before_it_is_parsed) {
  const ScratchFolder folder;
  const auto file = folder.write("large", "<");
  std::filesystem::resize_file(file, (std::uintmax_t{16} << 20) + 1);
  EXPECT_EQ(complaint(folder, [&] { open_recording(file); }).substr(0, 60),
            "DIR/large:1:1: expected a recording, which is a Renishaw .b5");
  const auto xml = folder.write("xml", "<a>" + std::string(std::size_t{16} << 20, ' '));
  EXPECT_EQ(complaint(folder, [&] { open_recording(xml); }),
            "DIR/xml: expected at most 16 MiB of XML, found a larger file.");
}

}  // namespace
}  // namespace ballbar
