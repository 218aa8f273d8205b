#include "effects/known_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ballbar/error.hpp"

namespace ballbar {

KnownEffects::KnownEffects(std::span<const Effect* const> built_in) : built_in_(built_in.size()) {
  Catalogue& all = versions_.emplace_back();
  for (const Effect* effect : built_in) all.emplace_back(std::shared_ptr<const Effect>{}, effect);
  newest_ = &all;
}

void KnownEffects::add(std::shared_ptr<const Effect> effect) {
  const std::lock_guard<std::mutex> lock(adding_);
  Catalogue all = versions_.back();
  const auto same = std::find_if(all.begin(), all.end(), [&](const auto& one) {
    return one->name == effect->name && one->level == effect->level;
  });
  if (same == all.end()) {
    all.push_back(std::move(effect));
  } else if (same - all.begin() < static_cast<std::ptrdiff_t>(built_in_)) {
    throw Error(fmt::format("{}: expected a name of its own, found that of an effect of the catalogue.", effect->name));
  } else {
    *same = std::move(effect);
  }
  newest_.store(&versions_.emplace_back(std::move(all)), std::memory_order_release);
}

const Catalogue& built_in_catalogue() { return known_effects().all(); }

void add_to_catalogue(std::shared_ptr<const Effect> effect) { known_effects().add(std::move(effect)); }

}  // namespace ballbar
