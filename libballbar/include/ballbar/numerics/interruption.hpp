// Long work that whoever asked for it may end: fits, filters and searches ask as they go on.
#pragma once

#include <functional>

namespace ballbar {

// As long as it lives, work of this thread calls `ask` now and then, at least every 0.1 s in fits and searches; what
// `ask` throws ends the work. Of several the newest is asked. A helper thread of in_parallel() ends when its caller's
// work does.
class Interruption {
 public:
  explicit Interruption(std::function<void()> ask);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  // What the newest of this thread asks; empty: there is none.
  static std::function<void()> newest();

 private:
  friend void expect_no_interruption();
  std::function<void()> ask_;
  Interruption* before_;
};

// Asks; where nobody wants to know, nothing.
void expect_no_interruption();

}  // namespace ballbar
