#include "ballbar/internal/model/recording_base_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kAnotherFeed = 1.05;  // times the slowest

void hold(Setting& setting, double value) {
  setting.start = value;
  setting.held = true;
}

Term circle_of(const Effect& base, const Catalogue& catalogue, double recording) {
  Term circle = term_of(base.name, {}, base.level, catalogue);
  for (std::size_t k = 0; k < circle.settings.size(); ++k) {
    if (base.parameters[k].shape_of == ShapeOf::recording) hold(circle.settings[k], recording);
  }
  return circle;
}

// Its gains that are one for all recordings, or those that are not, at 0.
void hold_gains(Term& circle, bool one_for_all) {
  const std::vector<std::string>& names = circle.effect->rules.one_for_all;
  for (std::size_t k = 0; k < circle.settings.size(); ++k) {
    const Parameter& parameter = circle.effect->parameters[k];
    if (parameter.kind != ParameterKind::gain) continue;
    const bool is_named = std::find(names.begin(), names.end(), parameter.name) != names.end();
    if (is_named == one_for_all) hold(circle.settings[k], 0.0);
  }
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

Model recording_base_model(const Series& trace, const Catalogue& catalogue) {
  const Effect* base = base_effect(Level::recording, catalogue);
  if (base == nullptr) throw Error("expected a catalogue with the base of recordings, found none in it.");
  Model model;
  model.level = Level::recording;
  model.targets = {"deviation_um"};
  const bool one_radius = has_one_radius(trace);
  const std::vector<double>& recording = find_column(trace, "recording")->values;
  const double last = *std::max_element(recording.begin(), recording.end());
  for (double number = 0.0; number <= last; number += 1.0) {
    model.terms.push_back(circle_of(*base, catalogue, number));
    if (one_radius) hold_gains(model.terms.back(), true);
  }
  if (one_radius) {
    model.terms.push_back(circle_of(*base, catalogue, -1.0));
    hold_gains(model.terms.back(), false);
  }
  return model;
}

Model with_circles(Model model, const Series& trace) {
  const bool has_base =
      std::any_of(model.terms.begin(), model.terms.end(), [](const Term& term) { return term.effect->rules.is_base; });
  if (has_base) return model;
  const Model base = recording_base_model(trace);
  model.terms.insert(model.terms.begin(), base.terms.begin(), base.terms.end());
  return model;
}

void expect_acts(const Model& model, Motion motion) {
  for (const Term& term : model.terms) {
    if (applies_to(*term.effect, motion)) continue;
    throw Error(fmt::format("expected effects that act where {} drives the circle, found {}.", name_of(motion),
                            term.effect->name));
  }
}

}  // namespace ballbar
