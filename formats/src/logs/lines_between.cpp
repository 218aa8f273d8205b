#include "logs/lines_between.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_header.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "logs/time_stamp.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLongestNames = 4096;  // bytes that are compared

bool is_same_name(std::string_view a, std::string_view b) {
  const NameAndUnit x = name_and_unit(trimmed_cell(a)), y = name_and_unit(trimmed_cell(b));
  const auto u = scaled_unit(x.unit), v = scaled_unit(y.unit);
  const bool is_same_unit = u && v ? u->canonical == v->canonical && u->factor == v->factor && u->offset == v->offset
                                   : folded_unit(x.unit) == folded_unit(y.unit);
  return folded(x.name) == folded(y.name) && is_same_unit;
}

}  // namespace

bool LinesBetween::repeats_names(std::string_view line) const {
  if (shape_.header_line == 0 || shape_.headers.front().empty()) return false;
  const std::string_view first = line.substr(0, std::min(cell_end(line, 0, shape_.delimiter), kLongestNames));
  return trimmed_cell(first) == shape_.headers.front();
}

void LinesBetween::look_for_names(std::string_view line, std::size_t number) {
  std::vector<std::string_view> now, before;
  split_cells(line, shape_.delimiter, now);
  split_cells(names_, shape_.delimiter, before);
  std::size_t known = 0;
  for (const std::string_view name : now) {
    known += std::any_of(before.begin(), before.end(), [&](std::string_view one) {
      return folded(name_and_unit(trimmed_cell(one)).name) == folded(name_and_unit(trimmed_cell(name)).name);
    });
  }
  if (2 * known < before.size()) return;  // a note
  for (std::size_t i = 0; i < std::min(now.size(), before.size()); ++i) {
    if (is_same_name(now[i], before[i])) continue;
    new_names_ =
        fmt::format("{}:{}: expected the names of line {} again, found {} in place of {}. Split the file here.", name_,
                    number, shape_.header_line, in_quotes(trimmed_cell(now[i])), in_quotes(trimmed_cell(before[i])));
    return;
  }
}

void LinesBetween::look_for_date(std::string_view line, std::size_t number, bool rows_are_above) {
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t end = std::min(line.find_first_of(" \t;,|=\"", begin), line.size());
    const auto stamp = time_stamp(line.substr(begin, end - begin), DateOrder::day_first);
    begin = end + 1;
    if (!stamp || !stamp->day) continue;
    if (!days_.empty() && !days_.contains(*stamp->day) && rows_are_above) {
      date_line_ = number;
      is_next_day_ = days_.contains(*stamp->day - 1);
    }
    days_.insert(*stamp->day);
    return;
  }
}

void LinesBetween::expect_same_table(bool goes_back) {
  if (!new_names_.empty()) throw Error(new_names_);
  const bool passes_midnight = is_next_day_ && goes_back;
  if (date_line_ > 0 && !passes_midnight) {
    throw Error(
        fmt::format("{}:{}: expected clocks of one day, found another date between them. Write the date in a column "
                    "of its own, or split the file here.",
                    name_, date_line_));
  }
  date_line_ = 0;
}

}  // namespace ballbar
