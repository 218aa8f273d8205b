// A fault that may last, as a full disk does, said once and not every row.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace ballbar::hal {

class LastingFault {
 public:
  // every_s: `attempt` may return without having tried, but not once that long has gone by since it last succeeded.
  explicit LastingFault(double every_s) : every_s_(every_s) {}

  // What is to be said, where `attempt` throws: a fault that has not been said since it was last known to be gone. Not
  // told from another by its text, which may have a number in it that goes up every row. now_s: seconds of a clock that
  // is never set back.
  std::optional<std::string> of(double now_s, const std::function<void()>& attempt);

 private:
  double every_s_;
  double last_s_ = 0.0;
  bool said_ = false;
};

}  // namespace ballbar::hal
