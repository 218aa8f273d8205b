#include "ballbar/model/circle_model.hpp"

#include <algorithm>

namespace ballbar {
namespace {

constexpr double kAnotherFeed = 1.05;  // times the slowest

void hold(Term& term, std::string_view parameter, double value) {
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (term.effect->parameters[k].name != parameter) continue;
    term.settings[k].start = value;
    term.settings[k].held = true;
  }
}

Term circle_of(double recording) {
  Term circle = term_of("circle", {}, Level::recording);
  hold(circle, "recording", recording);
  return circle;
}

bool has_one_radius(const Series& trace) {
  const std::vector<double>& length_mm = find_column(trace, "radius_mm")->values;
  const std::vector<double>& feed = find_column(trace, "feed_mm_per_min")->values;
  const auto [shortest, longest] = std::minmax_element(length_mm.begin(), length_mm.end());
  const auto [slowest, fastest] = std::minmax_element(feed.begin(), feed.end());
  const bool stated = std::all_of(feed.begin(), feed.end(), [](double value) { return value > 0.0; });
  return stated && *shortest == *longest && *fastest > kAnotherFeed * *slowest;
}

}  // namespace

Model circles_of(const Series& trace) {
  Model model;
  model.level = Level::recording;
  model.targets = {"deviation_um"};
  const bool one_radius = has_one_radius(trace);
  const std::vector<double>& recording = find_column(trace, "recording")->values;
  const double last = *std::max_element(recording.begin(), recording.end());
  for (double number = 0.0; number <= last; number += 1.0) {
    model.terms.push_back(circle_of(number));
    if (one_radius) hold(model.terms.back(), "radius_um", 0.0);
  }
  if (one_radius) {
    model.terms.push_back(circle_of(-1.0));
    hold(model.terms.back(), "centre_a_um", 0.0);
    hold(model.terms.back(), "centre_b_um", 0.0);
  }
  return model;
}

}  // namespace ballbar
