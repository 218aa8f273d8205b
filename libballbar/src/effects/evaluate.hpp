// From an effect's one template to values and exact derivatives.
//
// A functor has   template <class T> void operator()(const EffectRows& rows, const T* p, T* out) const   and writes
// n values; it is instantiated for double and for ceres::Jet over all of the effect's parameters.
#pragma once

#include <ceres/jet.h>

#include <array>
#include <cstddef>
#include <vector>

#include "ballbar/effect.hpp"

namespace ballbar {

template <int kParameters, class Functor>
Evaluate evaluated_by(Functor functor) {
  return [functor](const EffectRows& rows, const double* parameters, double* values, double* derivatives) {
    if (derivatives == nullptr) {
      functor(rows, parameters, values);
      return;
    }
    using Jet = ceres::Jet<double, kParameters>;
    std::array<Jet, kParameters> p;
    for (int k = 0; k < kParameters; ++k) p[static_cast<std::size_t>(k)] = Jet(parameters[k], k);
    const std::size_t n = rows.time_s.size();
    std::vector<Jet> out(n);
    functor(rows, p.data(), out.data());
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = out[i].a;
      for (int k = 0; k < kParameters; ++k) derivatives[i * kParameters + static_cast<std::size_t>(k)] = out[i].v[k];
    }
  };
}

}  // namespace ballbar
