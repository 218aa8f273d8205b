#include "logs/text_fold.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "ballbar/internal/nearest_name.hpp"

namespace ballbar {
namespace {

struct Folding {
  std::string_view from, to;
};

// Letters with accents of the European languages, small and capital.
constexpr Folding kLetters[] = {
    {"à", "a"},  {"á", "a"}, {"â", "a"},  {"ã", "a"}, {"ä", "a"}, {"å", "a"}, {"æ", "ae"}, {"ç", "c"}, {"è", "e"},
    {"é", "e"},  {"ê", "e"}, {"ë", "e"},  {"ì", "i"}, {"í", "i"}, {"î", "i"}, {"ï", "i"},  {"ñ", "n"}, {"ò", "o"},
    {"ó", "o"},  {"ô", "o"}, {"õ", "o"},  {"ö", "o"}, {"ø", "o"}, {"ù", "u"}, {"ú", "u"},  {"û", "u"}, {"ü", "u"},
    {"ß", "ss"}, {"À", "a"}, {"Á", "a"},  {"Â", "a"}, {"Ä", "a"}, {"Å", "a"}, {"Ç", "c"},  {"È", "e"}, {"É", "e"},
    {"Ê", "e"},  {"Í", "i"}, {"Î", "i"},  {"Ñ", "n"}, {"Ó", "o"}, {"Ô", "o"}, {"Ö", "o"},  {"Ø", "o"}, {"Ú", "u"},
    {"Û", "u"},  {"Ü", "u"}, {"œ", "oe"}, {"š", "s"}, {"č", "c"}, {"ž", "z"},
};

// µ is in Unicode twice (U+00B5, U+03BC); º (U+00BA) and ˚ (U+02DA) stand where ° (U+00B0) is meant. UTF-8 that was
// read as Latin-1 on its way shows a Â before each.
constexpr Folding kSigns[] = {
    {"Â°", "deg"}, {"Âº", "deg"}, {"Âµ", "u"},  {"Î¼", "u"},     {"°", "deg"},    {"º", "deg"},    {"˚", "deg"},
    {"µ", "u"},    {"μ", "u"},    {"㎛", "um"}, {"㎜", "mm"},    {"℃", "degc"},   {"℉", "degf"},   {"％", "%"},
    {"⁻¹", "^-1"}, {"·", "."},    {"⋅", "."},   {"／", "/"},     {"（", "("},     {"）", ")"},     {"［", "["},
    {"］", "]"},   {"：", ":"},   {"Ω", "ohm"}, {"\u00A0", " "}, {"\u202F", " "}, {"\u3000", " "}, {"\uFEFF", ""},
    {"−", "-"},    {"–", "-"},    {"、", ","},
};

template <std::size_t kSize>
const Folding* folding_at(const Folding (&table)[kSize], std::string_view text) {
  const auto* found =
      std::find_if(std::begin(table), std::end(table), [&](const Folding& one) { return text.starts_with(one.from); });
  return found == std::end(table) ? nullptr : found;
}

// Of the sign or letter that the text begins with; nullptr: it stays. None of them is ASCII.
const Folding* folding_at(std::string_view text) {
  if (static_cast<unsigned char>(text.front()) < 0x80) return nullptr;
  const Folding* sign = folding_at(kSigns, text);
  return sign != nullptr ? sign : folding_at(kLetters, text);
}

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

std::string small(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = small(c);
  return lower;
}

std::string folded_unit(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    if (const Folding* to = folding_at(text)) {
      out += to->to;
      text.remove_prefix(to->from.size());
      continue;
    }
    out += small(text.front());
    text.remove_prefix(1);
  }
  return out;
}

std::string folded(std::string_view text) {
  std::string out;
  for (const char c : folded_unit(text)) {
    if (is_letter_or_digit(c)) {
      out += c;
    } else if (!out.empty() && out.back() != ' ') {
      out += ' ';
    }
  }
  if (out.ends_with(' ')) out.pop_back();
  return out;
}

std::string parted(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z' && !text.empty() && text.back() >= 'a' && text.back() <= 'z') text += ' ';
    text += c;
  }
  return folded(text);
}

}  // namespace ballbar
