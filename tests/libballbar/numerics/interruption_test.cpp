// Work that is ended from outside.
#include "ballbar/internal/numerics/interruption.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/numerics/parallel.hpp"

namespace ballbar {
namespace {

struct Stop {};

TEST(Interruption, the_newest_is_asked_as_long_as_it_lives) {
  int outer = 0, inner = 0;
  expect_no_interruption();
  const Interruption first([&] { ++outer; });
  {
    const Interruption second([&] { ++inner; });
    expect_no_interruption();
  }
  expect_no_interruption();
  EXPECT_EQ(outer, 1);
  EXPECT_EQ(inner, 1);
}

TEST(Interruption, ends_a_fit) {
  Series data;
  Column temperature{"T_room_degC", Role::ambient, {}}, target{"z_um", Role::measured, {}};
  for (int i = 0; i < 200; ++i) {
    data.time_s.push_back(60.0 * i);
    temperature.values.push_back(20.0 + std::sin(0.05 * i));
    target.values.push_back(std::sin(0.05 * i - 0.4));
  }
  data.columns = {temperature, target};
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("lagged_expansion", {"T_room_degC"})};
  int asked = 0;
  const Interruption interruption([&] {
    if (++asked > 5) throw Stop{};
  });
  EXPECT_THROW(fit(model, data), Stop);
  EXPECT_EQ(asked, 6);
}

TEST(Interruption, ends_the_parts_of_other_threads_too) {
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<bool> stop{false};
  const Interruption interruption([&] {
    if (std::this_thread::get_id() != here) throw Error("asked in another thread");
    if (stop) throw Stop{};
  });
  // Part 0 begins first; whoever has it goes on until it is ended, nested parts included.
  const auto work = [&](std::size_t i) {
    if (i > 0) {
      stop = true;
      return;
    }
    while (true) in_parallel(2, [](std::size_t) { expect_no_interruption(); });
  };
  EXPECT_THROW(in_parallel(std::max(2U, std::thread::hardware_concurrency()), work), Stop);
}

}  // namespace
}  // namespace ballbar
