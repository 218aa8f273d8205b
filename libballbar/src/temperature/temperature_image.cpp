#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/temperature/temperature.hpp"
#include "numerics/not_finite.hpp"
#include "temperature/colour_scale.hpp"

namespace ballbar {
namespace {

constexpr double kOffScale = 40.0;       // levels of 255, luma counted twice
constexpr int kPaper = 24;               // levels of 255 from white or black
constexpr double kContrast = 0.1;        // of the scale's span
constexpr std::size_t kMedianReach = 3;  // pixels to each side
constexpr double kAtEnd = 0.01;          // of the scale's span
constexpr double kSaturated = 0.03;      // of the pixels used
constexpr std::size_t kSpike = 4;        // times as many as beside
constexpr std::size_t kWidestLine = 8;   // pixels: what is apart by more is not one thing

enum class Pixel : std::uint8_t { on, off_scale, contrasting, at_edge };

struct Field {
  PixelBox box;
  std::vector<double> degC;
  std::vector<Pixel> state;
};

Field inverted(const Picture& picture, const ColourScale& scale, const PixelBox& box) {
  std::vector<Luma> line;
  for (const Colour& colour : scale.colours) line.push_back(luma_of(colour));
  // Pictures have far fewer colours than pixels.
  std::unordered_map<std::uint32_t, OnScale> known;
  Field field{box, std::vector<double>(box.width * box.height), std::vector<Pixel>(box.width * box.height, Pixel::on)};
  for (std::size_t row = 0, at = 0; row < box.height; ++row) {
    for (std::size_t column = 0; column < box.width; ++column, ++at) {
      const Colour c = colour_at(picture, box.x + column, box.y + row);
      const std::uint32_t key = std::uint32_t{c[0]} << 16 | std::uint32_t{c[1]} << 8 | c[2];
      auto found = known.find(key);
      if (found == known.end()) found = known.emplace(key, nearest_on_scale(scale, line, luma_of(c))).first;
      field.degC[at] = found->second.degC;
      if (found->second.distance > kOffScale) field.state[at] = Pixel::off_scale;
    }
  }
  return field;
}

void cut_out_legend(Field& field, const PixelBox& legend) {
  for (std::size_t row = 0, at = 0; row < field.box.height; ++row) {
    for (std::size_t column = 0; column < field.box.width; ++column, ++at) {
      const std::size_t x = field.box.x + column, y = field.box.y + row;
      const bool in = x >= legend.x && x - legend.x < legend.width && y >= legend.y && y - legend.y < legend.height;
      if (in) field.state[at] = Pixel::off_scale;
    }
  }
}

// White or black paper around the picture, from its border inwards: such a colour may be on the scale (gray, hot).
// Empty where most of the border is neither.
std::vector<bool> background(const Picture& picture) {
  const auto paper = [&](std::size_t at, int level) {
    const std::uint8_t* c = &picture.rgb[3 * at];
    return std::abs(c[0] - level) <= kPaper && std::abs(c[1] - level) <= kPaper && std::abs(c[2] - level) <= kPaper;
  };
  std::vector<std::size_t> border;
  for (std::size_t x = 0; x < picture.width; ++x) {
    border.push_back(x);
    border.push_back((picture.height - 1) * picture.width + x);
  }
  for (std::size_t y = 0; y < picture.height; ++y) {
    border.push_back(y * picture.width);
    border.push_back(y * picture.width + picture.width - 1);
  }
  for (const int level : {255, 0}) {
    const auto many = std::count_if(border.begin(), border.end(), [&](std::size_t at) { return paper(at, level); });
    if (static_cast<std::size_t>(many) <= border.size() / 2) continue;
    std::vector<bool> outside(picture.width * picture.height);
    std::vector<std::size_t> open = border;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      if (outside[at] || !paper(at, level)) continue;
      outside[at] = true;
      if (at % picture.width > 0) open.push_back(at - 1);
      if (at % picture.width + 1 < picture.width) open.push_back(at + 1);
      if (at >= picture.width) open.push_back(at - picture.width);
      if (at + picture.width < outside.size()) open.push_back(at + picture.width);
    }
    return outside;
  }
  return {};
}

void cut_out_background(Field& field, const Picture& picture) {
  const std::vector<bool> outside = background(picture);
  if (outside.empty()) return;
  for (std::size_t at = 0; at < field.state.size(); ++at) {
    const std::size_t x = field.box.x + at % field.box.width, y = field.box.y + at / field.box.width;
    if (outside[y * picture.width + x]) field.state[at] = Pixel::off_scale;
  }
}

// Lines and letters whose colour is on the scale: a field of temperature does not jump within 7 pixels.
std::vector<std::size_t> contrasting(const Field& field, double limit_degC) {
  const std::size_t width = field.box.width, height = field.box.height;
  std::vector<std::size_t> places;
  std::vector<double> around;
  for (std::size_t row = 0, at = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column, ++at) {
      if (field.state[at] != Pixel::on) continue;
      around.clear();
      double low = field.degC[at], high = low;
      for (std::size_t y = row - std::min(row, kMedianReach); y <= std::min(row + kMedianReach, height - 1); ++y) {
        for (std::size_t x = column - std::min(column, kMedianReach); x <= std::min(column + kMedianReach, width - 1);
             ++x) {
          const std::size_t neighbour = y * width + x;
          if (field.state[neighbour] != Pixel::on) continue;
          around.push_back(field.degC[neighbour]);
          low = std::min(low, around.back());
          high = std::max(high, around.back());
        }
      }
      if (high - low <= limit_degC) continue;  // the usual case needs no median
      if (std::abs(field.degC[at] - median(around)) > limit_degC) places.push_back(at);
    }
  }
  return places;
}

// Pixels that are on the scale with one within `reach` (rows or columns) that is not: along rows, then along columns.
void leave_out_edges(Field& field, std::size_t reach) {
  const std::size_t width = field.box.width, height = field.box.height;
  std::vector<bool> in_row(field.state.size());
  for (std::size_t at = 0; at < field.state.size(); ++at) {
    const std::size_t row = at / width, column = at % width;
    if (field.state[at] == Pixel::on) continue;
    for (std::size_t x = column - std::min(column, reach); x <= std::min(column + reach, width - 1); ++x) {
      in_row[row * width + x] = true;
    }
  }
  for (std::size_t at = 0; at < field.state.size(); ++at) {
    const std::size_t row = at / width, column = at % width;
    bool near = false;
    for (std::size_t y = row - std::min(row, reach); y <= std::min(row + reach, height - 1) && !near; ++y) {
      near = in_row[y * width + column];
    }
    if (near && field.state[at] == Pixel::on) field.state[at] = Pixel::at_edge;
  }
}

// The bounding box of the remaining pixels, and the edge that was removed.
PixelBox bounds(const Field& field, std::size_t edge_px) {
  const std::size_t width = field.box.width, height = field.box.height;
  std::size_t left = width, right = 0, top = height, bottom = 0;
  for (std::size_t at = 0; at < field.state.size(); ++at) {
    if (field.state[at] != Pixel::on) continue;
    left = std::min(left, at % width);
    right = std::max(right, at % width);
    top = std::min(top, at / width);
    bottom = std::max(bottom, at / width);
  }
  if (left > right) {
    throw Error("the picture needs pixels whose colour is on the scale; found none but lines, edges and the legend");
  }
  left -= std::min(left, edge_px);
  top -= std::min(top, edge_px);
  right = std::min(right + edge_px, width - 1);
  bottom = std::min(bottom + edge_px, height - 1);
  return {field.box.x + left, field.box.y + top, right - left + 1, bottom - top + 1};
}

struct Stretch {
  std::size_t first = 0, last = 0;
};

// The stretches of numbers that are taken, apart by more than `gap` that are not.
std::vector<Stretch> stretches(const std::vector<bool>& taken, std::size_t gap) {
  std::vector<Stretch> found;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) continue;
    if (found.empty() || i - found.back().last - 1 > gap) found.push_back({i, i});
    found.back().last = i;
  }
  return found;
}

// A legend that was not stated, beside the spindle or below it, would pass for its end.
void expect_one_thing(const Field& field, std::size_t edge_px) {
  const std::size_t width = field.box.width, height = field.box.height;
  const auto expect_one = [&](bool columns) {
    std::vector<bool> taken(columns ? width : height);
    for (std::size_t at = 0; at < field.state.size(); ++at) {
      if (field.state[at] == Pixel::on) taken[columns ? at % width : at / width] = true;
    }
    const std::vector<Stretch> found = stretches(taken, kWidestLine + 2 * edge_px);
    if (found.size() < 2) return;
    std::string boxes;
    for (const Stretch& stretch : found) {
      if (&stretch - found.data() == 4) {
        boxes += " and more";
        break;
      }
      Field part = field;
      for (std::size_t at = 0; at < part.state.size(); ++at) {
        const std::size_t i = columns ? at % width : at / width;
        if (i < stretch.first || i > stretch.last) part.state[at] = Pixel::off_scale;
      }
      const PixelBox box = bounds(part, edge_px);
      boxes += fmt::format("{}{},{},{},{}", boxes.empty() ? "" : " and ", box.x, box.y, box.width, box.height);
    }
    throw Error(
        fmt::format("expected one thing on the scale, found {} apart from each other: {}; state which is the "
                    "spindle with --region, or the legend with --legend",
                    found.size(), boxes));
  };
  expect_one(true);
  expect_one(false);
}

void count_ends(TemperatureImage& image, const ColourScale& scale) {
  // Some lines at the ends of a legend's scale have one colour: the last and the first temperature that it stands for.
  std::size_t cold = 0, hot = scale.colours.size() - 1;
  while (cold < hot && scale.colours[cold + 1] == scale.colours.front()) ++cold;
  while (hot > cold && scale.colours[hot - 1] == scale.colours.back()) --hot;
  const double margin = kAtEnd * (scale.degC.back() - scale.degC.front());
  const double cold_wide = scale.degC[cold] - scale.degC.front() + margin;
  const double hot_wide = scale.degC.back() - scale.degC[hot] + margin;
  std::size_t next_cold = 0, next_hot = 0;
  for (const double T : image.degC) {
    const double above = T - scale.degC.front(), below = scale.degC.back() - T;  // NaN: neither
    if (above <= cold_wide) ++image.at_cold_end;
    if (above > cold_wide && above <= 2.0 * cold_wide) ++next_cold;
    if (below <= hot_wide) ++image.at_hot_end;
    if (below > hot_wide && below <= 2.0 * hot_wide) ++next_hot;
  }
  const auto saturated = [&](std::size_t there, std::size_t next) {
    return static_cast<double>(there) > kSaturated * static_cast<double>(image.used) && there > kSpike * next;
  };
  image.saturated_cold = saturated(image.at_cold_end, next_cold);
  image.saturated_hot = saturated(image.at_hot_end, next_hot);
}

}  // namespace

TemperatureImage temperature_image(const Picture& picture, const ColourScale& scale, const ImageOptions& options) {
  const PixelBox looked_at = options.region.value_or(PixelBox{0, 0, picture.width, picture.height});
  expect_inside(picture, looked_at, "the region");
  if (options.legend) expect_inside(picture, *options.legend, "the legend");
  if (options.edge_px > static_cast<std::size_t>(kWidestEdge_px)) {
    throw Error(fmt::format("the edge needs at most {} pixels; found {}", kWidestEdge_px, options.edge_px));
  }
  Field field = inverted(picture, scale, looked_at);
  cut_out_background(field, picture);
  if (options.legend) cut_out_legend(field, *options.legend);
  for (const std::size_t at : contrasting(field, kContrast * (scale.degC.back() - scale.degC.front()))) {
    field.state[at] = Pixel::contrasting;
  }
  leave_out_edges(field, options.edge_px);
  const PixelBox found = bounds(field, options.edge_px);
  if (!options.region) expect_one_thing(field, options.edge_px);

  TemperatureImage image;
  image.region = options.region.value_or(found);
  const PixelBox& box = image.region;
  for (std::size_t row = 0; row < box.height; ++row) {
    for (std::size_t column = 0; column < box.width; ++column) {
      const std::size_t at = (box.y - looked_at.y + row) * looked_at.width + box.x - looked_at.x + column;
      const Pixel state = field.state[at];
      image.degC.push_back(state == Pixel::on ? field.degC[at] : kUnknown);
      if (state == Pixel::on) ++image.used;
      if (state == Pixel::off_scale) ++image.off_scale;
      if (state == Pixel::contrasting) ++image.contrasting;
      if (state == Pixel::at_edge) ++image.at_edges;
    }
  }
  if (!scale.banded) count_ends(image, scale);
  return image;
}

}  // namespace ballbar
