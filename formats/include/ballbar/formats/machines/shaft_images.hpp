// [[spindle.image]] of a machine.toml: pictures of the shaft's temperature that `ballbar simulate` writes beside the
// other files (shaft_picture.hpp paints them).
//
//   [[spindle.image]]
//   time_min = 240        # one of [spindle]'s profile_min
//   file = "jet.jpg"      # a plain name that ends in .png or .jpg
//   colours = "jet"       # jet | turbo | viridis | inferno | gray ..., as colour_map has them
//   quality = 80          # of a .jpg, 1 to 100
//   legend = true
//   bands = 9             # steps of the scale, as finite-element programs draw it; default 0: smooth
//   from_mm = 190         # part of the shaft, from its rear end; default: all of it
//   to_mm = 520
//   min_degC = 20         # of the scale; default: the part's field rounded outwards to whole degC
//   max_degC = 40
//   width_px = 640
//   height_px = 180
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
#include "ballbar/simulation/simulate.hpp"

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
