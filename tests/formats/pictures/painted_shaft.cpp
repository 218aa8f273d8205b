#include "painted_shaft.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "ballbar/formats/pictures/picture_file.hpp"

namespace ballbar {

TemperatureProfile known_profile(int shape, std::uint32_t seed) {
  std::mt19937 random(seed * 101u + static_cast<std::uint32_t>(shape));
  const auto drawn = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const double width = drawn(70.0, 140.0), place = drawn(0.35, 0.65) * kShaft_mm, phase = drawn(0.0, 6.28);
  const double second = drawn(0.3, 0.8);
  const auto hump = [](double x, double centre, double half) { return std::exp(-std::pow((x - centre) / half, 2.0)); };
  TemperatureProfile profile;
  for (int i = 0; i <= 3300; ++i) {
    const double x = 0.1 * i;
    profile.x_mm.push_back(x);
    profile.degC.push_back(shape == 0 ? std::exp(-x / width)
                           : shape == 1
                               ? hump(x, 0.2 * kShaft_mm, 0.7 * width) + second * hump(x, 0.8 * kShaft_mm, 60.0)
                           : shape == 2 ? hump(x, place, width)
                                        : 1.0 - x / kShaft_mm + 0.05 * std::sin(x / 40.0 + phase));
  }
  const auto [low, high] = std::minmax_element(profile.degC.begin(), profile.degC.end());
  const double least = *low, span = *high - *low;
  for (double& T : profile.degC) T = 23.0 + 24.0 * (T - least) / span;
  return profile;
}

Picture painted_shaft(const TemperatureProfile& profile, std::string_view colours, std::size_t bands) {
  const std::vector<Colour> map = colour_map(colours);
  const auto colour_of = [&](double share) {  // of the scale, 0 to 1
    if (bands > 0) {
      const auto n = static_cast<double>(bands);
      share = (std::min(std::floor(share * n), n - 1.0) + 0.5) / n;
    }
    const Colour& c = map[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255.0))];
    return cv::Scalar(c[0], c[1], c[2]);
  };
  cv::Mat rgb(360, 900, CV_8UC3, cv::Scalar(255, 255, 255));
  const cv::Scalar black(0, 0, 0);
  const int middle = static_cast<int>(kShaftBox.y + kShaftBox.height / 2);
  int before = 0;
  for (std::size_t i = 0; i < kShaftBox.width; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(kShaftBox.width);
    const int half = share < 0.3 ? 100 : share < 0.75 ? 80 : 50;
    const int x = static_cast<int>(kShaftBox.x + i);
    const double T = temperature_at(profile, share * kShaft_mm);
    cv::line(rgb, {x, middle - half}, {x, middle + half - 1}, colour_of((T - kLow_degC) / (kHigh_degC - kLow_degC)));
    for (const int side : {-1, 1}) {
      const int edge = side < 0 ? middle - half : middle + half - 1;
      const int last = before == 0 ? middle : side < 0 ? middle - before : middle + before - 1;
      cv::line(rgb, {x, before == half ? edge : last}, {x, edge}, black);
    }
    before = half;
  }
  cv::line(rgb, {static_cast<int>(kShaftBox.x + kShaftBox.width - 1), middle - before},
           {static_cast<int>(kShaftBox.x + kShaftBox.width - 1), middle + before - 1}, black);
  const cv::Rect bar(static_cast<int>(kLegendBox.x), static_cast<int>(kLegendBox.y), static_cast<int>(kLegendBox.width),
                     static_cast<int>(kLegendBox.height));
  for (int i = 0; i < bar.height; ++i) {
    const int y = bar.y + bar.height - 1 - i;
    cv::line(rgb, {bar.x, y}, {bar.x + bar.width - 1, y}, colour_of((i + 0.5) / bar.height));
  }
  cv::rectangle(rgb, {bar.x - 1, bar.y - 1}, {bar.x + bar.width, bar.y + bar.height}, black);
  cv::putText(rgb, "Temperature, steady state, 6000 rpm", {60, 40}, cv::FONT_HERSHEY_SIMPLEX, 0.8, black, 2,
              cv::LINE_AA);
  cv::putText(rgb, "48", {bar.x + bar.width + 6, bar.y + 10}, cv::FONT_HERSHEY_SIMPLEX, 0.5, black, 1, cv::LINE_AA);
  cv::putText(rgb, "22", {bar.x + bar.width + 6, bar.y + bar.height}, cv::FONT_HERSHEY_SIMPLEX, 0.5, black, 1,
              cv::LINE_AA);
  Picture picture{static_cast<std::size_t>(rgb.cols), static_cast<std::size_t>(rgb.rows), {}};
  picture.rgb.assign(rgb.data, rgb.data + rgb.total() * 3);
  return picture;
}

}  // namespace ballbar
