// [[spindle.image]] of a machine.toml: pictures of the shaft temperature that `ballbar simulate` writes with the other
// files (shaft_picture.hpp paints them).
//
//   [[spindle.image]]
//   time_min = 240
//   file = "jet.jpg"
//   colours = "jet"       # all keys: image_keys()
//
// A PNG holds exactly the painted pixels. The bytes of both formats, and the pixels of a JPEG, depend on the version of
// the library that encodes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/text/keys.hpp"
#include "ballbar/lab/simulation/simulate.hpp"
#include "simulate/shaft_picture.hpp"
#include "simulate/simulated_files.hpp"

namespace ballbar {

std::vector<KeyTable> image_keys();  // [[spindle.image]]

struct ShaftImage {
  double time_s = 0.0;
  std::string file;
  int quality = 80;
  ShaftPictureStyle style;
};

// `name` is used in messages. Empty without such a table. Throws Error with name:line:column. shaft_picture() checks
// the numbers against the spindle.
std::vector<ShaftImage> read_shaft_images(std::string_view bytes, std::string_view name);

// Every picture names its time and speed. Throws the errors of shaft_picture(), preceded by the name of the file.
std::vector<SimulatedFile> shaft_image_files(const std::vector<ShaftImage>& images, const VirtualSpindle& spindle,
                                             const std::vector<ShaftProfile>& profiles);

}  // namespace ballbar
