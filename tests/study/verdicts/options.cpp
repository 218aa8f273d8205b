#include "options.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace ballbar::verdicts {
namespace {

std::uint64_t number_of(const std::string& word) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw std::runtime_error("expected a number, found " + word);
  }
  return value;
}

}  // namespace

Options options_of(const std::vector<std::string>& words) {
  Options options;
  bool has_count = false;
  const auto word = [&](std::size_t k) -> const std::string& {
    if (k >= words.size()) throw std::runtime_error("expected a word behind " + words.back() + ", found none");
    return words[k];
  };
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (words[k] == "--verbose") {
      options.is_verbose = true;
    } else if (words[k] == "--list") {
      options.lists = true;
    } else if (words[k] == "--first") {
      options.first = number_of(word(++k));
    } else if (words[k] == "--write") {
      options.folder = word(++k);
      options.cells = {word(++k)};
      options.first = number_of(word(++k));
      has_count = true;
    } else if (!has_count) {
      options.count = number_of(words[k]);
      has_count = true;
    } else {
      options.cells.push_back(words[k]);
    }
  }
  return options;
}

bool is_wanted(const Options& options, const std::string& cell) {
  return options.cells.empty() || std::any_of(options.cells.begin(), options.cells.end(), [&](const std::string& name) {
           return name.ends_with('*') ? cell.starts_with(name.substr(0, name.size() - 1)) : cell == name;
         });
}

}  // namespace ballbar::verdicts
