// Formats that this file defines, opened by what the program opens files with.
#include "ballbar/formats/text/reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "bad_text.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/units.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

// XML of another maker: angle in deg and deviation in um of each reading.
constexpr std::string_view kText = R"(<?xml version="1.0"?>
<CircleTest length="100">
0 1.5
90 2.5
180 -0.5
270 0
</CircleTest>
)";

RecordingFile read_circle_test(std::string_view bytes, std::string_view name) {
  Recording recording;
  const std::size_t length = bytes.find("length=\"");
  if (length == std::string_view::npos) throw Error(std::string(name) + ":2:1: expected length, found none.");
  std::istringstream text{std::string(bytes.substr(length + 8))};
  text >> recording.nominal_length_mm;
  text.ignore(2);  // ">
  for (double angle_deg = 0.0, deviation_um = 0.0; text >> angle_deg >> deviation_um;) {
    recording.angle_rad.push_back(rad_from_deg(angle_deg));
    recording.length_mm.push_back(recording.nominal_length_mm + mm_from_um(deviation_um));
  }
  return {{recording}, std::nullopt};
}

const Reader kCircleTest = {
    .found = "a circle test of another maker",
    .recording = "a circle test (XML, root CircleTest)",
    .is_yours = [](std::string_view head) { return head.find("<CircleTest ") != std::string_view::npos; },
    .read = read_circle_test,
};

// A table with semicolons and decimal commas.
Series read_logger(std::string_view bytes, std::string_view) {
  std::string text(bytes.substr(bytes.find('\n') + 1));
  std::replace(text.begin(), text.end(), ',', '.');
  std::istringstream rows(text);
  Series series;
  series.columns = {{"z_um", Role::measured, {}}};
  char semicolon = ';';
  for (double time_s = 0.0, z_um = 0.0; rows >> time_s >> semicolon >> z_um;) {
    series.time_s.push_back(time_s);
    series.columns[0].values.push_back(z_um);
  }
  return series;
}

const Reader kLogger = {
    .found = "a logger's table",
    .is_yours = [](std::string_view head) { return head.starts_with("Zeit;Z\n"); },
    .read = read_logger,
};

std::vector<Reader> with_own() {
  std::vector<Reader> readers = {kCircleTest, kLogger};
  readers.insert(readers.end(), known_readers().begin(), known_readers().end());
  return readers;
}

TEST(reader, a_recording_of_an_own_format) {
  const ScratchFolder folder;
  const auto file = folder.write("a.b5r", kText);
  const std::vector<Reader> readers = with_own();
  EXPECT_TRUE(is_recording_file(file, readers));
  const RecordingFile opened = open_recording(file, readers);
  ASSERT_EQ(opened.recordings.size(), 1u);
  EXPECT_FALSE(opened.b5r);
  EXPECT_EQ(opened.recordings[0].angle_rad[1], rad_from_deg(90.0));
  EXPECT_EQ(opened.recordings[0].length_mm, (std::vector<double>{100.0015, 100.0025, 99.9995, 100.0}));
  EXPECT_EQ(open_recording(folder.write("log", good_text("log")), readers).recordings.size(), 1u) << "the others too";
}

TEST(reader, a_trace_and_a_session_of_an_own_format) {
  const ScratchFolder folder;
  const std::vector<Reader> readers = with_own();
  const ModelData data = open_model_data({folder.write("circle.xml", kText)}, {}, 600.0, readers);
  EXPECT_EQ(data.level, Level::recording);
  const Column* const deviation = find_column(*data.series, "deviation_um");
  ASSERT_NE(deviation, nullptr);
  ASSERT_EQ(deviation->values.size(), 4u);
  EXPECT_NEAR(deviation->values[2], -0.5, 1e-9);  // um; a length of 100 mm holds 1e-11 um

  const auto session = folder.write("session.toml",
                                    "format = \"ballbar-session 1\"\nmethod = \"circles\"\n[bar]\n"
                                    "nominal_length_mm = 100\n[[test]]\nelapsed_s = 0\ncircle = \"circle.xml\"\n");
  EXPECT_EQ(open_session(session, readers).session.tests.front().circles.front().length_mm.size(), 4u);
  EXPECT_EQ(open_drift_data(session, readers).session->session.tests.size(), 1u);
  EXPECT_THROW(open_session(session), Error);
}

TEST(reader, a_series_of_an_own_format) {
  const ScratchFolder folder;
  const std::vector<Reader> readers = with_own();
  const auto file = folder.write("z.txt", "Zeit;Z\n0;1,5\n60;2,25\n");
  for (const Series& series : {open_series(file, readers), *open_drift_data(file, readers).series,
                               *open_model_data({file}, {}, 600.0, readers).series}) {
    EXPECT_EQ(series.time_s, (std::vector<double>{0.0, 60.0}));
    EXPECT_EQ(find_column(series, "z_um")->values, (std::vector<double>{1.5, 2.25}));
  }
}

TEST(reader, messages_are_of_the_list_that_was_handed_in) {
  const ScratchFolder folder;
  const std::vector<Reader> readers = with_own();
  const auto circle = folder.write("circle", kText);
  const auto logger = folder.write("logger", "Zeit;Z\n0;1,5\n");
  EXPECT_EQ(
      complaint(folder, [&] { open_recording(logger, readers); }),
      "DIR/logger:1:1: expected a recording, which is a circle test (XML, root CircleTest), a Renishaw .b5r file "
      "(XML), a ballbar log (a table whose first lines say # format = \"ballbar-log 1\") or a table whose numbers "
      "are a circle (angle and radius, or two coordinates), found a logger's table.");
  EXPECT_EQ(complaint(folder, [&] { open_drift_data(circle, readers); }),
            "DIR/circle:1:1: expected a session (a folder or a file with format = \"ballbar-session 1\") or a series "
            "of columns over time, found a circle test of another maker.");
  EXPECT_EQ(complaint(folder, [&] { open_recording(folder.write("bare", "<CircleTest >"), readers); }),
            "DIR/bare:2:1: expected length, found none.");
  EXPECT_EQ(complaint(folder, [&] { open_recording(circle); }),
            "DIR/circle:2:2: expected TEST_DOCUMENT, the root of a .b5r file, found \"CircleTest\".");
}

// Which entry of the list takes which bytes.
TEST(reader, each_knows_its_own) {
  const auto found = [](std::string_view bytes) { return found_in(reader_of(bytes)); };
  const Reader* const b5r = reader_of(good_text("b5r"));
  ASSERT_NE(b5r, nullptr);
  EXPECT_EQ(b5r->recording, "a Renishaw .b5r file (XML)");
  EXPECT_EQ(reader_of("\xEF\xBB\xBF <?xml version='1.0'?>\n<!-- <a> -->\r\n<TEST_DOCUMENT>"), b5r);
  EXPECT_EQ(reader_of("<TEST_DOCUMENT/>"), b5r);
  for (const char* other : {"<TEST_DOCUMENTS>", "<a><TEST_DOCUMENT>", "<!DOCTYPE TEST_DOCUMENT>", "<?xml", "<", "<!--",
                            "<a\nformat = \"ballbar-log 1\">"}) {
    ASSERT_NE(reader_of(other), nullptr) << other;
    EXPECT_NE(reader_of(other), b5r) << other;
    EXPECT_EQ(found(other), "XML, such as a .b5r file") << other;
  }
  EXPECT_EQ(found(good_text("log")), "a ballbar log");
  EXPECT_EQ(found(good_text("session")), "a session");
  EXPECT_EQ(found("format = 'ballbar-model 1'\n"), "a model");
  EXPECT_EQ(found("# format = \"ballbar-series 1\"\ntime_s,angle_deg\n"), "a series of columns over time");
  EXPECT_EQ(found("time_s,angle_urad\n"), "a series of columns over time");
  EXPECT_EQ(found("time_s,angle_deg\n").substr(0, 28), "a ballbar log without its he");
  EXPECT_EQ(found(std::string_view("<a\0", 3)), "a binary file");
  EXPECT_EQ(found(" \n"), "an empty file");
  EXPECT_EQ(reader_of("hello"), nullptr);
}

std::size_t longest_head = 0;

TEST(reader, is_asked_by_the_head_alone) {
  const ScratchFolder folder;
  const auto file = folder.write("long.csv", good_text("log") + std::string(3 * kHeadBytes, '\n'));
  const std::vector<Reader> nosy = {{.is_yours = [](std::string_view head) {
    longest_head = std::max(longest_head, head.size());
    return false;
  }}};
  EXPECT_EQ(Source(file).reader(nosy), nullptr);
  EXPECT_EQ(longest_head, kHeadBytes);
  EXPECT_THROW(open_recording(file, nosy), Error);
  EXPECT_EQ(longest_head, kHeadBytes) << "of a file that was read whole too";
  EXPECT_EQ(Source(folder.path()).reader(), nullptr);
  EXPECT_EQ(Source(folder.path() / "none").reader(), nullptr);
}

}  // namespace
}  // namespace ballbar
