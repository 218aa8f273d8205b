#include "programs/gnuplot.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "programs/finished.hpp"

namespace ballbar {
namespace {

// The last line says what is wrong; those before it repeat the script.
std::string last_line(std::string text) {
  constexpr const char* kSpace = " \t\r\n";
  text.erase(text.find_last_not_of(std::string(kSpace) + '.') + 1);  // the sentence has its own full stop
  const std::size_t line = text.rfind('\n') + 1;
  const std::size_t start = text.find_first_not_of(kSpace, line);
  return start == std::string::npos ? "" : text.substr(start);
}

// Length of the UTF-8 sequence at the start of `text` if it is a character that XML 1.0 holds, else 0.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || length > text.size()) return 0;
  unsigned code = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
    code = code << 6 | (byte(i) & 0x3FU);
  }
  constexpr unsigned kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < kSmallest[length] || code > 0x10FFFF) return 0;
  if ((code >= 0xD800 && code <= 0xDFFF) || code == 0xFFFE || code == 0xFFFF) return 0;
  return length;
}

// U+0000 to U+001F, U+007F to U+009F, and the line breaks U+2028, U+2029.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  if (character.size() == 2) return first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
  return character == "\xE2\x80\xA8" || character == "\xE2\x80\xA9";
}

}  // namespace

std::string svg_by_gnuplot(const std::string& script) {
  // GNUTERM: gnuplot 5.4 crashes where it does not know the terminal that the caller's environment names.
  const Finished drawn = finished("--plot", {"gnuplot", "-d"}, script, "GNUTERM=");
  if (drawn.not_found) {
    throw Error(
        "--plot: expected the program gnuplot to draw with, found none; on Debian it is in the package gnuplot-nox.");
  }
  if (drawn.signal != 0) {
    throw Error(fmt::format("--plot: expected gnuplot to draw, found it ended by signal {}.", drawn.signal));
  }
  if (drawn.status != 0) {
    const std::string said = last_line(drawn.err);
    throw Error(fmt::format("--plot: expected gnuplot to draw, found it ended with status {}{}.", drawn.status,
                            said.empty() ? "" : ": " + said));
  }
  // gnuplot does not look whether its writes succeed.
  if (last_line(drawn.out) != "</svg>") {
    throw Error("--plot: expected a whole SVG from gnuplot, found an output without its end.");
  }
  return drawn.out;
}

std::string gnuplot_quoted(std::string_view text) {
  constexpr std::string_view kPlain = " .,:+-=()/";
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    const char first = character[0];
    const bool letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
    if (length == 0) {
      quoted += "\uFFFD";
    } else if (is_control(character)) {
      quoted += ' ';
    } else if (length > 1 || letter || (first >= '0' && first <= '9') || kPlain.find(first) != std::string_view::npos) {
      quoted += character;
    } else {
      // gnuplot escapes < and & in an SVG, not >, and XML forbids "]]>" in a text.
      if (first == '>' && quoted.ends_with("\\135\\135")) quoted += ' ';
      quoted += fmt::format("\\{:03o}", static_cast<unsigned>(first));
    }
    text.remove_prefix(character.size());
  }
  return quoted + "\"";
}

}  // namespace ballbar
