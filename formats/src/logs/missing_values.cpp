#include "logs/missing_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "logs/log_roles.hpp"
#include "logs/log_table.hpp"

namespace ballbar {
namespace {

constexpr double kNoReading = 9e36;  // 9.9E37 and 1E38 stand for overload

// Numbers that loggers write where there is no value; only where they stand far outside all others.
constexpr double kSentinels[] = {-999.0,  -9999.0, -99999.0, -999.9,   -999.99, -9999.9, -99.9,
                                 -99.99,  -273.15, 999.9,    9999.0,   9999.9,  99999.0, 32767.0,
                                 65535.0, 3276.7,  6553.5,   -32768.0, -1e6,    1e6,     -3276.8};

}  // namespace

std::string take_missing_values(std::vector<double>& values) {
  std::string found;
  const auto take_out = [&](auto is_none) {
    std::size_t count = 0;
    double example = 0.0;
    for (double& value : values) {
      if (!is_none(value)) continue;
      example = value;
      value = kGap;
      ++count;
    }
    if (count > 0) found += fmt::format("{}{} times {:g}", found.empty() ? "" : ", ", count, example);
  };
  for (int side = 0; side < 4; ++side) {
    const Extremes all = extremes_of(values);
    if (std::abs(all.least) >= kNoReading || std::abs(all.most) >= kNoReading) {
      take_out([](double v) { return std::abs(v) >= kNoReading; });
      continue;
    }
    const auto is_known = [](double v) {
      return std::find(std::begin(kSentinels), std::end(kSentinels), v) != std::end(kSentinels);
    };
    const bool low = is_known(all.least), high = is_known(all.most);
    if (!low && !high) break;
    bool any = false;
    for (const double one : {low ? all.least : kGap, high ? all.most : kGap}) {
      if (std::isnan(one)) continue;
      const Extremes rest = extremes_of(values, one);
      const double far = 3.0 * (rest.most - rest.least) + 50.0;
      if (!(one < rest.least - far || one > rest.most + far)) continue;
      take_out([&](double v) { return v == one; });
      any = true;
    }
    if (!any) break;
  }
  return found;
}

}  // namespace ballbar
