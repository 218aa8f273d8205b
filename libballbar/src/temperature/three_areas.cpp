#include <algorithm>
#include <cmath>

#include "ballbar/temperature/temperature.hpp"

namespace ballbar {
namespace {

struct AreaLengths {
  double S1 = 0.0, S2 = 0.0, S3 = 0.0;

  void add(Area area, double length) { (area == Area::hot ? S1 : area == Area::middle ? S2 : S3) += length; }
  double sum() const { return S1 + S2 + S3; }
  double mean_degC(double min_degC, double max_degC) const {
    return min_degC + (max_degC - min_degC) * (5.0 * S1 + 3.0 * S2 + S3) / (6.0 * sum());
  }
};

}  // namespace

int otsu_threshold(const Histogram& histogram) {
  double n = 0.0, sum = 0.0;  // exact: integers below 2^53
  for (std::size_t i = 0; i < histogram.size(); ++i) {
    n += histogram[i];
    sum += static_cast<double>(i) * histogram[i];
  }
  double n1 = 0.0, sum1 = 0.0, largest = 0.0;
  int threshold = 0;
  for (std::size_t k = 0; k < histogram.size(); ++k) {
    n1 += histogram[k];
    sum1 += static_cast<double>(k) * histogram[k];
    const double n2 = n - n1;
    if (n1 == 0.0 || n2 == 0.0) continue;
    const double m1 = sum1 / n1, m2 = (sum - sum1) / n2;
    const double between = n1 * n2 * (m1 - m2) * (m1 - m2);  // s^2 n^2
    if (between > largest) {
      largest = between;
      threshold = static_cast<int>(k);
    }
  }
  return threshold;
}

int triangle_threshold(const Histogram& histogram) {
  const auto filled = [](std::uint32_t count) { return count > 0; };
  const auto first = std::find_if(histogram.begin(), histogram.end(), filled);
  if (first == histogram.end()) return -1;
  constexpr std::int64_t kLast = 255;
  const std::int64_t left = std::max<std::int64_t>(first - histogram.begin() - 1, 0);
  const auto last = std::find_if(histogram.rbegin(), histogram.rend(), filled);
  const std::int64_t right = std::min<std::int64_t>(kLast - (last - histogram.rbegin()) + 1, kLast);
  const std::int64_t top = std::max_element(histogram.begin(), histogram.end()) - histogram.begin();

  // The longer side is the lower one: otherwise the histogram is looked at from its other end.
  const bool mirrored = top - left < right - top;
  const std::int64_t end = mirrored ? kLast - right : left;
  const std::int64_t peak = mirrored ? kLast - top : top;
  const auto count_at = [&](std::int64_t i) {
    return static_cast<std::int64_t>(histogram[static_cast<std::size_t>(mirrored ? kLast - i : i)]);
  };
  // Distance of (i, count) under the line from (end, 0) to (peak, height), up to constants: height i - (peak - end)
  // count.
  std::int64_t threshold = end, farthest = 0;
  for (std::int64_t i = end + 1; i <= peak; ++i) {
    const std::int64_t distance = count_at(peak) * i - (peak - end) * count_at(i);
    if (distance > farthest) {
      farthest = distance;
      threshold = i;
    }
  }
  --threshold;
  return static_cast<int>(mirrored ? kLast - threshold : threshold);
}

ThreeAreas three_areas(const Picture& picture, const TemperatureImage& image, double min_degC, double max_degC,
                       bool vertical) {
  Histogram red{}, blue{};
  const PixelBox& box = image.region;
  const auto each = [&](auto&& visit) {
    for (std::size_t row = 0; row < box.height; ++row) {
      for (std::size_t column = 0; column < box.width; ++column) {
        const std::size_t at = row * box.width + column;
        if (!std::isnan(image.degC[at])) visit(at, colour_at(picture, box.x + column, box.y + row));
      }
    }
  };
  std::vector<std::size_t> pixels(vertical ? box.height : box.width);  // of each column
  const auto column_of = [&](std::size_t at) { return vertical ? at / box.width : at % box.width; };
  each([&](std::size_t at, const Colour& colour) {
    ++red[colour[0]];
    ++blue[colour[2]];
    ++pixels[column_of(at)];
  });
  ThreeAreas result;
  result.red_otsu = otsu_threshold(red);
  result.red_triangle = triangle_threshold(red);
  result.blue_otsu = otsu_threshold(blue);
  result.blue_triangle = triangle_threshold(blue);
  const auto area_of = [](const Colour& colour, int red_above, int blue_up_to) {
    return colour[0] > red_above ? Area::hot : colour[2] <= blue_up_to ? Area::middle : Area::cold;
  };
  result.areas.assign(image.degC.size(), Area::none);
  AreaLengths both, otsu;
  each([&](std::size_t at, const Colour& colour) {
    const Area area = area_of(colour, std::min(result.red_otsu, result.red_triangle),
                              std::max(result.blue_otsu, result.blue_triangle));
    result.areas[at] = area;
    ++(area == Area::hot ? result.hot : area == Area::middle ? result.middle : result.cold);
    const double length = 1.0 / static_cast<double>(pixels[column_of(at)]);
    both.add(area, length);
    otsu.add(area_of(colour, result.red_otsu, result.blue_otsu), length);
  });
  result.hot_share = both.S1 / both.sum();
  result.middle_share = both.S2 / both.sum();
  result.cold_share = both.S3 / both.sum();
  result.mean_degC = both.mean_degC(min_degC, max_degC);
  result.otsu_mean_degC = otsu.mean_degC(min_degC, max_degC);
  return result;
}

}  // namespace ballbar
