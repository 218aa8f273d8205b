#include "ballbar/formats/series/live_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLongestLine = std::size_t{64} << 10;
constexpr std::size_t kOther = std::numeric_limits<std::size_t>::max(), kTime = kOther - 1;
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

constexpr std::string_view kBlanks = " \t\r";

double number_of(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  double value = kNoValue;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc{} && end == cell.data() + cell.size() ? value : kNoValue;
}

}  // namespace

LiveRows::LiveRows(std::string name, std::vector<std::string> columns)
    : name_(std::move(name)), columns_(std::move(columns)) {
  row_.values.resize(columns_.size());
}

void LiveRows::add(std::string_view bytes) {
  bytes_.erase(0, begin_);
  searched_ -= begin_;
  begin_ = 0;
  bytes_.append(bytes);
}

const LiveRow* LiveRows::next() {
  while (true) {
    const std::size_t end = bytes_.find('\n', searched_);
    const bool whole = end != std::string::npos;
    searched_ = whole ? end + 1 : bytes_.size();
    if (searched_ - begin_ > kLongestLine) too_long_ = true;
    if (too_long_ && !named()) {
      throw Error(fmt::format("{}:{}: expected the names of the columns in at most 64 KiB, found a longer line.", name_,
                              line_ + 1));
    }
    if (!whole) {
      if (too_long_) {  // nothing of it is kept
        taken_ += bytes_.size() - begin_;
        begin_ = bytes_.size();
      }
      return nullptr;
    }
    taken_ += end + 1 - begin_;
    const std::string_view line = too_long_ ? "" : std::string_view(bytes_).substr(begin_, end - begin_);
    const bool lost = std::exchange(too_long_, false);
    begin_ = end + 1;
    ++line_;
    if (const LiveRow* row = take(lost ? "," : line)) return row;
  }
}

const LiveRow* LiveRows::last() {
  if (begin_ < bytes_.size() || too_long_) add("\n");
  if (const LiveRow* row = next()) return row;
  if (!named()) throw Error(fmt::format("{}: expected a line with the names of the columns, found none.", name_));
  return nullptr;
}

const LiveRow* LiveRows::take(std::string_view line) {
  if (line_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
  line = trimmed(line, kBlanks);
  if (line.empty() || line.starts_with('#')) return nullptr;
  if (!named()) {
    name_columns(line);
    return nullptr;
  }
  row_.time_s = kNoValue;
  std::fill(row_.values.begin(), row_.values.end(), kNoValue);
  std::size_t cell = 0;
  for (std::size_t begin = 0, end = 0; begin <= line.size(); ++cell, begin = end + 1) {
    end = cell_end(line, begin, ',');
    if (cell >= cells_ || target_[cell] == kOther) continue;
    const double value = number_of(trimmed(line.substr(begin, end - begin), kBlanks));
    (target_[cell] == kTime ? row_.time_s : row_.values[target_[cell]]) = value;
  }
  if (cell != cells_) {
    row_.time_s = kNoValue;
    std::fill(row_.values.begin(), row_.values.end(), kNoValue);
  }
  row_.time_s *= second_;
  return &row_;
}

void LiveRows::name_columns(std::string_view line) {
  std::vector<std::string_view> cells;
  split_cells(line, ',', cells);
  std::vector<std::string> names;
  for (const std::string_view cell : cells) names.push_back(unquoted(trimmed(cell, kBlanks)));
  const auto fail = [&](const std::string& sentence) { throw Error(fmt::format("{}:{}: {}", name_, line_, sentence)); };
  const auto count = [&](std::string_view name) { return std::count(names.begin(), names.end(), name); };
  if (count("time_s") + count("time_min") != 1) {
    fail(fmt::format("expected one column time_s or time_min, found {}.",
                     count("time_s") + count("time_min") == 0 ? in_quotes(line) : std::string("more than one")));
  }
  second_ = count("time_min") == 1 ? 60.0 : 1.0;
  for (const std::string& name : columns_) {
    if (name == "time_s" || name == "time_min") {
      fail(fmt::format("expected signals for the model to read, found {}. In a formula, time is t.", name));
    }
    if (count(name) == 1) continue;
    if (count(name) > 1) fail(fmt::format("expected the column {} once, found it {} times.", name, count(name)));
    const std::vector<std::string_view> known(names.begin(), names.end());
    fail(fmt::format("expected the column {}, which the model reads, found none; the nearest is {}.", name,
                     in_quotes(nearest_name(name, known))));
  }
  for (const std::string& name : names) {
    const auto column = std::find(columns_.begin(), columns_.end(), name);
    const bool is_time = name == "time_s" || name == "time_min";
    target_.push_back(is_time                    ? kTime
                      : column != columns_.end() ? static_cast<std::size_t>(column - columns_.begin())
                                                 : kOther);
  }
  cells_ = names.size();
}

}  // namespace ballbar
