// Any bytes: read_picture returns a whole picture or throws Error; what is read makes a temperature or throws Error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/temperature/temperature.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  constexpr std::size_t kMost = 100'000;  // pixels: more takes time and finds nothing new
  try {
    const ballbar::PictureSize stored = ballbar::picture_size(bytes, "fuzz");
    if (stored.width > kMost / stored.height) return 0;
    const ballbar::Picture picture = ballbar::read_picture(bytes, "fuzz");
    if (picture.rgb.size() != 3 * picture.width * picture.height) std::abort();
    const ballbar::PixelBox legend{0, 0, picture.width, picture.height / 8};
    const ballbar::ColourScale scale = ballbar::legend_scale(picture, legend, 20.0, 50.0);
    const ballbar::TemperatureImage image = ballbar::temperature_image(picture, scale, {{}, legend, 3});
    const ballbar::ImageProfile columns = ballbar::image_profile(image, scale, 0.0, 1.0, false);
    const double mean = ballbar::mean_degC(columns.profile);
    if (ballbar::mean_points(columns.profile).empty() || !(mean > -1000.0 && mean < 1000.0)) std::abort();
    ballbar::three_areas(picture, image, 20.0, 50.0, false);
  } catch (const ballbar::Error&) {
  }
  return 0;
}
