#include "next_test/options.hpp"

#include <charconv>
#include <stdexcept>

namespace ballbar::next_test {
namespace {

template <class Number>
Number number_of(const std::string& word) {
  Number value{};
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
  std::size_t k = 0;
  const auto next = [&]() -> const std::string& {
    if (++k >= words.size()) throw std::runtime_error("expected a word behind " + words.back() + ", found none");
    return words[k];
  };
  for (; k < words.size(); ++k) {
    const std::string& word = words[k];
    if (word == "--verbose") {
      options.is_verbose = true;
    } else if (word == "--list") {
      options.lists = true;
    } else if (word == "--own-places") {
      options.loop.places = verdicts::Places::own;
    } else if (word == "--first") {
      options.first = number_of<std::uint64_t>(next());
    } else if (word == "--hours") {
      options.loop.hours = number_of<double>(next());
    } else if (word == "--max-rpm") {
      options.loop.max_rpm = number_of<double>(next());
    } else if (word == "--tests") {
      options.loop.stages = number_of<std::size_t>(next());
    } else if (word == "--threads") {
      options.threads = number_of<std::size_t>(next());
    } else if (word == "--plan") {
      options.loop.plan = next();
    } else if (word.starts_with("--")) {
      throw std::runtime_error("expected an option of the study, found " + word);
    } else if (!has_count) {
      options.count = number_of<std::uint64_t>(word);
      has_count = true;
    } else {
      options.cells.push_back(word);
    }
  }
  return options;
}

}  // namespace ballbar::next_test
