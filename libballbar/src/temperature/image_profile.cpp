#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/temperature/temperature.hpp"

namespace ballbar {
namespace {

constexpr double kShortest_mm = 0.1;       // of the region
constexpr std::size_t kFewestPixels = 3;   // of a column
constexpr std::size_t kFewestColumns = 8;  // and the least window
constexpr double kShared = 8.0;            // pixels, along a column and along x, that have one error: a JPEG's block

struct ImageColumn {
  double x_mm = 0.0, degC = 0.0, sigma_degC = 0.0;
};

// Along one line of pixels: straight between the steps of the staircase, T at a step the mean of both bands.
std::vector<double> without_bands(const std::vector<double>& staircase) {
  struct Node {
    double at, degC;
  };
  std::vector<Node> nodes;
  std::size_t begin = 0, end = 0;  // of the stretch of one band, first and last pixel
  double band = std::nan(""), step_before = 0.0;
  for (std::size_t i = 0; i < staircase.size(); ++i) {
    const double T = staircase[i];
    if (std::isnan(T)) continue;
    if (T == band) {
      end = i;
      continue;
    }
    if (!std::isnan(band)) {
      const double step = T - band;
      if (step * step_before < 0.0) nodes.push_back({0.5 * static_cast<double>(begin + end), band});
      nodes.push_back({0.5 * static_cast<double>(end + i), 0.5 * (band + T)});
      step_before = step;
    }
    band = T;
    begin = end = i;
  }
  std::vector<double> straight = staircase;
  if (nodes.size() < 2) return straight;
  std::size_t next = 1;
  for (std::size_t i = 0; i < straight.size(); ++i) {
    if (std::isnan(straight[i])) continue;
    const auto at = static_cast<double>(i);
    while (next + 1 < nodes.size() && nodes[next].at < at) ++next;
    const Node &p = nodes[next - 1], &q = nodes[next];
    const double T = p.degC + (q.degC - p.degC) * (at - p.at) / (q.at - p.at);
    // Beyond the first and the last step no farther than their bands reach.
    const double reach = std::abs(straight[i] - (at < p.at ? p.degC : q.degC));
    straight[i] = at < p.at || at > q.at ? std::clamp(T, straight[i] - reach, straight[i] + reach) : T;
  }
  return straight;
}

ImageColumn column_of(const std::vector<double>& pixels, double x_mm) {
  const auto n = static_cast<double>(pixels.size());
  double sum = 0.0, squares = 0.0;
  for (const double T : pixels) sum += T;
  for (const double T : pixels) squares += (T - sum / n) * (T - sum / n);
  const double scatter = std::sqrt(squares / (n - 1.0));
  return {x_mm, sum / n, scatter / std::sqrt(std::max(1.0, n / kShared))};
}

struct LinePoint {
  double degC = 0.0, sigma_degC = 0.0;
};

// The least-squares line through the columns [begin, end), at x:  T = sum w_i T_i,  w_i = 1/n + (x - m)(x_i - m) / S.
LinePoint line_through(const std::vector<ImageColumn>& columns, std::size_t begin, std::size_t end, double x_mm) {
  const auto n = static_cast<double>(end - begin);
  double m = 0.0, S = 0.0;
  for (std::size_t i = begin; i < end; ++i) m += columns[i].x_mm / n;
  for (std::size_t i = begin; i < end; ++i) S += (columns[i].x_mm - m) * (columns[i].x_mm - m);
  LinePoint point;
  double variance = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const double w = 1.0 / n + (x_mm - m) * (columns[i].x_mm - m) / S;
    point.degC += w * columns[i].degC;
    variance += w * w * columns[i].sigma_degC * columns[i].sigma_degC;
  }
  point.sigma_degC = std::sqrt(variance * std::min(kShared, n));
  return point;
}

}  // namespace

ImageProfile image_profile(const TemperatureImage& image, const ColourScale& scale, double from_mm, double to_mm,
                           bool vertical) {
  if (!(from_mm >= -kLargestPlace_mm && to_mm <= kLargestPlace_mm && to_mm - from_mm >= kShortest_mm)) {
    throw Error(fmt::format(
        "the region needs an end {} mm or more above its start, both within {:g} mm of 0; found {} to {} mm",
        kShortest_mm, kLargestPlace_mm, from_mm, to_mm));
  }
  const PixelBox& box = image.region;
  ImageProfile result;
  result.columns = vertical ? box.height : box.width;
  const std::size_t across = vertical ? box.width : box.height;
  const double pixel_mm = (to_mm - from_mm) / static_cast<double>(result.columns);

  // Line by line along the spindle.
  std::vector<std::vector<double>> lines(across);
  for (std::size_t j = 0; j < across; ++j) {
    for (std::size_t i = 0; i < result.columns; ++i) {
      lines[j].push_back(image.degC[vertical ? i * box.width + j : j * box.width + i]);
    }
    if (scale.banded) lines[j] = without_bands(lines[j]);
  }

  std::vector<ImageColumn> columns;  // those with pixels
  std::vector<double> pixels, places{from_mm};
  for (std::size_t i = 0; i < result.columns; ++i) {
    pixels.clear();
    for (std::size_t j = 0; j < across; ++j) {
      if (!std::isnan(lines[j][i])) pixels.push_back(lines[j][i]);
    }
    const double x_mm = from_mm + (static_cast<double>(i) + 0.5) * pixel_mm;
    places.push_back(x_mm);
    if (pixels.size() >= kFewestPixels) columns.push_back(column_of(pixels, x_mm));
  }
  places.push_back(to_mm);
  result.empty_columns = result.columns - columns.size();
  if (columns.size() < kFewestColumns) {
    throw Error(fmt::format("the region needs at least {} {} with {} pixels on the scale; found {}", kFewestColumns,
                            vertical ? "rows" : "columns", kFewestPixels, columns.size()));
  }

  result.window = std::min(columns.size(), std::max(kFewestColumns, result.columns / 40));
  std::size_t begin = 0;
  for (const double x_mm : places) {
    // The window moves on while the column after it is nearer than its first.
    while (begin + result.window < columns.size() &&
           columns[begin + result.window].x_mm - x_mm < x_mm - columns[begin].x_mm) {
      ++begin;
    }
    const LinePoint point = line_through(columns, begin, begin + result.window, x_mm);
    result.profile.x_mm.push_back(x_mm);
    result.profile.degC.push_back(point.degC);
    result.profile.sigma_degC.push_back(point.sigma_degC);
  }
  const auto n = static_cast<double>(columns.size());
  double variance = scale.step_degC * scale.step_degC / 12.0;
  for (const ImageColumn& column : columns) {
    variance += std::min(kShared, n) * column.sigma_degC * column.sigma_degC / (n * n);
  }
  result.sigma_mean_degC = std::sqrt(variance);
  return result;
}

}  // namespace ballbar
