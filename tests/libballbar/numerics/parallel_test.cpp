// Parts of work on several threads.
#include "ballbar/internal/numerics/parallel.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

TEST(InParallel, parts_inside_parts_are_all_done) {
  std::vector<std::vector<int>> done(20, std::vector<int>(30, 0));
  in_parallel(done.size(), [&](std::size_t i) { in_parallel(done[i].size(), [&](std::size_t j) { ++done[i][j]; }); });
  for (const std::vector<int>& inner : done) EXPECT_EQ(inner, std::vector<int>(30, 1));
  const auto throws = [&](std::size_t i) {
    in_parallel(3, [&](std::size_t j) {
      if (j > 0) throw Error(fmt::format("{} {}", i, j));
    });
  };
  try {
    in_parallel(4, throws);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "0 1");
  }
}

TEST(InParallel, nothing_is_begun_once_a_part_has_thrown) {
  std::atomic<int> begun{0};
  const auto first_throws = [&](std::size_t i) {
    ++begun;
    if (i == 0) throw Error("first");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  EXPECT_THROW(in_parallel(1000, first_throws), Error);
  EXPECT_LT(begun, 500);
}

}  // namespace
}  // namespace ballbar
