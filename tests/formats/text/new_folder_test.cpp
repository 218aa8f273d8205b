#include "ballbar/formats/text/new_folder.hpp"

#include <gtest/gtest.h>

#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(new_folder, whole_in_a_new_or_an_empty_one) {
  const ScratchFolder scratch;
  write_folder(scratch.path() / "a/b/", {{"x.txt", "one"}, {"b/y.txt", "two"}});
  EXPECT_EQ(read_bytes(scratch.path() / "a/b/x.txt", 10), "one");
  EXPECT_EQ(read_bytes(scratch.path() / "a/b/b/y.txt", 10), "two");
  EXPECT_EQ(entries(scratch.path() / "a"), 1u);  // no temporary one is left
  fs::create_directory(scratch.path() / "empty");
  write_folder(scratch.path() / "empty", {{"x.txt", "one"}});
  EXPECT_EQ(entries(scratch.path() / "empty"), 1u);
}

TEST(new_folder, nothing_is_written_over_or_half) {
  const ScratchFolder scratch;
  scratch.write("full/kept.txt", "kept");
  scratch.write("file", "kept");
  const auto write = [&](const fs::path& folder, const char* name) {
    return complaint(scratch, [&] { write_folder(folder, {{"x.txt", "one"}, {name, "two"}}); });
  };
  EXPECT_EQ(write(scratch.path() / "full", "y.txt"),
            "DIR/full: expected a new or an empty folder, found one that holds files.");
  EXPECT_EQ(write(scratch.path() / "file", "y.txt"), "DIR/file: expected a new or an empty folder, found a file.");
  EXPECT_EQ(write("", "y.txt"), "Expected the name of a folder to write to, found an empty one.");
  EXPECT_NE(write(scratch.path() / "new", "x.txt/below"), "no complaint");
  EXPECT_FALSE(fs::exists(scratch.path() / "new"));
  EXPECT_EQ(entries(scratch.path()), 2u);
  EXPECT_EQ(entries(scratch.path() / "full"), 1u);
}

}  // namespace
}  // namespace ballbar
