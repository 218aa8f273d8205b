#include "ballbar/numerics/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "ballbar/numerics/interruption.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostThreads = 8;
constexpr std::chrono::milliseconds kPatience{20};

thread_local bool in_a_part = false;  // then the cores have work

struct Ended {};  // thrown in a part, once the work is over for another reason

// What ends the work of all threads: the interruption, or the fault of the part with the lowest number.
class Faults {
 public:
  explicit Faults(std::size_t count) : first_(count), count_(count) {}

  bool any() const { return interrupted_ || first_ < count_; }

  void expect_none_before(std::size_t part) const {
    if (interrupted_ || first_ < part) throw Ended{};
  }

  void add(std::size_t part, std::exception_ptr fault) {
    const std::lock_guard<std::mutex> lock(adding_);
    if (part >= first_) return;
    fault_ = std::move(fault);
    first_ = part;
  }

  void interrupt(std::exception_ptr by) {
    const std::lock_guard<std::mutex> lock(adding_);
    interruption_ = std::move(by);
    interrupted_ = true;
  }

  // Once all threads have ended.
  void rethrow() const {
    if (interruption_) std::rethrow_exception(interruption_);
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  std::mutex adding_;
  std::atomic<std::size_t> first_;
  std::atomic<bool> interrupted_{false};
  const std::size_t count_;
  std::exception_ptr fault_, interruption_;
};

// Threads that help, and the wait for them.
class Helpers {
 public:
  template <class Work>
  void add(Work work) {
    threads_.emplace_back([this, work] {
      work();
      const std::lock_guard<std::mutex> lock(counting_);
      ++ended_;
      one_ended_.notify_one();
    });
  }

  // Whether all have ended, within a short time.
  bool have_ended() {
    std::unique_lock<std::mutex> lock(counting_);
    return one_ended_.wait_for(lock, kPatience, [this] { return ended_ == threads_.size(); });
  }

  void join() {
    for (std::thread& one : threads_) one.join();
  }

 private:
  std::vector<std::thread> threads_;
  std::mutex counting_;
  std::condition_variable one_ended_;
  std::size_t ended_ = 0;
};

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& part) {
  Faults faults(count);
  std::atomic<std::size_t> next{0};
  const bool inside = in_a_part;
  const std::function<void()> outer = Interruption::newest();  // that of who asked for the work
  const auto ask_outer = [&] {
    try {
      if (outer) outer();
    } catch (...) {
      faults.interrupt(std::current_exception());
    }
  };
  const auto work = [&](bool is_caller) {
    in_a_part = true;
    std::size_t i = 0;
    const Interruption question([&] {
      if (is_caller) ask_outer();
      faults.expect_none_before(i);
    });
    while (!faults.any() && (i = next++) < count) {
      try {
        expect_no_interruption();
        part(i);
      } catch (const Ended&) {
      } catch (...) {
        faults.add(i, std::current_exception());
      }
    }
    in_a_part = inside;
  };
  const std::size_t cores = inside ? 1 : std::max(1U, std::thread::hardware_concurrency());
  Helpers helpers;
  try {
    for (std::size_t k = 1; k < std::min({count, cores, kMostThreads}); ++k) helpers.add([&] { work(false); });
  } catch (const std::system_error&) {
    // No thread to be had, as in a page: those that there are do it.
  }
  work(true);
  while (!helpers.have_ended()) ask_outer();
  helpers.join();
  faults.rethrow();
}

}  // namespace ballbar
