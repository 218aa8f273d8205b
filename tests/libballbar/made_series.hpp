// What tests of made series share: random numbers keyed by name, columns to change, the words of an Error.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar::made {

inline void expect_error(const std::string& message, const std::function<void()>& what) {
  try {
    what();
    ADD_FAILURE() << "no Error: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), message);
  }
}

inline std::vector<double>& values_of(Series& series, std::string_view column) {
  return const_cast<Column*>(find_column(series, column))->values;
}

}  // namespace ballbar::made
