// What a quantity of a test is of: which axis, which effect, or all axes together.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"

namespace ballbar {

struct QuantityKind {
  const Effect* effect = nullptr;  // of the catalogue, whose row it is; of a scale that of two scales
  std::optional<int> axis;         // 0, 1, 2 of X, Y, Z
  std::string stem;                // what it is without axis and side: the same for both sides and all axes
  bool of_scale = false;           // of one axis, or of all
  bool of_sum = false;             // circularity, what the fit leaves: they follow the others
  bool of_both_scales = false;     // how the scales of both axes differ
};

QuantityKind kind_of(std::string_view name, Plane plane);

}  // namespace ballbar
