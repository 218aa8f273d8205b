#include "ballbar/formats/sessions/drift_data.hpp"

#include <gtest/gtest.h>

#include "bad_text.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

std::string rotating(std::string_view kind) { return changed(kind, "linear_axes", "spindle"); }

TEST(drift_data, a_series_whatever_its_name) {
  const ScratchFolder folder;
  const auto path = folder.write("session.toml", good_text("probes"));
  const DriftData data = open_drift_data(path);
  EXPECT_FALSE(data.session);
  ASSERT_TRUE(data.series);
  EXPECT_EQ(data.series->five_probe->columns[0], "ch1_um");
  EXPECT_EQ(data.files, std::vector<std::filesystem::path>{path});
  EXPECT_TRUE(open_drift_data(folder.write("plain", "time_s,x_um\n0,1\n")).series);
}

TEST(drift_data, a_session_by_its_file_or_its_folder) {
  const ScratchFolder folder;
  folder.write("00-r.csv", rotating("log"));
  folder.write("00-z.csv", good_text("axial"));
  const auto file = folder.write("session.toml", good_text("rotation"));
  for (const auto& path : {file, folder.path()}) {
    const DriftData data = open_drift_data(path);
    EXPECT_FALSE(data.series);
    ASSERT_TRUE(data.session);
    EXPECT_EQ(data.session->session.tests.size(), 1u);
    EXPECT_EQ(data.files.size(), 3u) << "the session and its two recordings";
  }
}

TEST(drift_data, says_what_it_found_instead) {
  const ScratchFolder folder;
  const auto opening = [&](std::string_view bytes) {
    const auto path = folder.write("f", bytes);
    return complaint(folder, [&] { open_drift_data(path); });
  };
  const std::string expected =
      "DIR/f:1:1: expected a session (a folder or a file with format = \"ballbar-session 1\") or a series "
      "of columns over time, found ";
  EXPECT_EQ(opening(good_text("log")), expected + "a ballbar log.");
  EXPECT_EQ(opening(good_text("b5r")), expected + "XML, such as a .b5r file.");
  EXPECT_EQ(opening(""), expected + "an empty file.");
  EXPECT_EQ(opening("title = 1\n"), "DIR/f:1:1: expected the key format, found none.");
  EXPECT_EQ(opening("time_s,x_um\n0,a\n"), "DIR/f:2:3: expected a finite number for x_um, found \"a\".");
  EXPECT_EQ(complaint(folder, [&] { open_drift_data(folder.path() / "none"); }),
            "DIR/none: expected a file, found nothing of that name.");
  EXPECT_EQ(complaint(folder, [&] { open_series(folder.path() / "none.csv"); }),
            "DIR/none.csv: expected a file, found nothing of that name.");
}

}  // namespace
}  // namespace ballbar
