// Parts of work on several threads.
#include "ballbar/numerics/parallel.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
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

}  // namespace
}  // namespace ballbar
