#include "history/quantity_kind.hpp"

#include <map>
#include <tuple>

#include "ballbar/history/machine_test.hpp"
#include "history/series_judgement.hpp"

namespace ballbar {
namespace {

// Whose name a row's begins with: the longest.
const Effect* effect_of_row(std::string_view row) {
  const Effect* longest = nullptr;
  for (const auto& effect : built_in_catalogue()) {
    if (effect->level != Level::recording || effect->rules.error_fit == ErrorFit::none) continue;
    const bool own = row == effect->name || (row.starts_with(effect->name) && row[effect->name.size()] == '_');
    if (own && (longest == nullptr || effect->name.size() > longest->name.size())) longest = effect.get();
  }
  return longest;
}

const Effect* effect_of_scales() {
  for (const auto& effect : built_in_catalogue()) {
    if (effect->level == Level::recording && effect->rules.relation == AxisRelation::scale) return effect.get();
  }
  return nullptr;
}

}  // namespace

QuantityKind kind_of(std::string_view name, Plane plane) {
  QuantityKind kind;
  for (int axis = 0; axis < 3; ++axis) {
    if (name != scale_name(axis)) continue;
    return {effect_of_scales(), axis, "scale", true};
  }
  if (is_global_scale(name)) return {nullptr, std::nullopt, std::string(name), true};
  kind.effect = effect_of_row(name);
  kind.of_sum = name == "circularity" || name == "residual_rms";
  if (kind.effect == nullptr) {
    kind.stem = name;
    return kind;
  }
  kind.of_both_scales = kind.effect->rules.relation == AxisRelation::scale;
  kind.stem = kind.effect->name;
  const auto pair = axes_of(plane);
  for (const std::size_t side : {0U, 1U}) {
    const std::string_view end = side == 0 ? "_a" : "_b";
    if (!kind.stem.ends_with(end)) continue;
    kind.stem.resize(kind.stem.size() - end.size());
    kind.axis = pair[side];
    break;
  }
  return kind;
}

}  // namespace ballbar
