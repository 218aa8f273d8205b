#include "ballbar/internal/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace ballbar {
// Three rows of the table.
std::size_t letters_apart(std::string_view name, std::string_view other) {
  name = name.substr(0, 100);  // what is longer is near to nothing
  std::vector<std::size_t> before, last(other.size() + 1), row(other.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < name.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < other.size(); ++j) {
      row[j + 1] = std::min({last[j] + (name[i] == other[j] ? 0 : 1), last[j + 1] + 1, row[j] + 1});
      if (i > 0 && j > 0 && name[i] == other[j - 1] && name[i - 1] == other[j]) {
        row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
      }
    }
    before = last;
    last = row;
  }
  return last.back();
}

std::size_t utf8_length(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  const auto continues = [&](std::size_t i) { return (at(i) & 0xC0u) == 0x80u; };
  const unsigned lead = at(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return continues(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool fits = (lead != 0xE0 || at(1) >= 0xA0) && (lead != 0xED || at(1) <= 0x9F);
    return fits && continues(1) && continues(2) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool fits = (lead != 0xF0 || at(1) >= 0x90) && (lead != 0xF4 || at(1) <= 0x8F);
    return fits && continues(1) && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

std::string in_quotes(std::string_view found) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  std::size_t i = 0;
  while (i < found.size() && i < kLongest) {
    const std::size_t length = utf8_length(found.substr(i, 4));
    const auto byte = static_cast<unsigned char>(found[i]);
    if (length == 0 || byte < 0x20 || byte == 0x7F) {
      result += fmt::format("\\x{:02X}", byte);
      ++i;
    } else {
      result += found.substr(i, length);
      i += length;
    }
  }
  return result + (i < found.size() ? "...\"" : "\"");
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
  return *std::min_element(known.begin(), known.end(), [&](auto left, auto right) {
    return letters_apart(name, left) < letters_apart(name, right);
  });
}

std::string_view near_name(std::string_view name, std::span<const std::string_view> known) {
  constexpr std::size_t kShortestBeginning = 2;
  if (known.empty() || name.empty()) return {};
  const std::string_view nearest = nearest_name(name, known);
  if (3 * letters_apart(name, nearest) <= std::max(name.size(), nearest.size())) return nearest;
  const auto begun = std::find_if(known.begin(), known.end(), [&](auto one) { return one.starts_with(name); });
  return begun == known.end() || name.size() < kShortestBeginning ? std::string_view() : *begun;
}

}  // namespace ballbar
