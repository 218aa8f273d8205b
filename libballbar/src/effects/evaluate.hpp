// Makes values and exact derivatives from the template of an effect, which is instantiated for double and for
// ceres::Jet over all parameters of the effect. The functor returns the value at row i, from rows 0, i - 1 and i and a
// memory of kKept numbers, so that it can run live:
//
//   template <class T> T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const
#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

// A gain from -bound to bound; `row`: of an error of the machine, its row in the table of errors.
inline Parameter gain_within(const char* name, const char* unit, double bound, const char* meaning,
                             const char* row = "") {
  return {name, unit, ParameterKind::gain, 0.0, -bound, bound, {}, meaning, false, ShapeOf::curve, {}, {}, row};
}

// um/K of a body of steel: alpha L.
inline Parameter growth_of_steel(const char* meaning) {
  Parameter gain = gain_within("gain_um_per_K", "um/K", 1000.0, meaning);
  gain.usual_low = 0.1, gain.usual_high = 15.0;
  gain.usual =
      "alpha L of 10 mm to 1 m of steel, 11 to 14e-6 /K; the spindle of Huang, Li, Zhao 2022 has 13.6e-6 /K "
      "times 165 mm, 2.2 um/K";
  return gain;
}

template <int kParameters, int kKept = 0, class Functor>
Evaluate by_row(Functor functor) {
  constexpr std::size_t kNumbers = kKept > 0 ? kKept : 1;
  const auto some = [functor](const EffectRows& rows, std::size_t begin, std::size_t end, const double* parameters,
                              double* kept, double* values) {
    if (end - begin == 1) {
      *values = functor(rows, begin, parameters, kept);
      return;
    }
    std::array<double, kNumbers> numbers{};  // a local array, so that it stays in registers
    std::copy_n(kept, kKept, numbers.begin());
    for (std::size_t i = begin; i < end; ++i) values[i - begin] = functor(rows, i, parameters, numbers.data());
    std::copy_n(numbers.begin(), kKept, kept);
  };
  const auto all = [functor, some](const EffectRows& rows, const double* parameters, double* values,
                                   double* derivatives) {
    const std::size_t n = rows.time_s.size();
    if (derivatives == nullptr) {
      std::array<double, kNumbers> kept{};
      some(rows, 0, n, parameters, kept.data(), values);
      return;
    }
    using Jet = ceres::Jet<double, kParameters>;
    std::array<Jet, kParameters> p;
    for (int k = 0; k < kParameters; ++k) p[static_cast<std::size_t>(k)] = Jet(parameters[k], k);
    std::array<Jet, kNumbers> kept{};
    for (std::size_t i = 0; i < n; ++i) {
      const Jet value = functor(rows, i, p.data(), kept.data());
      values[i] = value.a;
      for (int k = 0; k < kParameters; ++k) derivatives[i * kParameters + static_cast<std::size_t>(k)] = value.v[k];
    }
  };
  return {all, some, static_cast<std::size_t>(kKept), static_cast<std::size_t>(kParameters)};
}

// The same for an effect that does not run live; it may read any row.
template <int kParameters, class Functor>
Evaluate by_reading(Functor functor) {
  return {by_row<kParameters>(functor).all, {}, 0, static_cast<std::size_t>(kParameters)};
}

}  // namespace ballbar
