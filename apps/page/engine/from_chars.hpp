// Included before every file of the engine: its standard library (libc++ 14) reads no floating-point numbers.
#pragma once

#include <fast_float/fast_float.h>

#include <charconv>
#include <limits>
#include <system_error>

namespace std {  // where the library itself has it from version 20 on

// As the standard has it. fast_float answers infinity, or zero, where the standard says out of range.
inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format format = chars_format::general) {
  double read = 0.0;
  const auto how = format == chars_format::fixed        ? fast_float::chars_format::fixed
                   : format == chars_format::scientific ? fast_float::chars_format::scientific
                                                        : fast_float::chars_format::general;
  const fast_float::from_chars_result answer = fast_float::from_chars(first, last, read, how);
  if (answer.ec != errc()) return {answer.ptr, answer.ec};
  bool digits = false;  // infinity in words is a number; a zero of zeros alone too
  bool only_zeros = true;
  for (const char* sign = first; sign != answer.ptr && *sign != 'e' && *sign != 'E'; ++sign) {
    if (*sign < '0' || *sign > '9') continue;
    digits = true;
    only_zeros = only_zeros && *sign == '0';
  }
  const bool beyond = read > numeric_limits<double>::max() || read < numeric_limits<double>::lowest();
  if (digits && (beyond || (read == 0.0 && !only_zeros))) return {answer.ptr, errc::result_out_of_range};
  value = read;
  return {answer.ptr, errc()};
}

}  // namespace std
