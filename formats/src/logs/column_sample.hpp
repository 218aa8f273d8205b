// Statistics of the first rows of a log: the decimal sign, and the content of each column.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "logs/log_shape.hpp"

namespace ballbar {

// Counts of the cells of a column by their possible types.
struct ColumnSample {
  std::size_t numbers = 0, dates = 0, clocks = 0, stamps = 0, missing = 0, texts = 0, minutes_and_seconds = 0;
  std::vector<double> values;
  bool rises = true, ever_rises = false;  // numbers
  bool day_first = false, month_first = false, either = false;
  std::size_t packed_dates = 0, packed_clocks = 0, two_fields = 0;  // 20261122, 130510, 05:10
  bool has_three_fields = false, two_fields_return = false;         // 1:05:10; 5:10 below it
  std::size_t sure_dates = 0, lacks_year = 0;                       // with dots or a year of four digits; of stamps
  std::size_t dotted_clocks = 0;                                    // 07.05.00, of the clocks; or dates
  bool dotted_clocks_fall = false;
  double last_clock_s = 0.0;
  std::set<std::string> last_fields;          // of these, "00"
  std::size_t midnights = 0;                  // stamps at 0:00
  std::optional<double> first_s, last_s;      // stamps and clocks
  std::size_t switches = 0;                   // "on", "off"; among texts or missing
  std::set<std::string> switch_words, words;  // of the texts: the first 1000 that differ

  bool has_dotted_clocks = false;

  // A column of two words at most for on and off, and no number. Of "off" alone too: it may be on later.
  [[nodiscard]] bool is_switch() const {
    return switches > 0 && numbers + dates + clocks + stamps == 0 && texts <= switches && switch_words.size() <= 2;
  }

  [[nodiscard]] std::size_t written() const { return numbers + dates + clocks + stamps + texts; }
  // Of what is written; a stray word is told when the rows are read.
  [[nodiscard]] bool mostly(std::size_t count) const { return count > 0 && count * 10 >= written() * 6; }
};

// One per column, of the first rows of the shape.
std::vector<ColumnSample> samples_of(const LogShape& shape, std::size_t rows);
inline std::vector<ColumnSample> samples_of(const LogShape& shape) { return samples_of(shape, shape.rows.size()); }

bool all_whole(const ColumnSample& sample);

// 0, 1, 2 ... or 1, 2, 3 ...; `gaps`: some may be left out.
bool counts_rows(const ColumnSample& sample, bool gaps);

// Whether a column of numbers in a unit of time covers the same duration as one of time stamps.
bool runs_as_long(const ColumnSample& numbers, double unit_s, const ColumnSample& stamps);

// Sets shape.decimal, the decimal sign, from the first rows: "0,125" and "1.234,5" are unambiguous, "1,234" alone is
// not. 07.05 is no number where a line above the rows names a clock. Throws Error with name:line if both signs are
// possible.
void find_decimal(const std::string& name, std::span<const HeadLine> above, const LogRecipe& recipe, LogShape& shape);

}  // namespace ballbar
