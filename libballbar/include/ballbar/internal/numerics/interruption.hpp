// Lets a caller end long work: fits, filters and searches check for an interruption regularly.
#pragma once

#include <functional>

namespace ballbar {

// While it exists, work of this thread calls `ask` regularly, at least every 0.1 s in fits and searches. An exception
// from `ask` ends the work. If there are several, the newest is called. Helper threads of in_parallel() end with the
// work of their caller.
class Interruption {
 public:
  explicit Interruption(std::function<void()> ask);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  // The `ask` of the newest one in this thread; empty: there is none.
  static std::function<void()> newest();

 private:
  friend void expect_no_interruption();
  std::function<void()> ask_;
  Interruption* before_;
};

// Calls the newest `ask`, if there is one.
void expect_no_interruption();

}  // namespace ballbar
