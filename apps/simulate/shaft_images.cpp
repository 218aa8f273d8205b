#include "simulate/shaft_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/units.hpp"
#include "text/path_inside.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr Key kImageKeys[] = {
    {"time_min", "min", "one of the times of `profile_min`; needed"},
    {"file", "text", "a plain name that ends in .png or .jpg; needed"},
    {"colours", "text", "colour map, as `compensate --colours` knows them; default \"jet\""},
    {"quality", "number", "of a .jpg, 1 to 100; default 80"},
    {"legend", "true or false", "whether a scale is drawn; default true"},
    {"bands", "number", "steps of the scale, 2 to 64; 0, the default: smooth"},
    {"from_mm", "mm", "where the part that is shown begins, from the shaft's rear end; default: all of it"},
    {"to_mm", "mm", "where it ends"},
    {"min_degC", "degC", "cold end of the scale; default: the coldest of the part, rounded down to whole degC"},
    {"max_degC", "degC", "hot end; default: the hottest, rounded up"},
    {"width_px", "pixels", "200 to 4000; default 640"},
    {"height_px", "pixels", "100 to 4000; default 180"},
};

std::size_t count(const TomlTable& table, std::string_view key, std::size_t by_default) {
  const std::optional<std::int64_t> read = integer(table, key);
  if (!read) return by_default;
  if (*read < 0) fail_kind(table, key, "a count not below 0");
  return static_cast<std::size_t>(*read);
}

std::string file_name(const TomlTable& table, const std::vector<ShaftImage>& before) {
  const std::string file = required(string, table, "file");
  const std::filesystem::path path(file);
  const std::string ending = path.extension().string();
  if (!stays_inside(file) || path.has_parent_path() || path.stem().empty() || (ending != ".png" && ending != ".jpg")) {
    fail_kind(table, "file", "a plain name that ends in .png or .jpg");
  }
  const auto same = [&](const ShaftImage& image) { return image.file == file; };
  if (std::any_of(before.begin(), before.end(), same)) fail_kind(table, "file", "a name for each image");
  return file;
}

// As [spindle] lists its times; a simulation that keeps no profile there has nothing to paint.
double time_s(const TomlTable& table, const std::vector<double>& profile_min) {
  const double time_min = required(number, table, "time_min");
  if (std::find(profile_min.begin(), profile_min.end(), time_min) == profile_min.end()) {
    fail_kind(table, "time_min", "one of the times of profile_min");
  }
  return time_min * 60.0;
}

ShaftImage read_image(const TomlTable& table, const std::vector<double>& profile_min,
                      const std::vector<ShaftImage>& before) {
  expect_keys(table, kImageKeys);
  ShaftImage image;
  image.time_s = time_s(table, profile_min);
  image.file = file_name(table, before);
  const std::size_t quality = count(table, "quality", 80);
  if (quality < 1 || quality > 100) fail_kind(table, "quality", "an integer from 1 to 100");
  image.quality = static_cast<int>(quality);
  ShaftPictureStyle& style = image.style;
  style.colours = string(table, "colours").value_or(style.colours);
  style.legend = boolean(table, "legend").value_or(style.legend);
  style.bands = count(table, "bands", style.bands);
  style.from_mm = number(table, "from_mm");
  style.to_mm = number(table, "to_mm");
  style.min_degC = number(table, "min_degC");
  style.max_degC = number(table, "max_degC");
  style.width_px = count(table, "width_px", style.width_px);
  style.height_px = count(table, "height_px", style.height_px);
  return image;
}

// Of the duty up to that time: a change at the very time comes after it.
double speed_rpm(const DutyPlan& plan, double at_s) {
  const auto after = std::lower_bound(plan.time_s.begin(), plan.time_s.end(), at_s);
  const auto i = std::max<std::ptrdiff_t>(after - plan.time_s.begin(), 1) - 1;
  return plan.speed_rpm[static_cast<std::size_t>(i)];
}

SimulatedFile file_of(const ShaftImage& image, const VirtualSpindle& spindle, const TemperatureProfile& shaft) {
  ShaftPictureStyle style = image.style;
  style.text = fmt::format("{:g} min  {:g} rpm  degC", min_from_s(image.time_s), speed_rpm(spindle.plan, image.time_s));
  const Picture picture = shaft_picture(spindle.body, shaft, style).picture;
  return {image.file, image.file.ends_with(".png") ? write_png(picture) : write_jpeg(picture, image.quality)};
}

}  // namespace

std::vector<KeyTable> image_keys() { return {{"`[[spindle.image]]`", kImageKeys}}; }

std::vector<ShaftImage> read_shaft_images(std::string_view bytes, std::string_view name) {
  const TomlSource source = parse_toml(bytes, name);
  const TomlTable root = root_of(source);
  std::vector<ShaftImage> images;
  const std::optional<TomlTable> spindle = subtable(root, "spindle");
  if (!spindle) return images;
  const std::vector<double> profile_min = numbers(*spindle, "profile_min").value_or(std::vector<double>{});
  for (TomlTable& table : subtables(*spindle, "image")) {
    table.label = fmt::format("[[spindle.image]] {}", images.size() + 1);
    images.push_back(read_image(table, profile_min, images));
  }
  return images;
}

std::vector<SimulatedFile> shaft_image_files(const std::vector<ShaftImage>& images, const VirtualSpindle& spindle,
                                             const std::vector<ShaftProfile>& profiles) {
  std::vector<SimulatedFile> files;
  for (const ShaftImage& image : images) {
    const auto profile =
        std::find_if(profiles.begin(), profiles.end(), [&](const ShaftProfile& p) { return p.time_s == image.time_s; });
    if (profile == profiles.end()) {
      throw Error(fmt::format("{}: expected a profile of the shaft at {} s, found none.", image.file, image.time_s));
    }
    try {
      files.push_back(file_of(image, spindle, profile->shaft));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", image.file, error.what()));
    }
  }
  return files;
}

}  // namespace ballbar
