// Drift and tilt of the spindle from five probes on a bar (ISO 230-3 layout).
//
// The bar is rigid. Plane 1 is near the spindle's nose, plane 2 at the distance d from it. Readings minus those
// of the reference row:
//
//   x(s) = X1 + (X2 - X1) s / d     y(s) = Y1 + (Y2 - Y1) s / d     z = Z      at the distance s from plane 1
//   tilt about Y:  B = (X2 - X1) / d      tilt about X:  A = -(Y2 - Y1) / d    (um/mm = mrad; here urad)
//
// Any probe may be missing. With one probe of a pair the drift is known only in the plane of that probe. Without a
// pair, or without the spacing, there is no tilt. `remarks` say what is not known.
//
// Uncertainty (GUM, law of propagation; sources independent, the five probes independent of one another; w_1 = 1 -
// s/d and w_2 = s/d for a drift, -1/d and 1/d for a tilt, P the drift that a probe reads):
//   probe resolution  q      sqrt(2 q^2 / 12 sum w^2)          a step q: rectangular, in the reading and the reference
//   probe scatter     n      sqrt(2 sum w^2 (n^2 - q^2 / 12))  from reading to reading, found in the file (below): the
//                                                              part that the resolution does not explain
//   probe linearity   e %    sqrt(sum w^2 (e/100 P)^2 / 3)     limits of a rectangular distribution
//   place of the ball u_s    |tilt| u_s                        if u_s is stated
//
// The scatter n: each reading minus the straight line between its neighbours, divided by the root of the sum of squared
// weights; root mean square of the lower 95 %, corrected for the cut. It does not include slow errors of a probe.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct FivePointOptions {
  double from_plane_1_mm = 0.0;        // s; negative towards the nose
  double from_plane_1_sigma_mm = 0.0;  // u_s
  std::optional<double> reference_s;   // the nearest row with readings of all probes; nullopt: the first such row
};

struct FivePoint {
  MeasuredDrift drift;  // x, y, z um; tilt_a, tilt_b urad; without a spacing y2_minus_y1, x2_minus_x1 um
  std::array<std::optional<double>, 5> scatter_um;  // as kProbes; nullopt: no such probe, or fewer than 4 neighbours
};

// Whether the series has a column of a probe, or a [five_probe] table.
bool is_five_probe(const Series& series);

// O(n). Throws Error: no probe's column; a column of another unit than um; two probes on one column; s other than 0
// without a spacing; no row in which all probes have a reading.
FivePoint five_point(const Series& series, const FivePointOptions& options = {});

// Range (max - min) of one axis over rows [begin, end): in the first 60 min, after them, in the last 60 min (of longer
// stretches), and in total; and the change from the first row to the last. Noise alone gives a range of about 3 sigma
// in ten readings, and 6 sigma in a thousand. Therefore the range of 30 rows and more is that of a smoothing spline,
// less what noise adds to it (bootstrap); its sigma has the noise, that correction in full, and what is stated beside
// the noise. Of fewer rows it is that of the readings. The other sigmas add those of the two extreme rows as
// independent. They are too large by the contribution of the reference, and too small by a factor of at most sqrt(2) in
// the probe linearity of rows of opposite sign.
struct DriftRange {
  std::optional<Estimate> first_60_min, after_60_min, last_60_min, total, at_end;
  std::string unit;  // of the axis
};
DriftRange range_of(const DriftAxis& axis, const std::vector<double>& time_s, std::size_t begin, std::size_t end);

}  // namespace ballbar
