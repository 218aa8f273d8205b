#include "ballbar/numerics/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace ballbar {
namespace {

constexpr std::size_t kMostThreads = 8;

thread_local bool in_a_part = false;  // then the cores have work

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& part) {
  std::vector<std::exception_ptr> thrown(count);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> ended{false};
  const bool inside = in_a_part;
  const auto work = [&] {
    in_a_part = true;
    for (std::size_t i = 0; !ended && (i = next++) < count;) {
      try {
        part(i);
      } catch (...) {
        thrown[i] = std::current_exception();
        ended = true;  // those before it have begun
      }
    }
    in_a_part = inside;
  };
  {
    const std::size_t cores = inside ? 1 : std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::thread> helpers;
    try {
      for (std::size_t k = 1; k < std::min({count, cores, kMostThreads}); ++k) helpers.emplace_back(work);
    } catch (const std::system_error&) {
      // No thread to be had, as in a page: those that there are do it.
    }
    work();
    for (std::thread& helper : helpers) helper.join();
  }
  for (const std::exception_ptr& one : thrown) {
    if (one) std::rethrow_exception(one);
  }
}

}  // namespace ballbar
