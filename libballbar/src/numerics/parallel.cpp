#include "ballbar/internal/numerics/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "ballbar/internal/numerics/interruption.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostThreads = 8;
constexpr std::chrono::milliseconds kPatience{20};  // between questions to the caller while others work

thread_local bool in_a_part = false;

struct Ended {};  // thrown in a part once the work is over for another reason

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& part) {
  const auto do_part = [&](std::size_t i) {
    expect_no_interruption();
    part(i);
  };
  if (in_a_part) {  // the cores have work
    for (std::size_t i = 0; i < count; ++i) do_part(i);
    return;
  }
  std::function<void()> ask = Interruption::newest();
  if (!ask) ask = [] {};
  std::atomic<std::size_t> next{0}, fault_of{count + 1};  // 0: the interruption; i + 1: part i; the lowest counts
  std::exception_ptr fault;
  std::mutex mutex;
  const auto guarded = [&](std::size_t number, const auto& work) {
    try {
      work();
    } catch (const Ended&) {
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (number >= fault_of) return;
      fault = std::current_exception();
      fault_of = number;
    }
  };
  const auto do_parts = [&](bool of_caller) {
    in_a_part = true;
    std::size_t i = 0;
    const Interruption question([&] {
      if (of_caller) guarded(0, ask);
      if (fault_of <= i) throw Ended{};
    });
    while (fault_of > count && (i = next++) < count) guarded(i + 1, [&] { do_part(i); });
    in_a_part = false;
  };
  const std::size_t threads = std::min({count, kMostThreads, std::size_t{std::thread::hardware_concurrency()}});
  std::vector<std::thread> helpers;
  std::vector<std::future<void>> ends;
  try {
    for (std::size_t k = 1; k < threads; ++k) {
      std::packaged_task<void()> help([&] { do_parts(false); });
      ends.push_back(help.get_future());
      helpers.emplace_back(std::move(help));
    }
  } catch (const std::system_error&) {
    // No thread to be had, as in a page: those that there are do it.
  }
  do_parts(true);
  for (const std::future<void>& end : ends) {
    while (end.wait_for(kPatience) != std::future_status::ready) guarded(0, ask);
  }
  for (std::thread& helper : helpers) helper.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace ballbar
