#include "ballbar/formats/text/archive.hpp"

#include <gtest/gtest.h>
#include <zip.h>

#include <string>
#include <utility>
#include <vector>

#include "bad_text.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Entries = std::vector<std::pair<std::string, std::string>>;

fs::path write_zip(const ScratchFolder& folder, std::string_view name, const Entries& entries,
                   const char* password = nullptr) {
  const fs::path path = folder.path() / name;
  zip_t* const archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [entry, bytes] : entries) {
    zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const auto index = zip_file_add(archive, entry.c_str(), source, ZIP_FL_ENC_UTF_8);
    EXPECT_GE(index, 0);
    if (password != nullptr) {
      zip_file_set_encryption(archive, static_cast<zip_uint64_t>(index), ZIP_EM_TRAD_PKWARE, password);
    }
  }
  EXPECT_EQ(zip_close(archive), 0);
  return path;
}

TEST(archive, its_b5r_files_are_read_as_if_it_were_a_folder) {
  const ScratchFolder folder;
  const fs::path zip = write_zip(
      folder, "tests.zip", {{"tests/02.B5R", good_text("both")}, {"01.b5r", good_text("b5r")}, {"readme.txt", "x"}});
  EXPECT_TRUE(is_archive(zip));
  EXPECT_EQ(files_in_archive(zip), (std::vector<fs::path>{zip / "01.b5r", zip / "tests/02.B5R"}));
  EXPECT_EQ(bytes_in_archive(zip / "01.b5r", kLargestText), good_text("b5r"));
  EXPECT_EQ(open_recording(zip / "tests/02.B5R").recordings.size(), 2u);
  EXPECT_EQ(files_below({folder.path().string()}).files, files_in_archive(zip));
  EXPECT_EQ(complaint(folder, [&] { open_recording(zip); }),
            "DIR/tests.zip: expected an archive of one .b5r file, found 2; DIR/tests.zip/01.b5r is one of them.");
  EXPECT_EQ(complaint(folder, [&] { open_recording(zip / "03.b5r"); }),
            "DIR/tests.zip/03.b5r: expected a file in the archive DIR/tests.zip, found none of that name.");
  EXPECT_EQ(bytes_in_archive(folder.path() / "no.zip/01.b5r", kLargestText), std::nullopt);
}

TEST(archive, one_file_inside_stands_for_it) {
  const ScratchFolder folder;
  const fs::path zip = write_zip(folder, "one.zip", {{"a.b5r", good_text("b5r")}});
  EXPECT_TRUE(is_recording_file(zip));
  EXPECT_EQ(open_recording(zip).recordings.size(), 1u);
}

TEST(archive, without_a_b5r_it_is_none) {
  const ScratchFolder folder;
  EXPECT_FALSE(is_archive(write_zip(folder, "a.zip", {{"a.txt", "x"}})));
  EXPECT_FALSE(is_archive(folder.write("b.xlsx", std::string_view("PK\3\4 damaged", 12))));
  EXPECT_FALSE(is_archive(folder.path()));
  EXPECT_FALSE(is_archive(folder.path() / "nothing"));
}

TEST(archive, what_a_system_hides_is_no_test) {
  const ScratchFolder folder;
  const fs::path zip = write_zip(folder, "mac.zip",
                                 {{"Prüfungen/1.b5r", good_text("b5r")},
                                  {"__MACOSX/Prüfungen/._1.b5r", std::string("\0\5\26\7", 4)},
                                  {".Trashes/2.b5r", good_text("b5r")},
                                  {"Prüfungen/.DS_Store", "x"}});
  EXPECT_EQ(files_in_archive(zip), (std::vector<fs::path>{zip / "Prüfungen/1.b5r"}));
  EXPECT_FALSE(is_archive(write_zip(folder, "hidden.zip", {{"._1.b5r", "x"}})));
}

TEST(archive, names_that_leave_it_are_refused) {
  const ScratchFolder folder;
  for (const std::string name : {"../out.b5r", "a/../../out.b5r", "/etc/out.b5r"}) {
    const fs::path zip = write_zip(folder, "a.zip", {{name, good_text("b5r")}});
    EXPECT_EQ(complaint(folder, [&] { files_in_archive(zip); }),
              "DIR/a.zip: expected names that stay inside the archive, found \"" + name + "\".");
  }
}

TEST(archive, a_bomb_is_not_unpacked) {
  const ScratchFolder folder;
  const fs::path large = write_zip(folder, "large.zip", {{"a.b5r", std::string(kLargestText + 1, ' ')}});
  EXPECT_LT(fs::file_size(large), 100000u);
  EXPECT_EQ(complaint(folder, [&] { open_recording(large); }),
            "DIR/large.zip/a.b5r: expected at most 16 MiB when unpacked, found a larger file.");
  // An archive that claims less than it holds: the size at 22 bytes of the local header and 24 of the central one.
  std::string bytes = read_bytes(write_zip(folder, "lying.zip", {{"a.b5r", std::string(100000, ' ')}}), kLargestText);
  const std::size_t central = bytes.rfind("PK\1\2");
  bytes[central + 24] = 10;
  bytes[central + 25] = bytes[central + 26] = 0;
  const fs::path lying = folder.write("lying.zip", bytes);
  EXPECT_EQ(complaint(folder, [&] { open_recording(lying); }).substr(0, 21), "DIR/lying.zip/a.b5r: ");
}

TEST(archive, what_is_locked_or_damaged_is_told) {
  const ScratchFolder folder;
  const fs::path locked = write_zip(folder, "locked.zip", {{"a.b5r", good_text("b5r")}}, "secret");
  EXPECT_EQ(complaint(folder, [&] { open_recording(locked); }),
            "DIR/locked.zip/a.b5r: expected a file without a password, found one that cannot be unpacked.");
  const fs::path cut = folder.write("cut.zip", std::string_view("PK\3\4 damaged", 12));
  EXPECT_EQ(complaint(folder, [&] { files_in_archive(cut); }),
            "DIR/cut.zip: expected a whole archive (.zip), found a damaged one.");
  EXPECT_EQ(recordings_below({cut.string()}).faults.size(), 1u);
  std::string bytes = read_bytes(write_zip(folder, "a.zip", {{"a.b5r", good_text("b5r")}}), kLargestText);
  bytes.replace(60, 20, std::string(20, '\xFF'));
  EXPECT_EQ(complaint(folder, [&] { open_recording(folder.write("a.zip", bytes)); }),
            "DIR/a.zip/a.b5r: expected a whole file in the archive, found a damaged one.");
}

}  // namespace
}  // namespace ballbar
