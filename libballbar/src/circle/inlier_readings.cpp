#include "circle/inlier_readings.hpp"

#include <algorithm>
#include <iterator>

namespace ballbar {

Recording without(const Recording& recording, const std::vector<std::size_t>& discounted) {
  Recording kept = recording;
  kept.angle_rad.clear();
  kept.length_mm.clear();
  kept.time_s.clear();
  auto next = discounted.begin();
  for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
    if (next != discounted.end() && *next == i) {
      ++next;
      continue;
    }
    kept.angle_rad.push_back(recording.angle_rad[i]);
    kept.length_mm.push_back(recording.length_mm[i]);
  }
  return kept;
}

std::vector<std::size_t> in_either(const std::vector<std::size_t>& first, const std::vector<std::size_t>& second) {
  std::vector<std::size_t> both;
  std::set_union(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(both));
  return both;
}

}  // namespace ballbar
