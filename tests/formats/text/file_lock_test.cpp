#include "ballbar/formats/text/file_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "scratch_folder.hpp"

namespace ballbar {
namespace {

TEST(file_lock, held_by_one_at_a_time) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "lock";
  std::optional<FileLock> first = FileLock::of(path);
  ASSERT_TRUE(first);
  EXPECT_FALSE(FileLock::of(path));
  FileLock moved = std::move(*first);
  first.reset();
  EXPECT_FALSE(FileLock::of(path));
  { const FileLock let_go = std::move(moved); }
  EXPECT_TRUE(FileLock::of(path));
}

TEST(file_lock, a_killed_program_lets_go) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "lock";
  int told[2];
  ASSERT_EQ(pipe(told), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const std::optional<FileLock> held = FileLock::of(path);
    const char got = held ? 'y' : 'n';
    if (write(told[1], &got, 1) != 1) _exit(1);
    while (true) pause();
  }
  char got = 0;
  ASSERT_EQ(read(told[0], &got, 1), 1);
  EXPECT_EQ(got, 'y');
  EXPECT_FALSE(FileLock::of(path));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(told[0]);
  close(told[1]);
  EXPECT_TRUE(FileLock::of(path));
}

TEST(file_lock, refused_where_there_can_be_no_file) {
  const ScratchFolder folder;
  EXPECT_EQ(complaint(folder, [&] { FileLock::of(folder.path() / "none/lock"); }),
            "DIR/none/lock: expected a file that can be locked, found: No such file or directory.");
}

}  // namespace
}  // namespace ballbar
