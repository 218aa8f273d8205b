// What every reader of pictures says of a damaged one.
#pragma once

#include <string_view>

namespace ballbar {

// Throws Error. `what` may be empty; it stands without a full stop.
[[noreturn]] void fail_damaged(std::string_view name, std::string_view what);

}  // namespace ballbar
