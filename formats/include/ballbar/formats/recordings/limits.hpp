// Limits of a test's results as a `.b5r` states them, and a value held against them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ballbar {

// One TOLERANCE of a FEATURE_SPEC. At least one of both ends is stated.
struct Limit {
  std::string parent;     // "RUN_SPEC", "NAME version" of an ANALYSIS_SPEC, or the element that it stands in
  std::string name;       // "AF_OFFSET_A"
  std::string data_type;  // "UT_LENGTH_MM"
  std::string level;      // "WARNING"; any other is a tolerance that the value fails
  std::optional<double> lower, upper;  // in data_type's unit
};

enum class Judgement { pass, warning, fail };

// The worst that the limits of that name say of the value; on the limit is within it. Limits are converted to the
// value's unit (mm and um); one of another kind of unit says nothing. AF_OFFSET_A and _B are the limits of
// AF_CENTRE_OFFSET_A and _B, and AF_FEEDRATE of AF_CALCULATED_FEEDRATE. Nothing where no limit applies, or the value
// is not finite. `parent`: only the limits that stand there.
std::optional<Judgement> judged(std::span<const Limit> limits, std::string_view name, double value,
                                std::string_view data_type, std::string_view parent = {});

// The narrowest ends of the limits of that name, in the unit of data_type; as judged() takes them.
struct LimitRange {
  std::optional<double> lower, upper;
};
LimitRange range_of(std::span<const Limit> limits, std::string_view name, std::string_view data_type);

// "pass", "warning", "fail".
std::string_view name_of(Judgement judgement);

}  // namespace ballbar
