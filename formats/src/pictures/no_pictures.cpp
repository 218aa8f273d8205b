// In place of picture_file.cpp and colour_map.cpp where ballbar is built without what reads and writes pictures.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"

namespace ballbar {
namespace {

[[noreturn]] void fail(std::string_view what) {
  throw Error(
      fmt::format("{}: expected a ballbar that can read and draw pictures, found one built without OpenCV. Install "
                  "libopencv-imgproc-dev, libspng-dev and libjpeg62-turbo-dev, configure with -D BALLBAR_IMAGES=ON and "
                  "build again.",
                  what));
}

}  // namespace

Picture read_picture(std::string_view, std::string_view name) { fail(name); }
std::string write_png(const Picture&) { fail("a PNG"); }
std::string write_jpeg(const Picture&, int) { fail("a JPEG"); }
std::vector<Colour> colour_map(std::string_view name) { fail(fmt::format("the colour map {}", name)); }
std::vector<std::string_view> colour_map_names() { return {}; }

}  // namespace ballbar
