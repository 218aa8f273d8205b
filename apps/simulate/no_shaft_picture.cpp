// In place of shaft_picture.cpp where ballbar is built without what paints pictures.
#include "ballbar/formats/pictures/picture_file.hpp"
#include "simulate/shaft_picture.hpp"

namespace ballbar {

ShaftPicture shaft_picture(const FiniteVolumeSpindle&, const TemperatureProfile&, const ShaftPictureStyle& style) {
  colour_map(style.colours);  // says what to install
  return {};
}

}  // namespace ballbar
