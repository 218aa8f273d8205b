#include "ballbar/formats/pictures/picture_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "pictures/heard_stderr.hpp"
#include "pictures/jpeg_outline.hpp"

namespace ballbar {
namespace {

constexpr std::pair<std::string_view, int> kMaps[] = {
    {"bone", cv::COLORMAP_BONE},       {"cividis", cv::COLORMAP_CIVIDIS}, {"gray", -1},
    {"hot", cv::COLORMAP_HOT},         {"inferno", cv::COLORMAP_INFERNO}, {"jet", cv::COLORMAP_JET},
    {"magma", cv::COLORMAP_MAGMA},     {"parula", cv::COLORMAP_PARULA},   {"plasma", cv::COLORMAP_PLASMA},
    {"rainbow", cv::COLORMAP_RAINBOW}, {"turbo", cv::COLORMAP_TURBO},     {"viridis", cv::COLORMAP_VIRIDIS}};

void silence() { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }

// 8 or 16 bits; 1, 3 or 4 channels, the fourth the opacity; to 8-bit red, green, blue over white.
cv::Mat rgb_of(cv::Mat decoded) {
  if (decoded.depth() == CV_16U) decoded.convertTo(decoded, CV_8U, 1.0 / 257.0);
  cv::Mat rgb;
  if (decoded.channels() == 1) {
    cv::cvtColor(decoded, rgb, cv::COLOR_GRAY2RGB);
  } else if (decoded.channels() == 3) {
    cv::cvtColor(decoded, rgb, cv::COLOR_BGR2RGB);
  } else {
    cv::cvtColor(decoded, rgb, cv::COLOR_BGRA2RGB);
    for (int row = 0; row < rgb.rows; ++row) {
      for (int column = 0; column < rgb.cols; ++column) {
        const int opacity = decoded.at<cv::Vec4b>(row, column)[3];
        auto& pixel = rgb.at<cv::Vec3b>(row, column);
        for (int c = 0; c < 3; ++c) {
          pixel[c] = static_cast<std::uint8_t>((pixel[c] * opacity + 255 * (255 - opacity) + 127) / 255);
        }
      }
    }
  }
  return rgb;
}

[[noreturn]] void fail_damaged(std::string_view name, std::string_view said) {
  throw Error(
      fmt::format("{}: expected a whole picture, found a damaged one{}{}.", name, said.empty() ? "" : ": ", said));
}

std::string encoded(const Picture& picture, const char* ending, const std::vector<int>& parameters) {
  if (picture.rgb.empty() || picture.rgb.size() != 3 * picture.width * picture.height) {
    throw Error(fmt::format("a picture of {} by {} pixels needs 3 values a pixel; found {}", picture.width,
                            picture.height, picture.rgb.size()));
  }
  silence();
  const cv::Mat rgb(static_cast<int>(picture.height), static_cast<int>(picture.width), CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));  // only read
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(ending, bgr, bytes, parameters)) throw Error("a picture could not be encoded");
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Picture read_picture(std::string_view bytes, std::string_view name) {
  const PictureSize size = picture_size(bytes, name);
  if (size.width > kMostPixels / size.height) {
    throw Error(fmt::format("{}: expected at most {} megapixels, found {} by {}.", name, kMostPixels / 1'000'000,
                            size.width, size.height));
  }
  const bool png = bytes.starts_with('\x89');
  if (!png && !jpeg_outline(bytes).whole) fail_damaged(name, "it ends before its end marker");
  silence();
  // As it is stored, so that opacity is known; a JPEG has none, and only IMREAD_COLOR turns it.
  const int how = png ? cv::IMREAD_UNCHANGED : cv::IMREAD_COLOR;
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));  // only read
  cv::Mat decoded;
  const std::string said = heard_stderr([&] {
    try {
      decoded = cv::imdecode(raw, how);
    } catch (const cv::Exception&) {  // then there is no picture
    }
  });
  const bool cut = said.starts_with("Corrupt JPEG") || said.starts_with("Premature end");
  if (cut || decoded.empty()) fail_damaged(name, said);
  const cv::Mat rgb = rgb_of(std::move(decoded));
  Picture picture{static_cast<std::size_t>(rgb.cols), static_cast<std::size_t>(rgb.rows), {}};
  picture.rgb.assign(rgb.data, rgb.data + 3 * picture.width * picture.height);
  return picture;
}

std::string write_png(const Picture& picture) { return encoded(picture, ".png", {}); }

std::string write_jpeg(const Picture& picture, int quality) {
  return encoded(picture, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

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
