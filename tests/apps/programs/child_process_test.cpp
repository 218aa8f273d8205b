#include "programs/child_process.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <csignal>
#include <string>

namespace ballbar {
namespace {

ChildProcess shell(const std::string& command, std::string_view in = {}) {
  return child_process("--plot", {"sh", "-c", command}, in);
}

TEST(ChildProcess, tells_what_was_written_and_how_it_ended) {
  const ChildProcess said = shell("cat; echo wrong >&2; exit 3", "text");
  EXPECT_EQ(said.out, "text");
  EXPECT_EQ(said.err, "wrong\n");
  EXPECT_EQ(said.status, 3);
  EXPECT_EQ(said.signal, 0);
  EXPECT_FALSE(said.not_found);
  EXPECT_EQ(shell("kill -9 $$").signal, SIGKILL);
}

TEST(ChildProcess, a_program_that_is_not_there_is_no_error) {
  EXPECT_TRUE(child_process("--plot", {"ballbar-has-no-such-program"}, "text").not_found);
}

// More than a pipe holds (64 KiB) both ways, and back before all is read.
TEST(ChildProcess, long_texts_do_not_block) {
  const std::string in(300000, 'a');
  EXPECT_EQ(shell("head -c 250000 /dev/zero | tr '\\0' b; cat", in).out, std::string(250000, 'b') + in);
}

TEST(ChildProcess, arguments_are_not_read_by_a_shell) {
  EXPECT_EQ(child_process("--plot", {"printf", "%s", "$(echo x) `y` '\"; z"}, "").out, "$(echo x) `y` '\"; z");
}

TEST(ChildProcess, the_environment_is_ours_but_for_what_is_left_out) {
  setenv("BALLBAR_TEST_A", "1", 1);
  setenv("BALLBAR_TEST_B", "2", 1);
  const ChildProcess said =
      child_process("--plot", {"sh", "-c", "echo \"$BALLBAR_TEST_A,$BALLBAR_TEST_B\""}, "", "BALLBAR_TEST_A=");
  EXPECT_EQ(said.out, ",2\n");
  unsetenv("BALLBAR_TEST_A");
  unsetenv("BALLBAR_TEST_B");
}

// One that ends before it reads is no SIGPIPE here, and the caller's choice stays.
TEST(ChildProcess, signals_stay_as_they_are) {
  struct sigaction before {};
  struct sigaction after {};
  sigaction(SIGPIPE, nullptr, &before);
  EXPECT_EQ(shell("exit 0", std::string(300000, 'a')).status, 0);
  sigaction(SIGPIPE, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
}

}  // namespace
}  // namespace ballbar
