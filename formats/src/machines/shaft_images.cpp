#include "ballbar/formats/machines/shaft_images.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

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
