// The effects of src/effects, and those that a program adds while it runs.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <span>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

class KnownEffects {
 public:
  explicit KnownEffects(std::span<const Effect* const> built_in);
  const Catalogue& all() const { return *newest_.load(std::memory_order_acquire); }
  void add(std::shared_ptr<const Effect> effect);

 private:
  std::mutex adding_;
  std::size_t built_in_;
  std::deque<Catalogue> versions_;  // one may be looked through while another is made
  std::atomic<const Catalogue*> newest_;
};

KnownEffects& known_effects();

}  // namespace ballbar
