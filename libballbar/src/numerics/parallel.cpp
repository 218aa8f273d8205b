#include "ballbar/numerics/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include "ballbar/numerics/interruption.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostThreads = 8;
constexpr std::chrono::milliseconds kPatience{20};

thread_local bool in_a_part = false;  // then the cores have work

struct Ended {};  // thrown in a helper, once the work is over for another reason

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& part) {
  std::vector<std::exception_ptr> thrown(count + 1);  // the last: by who interrupts
  std::vector<std::exception_ptr> over(count);        // of parts that end because others threw
  std::atomic<std::size_t> next{0};
  std::atomic<bool> ended{false};
  const bool inside = in_a_part;
  const auto work = [&] {
    in_a_part = true;
    for (std::size_t i = 0; !ended && (i = next++) < count;) {
      try {
        expect_no_interruption();
        part(i);
      } catch (const Ended&) {
        over[i] = std::current_exception();
        ended = true;
      } catch (...) {
        thrown[i] = std::current_exception();
        ended = true;  // those before it have begun
      }
    }
    in_a_part = inside;
  };
  const auto help = [&] {
    const Interruption with_the_caller([&] {
      if (ended) throw Ended{};
    });
    work();
  };
  {
    const std::size_t cores = inside ? 1 : std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::future<void>> helpers;
    try {
      for (std::size_t k = 1; k < std::min({count, cores, kMostThreads}); ++k)
        helpers.push_back(std::async(std::launch::async, help));
    } catch (const std::system_error&) {
      // No thread to be had, as in a page: those that there are do it.
    }
    work();
    for (const std::future<void>& helper : helpers) {
      while (helper.wait_for(kPatience) != std::future_status::ready) {
        try {
          if (!ended) expect_no_interruption();
        } catch (...) {
          thrown[count] = std::current_exception();
          ended = true;
        }
      }
    }
  }
  for (const auto* const all : {&thrown, &over}) {
    for (const std::exception_ptr& one : *all) {
      if (one) std::rethrow_exception(one);
    }
  }
}

}  // namespace ballbar
