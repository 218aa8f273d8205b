// Units and signs of all ballbar headers, and the conversions between them.
//
//   length, set-up      mm        radius, length of the bar, height, distance of probes; names end in _mm
//   deviation, drift    um        readings less a reference, residuals, sigmas; _um
//   angle               rad       inside; deg where a person reads it (_deg); slopes and squareness um/m = urad
//   time                s         from the start of a series; _s; a date is s since 1970-01-01T00:00:00 on the
//                                 machine's own clock, without a zone
//   temperature         degC      a temperature; K a difference of two, and the unit of gains: um/K
//   speed, feed         rpm, mm/min
//   probability, share  0 to 1
//
// Axes are those of the machine, right-handed (ISO 841). A drift is that of the tool's side relative to the table. A
// residual is measured less predicted. Every sigma is a standard uncertainty (GUM); intervals say that they have 95 %.
// NaN is "not known" or a gap, infinity "not determined".
//
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
