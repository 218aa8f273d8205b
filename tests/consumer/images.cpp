// The component images of the installed package: a picture through a PNG and back.
#include <ballbar/formats/pictures/picture_file.hpp>

int main() {
  const ballbar::Picture picture{2, 1, {255, 0, 0, 0, 0, 255}};
  return ballbar::read_picture(ballbar::write_png(picture), "in-code.png").rgb == picture.rgb ? 0 : 1;
}
