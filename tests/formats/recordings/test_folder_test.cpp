#include "ballbar/formats/recordings/test_folder.hpp"

#include <gtest/gtest.h>

#include "bad_text.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

using Paths = std::vector<std::filesystem::path>;

TEST(test_folder, recordings_are_found_below_folders_whatever_their_names) {
  const ScratchFolder folder;
  const auto b = folder.write("b.b5r", "not one, by its name alone");
  const auto a = folder.write("deep/er/a.txt", good_text("b5r"));
  const auto log = folder.write("deep/log.csv", good_text("log"));
  folder.write("notes.txt", "hello");
  folder.write(".hidden/c.b5r", good_text("b5r"));
  const std::string root = folder.path().string();
  EXPECT_EQ(recordings_below({root}).files, (Paths{b, a, log}));
  // A file that is given stays, and once.
  const auto notes = folder.path() / "notes.txt";
  EXPECT_EQ(recordings_below({root, notes.string(), b.string()}).files, (Paths{b, a, log, notes}));
  EXPECT_EQ(complaint(folder, [&] { recordings_below({root + "/no"}); }),
            "DIR/no: expected a folder of tests, found nothing of that name.");
}

TEST(test_folder, a_folder_with_a_session_is_no_folder_of_tests) {
  const ScratchFolder folder;
  EXPECT_TRUE(is_folder_of_tests(folder.path()));
  const auto file = folder.write("session.toml", good_text("session"));
  EXPECT_FALSE(is_folder_of_tests(folder.path()));
  EXPECT_FALSE(is_folder_of_tests(file));
}

}  // namespace
}  // namespace ballbar
