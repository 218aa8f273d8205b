// Colour maps as OpenCV has them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/internal/nearest_name.hpp"

namespace ballbar {
namespace {

constexpr std::pair<std::string_view, int> kMaps[] = {
    {"bone", cv::COLORMAP_BONE},       {"cividis", cv::COLORMAP_CIVIDIS}, {"gray", -1},
    {"hot", cv::COLORMAP_HOT},         {"inferno", cv::COLORMAP_INFERNO}, {"jet", cv::COLORMAP_JET},
    {"magma", cv::COLORMAP_MAGMA},     {"parula", cv::COLORMAP_PARULA},   {"plasma", cv::COLORMAP_PLASMA},
    {"rainbow", cv::COLORMAP_RAINBOW}, {"turbo", cv::COLORMAP_TURBO},     {"viridis", cv::COLORMAP_VIRIDIS}};

}  // namespace

std::vector<std::string_view> colour_map_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, map] : kMaps) names.push_back(name);
  return names;
}

std::vector<Colour> colour_map(std::string_view name) {
  const bool reversed = name.ends_with("_r");
  const std::string_view plain = reversed ? name.substr(0, name.size() - 2) : name;
  const auto* const found =
      std::find_if(std::begin(kMaps), std::end(kMaps), [&](auto& map) { return map.first == plain; });
  if (found == std::end(kMaps)) {
    throw Error(fmt::format("expected a colour map, one of {}, or one of them with _r, found {}.",
                            fmt::join(colour_map_names(), ", "), in_quotes(name)));
  }
  cv::Mat levels(1, 256, CV_8UC1), colours;
  for (int i = 0; i < 256; ++i) levels.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  if (found->second < 0) {
    cv::cvtColor(levels, colours, cv::COLOR_GRAY2BGR);
  } else {
    cv::applyColorMap(levels, colours, found->second);
  }
  std::vector<Colour> map;
  for (int i = 0; i < 256; ++i) {
    const auto bgr = colours.at<cv::Vec3b>(0, i);
    map.push_back({bgr[2], bgr[1], bgr[0]});
  }
  if (reversed) std::reverse(map.begin(), map.end());
  return map;
}

}  // namespace ballbar
