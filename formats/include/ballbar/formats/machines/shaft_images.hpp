// [[spindle.image]] of a machine.toml: pictures of the shaft's temperature that `ballbar simulate` writes beside the
// other files (shaft_picture.hpp paints them).
//
//   [[spindle.image]]
//   time_min = 240
//   file = "jet.jpg"
//   colours = "jet"       # all keys: image_keys() of keys.hpp
//
// Read by ballbar::formats; painted by ballbar::images.
//
// A PNG holds the painted pixels. The bytes of both, and the pixels of a JPEG, depend on the library that encodes them:
// another version of it may write others from the same machine.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/machines/simulated_files.hpp"
#include "ballbar/formats/pictures/shaft_picture.hpp"
#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar {

struct ShaftImage {
  double time_s = 0.0;
  std::string file;
  int quality = 80;
  ShaftPictureStyle style;
};

// `name` stands in messages. No table: no images. Throws Error with name:line:column; numbers that contradict the
// spindle are left to shaft_picture().
std::vector<ShaftImage> read_shaft_images(std::string_view bytes, std::string_view name);

// Every picture names its time and speed. Throws Error, beginning with the file's name: what shaft_picture throws.
std::vector<SimulatedFile> shaft_image_files(const std::vector<ShaftImage>& images, const VirtualSpindle& spindle,
                                             const std::vector<ShaftProfile>& profiles);

}  // namespace ballbar
