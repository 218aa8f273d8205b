#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "ballbar/error.hpp"
#include "logs/column_sample.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_header.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsOfNames = 400;  // that a layout is told by

bool is_number(const ColumnSample& sample) { return sample.mostly(sample.numbers); }

bool are_all(std::size_t count, const LogShape& shape) {
  return static_cast<double>(count) >= kExplained * static_cast<double>(std::min(kRowsOfNames, shape.rows.size()));
}

// The shape with columns that have no names yet; all lines above the rows are its preamble.
LogShape without_names(const LogShape& shape, const std::vector<HeadLine>& above) {
  LogShape bare = shape;
  bare.headers.assign(shape.headers.size(), "");
  bare.units = bare.headers;
  bare.is_label.assign(shape.headers.size(), false);
  bare.header_line = bare.units_line = 0;
  bare.preamble = above;
  return bare;
}

// "T1 20.1 T2 22.3", "T1 20.1 C T2 22.3 C": most columns of numbers have their name on their left.
std::optional<LogShape> beside_values(const LogShape& shape, const std::vector<ColumnSample>& samples,
                                      const std::vector<HeadLine>& above) {
  const auto first_number = std::find_if(samples.begin(), samples.end(), is_number);
  if (std::none_of(samples.begin(), first_number, [](const auto& sample) { return sample.words.size() == 1; }))
    return std::nullopt;
  LogShape names = without_names(shape, above);
  std::size_t labels = 0, numbers = 0;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    numbers += is_number(samples[j]);
    if (samples[j].words.size() != 1 || !are_all(samples[j].texts, shape)) continue;
    const std::string word = written(*samples[j].words.begin());
    const bool follows = j > 0 && is_number(samples[j - 1]) && names.units[j - 1].empty();
    const bool leads = j + 1 < samples.size() && samples[j + 1].texts == 0;
    if (follows && !leads && log_unit(word)) {
      names.units[j - 1] = word;
    } else if (leads) {
      names.headers[j + 1] = word.substr(0, word.find_last_not_of(":=") + 1);
      ++labels;
    } else {
      continue;
    }
    names.is_label[j] = true;
  }
  if (shape.rows.size() < 2 || labels < 2 || 3 * labels < 2 * numbers) return std::nullopt;
  names.names_from = "names beside the values";
  return names;
}

// The names of three axes and their unit, as the last line above the points that has them: "AXES: X, Y, Z (mm)".
void name_axes(std::size_t first, LogShape& names) {
  std::vector<std::string_view> cells;
  for (std::size_t k = 0; k < 3; ++k) names.headers[first + k] = std::string(1, static_cast<char>('X' + k));
  names.names_from = "points: X, Y, Z in the order of the columns";
  for (const HeadLine& line : names.preamble) {
    const std::string_view text = line.text;
    for (const std::string_view word : {"mm", "millimeter", "millimetre", "inch", "inches", "meters", "metres"}) {
      const std::string key = " " + folded(text) + " ";
      if (key.find(fmt::format(" {} ", word)) == std::string::npos) continue;
      for (std::size_t k = 0; k < 3; ++k) names.units[first + k] = word;
    }
    split_cells(text.substr(text.find(':') == std::string_view::npos ? 0 : text.find(':') + 1), ',', cells);
    if (cells.size() != 3) continue;
    const NameAndUnit last = name_and_unit(trimmed_cell(cells[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      const NameAndUnit axis = name_and_unit(trimmed_cell(cells[k]));
      names.headers[first + k] = written(axis.name);
      const std::string& unit = axis.unit.empty() ? last.unit : axis.unit;
      if (!unit.empty()) names.units[first + k] = written(unit);
    }
    names.names_from = fmt::format("points: names from line {}", line.number);
  }
}

// "group, name, 1, x, y, z, stamp": a word at least, then perhaps a number of the point, then three numbers with
// decimals.
std::optional<LogShape> points(const LogShape& shape, const std::vector<ColumnSample>& samples,
                               const std::vector<HeadLine>& above) {
  const auto is_coordinate = [&](const ColumnSample& sample) { return is_number(sample) && !all_whole(sample); };
  const auto first = std::find_if(samples.begin(), samples.end(), is_coordinate);
  const bool is_named =
      std::any_of(samples.begin(), first, [&](const ColumnSample& sample) { return are_all(sample.texts, shape); });
  const bool are_three = samples.end() - first >= 3 && std::all_of(first, first + 3, [&](const ColumnSample& sample) {
                           return are_all(sample.numbers, shape);
                         });
  if (!is_named || !are_three || std::any_of(first + 3, samples.end(), is_coordinate)) return std::nullopt;
  LogShape names = without_names(shape, above);
  name_axes(static_cast<std::size_t>(first - samples.begin()), names);
  return names;
}

// "Ch 1,unit,Ch 2,unit": the unit of each value beside it, as one word in all rows.
void take_units_beside(const std::vector<ColumnSample>& samples, LogShape& shape) {
  for (std::size_t j = 1; j < samples.size(); ++j) {
    const bool is_unit = samples[j].words.size() == 1 && log_unit(*samples[j].words.begin());
    if (!is_unit || !is_number(samples[j - 1]) || !shape.units[j - 1].empty()) continue;
    if (!name_and_unit(shape.headers[j - 1]).unit.empty()) continue;
    shape.units[j - 1] = written(*samples[j].words.begin());
    shape.is_label[j] = true;
  }
}

}  // namespace

void find_names(const std::string& name, const std::vector<HeadLine>& lines, const Cut& cut, bool is_first,
                LogShape& shape) {
  find_header(lines, cut, is_first, shape);
  shape.is_label.assign(cut.columns, false);
  const std::vector<ColumnSample> samples = samples_of(shape, kRowsOfNames);
  const std::vector<HeadLine> above(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(cut.first));
  std::optional<LogShape> found = beside_values(shape, samples, above);
  const bool has_names = std::any_of(above.begin(), above.end(), [&](const HeadLine& line) {
    return line.number == shape.header_line && !line.text.starts_with("//");
  });
  std::optional<LogShape> of_points = has_names ? std::nullopt : points(shape, samples, above);
  if (found && of_points) {
    throw Error(
        fmt::format("{}:{}: expected rows of one layout, found words and numbers that are names beside their "
                    "values or points with X, Y and Z. Put a line of names above them.",
                    name, shape.first_row_line));
  }
  if (found || of_points) {
    shape = std::move(found ? *found : *of_points);
    return;
  }
  if (shape.header_line + 1 != shape.first_row_line || shape.units_line > 0) {
    if (shape.header_line > 0) shape.names_from = fmt::format("names from line {}", shape.header_line);
    if (shape.units_line > 0 && shape.units_line != shape.header_line)
      shape.names_from += fmt::format(", units from line {}", shape.units_line);
  }
  take_units_beside(samples, shape);
}

}  // namespace ballbar
