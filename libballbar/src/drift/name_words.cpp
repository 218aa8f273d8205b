#include "drift/name_words.hpp"

#include <algorithm>
#include <cstddef>

namespace ballbar {

bool is_same_but_for_capitals(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return small(x) == small(y); });
}

bool has_word(std::string_view name, std::string_view word) {
  const auto is_alnum = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  for (std::size_t begin = 0; begin < name.size();) {
    std::size_t end = begin;
    while (end < name.size() && is_alnum(name[end])) ++end;
    if (end > begin && is_same_but_for_capitals(name.substr(begin, end - begin), word)) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace ballbar
