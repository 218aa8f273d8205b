// Limits for the results of a test, as stated in a `.b5r`, and the judgement of values by them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ballbar {

// One TOLERANCE of a FEATURE_SPEC. At least one of the two ends is stated.
struct Limit {
  std::string parent;                  // "RUN_SPEC", "NAME version" of an ANALYSIS_SPEC, or its parent element
  std::string name;                    // "AF_OFFSET_A"
  std::string data_type;               // "UT_LENGTH_MM"
  std::string level;                   // "WARNING"; any other level means fail
  std::optional<double> lower, upper;  // in data_type's unit
};

enum class Judgement { pass, warning, fail };

// The worst judgement of the value by the limits of that name. A value on the limit is within it. Limits are converted
// to the unit of the value (mm and um); limits in other units are ignored. AF_OFFSET_A and _B are the limits of
// AF_CENTRE_OFFSET_A and _B, and AF_FEEDRATE of AF_CALCULATED_FEEDRATE. Returns nullopt if no limit applies or the
// value is not finite. `parent`: use only the limits with this parent.
std::optional<Judgement> judged(std::span<const Limit> limits, std::string_view name, double value,
                                std::string_view data_type, std::string_view parent = {});

// The narrowest range of the limits of that name, in the unit of data_type, by the rules of judged().
struct LimitRange {
  std::optional<double> lower, upper;
};
LimitRange range_of(std::span<const Limit> limits, std::string_view name, std::string_view data_type);

// "pass", "warning", "fail".
std::string_view name_of(Judgement judgement);

}  // namespace ballbar
