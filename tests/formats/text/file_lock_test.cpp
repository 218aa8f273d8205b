#include "ballbar/formats/text/file_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "ballbar/formats/text/file_bytes.hpp"
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
  EXPECT_FALSE(std::filesystem::exists(path));  // the file goes with the lock
  EXPECT_TRUE(FileLock::of(path));
}

TEST(file_lock, says_who_holds_it) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "lock";
  const std::optional<FileLock> held = FileLock::of(path, "ballbar add (process 7)");
  ASSERT_TRUE(held);
  EXPECT_FALSE(FileLock::of(path, "another"));
  EXPECT_EQ(read_bytes(path, 100), "ballbar add (process 7)");
}

// Who opened a file that its holder then removed holds nothing: 4 programs count to 200 in turn.
TEST(file_lock, is_of_the_file_that_is_there) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "lock", counted = folder.write("count", "0");
  std::vector<pid_t> children;
  for (int child = 0; child < 4; ++child) {
    children.push_back(fork());
    ASSERT_GE(children.back(), 0);
    if (children.back() > 0) continue;
    for (int k = 0; k < 50;) {
      const std::optional<FileLock> held = FileLock::of(path);
      if (!held) continue;
      const int count = std::stoi(read_bytes(counted, 100));
      write_bytes(counted, std::to_string(count + 1));
      ++k;
    }
    _exit(0);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(read_bytes(counted, 100), "200");
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
