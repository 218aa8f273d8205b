#include "ballbar/compensation/reduction.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

double size_of(double error_um, ErrorSize size) {
  return size == ErrorSize::mean_of_sizes ? std::abs(error_um) : error_um * error_um;
}

double sum_of(std::span<const double> errors_um, ErrorSize size) {
  double sum = 0.0;
  for (const double error_um : errors_um) sum += size_of(error_um, size);
  return sum;
}

double share_of(double before, double after, ErrorSize size) {
  if (!(before > 0.0)) return kUnknown;
  return 1.0 - (size == ErrorSize::mean_of_sizes ? after / before : std::sqrt(after / before));
}

// Twice the lag at which the values are no longer alike.
std::size_t stretch_of(std::span<const double> values) {
  const std::size_t n = values.size(), longest = std::max<std::size_t>(1, n / 5);
  double mean = 0.0, square = 0.0;
  for (const double value : values) mean += value / static_cast<double>(n);
  for (const double value : values) square += (value - mean) * (value - mean);
  for (std::size_t lag = 1; lag < longest; ++lag) {
    double product = 0.0;
    for (std::size_t i = lag; i < n; ++i) product += (values[i] - mean) * (values[i - lag] - mean);
    if (!(product > 0.2 * square)) return std::min(longest, lag == 1 ? lag : 2 * lag);
  }
  return longest;
}

// sigma^2 = (g - 1) / g sum (share without stretch j - their mean)^2, g stretches
double jackknife(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size,
                 std::size_t stretch) {
  const std::size_t n = before_um.size();
  if (n < 3) return kUnknown;
  const double before = sum_of(before_um, size), after = sum_of(after_um, size);
  std::vector<double> without;
  double mean = 0.0;
  for (std::size_t from = 0; from < n; from += stretch) {
    const std::size_t count = std::min(stretch, n - from);
    without.push_back(share_of(before - sum_of(before_um.subspan(from, count), size),
                               after - sum_of(after_um.subspan(from, count), size), size));
    mean += without.back();
  }
  const auto groups = static_cast<double>(without.size());
  mean /= groups;
  double square = 0.0;
  for (const double share : without) square += (share - mean) * (share - mean);
  return std::sqrt((groups - 1.0) / groups * square);
}

constexpr std::array<Huang2022Bore, 10> kTable3{{{29.979709, 175.005271, 29.994545, 175.002451},
                                                 {29.979625, 175.005322, 29.994471, 175.002513},
                                                 {29.979721, 175.005288, 29.994516, 175.002462},
                                                 {29.979711, 175.005158, 29.994528, 175.002381},
                                                 {29.979906, 175.005952, 29.994661, 175.002736},
                                                 {29.979535, 175.005573, 29.994345, 175.002616},
                                                 {29.979431, 175.005482, 29.994239, 175.002561},
                                                 {29.979607, 175.005467, 29.994404, 175.002478},
                                                 {29.979782, 175.005441, 29.994567, 175.002537},
                                                 {29.979756, 175.005393, 29.994632, 175.002493}}};

Reduction of_table(double Huang2022Bore::*before_mm, double Huang2022Bore::*after_mm, double nominal_mm) {
  std::vector<double> before_um, after_um;
  for (const Huang2022Bore& bore : kTable3) {
    before_um.push_back(1e3 * (bore.*before_mm - nominal_mm));
    after_um.push_back(1e3 * (bore.*after_mm - nominal_mm));
  }
  return reduction_of(before_um, after_um, ErrorSize::mean_of_sizes);
}

}  // namespace

Reduction reduction_of(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size) {
  assert(!before_um.empty() && before_um.size() == after_um.size());
  const auto n = static_cast<double>(before_um.size());
  const double before = sum_of(before_um, size), after = sum_of(after_um, size);
  const bool squares = size == ErrorSize::root_mean_square;
  const std::size_t stretch = stretch_of(after_um);
  return {squares ? std::sqrt(before / n) : before / n, squares ? std::sqrt(after / n) : after / n,
          share_of(before, after, size), jackknife(before_um, after_um, size, stretch), stretch};
}

std::span<const Huang2022Bore> huang2022_table_3() { return kTable3; }

Reduction huang2022_axial_reduction() {
  return of_table(&Huang2022Bore::depth_before_mm, &Huang2022Bore::depth_after_mm, kHuang2022Depth_mm);
}

Reduction huang2022_radial_reduction() {
  return of_table(&Huang2022Bore::diameter_before_mm, &Huang2022Bore::diameter_after_mm, kHuang2022Diameter_mm);
}

}  // namespace ballbar
