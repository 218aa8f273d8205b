#include "plan/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/internal/nearest_name.hpp"

namespace ballbar {

std::string escaped_xml(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i, 4));
    const char c = text[i];
    if (length > 1) {
      // U+FFFE and U+FFFF are no characters of XML.
      out += text.substr(i, 3) == "\xEF\xBF\xBE" || text.substr(i, 3) == "\xEF\xBF\xBF" ? "?" : text.substr(i, length);
    } else if (length == 0) {
      out += '?';
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    }
    i += std::max<std::size_t>(length, 1);
  }
  return out;
}

std::vector<std::string> broken_lines(std::string_view text, std::size_t most) {
  std::vector<std::string> lines;
  std::string line;
  std::size_t characters = 0;
  const auto end_line = [&] {
    if (!line.empty()) lines.push_back(line);
    line.clear();
    characters = 0;
  };
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\n') end_line();
    if (text[i] == ' ' || text[i] == '\n') {
      ++i;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \n", i), text.size());
    const std::string_view word = text.substr(i, end - i);
    const auto length = static_cast<std::size_t>(std::count_if(
        word.begin(), word.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
    if (characters + length > most) end_line();
    if (characters > 0) line += ' ';
    for (std::size_t k = 0; k < word.size();) {
      const std::size_t one = std::max<std::size_t>(utf8_length(word.substr(k, 4)), 1);
      if (characters >= most) end_line();
      line += word.substr(k, one);
      ++characters;
      k += one;
    }
    ++characters;  // the blank after it
    i = end;
  }
  end_line();
  return lines;
}

double axis_step(double range, int count) {
  const double rough = range / count, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (power * factor >= rough) return power * factor;
  }
  return power * 10.0;
}

void Svg::add(std::string_view element) {
  body_ += element;
  body_ += '\n';
}

void Svg::text(double x, double y, std::string_view words, std::string_view more) {
  add(fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>", x, y, more, escaped_xml(words)));
}

void Svg::line(double x1, double y1, double x2, double y2, std::string_view more) {
  add(fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>", x1, y1, x2, y2, more));
}

void Svg::rectangle(double x, double y, double width, double height, std::string_view more) {
  add(fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>", x, y, width, height,
                  more));
}

std::string Svg::whole(double width, double height, std::string_view title, std::string_view description) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
      "{0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n<title>{2}</title>\n<desc>{3}</desc>\n<rect "
      "width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n{4}</svg>\n",
      width, height, escaped_xml(title), escaped_xml(description), body_);
}

}  // namespace ballbar
