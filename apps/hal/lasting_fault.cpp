#include "lasting_fault.hpp"

#include <exception>
#include <utility>

namespace ballbar::hal {

std::optional<std::string> LastingFault::of(double now_s, const std::function<void()>& attempt) {
  try {
    attempt();
    // Sooner than that nothing may have been tried, and the fault still be there.
    if (now_s - last_s_ > every_s_) said_ = false;
    return std::nullopt;
  } catch (const std::exception& error) {
    last_s_ = now_s;
    if (std::exchange(said_, true)) return std::nullopt;
    return error.what();
  }
}

}  // namespace ballbar::hal
