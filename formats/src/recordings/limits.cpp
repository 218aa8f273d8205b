#include "ballbar/formats/recordings/limits.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar {
namespace {

// A limit of 0.00007 mm is 0.06999999999999999 um once converted: an excess of no more than rounding is none.
constexpr double kRounding = 1e-9;

// The name under which the limits of a result stand.
std::string_view limit_name(std::string_view result) {
  if (result == "AF_CENTRE_OFFSET_A") return "AF_OFFSET_A";
  if (result == "AF_CENTRE_OFFSET_B") return "AF_OFFSET_B";
  if (result == "AF_CALCULATED_FEEDRATE") return "AF_FEEDRATE";
  return result;
}

// What a value in `from` is multiplied by to be in `to`.
std::optional<double> conversion(std::string_view from, std::string_view to) {
  if (from == to) return 1.0;
  if (from == "UT_LENGTH_MM" && to == "UT_LENGTH_UM") return 1e3;
  if (from == "UT_LENGTH_UM" && to == "UT_LENGTH_MM") return 1e-3;
  return std::nullopt;
}

bool is_of(const Limit& limit, std::string_view result) {
  return limit.name == result || limit.name == limit_name(result);
}

}  // namespace

std::optional<Judgement> judged(std::span<const Limit> limits, std::string_view name, double value,
                                std::string_view data_type, std::string_view parent) {
  if (!std::isfinite(value)) return std::nullopt;
  std::optional<Judgement> worst;
  for (const Limit& limit : limits) {
    if (!is_of(limit, name)) continue;
    if (!parent.empty() && limit.parent != parent) continue;
    const std::optional<double> factor = conversion(limit.data_type, data_type);
    if (!factor) continue;
    const auto beyond = [&](double excess, double end) { return excess > kRounding * std::abs(end); };
    const double lower = limit.lower.value_or(0.0) * *factor;
    const double upper = limit.upper.value_or(0.0) * *factor;
    const bool outside = (limit.lower && beyond(lower - value, lower)) || (limit.upper && beyond(value - upper, upper));
    const Judgement one =
        !outside ? Judgement::pass : (limit.level == "WARNING" ? Judgement::warning : Judgement::fail);
    worst = worst ? std::max(*worst, one) : one;
  }
  return worst;
}

LimitRange range_of(std::span<const Limit> limits, std::string_view name, std::string_view data_type) {
  LimitRange range;
  for (const Limit& limit : limits) {
    const std::optional<double> factor = conversion(limit.data_type, data_type);
    if (!factor || !is_of(limit, name)) continue;
    if (limit.lower) range.lower = std::max(range.lower.value_or(*limit.lower * *factor), *limit.lower * *factor);
    if (limit.upper) range.upper = std::min(range.upper.value_or(*limit.upper * *factor), *limit.upper * *factor);
  }
  return range;
}

std::string_view name_of(Judgement judgement) {
  if (judgement == Judgement::pass) return "pass";
  return judgement == Judgement::warning ? "warning" : "fail";
}

}  // namespace ballbar
