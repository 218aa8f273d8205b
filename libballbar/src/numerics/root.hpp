// Where a rising function passes a value.
#pragma once

#include <boost/math/tools/roots.hpp>
#include <utility>

namespace ballbar {

// Neighbouring doubles, the last that is below and the first that is not, by bisection; `low` twice where it is not
// below, `high` twice where it is.
template <class IsBelow>
std::pair<double, double> root_between(const IsBelow& is_below, double low, double high) {
  if (!is_below(low)) return {low, low};
  if (is_below(high)) return {high, high};
  const auto sign = [&](double x) { return is_below(x) ? -1.0 : 1.0; };
  const auto never = [](double, double) { return false; };  // it ends where no double lies between
  return boost::math::tools::bisect(sign, low, high, never);
}

}  // namespace ballbar
