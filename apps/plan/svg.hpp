// An SVG picture, element by element.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// Text for XML: escaped, with control characters as blanks and invalid UTF-8 as question marks.
std::string escaped_xml(std::string_view text);

// Lines of at most `most` characters, broken at blanks, or within a word that is too long.
std::vector<std::string> broken_lines(std::string_view text, std::size_t most);

// A range of values over a range of pixels.
struct Scale {
  double low = 0.0, high = 1.0, from_px = 0.0, to_px = 1.0;

  double operator()(double value) const { return from_px + (value - low) / (high - low) * (to_px - from_px); }
};

// The step of 1, 2 or 5 times a power of ten that gives about `count` steps.
double axis_step(double range, int count);

// Its own height is known last.
class Svg {
 public:
  // `more`: further attributes, beginning with a blank.
  void add(std::string_view element);
  void text(double x, double y, std::string_view words, std::string_view more = "");
  void line(double x1, double y1, double x2, double y2, std::string_view more);
  void rectangle(double x, double y, double width, double height, std::string_view more);

  std::string whole(double width, double height, std::string_view title, std::string_view description) const;

 private:
  std::string body_;
};

}  // namespace ballbar
