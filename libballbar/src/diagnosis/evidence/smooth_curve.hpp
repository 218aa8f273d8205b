// The smooth curve through the readings of a sensor.
#pragma once

#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"

namespace ballbar {

struct Observation {
  double time_s = 0.0, value = 0.0, variance = 1.0;  // in units of the scatter
};

// The mean of an integrated random walk, x'' = white noise, given the observations, at these times; all rise. Its slope
// may change at bends_s: a body begins to warm when the spindle starts (an intervention: Harvey and Durbin 1986, J. R.
// Stat. Soc. A 149, 187). The roughness and the size of the bends are those of the largest likelihood.
std::vector<double> smooth_curve(const std::vector<Observation>& observations, const std::vector<double>& time_s,
                                 const std::vector<double>& bends_s = {});

// The same, but where the observations less the median of those about them have heavy tails, far ones count less, by
// the weights of Student's t with Tuning::freedom degrees of freedom (Lange, Little and Taylor 1989, J. Am. Stat.
// Assoc. 84, 881). A step of the curve has no such observations, and near bends_s all count in
// full.
std::vector<double> robust_curve(std::vector<Observation> observations, const std::vector<double>& time_s,
                                 const std::vector<double>& bends_s, const Tuning& tuning);

}  // namespace ballbar
