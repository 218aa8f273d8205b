// Conversions between the units ballbar uses: mm for set-up lengths, um for deviations, rad, s, degC.
// Convert once, where a number enters or leaves, so that equal units touch everywhere else.
#pragma once

#include <numbers>

namespace ballbar {

inline constexpr double kPi = std::numbers::pi;

constexpr double um_from_mm(double length_mm) { return length_mm * 1e3; }
constexpr double mm_from_um(double length_um) { return length_um / 1e3; }
constexpr double rad_from_deg(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double deg_from_rad(double angle_rad) { return angle_rad * (180.0 / kPi); }
constexpr double min_from_s(double time_s) { return time_s / 60.0; }

}  // namespace ballbar
