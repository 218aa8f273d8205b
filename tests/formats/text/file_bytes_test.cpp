#include "ballbar/formats/text/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>

#include "scratch_folder.hpp"

namespace {
std::string g_flushed;  // a letter a call: f, a file; d, a folder
int g_refuse = 0;       // what the disk says
}  // namespace

// In place of the system's.
extern "C" int fsync(int file) {
  struct stat status {};
  fstat(file, &status);
  g_flushed += S_ISDIR(status.st_mode) ? 'd' : 'f';
  if (g_refuse == 0) return static_cast<int>(syscall(SYS_fsync, file));
  errno = g_refuse;
  return -1;
}

namespace ballbar {
namespace {

namespace fs = std::filesystem;

TEST(bytes, come_back_as_they_were) {
  const ScratchFolder folder;
  const std::string bytes("a\0\r\n\xFF", 5);
  write_bytes(folder.path() / "file", bytes);
  EXPECT_EQ(read_bytes(folder.path() / "file", 5), bytes);
  write_bytes(folder.path() / "file", "");
  EXPECT_EQ(read_bytes(folder.path() / "file", 5), "");
}

TEST(bytes, reading_is_refused_with_a_whole_sentence) {
  const ScratchFolder folder;
  const auto reading = [&](const fs::path& path) {
    return complaint(folder, [&] { read_bytes(path, std::size_t{1} << 20); });
  };
  EXPECT_EQ(reading(folder.path()), "DIR: expected a file, found a directory.");
  EXPECT_EQ(reading(folder.path() / "none"), "DIR/none: expected a file, found nothing of that name.");
  EXPECT_EQ(reading(folder.path() / "none/x"), "DIR/none/x: expected a file, found nothing of that name.");
  EXPECT_EQ(reading("/dev/zero"), "/dev/zero: expected a regular file, found a pipe, device or socket.");
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(reading(pipe), "DIR/pipe: expected a regular file, found a pipe, device or socket.");
  const fs::path loop = folder.path() / "loop";
  fs::create_symlink(loop, loop);
  EXPECT_EQ(reading(loop), "DIR/loop: expected a readable file, found: Too many levels of symbolic links.");
  // Two gigabytes that take no room on the disk; refused before they are read.
  const fs::path huge = folder.write("huge", "");
  fs::resize_file(huge, std::uintmax_t{1} << 31);
  EXPECT_EQ(reading(huge), "DIR/huge: expected at most 1 MiB, found a larger file.");
}

TEST(bytes, the_head_of_a_file_of_any_size) {
  const ScratchFolder folder;
  const fs::path file = folder.write("file", "abcdef");
  EXPECT_EQ(read_head(file, 4), "abcd");
  EXPECT_EQ(read_head(file, 6), "abcdef");
  EXPECT_EQ(read_head(file, 7), "abcdef");
  fs::resize_file(file, std::uintmax_t{1} << 31);
  EXPECT_EQ(read_head(file, 7), std::string("abcdef\0", 7));
  EXPECT_EQ(complaint(folder, [&] { read_head(folder.path(), 4); }), "DIR: expected a file, found a directory.");
}

TEST(bytes, reading_without_permission_is_refused) {
  const ScratchFolder folder;
  const fs::path file = folder.write("secret", "x");
  fs::permissions(file, fs::perms::none);
  if (access(file.c_str(), R_OK) == 0) GTEST_SKIP() << "this user reads everything";
  EXPECT_EQ(complaint(folder, [&] { read_bytes(file, 10); }),
            "DIR/secret: expected a readable file, found: Permission denied.");
}

// The system claims size 0 for this one.
TEST(bytes, size_of_a_file_is_not_believed) {
  EXPECT_FALSE(read_bytes("/proc/self/status", std::size_t{1} << 20).empty());
}

TEST(bytes, a_write_that_fails_leaves_the_file_and_no_other) {
  const ScratchFolder folder;
  const fs::path file = folder.write("file", "before");
  EXPECT_THROW(write_through(file,
                             [](const fs::path& temporary) {
                               EXPECT_TRUE(fs::exists(temporary));
                               throw Error("stopped");
                             }),
               Error);
  EXPECT_EQ(read_bytes(file, 10), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(bytes, writing_is_refused_with_a_whole_sentence) {
  const ScratchFolder folder;
  const auto writing = [&](const fs::path& path) { return complaint(folder, [&] { write_bytes(path, "x"); }); };
  EXPECT_EQ(writing(folder.path()), "DIR: expected the name of a file to write, found a directory.");
  EXPECT_EQ(writing(folder.path() / "none/x"),
            "DIR/none/x: expected a folder to write to, found: No such file or directory.");
  EXPECT_EQ(writing("/dev/null"), "/dev/null: expected a regular file or a new name, found neither.");
}

TEST(bytes, a_state_is_on_the_disk_and_so_is_its_name) {
  const ScratchFolder folder;
  const fs::path file = folder.write("file", "before");
  fs::create_symlink("file", folder.path() / "link");
  g_flushed.clear();
  write_bytes(file, "plain");
  EXPECT_EQ(g_flushed, "");
  write_bytes_durably(folder.path() / "link", "after");
  EXPECT_EQ(g_flushed, "fd");
  EXPECT_EQ(read_bytes(file, 10), "after");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  g_refuse = EINVAL;  // a file system that has no disk
  write_bytes_durably(file, "more");
  EXPECT_EQ(read_bytes(file, 10), "more");
  g_refuse = EIO;
  EXPECT_EQ(complaint(folder, [&] { write_bytes_durably(file, "lost"); }),
            "DIR/file: expected a disk that stores it, found: Input/output error.");
  g_refuse = 0;
  EXPECT_EQ(read_bytes(file, 10), "more");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2);
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_bytes_durably("bare", "x");  // the folder has no name
  fs::current_path(before);
  EXPECT_EQ(read_bytes(folder.path() / "bare", 10), "x");
}

TEST(bytes, a_link_stays_a_link) {
  const ScratchFolder folder;
  folder.write("target", "before");
  fs::create_symlink("target", folder.path() / "link");
  write_bytes(folder.path() / "link", "after");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(read_bytes(folder.path() / "target", 10), "after");
}

}  // namespace
}  // namespace ballbar
