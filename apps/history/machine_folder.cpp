#include "history/machine_folder.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_between(char c) { return c == '-' || c == '_' || c == '.' || c == ' '; }

struct Number {
  std::size_t digits = 0, end = 0;  // end: behind it in the name
  int value = 0;
};

// The numbers that a name begins with, at most three, one sign between two.
std::vector<Number> leading_numbers(std::string_view name) {
  std::vector<Number> numbers;
  std::size_t at = 0;
  while (numbers.size() < 3 && at < name.size() && is_digit(name[at])) {
    Number number;
    for (; at < name.size() && is_digit(name[at]) && number.digits < 9; ++at, ++number.digits)
      number.value = 10 * number.value + (name[at] - '0');
    number.end = at;
    numbers.push_back(number);
    if (at < name.size() && is_between(name[at])) ++at;
  }
  return numbers;
}

bool is_year(const Number& number) { return number.digits == 4 && number.value >= 1900 && number.value < 2100; }
bool is_month(const Number& number) { return number.digits <= 2 && number.value >= 1 && number.value <= 12; }
bool is_day(const Number& number) { return number.digits <= 2 && number.value >= 1 && number.value <= 31; }

// "2025-W03", "2025KW3", "2025_Q1"
bool is_week_or_quarter(std::string_view behind_year) {
  std::size_t at = !behind_year.empty() && is_between(behind_year.front()) ? 1 : 0;
  const std::size_t letters = at;
  while (at < behind_year.size() && is_letter(behind_year[at])) ++at;
  const std::string_view word = behind_year.substr(letters, at - letters);
  const bool is_known = word == "W" || word == "KW" || word == "Q" || word == "w" || word == "kw" || word == "q";
  return is_known && at < behind_year.size() && is_digit(behind_year[at]);
}

// What follows the date, behind a sign, is of the test: "2025-01-20 after crash".
bool is_date(std::string_view name) {
  const std::vector<Number> numbers = leading_numbers(name);
  if (numbers.empty()) return false;
  const auto ends_at = [&](const Number& last) {
    return last.end == name.size() || name[last.end] == 'T' ||
           (!is_digit(name[last.end]) && !is_letter(name[last.end]));
  };
  const Number& first = numbers[0];
  if (first.digits == 8) {
    const Number year{4, 0, first.value / 10000}, month{2, 0, first.value / 100 % 100}, day{2, 0, first.value % 100};
    return is_year(year) && is_month(month) && is_day(day) && ends_at(first);
  }
  if (is_year(first) && is_week_or_quarter(name.substr(first.end))) return true;
  if (numbers.size() < 2) return false;
  if (is_year(first)) {
    if (!is_month(numbers[1])) return false;
    return numbers.size() == 2 || numbers[2].digits > 2 ? ends_at(numbers[1])
                                                        : is_day(numbers[2]) && ends_at(numbers[2]);
  }
  return numbers.size() == 3 && is_day(first) && is_month(numbers[1]) && is_year(numbers[2]) && ends_at(numbers[2]);
}

bool is_year_alone(std::string_view name) {
  const std::vector<Number> numbers = leading_numbers(name);
  return numbers.size() == 1 && is_year(numbers[0]) && numbers[0].end == name.size();
}

}  // namespace

std::filesystem::path machine_folder(std::filesystem::path folder) {
  bool is_below_date = false;
  while (folder.has_filename()) {
    const std::string name = folder.filename().string();
    if (!is_date(name) && !(is_below_date && is_year_alone(name))) break;
    is_below_date = true;
    folder = folder.parent_path();
  }
  return folder;
}

}  // namespace ballbar
