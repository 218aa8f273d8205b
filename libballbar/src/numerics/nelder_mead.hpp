// Minimum of a function of one to three variables without derivatives: Nelder and Mead's simplex.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ballbar {

template <std::size_t N>
struct Minimum {
  std::array<double, N> x{};
  double value = 0.0;
};

// From `start`, with first steps of `step`, until the simplex' values differ by less than `tolerance` or `most` values
// were taken. Reflection 1, expansion 2, contraction and shrinking 1/2.
template <std::size_t N, class Function>
Minimum<N> nelder_mead(const Function& function, const std::array<double, N>& start, const std::array<double, N>& step,
                       double tolerance, int most) {
  using Vertex = Minimum<N>;
  std::array<Vertex, N + 1> simplex;
  int taken = 0;
  const auto vertex = [&](const std::array<double, N>& x) {
    ++taken;
    return Vertex{x, function(x)};
  };
  const auto by_value = [](const Vertex& a, const Vertex& b) { return a.value < b.value; };
  simplex[0] = vertex(start);
  for (std::size_t i = 0; i < N; ++i) {
    std::array<double, N> x = start;
    x[i] += step[i];
    simplex[i + 1] = vertex(x);
  }
  while (true) {
    std::stable_sort(simplex.begin(), simplex.end(), by_value);
    Vertex& worst = simplex[N];
    if (!(worst.value - simplex[0].value > tolerance) || taken >= most) return simplex[0];
    std::array<double, N> centre{};
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t d = 0; d < N; ++d) centre[d] += simplex[i].x[d] / static_cast<double>(N);
    }
    const auto along = [&](double factor) {
      std::array<double, N> x;
      for (std::size_t d = 0; d < N; ++d) x[d] = centre[d] + factor * (worst.x[d] - centre[d]);
      return vertex(x);
    };
    const Vertex reflected = along(-1.0);
    if (reflected.value < simplex[0].value) {
      worst = std::min(along(-2.0), reflected, by_value);
    } else if (reflected.value < simplex[N - 1].value) {
      worst = reflected;
    } else {
      const Vertex contracted = along(reflected.value < worst.value ? -0.5 : 0.5);
      if (contracted.value < std::min(reflected.value, worst.value)) {
        worst = contracted;
        continue;
      }
      for (std::size_t i = 1; i <= N; ++i) {
        std::array<double, N> x;
        for (std::size_t d = 0; d < N; ++d) x[d] = 0.5 * (simplex[0].x[d] + simplex[i].x[d]);
        simplex[i] = vertex(x);
      }
    }
  }
}

}  // namespace ballbar
