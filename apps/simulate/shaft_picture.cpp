#include "simulate/shaft_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"

namespace ballbar {
namespace {

constexpr Colour kBlack{0, 0, 0};
constexpr std::size_t kMargin_px = 12, kTextHeight_px = 24, kBarWidth_px = 16, kNumbersWidth_px = 56;

Picture blank(std::size_t width, std::size_t height) {
  return {width, height, std::vector<std::uint8_t>(3 * width * height, 255)};
}

void paint(Picture& picture, std::size_t x, std::size_t y, const Colour& colour) {
  std::copy(colour.begin(), colour.end(),
            picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * (y * picture.width + x)));
}

// Left end of the text and its baseline.
void write(Picture& picture, const std::string& text, std::size_t x, std::size_t y) {
  constexpr double kSize = 0.4;  // letters of 9 pixels
  cv::Mat pixels(static_cast<int>(picture.height), static_cast<int>(picture.width), CV_8UC3, picture.rgb.data());
  cv::putText(pixels, text, {static_cast<int>(x), static_cast<int>(y)}, cv::FONT_HERSHEY_SIMPLEX, kSize, {0, 0, 0});
}

void outline(Picture& picture, const PixelBox& box) {
  for (std::size_t x = box.x - 1; x <= box.x + box.width; ++x) {
    paint(picture, x, box.y - 1, kBlack);
    paint(picture, x, box.y + box.height, kBlack);
  }
  for (std::size_t y = box.y - 1; y <= box.y + box.height; ++y) {
    paint(picture, box.x - 1, y, kBlack);
    paint(picture, box.x + box.width, y, kBlack);
  }
}

struct Part {
  double from_mm = 0.0, to_mm = 0.0;
};

Part part_of(const FiniteVolumeSpindle& body, const ShaftPictureStyle& style) {
  const Part part{style.from_mm.value_or(0.0), style.to_mm.value_or(body.length_mm)};
  if (part.from_mm >= 0.0 && part.from_mm < part.to_mm && part.to_mm <= body.length_mm) return part;
  throw Error(fmt::format("a picture of the shaft: expected a part within 0 to {} mm, found {} to {} mm.",
                          body.length_mm, part.from_mm, part.to_mm));
}

double radius_mm(const FiniteVolumeSpindle& body, double x_mm) {
  return x_mm < body.nose_mm ? body.shaft_radius_mm : body.tool_radius_mm;
}

double largest_radius_mm(const FiniteVolumeSpindle& body, const Part& part) {
  const double first_mm = radius_mm(body, part.from_mm);
  return part.to_mm > body.nose_mm ? std::max(first_mm, body.tool_radius_mm) : first_mm;
}

void check_size(const char* name, std::size_t value, std::size_t least, std::size_t most) {
  if (value >= least && value <= most) return;
  throw Error(fmt::format("a picture of the shaft: expected {} from {} to {}, found {}.", name, least, most, value));
}

// Temperature to colour.
struct Scale {
  double min_degC, max_degC;
  std::size_t bands;
  std::vector<Colour> colours;

  Colour of_share(double share) const {
    share = std::clamp(share, 0.0, 1.0);
    const auto count = static_cast<double>(bands);
    if (bands > 0) share = std::min(std::floor(share * count), count - 1.0) / (count - 1.0);
    return colours[static_cast<std::size_t>(std::lround(share * static_cast<double>(colours.size() - 1)))];
  }
  Colour of(double degC) const { return of_share((degC - min_degC) / (max_degC - min_degC)); }
};

Scale scale_of(const TemperatureProfile& shaft, const Part& part, const ShaftPictureStyle& style) {
  std::vector<double> degC{temperature_at(shaft, part.from_mm), temperature_at(shaft, part.to_mm)};
  for (std::size_t i = 0; i < shaft.x_mm.size(); ++i) {
    if (shaft.x_mm[i] > part.from_mm && shaft.x_mm[i] < part.to_mm) degC.push_back(shaft.degC[i]);
  }
  const auto [least, most] = std::minmax_element(degC.begin(), degC.end());
  const double min_degC = style.min_degC.value_or(std::floor(*least));
  const double max_degC = style.max_degC.value_or(std::max(std::ceil(*most), min_degC + 1.0));
  if (!(max_degC > min_degC)) {
    throw Error(
        fmt::format("a picture of the shaft: expected max_degC above min_degC, found {} and {}.", max_degC, min_degC));
  }
  return {min_degC, max_degC, style.bands, colour_map(style.colours)};
}

// The silhouette's box in the place that text and legend leave.
PixelBox box_of(const FiniteVolumeSpindle& body, const Part& part, const ShaftPictureStyle& style) {
  const std::size_t legend_px = style.legend ? kBarWidth_px + kNumbersWidth_px + kMargin_px : 0;
  const PixelBox place{kMargin_px, kTextHeight_px + kMargin_px, style.width_px - 2 * kMargin_px - legend_px,
                       style.height_px - kTextHeight_px - 2 * kMargin_px};
  const double length_mm = part.to_mm - part.from_mm;
  const double thick_mm = largest_radius_mm(body, part);
  const double px_per_mm =
      std::min(static_cast<double>(place.width) / length_mm, static_cast<double>(place.height) / (2.0 * thick_mm));
  const auto width = static_cast<std::size_t>(std::lround(length_mm * px_per_mm));
  const auto height = 2 * static_cast<std::size_t>(std::lround(thick_mm * px_per_mm));
  constexpr std::size_t kLeast_px = 4;
  if (width < kLeast_px || height < kLeast_px) {
    throw Error(
        fmt::format("a picture of the shaft: expected a part that is painted larger than {} pixels, found {} "
                    "mm of radius {} mm in {} by {} pixels.",
                    kLeast_px, length_mm, thick_mm, place.width, place.height));
  }
  return {place.x + (place.width - std::min(width, place.width)) / 2,
          place.y + (place.height - std::min(height, place.height)) / 2, width, height};
}

void paint_shaft(Picture& picture, const FiniteVolumeSpindle& body, const TemperatureProfile& shaft, const Part& part,
                 const PixelBox& box, const Scale& scale) {
  const double mm_per_px = (part.to_mm - part.from_mm) / static_cast<double>(box.width);
  const std::size_t thick_px = box.height / 2;
  const std::size_t middle = box.y + thick_px;
  const double thick_mm = largest_radius_mm(body, part);
  std::vector<std::size_t> half_px;  // a column's rows are middle - half to middle + half - 1
  for (std::size_t column = 0; column < box.width; ++column) {
    const double x_mm = part.from_mm + (static_cast<double>(column) + 0.5) * mm_per_px;
    half_px.push_back(std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(radius_mm(body, x_mm) / thick_mm * static_cast<double>(thick_px)))));
    const Colour colour = scale.of(temperature_at(shaft, x_mm));
    for (std::size_t y = middle - half_px[column]; y < middle + half_px[column]; ++y) {
      paint(picture, box.x + column, y, colour);
    }
  }
  // Outside of the silhouette, so that no pixel of the field is lost.
  for (std::size_t column = 0; column <= box.width + 1; ++column) {
    const auto half_at = [&](std::size_t c) { return c >= 1 && c <= box.width ? half_px[c - 1] : 0; };
    const std::size_t own = half_at(column);
    const std::size_t neighbour = std::max(column > 0 ? half_at(column - 1) : 0, half_at(column + 1));
    const std::size_t reach = std::max(own == 0 ? 0 : own + 1, neighbour);
    for (std::size_t from_middle = own; from_middle < reach; ++from_middle) {
      paint(picture, box.x + column - 1, middle - from_middle - 1, kBlack);
      paint(picture, box.x + column - 1, middle + from_middle, kBlack);
    }
  }
}

PixelBox paint_legend(Picture& picture, const Scale& scale) {
  const std::size_t top = kTextHeight_px + kMargin_px;
  const PixelBox bar{picture.width - kMargin_px - kNumbersWidth_px - kBarWidth_px, top, kBarWidth_px,
                     picture.height - top - kMargin_px};
  for (std::size_t row = 0; row < bar.height; ++row) {
    const double share = 1.0 - (static_cast<double>(row) + 0.5) / static_cast<double>(bar.height);
    for (std::size_t x = bar.x; x < bar.x + bar.width; ++x) paint(picture, x, bar.y + row, scale.of_share(share));
  }
  outline(picture, bar);
  constexpr std::size_t kNumbers = 5, kHalfLetter_px = 4, kGap_px = 6;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kNumbers - 1);
    const auto down_px = static_cast<std::size_t>(std::lround((1.0 - share) * static_cast<double>(bar.height - 1)));
    write(picture, fmt::format("{:.4g}", std::lerp(scale.min_degC, scale.max_degC, share)), bar.x + bar.width + kGap_px,
          bar.y + down_px + kHalfLetter_px);
  }
  return bar;
}

}  // namespace

ShaftPicture shaft_picture(const FiniteVolumeSpindle& body, const TemperatureProfile& shaft,
                           const ShaftPictureStyle& style) {
  check_size("width_px", style.width_px, 200, 4000);
  check_size("height_px", style.height_px, 100, 4000);
  if (style.bands != 0) check_size("bands", style.bands, 2, 64);
  const Part part = part_of(body, style);
  const Scale scale = scale_of(shaft, part, style);
  ShaftPicture result{.picture = blank(style.width_px, style.height_px),
                      .shaft = box_of(body, part, style),
                      .min_degC = scale.min_degC,
                      .max_degC = scale.max_degC};
  paint_shaft(result.picture, body, shaft, part, result.shaft, scale);
  if (style.legend) result.bar = paint_legend(result.picture, scale);
  write(result.picture, fmt::format("SIMULATED{}{}", style.text.empty() ? "" : "  ", style.text), kMargin_px,
        kTextHeight_px - 8);
  return result;
}

}  // namespace ballbar
