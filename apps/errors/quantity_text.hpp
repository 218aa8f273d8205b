// How quantities and dates are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ballbar {

std::string date_text(double time_s);                           // "2025-09-04"
std::string iso_date_text(std::int64_t time_s);                 // "2025-09-04T16:10:49"
std::string several(std::size_t count, std::string_view what);  // "1 test", "2 tests"

std::string signed_text(double value, int decimals);

}  // namespace ballbar
