#include "logs/log_table.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/lines_between.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_header.hpp"
#include "logs/time_stamp.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFreeRows = 2;           // that are no rows of numbers, of any file; beside one in a hundred
constexpr std::int64_t kLongestPause_d = 365;  // after more days a clock that was not set is set
constexpr std::int64_t kYearsOfNoPause_d = 3 * 365;  // whatever year it started with

// A date may be read in two ways: how its days run in either, from row to row.
struct OrderEvidence {
  bool day_first = false, month_first = false;
  std::int64_t last[2] = {0, 0};
  std::int64_t longest[2] = {0, 0};  // step forward, days
  bool back[2] = {false, false};
  bool any = false;

  void look_at(std::string_view text, const TimeStamp& stamp) {
    if (!stamp.day) return;
    day_first = day_first || stamp.day_first_only;
    month_first = month_first || stamp.month_first_only;
    const auto other = time_stamp(text, DateOrder::month_first);
    const std::int64_t days[2] = {*stamp.day, other && other->day ? *other->day : *stamp.day};
    for (int k : {0, 1}) {
      if (any) {
        longest[k] = std::max(longest[k], days[k] - last[k]);
        back[k] = back[k] || days[k] < last[k];
      }
      last[k] = days[k];
    }
    any = true;
  }

  // By dates that are one thing alone, else by days that follow each other in one reading and jump in the other.
  [[nodiscard]] std::optional<DateOrder> order() const {
    if (day_first != month_first) return day_first ? DateOrder::day_first : DateOrder::month_first;
    const auto even = [&](int k) { return !back[k] && longest[k] <= 2; };
    const auto jumps = [&](int k) { return back[k] || longest[k] >= 20; };
    if (even(0) && jumps(1)) return DateOrder::day_first;
    if (even(1) && jumps(0)) return DateOrder::month_first;
    return std::nullopt;
  }
};

// Where clocks start that are not set: 1970-01-01, 1980-01-01, 1980-01-06 (satellites) and 2000-01-01, or the day
// after.
bool is_day_of_unset_clock(std::int64_t day) {
  constexpr std::int64_t kFirstDays[] = {0, 3652, 3657, 10957};
  return std::any_of(std::begin(kFirstDays), std::end(kFirstDays),
                     [&](std::int64_t first) { return day == first || day == first + 1; });
}

// The first day of a year, or a day beside it, from which clocks of any make start.
bool is_new_year(std::int64_t day) {
  const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(day))};
  const unsigned month = static_cast<unsigned>(date.month()), of_month = static_cast<unsigned>(date.day());
  return (month == 1 && of_month <= 2) || (month == 12 && of_month == 31);
}

bool has_values(ColumnKind kind) { return kind == ColumnKind::number || kind == ColumnKind::words; }

class Table {
 public:
  Table(const LogShape& shape, const LogPlan& plan, const std::string& name, const LogRecipe& recipe, std::size_t rows)
      : shape_(shape), plan_(plan), name_(name), recipe_(recipe), between_(shape, name) {
    for (const std::string& text : recipe.missing) {
      if (const auto number = cell_number(text, shape.decimal)) none_.push_back(*number);
    }
    table_.values.resize(plan.columns.size());
    table_.words.resize(plan.columns.size());
    for (std::size_t i = 0; i < plan.columns.size(); ++i) {
      if (has_values(plan.columns[i].kind)) table_.values[i].reserve(rows);
    }
    if (plan.time.kind == TimePlan::Kind::stamps) table_.time_s.reserve(rows);
    number_columns_ =
        static_cast<std::size_t>(std::count_if(plan.columns.begin(), plan.columns.end(),
                                               [](const auto& column) { return column.kind == ColumnKind::number; }));
    row_.resize(plan.columns.size(), kGap);
    for (const PlannedColumn& column : plan.columns) {
      has_hours_ = has_hours_ || (column.kind == ColumnKind::part && column.part_s >= 1.0);
      has_calendar_ = has_calendar_ || column.kind == ColumnKind::day;
    }
    has_channels_ = std::any_of(plan.columns.begin(), plan.columns.end(),
                                [](const auto& column) { return column.kind == ColumnKind::channel; });
    find_decimals();
  }

  void read(const Source& source) {
    LogLines lines(source, shape_.encoding);
    bool expected_next = false;
    std::size_t last_line = 0, between = 0;
    while (lines.next(true)) {
      const std::string_view line = lines.line();
      if (lines.number() == shape_.header_line) between_.take_names(line);
      if (lines.number() < shape_.first_row_line) {
        look_for_date(line, lines.number());
        continue;
      }
      if (!take_row(line, lines.number())) {
        if (!is_timed_) look_for_date(line, lines.number());
        expected_next = false;
        ++between;
        continue;
      }
      if (table_.rows > 1) table_.without_row += between;
      between = 0;
      if (!expected_next || lines.number() != last_line + 1 || table_.rows == 1)
        table_.lines.emplace_back(table_.rows - 1, lines.number());
      expected_next = true;
      last_line = lines.number();
    }
  }

  // The table, where not too many rows are skipped.
  LogTable taken() {
    table_.other_lines += pending_.size();
    const std::string& fault = table_.bad_lines.empty() ? first_cut_ : first_fault_;
    const std::size_t skipped = table_.bad_lines.size();
    const std::size_t bad = skipped + table_.cut_lines.size();
    const std::size_t all = table_.rows + (plan_.time.kind == TimePlan::Kind::rows ? 0 : skipped);
    if (recipe_.skip_bad_rows || (bad <= kFreeRows + all / 100 && bad * 10 <= all)) return std::move(table_);
    if (bad == 1) throw Error(fmt::format("{} Use --skip-bad-rows to omit the row.", fault));
    throw Error(fmt::format("{} This affects {} of {} rows. Use --skip-bad-rows to omit them.", fault, bad, all));
  }

  // Words without a digit where a number is expected, in more than one row each, if rows were lost to nothing else.
  [[nodiscard]] std::vector<std::string> repeated_words() const {
    std::vector<std::string> words;
    std::size_t rows = 0;
    for (const auto& [word, count] : bad_words_) {
      if (count < 2) return {};
      rows += count;
      words.push_back(word);
    }
    return rows == table_.bad_lines.size() ? words : std::vector<std::string>{};
  }

  LogTable table_;
  OrderEvidence evidence_;
  std::size_t first_either_line_ = 0;
  std::string first_either_;

 private:
  // Whether the line ends within the number of this column, by its decimals.
  [[nodiscard]] bool is_cut_off(std::size_t column) const {
    return plan_.columns[column].kind == ColumnKind::number && decimals_of(last_cell_) < decimals_[column];
  }

  [[nodiscard]] std::size_t decimals_of(std::string_view cell) const {
    const std::size_t sign = cell.find(shape_.decimal);
    const std::size_t last = cell.find_last_of("0123456789");
    return sign == std::string_view::npos || last == std::string_view::npos || last < sign ? 0 : last - sign;
  }

  // The fewest that a column has in the first rows.
  void find_decimals() {
    decimals_.assign(plan_.columns.size(), std::string_view::npos);
    std::vector<std::string_view> cells;
    for (const HeadLine& row : shape_.rows) {
      split_cells(row.text, shape_.delimiter, cells);
      if (cells.size() != decimals_.size()) continue;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (look_of(cells[i]).kind != NumberLook::Kind::other)
          decimals_[i] = std::min(decimals_[i], decimals_of(cells[i]));
      }
    }
    for (std::size_t& decimals : decimals_) decimals = decimals == std::string_view::npos ? 0 : decimals;
  }

  std::string_view cell_at(const char* begin, const char* end) const {
    const std::string_view rest(begin, static_cast<std::size_t>(end - begin));
    return rest.substr(0, cell_end(rest, 0, shape_.delimiter));
  }

  const char* past_blanks(const char* at, const char* end) const {
    while (at < end && (*at == ' ' || (*at == '\t' && shape_.delimiter != '\t'))) ++at;
    return at;
  }

  bool is_end(const char* at, const char* end) const {
    return at == end || *at == shape_.delimiter || (shape_.delimiter == ' ' && *at == '\t');
  }

  // The rows have a clock alone: a date between them may be that of the rows behind it.
  void look_for_date(std::string_view line, std::size_t number) {
    if (plan_.time.kind == TimePlan::Kind::stamps && !table_.first_day)
      between_.look_for_date(line, number, table_.rows > 0);
  }

  // Counts a row that is none of numbers.
  bool skip(const std::string& fault, std::size_t line) {
    if (table_.bad_lines.empty()) first_fault_ = fmt::format("{}:{}: {}", name_, line, fault);
    table_.bad_lines.push_back(line);
    if (plan_.time.kind != TimePlan::Kind::rows) return false;
    for (std::size_t i = 0; i < plan_.columns.size(); ++i) {  // the rows behind it keep their numbers
      if (has_values(plan_.columns[i].kind)) table_.values[i].push_back(kGap);
    }
    if (has_channels_) take_channel();
    ++table_.rows;
    return true;
  }

  // Adds the row, or counts the line among others.
  bool take_row(std::string_view line, std::size_t number) {
    const char* at = line.data();
    const char* const end = at + line.size();
    std::size_t column = 0, numbers = 0;
    std::optional<std::size_t> bad;  // the first cell that is text where a number is expected
    std::string_view bad_cell;
    date_ = clock_ = half_day_ = channel_ = {};
    parts_s_ = 0.0;
    clock_is_set_ = false;
    day_.reset();
    const std::size_t columns = plan_.columns.size();
    is_timed_ = false;
    at = past_blanks(at, end);
    if (at == end) return false;
    if (*at == '#' || between_.repeats_names(line)) {
      if (*at != '#') between_.look_for_names(line, number);
      ++table_.other_lines;
      return false;
    }
    bool more = true;
    const fast_float::parse_options how(fast_float::chars_format::general, shape_.decimal);
    for (; column < columns && more; ++column) {
      at = past_blanks(at, end);
      last_cell_ = {at, static_cast<std::size_t>(end - at)};  // of a row that is short, up to its end
      const ColumnKind kind = plan_.columns[column].kind;
      if (kind == ColumnKind::number) {
        double value = kGap;
        const auto [rest, error] = fast_float::from_chars_advanced(at, end, value, how);
        const char* const after = error == std::errc{} ? past_blanks(rest, end) : at;
        if (error == std::errc{} && std::isfinite(value) && (is_end(rest, end) || is_end(after, end))) {
          const bool is_none = std::find(none_.begin(), none_.end(), value) != none_.end();
          row_[column] = is_none ? kGap : value;
          if (!is_none) ++numbers;
          at = shape_.delimiter == ' ' ? rest : after;
        } else {
          const std::string_view cell = cell_at(at, end);
          row_[column] = kGap;
          const auto on = switch_value(cell);
          if (on && (plan_.columns[column].is_switch || (plan_.columns[column].is_speed && *on == 0.0))) {
            row_[column] = *on;
            ++numbers;
          } else if (!is_missing(cell, recipe_.missing)) {
            if (const auto slow = number_in(cell, plan_.columns[column])) {
              row_[column] = *slow;
              ++numbers;
            } else if (!bad) {
              bad = column;
              bad_cell = cell;
            }
          }
          at += cell.size();
        }
      } else {
        const std::string_view cell = cell_at(at, end);
        if (kind == ColumnKind::stamp || kind == ColumnKind::date) date_ = trimmed_cell(cell);
        if (kind == ColumnKind::clock) clock_ = trimmed_cell(cell);
        if (kind == ColumnKind::part)
          parts_s_ += cell_number(cell, shape_.decimal).value_or(kGap) * plan_.columns[column].part_s;
        if (kind >= ColumnKind::year && kind <= ColumnKind::day)
          calendar_[static_cast<std::size_t>(kind) - static_cast<std::size_t>(ColumnKind::year)] =
              cell_number(cell, shape_.decimal).value_or(-1.0);
        if (kind == ColumnKind::half_day) half_day_ = trimmed_cell(cell);
        if (kind == ColumnKind::channel) channel_ = trimmed_cell(cell);
        if (kind == ColumnKind::words) row_[column] = word_in(cell, table_.words[column]);
        at += cell.size();
      }
      more = at < end;
      if (more && shape_.delimiter != ' ') {
        ++at;
        if (at == end) {  // the line ends in a delimiter: an empty cell follows
          more = false;
          if (column + 1 < columns) row_[++column] = kGap;
        }
      }
    }
    return finish_row({at, static_cast<std::size_t>(end - at)}, more, column, numbers, bad, bad_cell, number);
  }

  bool finish_row(std::string_view rest, bool more, std::size_t column, std::size_t numbers,
                  const std::optional<std::size_t>& bad, std::string_view bad_cell, std::size_t line) {
    double time_s = kGap;
    const TimePlan& plan = plan_.time;
    bool timed = plan.kind == TimePlan::Kind::rows;
    const StampState before{table_.first_day, table_.has_clock,  table_.elapsed,
                            table_.zoned,     table_.lacks_year, zone_s_};
    if (plan.kind == TimePlan::Kind::stamps) timed = take_stamp(line, time_s);
    if (plan.kind == TimePlan::Kind::number) timed = column > plan.column && std::isfinite(row_[plan.column]);
    // Few numbers and no time: a line of text, a header once more, a note at the end.
    const std::size_t found = numbers - (plan.kind == TimePlan::Kind::number && timed ? 1 : 0);
    const bool untimed = plan.kind == TimePlan::Kind::rows && found * 2 < number_columns_;
    if (!timed && !bad && found > 0 && found * 2 >= number_columns_) {
      ++table_.without_time;
      restore(before);
      return false;
    }
    if (!timed || (found == 0 && (!bad || untimed) && column < plan_.columns.size())) {
      pending_.push_back(line);
      restore(before);
      return false;
    }
    between_.expect_same_table(!table_.time_s.empty() && time_s < table_.time_s.back());
    for (const std::size_t text : pending_) {
      if (table_.bad_lines.empty())
        first_fault_ = fmt::format("{}:{}: expected a row of numbers, found none.", name_, text);
      table_.bad_lines.push_back(text);
    }
    pending_.clear();
    if (bad || (more && !is_remark(rest))) restore(before);
    if (bad) {
      const std::string_view word = trimmed_cell(bad_cell);
      if (std::none_of(word.begin(), word.end(), is_digit)) ++bad_words_[std::string(word)];
      return skip(fmt::format("expected a number for {}, found {}. Use --missing to read such a text as a gap.",
                              in_quotes(plan_.columns[*bad].source), in_quotes(trimmed_cell(bad_cell))),
                  line);
    }
    if (more && !is_remark(rest)) {
      return skip(fmt::format("expected {} values, one for each column, found more: {}.", plan_.columns.size(),
                              in_quotes(rest)),
                  line);
    }
    if (clock_is_set_) leave_out_rows_above();
    last_day_ = day_;
    if (column < plan_.columns.size()) {
      for (std::size_t i = column; i < plan_.columns.size(); ++i) row_[i] = kGap;
      if (is_cut_off(column - 1)) {
        row_[column - 1] = kGap;
        if (table_.cut_lines.empty()) {
          first_cut_ =
              fmt::format("{}:{}: expected {} values, one for each column, found a line that ends within value {}.",
                          name_, line, plan_.columns.size(), column);
        }
        table_.cut_lines.push_back(line);
      } else {
        ++table_.short_rows;
      }
    }
    for (std::size_t i = 0; i < plan_.columns.size(); ++i) {
      if (has_values(plan_.columns[i].kind)) table_.values[i].push_back(row_[i]);
    }
    if (plan.kind == TimePlan::Kind::stamps) table_.time_s.push_back(time_s);
    if (has_channels_) take_channel();
    ++table_.rows;
    return true;
  }

  [[nodiscard]] std::optional<double> number_in(std::string_view cell, const PlannedColumn& column) const {
    cell = trimmed_cell(cell);
    if (cell.starts_with(column.before)) cell.remove_prefix(column.before.size());
    if (cell.ends_with(column.behind)) cell.remove_suffix(column.behind.size());
    return cell_number(cell, shape_.decimal);
  }

  // The place of the word among those that differ; a gap: the cell is empty.
  static double word_in(std::string_view cell, std::vector<std::string>& words) {
    cell = trimmed_cell(cell);
    if (cell.find_first_not_of("-_./?") == std::string_view::npos) return kGap;
    const auto known = std::find(words.begin(), words.end(), cell);
    const auto place = static_cast<std::size_t>(known - words.begin());
    if (known == words.end() && words.size() < kMostStates) words.emplace_back(cell);
    return static_cast<double>(place);
  }

  void take_channel() {
    const auto known = channels_.find(channel_);
    const auto next = static_cast<std::uint32_t>(table_.channels.size());
    if (known == channels_.end()) {
      channels_.emplace(channel_, next);
      const std::string channel = written(channel_);
      table_.channels.push_back(channel.empty() ? "unnamed" : channel);
    }
    table_.channel_of.push_back(known == channels_.end() ? next : known->second);
  }

  // A word behind the last column is a remark; a number would be of a column that the rows before did not have.
  [[nodiscard]] bool is_remark(std::string_view rest) const {
    if (rest.find_first_not_of(" \t;,|") == std::string_view::npos) return true;
    std::vector<std::string_view> cells;
    split_cells(rest, shape_.delimiter, cells);
    return std::all_of(cells.begin(), cells.end(),
                       [](std::string_view cell) { return look_of(cell).kind == NumberLook::Kind::other; });
  }

  // What the stamps before a row say of all.
  struct StampState {
    std::optional<std::int64_t> first_day;
    bool has_clock, elapsed, zoned, lacks_year;
    double zone_s;
  };

  void restore(const StampState& before) {
    table_.first_day = before.first_day;
    table_.has_clock = before.has_clock;
    table_.elapsed = before.elapsed;
    table_.zoned = before.zoned;
    table_.lacks_year = before.lacks_year;
    zone_s_ = before.zone_s;
  }

  // The date and the clock of the row, as far as they are texts.
  std::optional<TimeStamp> stamp_of_row(DateOrder order, const std::optional<std::string>& with_colons) {
    if (date_.empty() && !clock_.empty() && last_day_) return TimeStamp{};  // the date of the row above
    if (has_calendar_) {
      const double year = calendar_[0] < 100.0 ? 2000.0 + calendar_[0] : calendar_[0];
      calendar_date_ = fmt::format("{:04.0f}-{:02.0f}-{:02.0f}", year, calendar_[1], calendar_[2]);
      date_ = calendar_date_;
    }
    if (plan_.columns[plan_.time.column].kind == ColumnKind::part) return TimeStamp{.clock_s = 0.0};
    return time_stamp(with_colons && clock_.empty() ? std::string_view(*with_colons) : date_, order);
  }

  // The clock is set now: no row before has a time.
  void leave_out_rows_above() {
    table_.before_clock += table_.rows;
    for (std::vector<double>& values : table_.values) values.clear();
    for (std::size_t i = 0; i < table_.words.size(); ++i) {  // of them the word of this row stays
      std::vector<std::string>& words = table_.words[i];
      const bool is_known = !words.empty() && row_[i] < static_cast<double>(words.size());
      words = is_known ? std::vector{words[static_cast<std::size_t>(row_[i])]} : std::vector<std::string>{};
      if (is_known) row_[i] = 0.0;
    }
    table_.time_s.clear();
    table_.channel_of.clear();
    table_.channels.clear();
    channels_.clear();
    table_.lines.clear();
    table_.rows = table_.short_rows = 0;
    evidence_ = {};
  }

  bool take_stamp(std::size_t line, double& time_s) {
    const DateOrder order = plan_.time.order.value_or(DateOrder::day_first);
    auto with_colons = plan_.time.dotted_clock ? clock_of_dots(clock_.empty() ? date_ : clock_, true) : std::nullopt;
    if (is_half_day(half_day_)) {
      std::string_view& clock = clock_.empty() ? date_ : clock_;
      const std::string_view plain = with_colons ? std::string_view(*with_colons) : clock;
      const auto alone = time_stamp(plain, order);
      if (alone && alone->clock_s && *alone->clock_s < 13.0 * 3600.0) {  // else it is one of 24 hours
        in_half_day_ = fmt::format("{} {}", plain, half_day_);
        if (with_colons)
          with_colons = in_half_day_;
        else
          clock = in_half_day_;
      }
    }
    auto stamp = stamp_of_row(order, with_colons);
    if (!stamp || std::isnan(parts_s_)) return false;
    if (has_hours_ && !stamp->clock_s) stamp->clock_s = 0.0;
    double clock_s = stamp->clock_s.value_or(0.0);
    if (stamp->two_fields && plan_.time.two_fields_are_minutes) clock_s /= 60.0;
    is_timed_ = stamp->clock_s.has_value();
    table_.has_clock = table_.has_clock || stamp->clock_s;
    table_.elapsed = table_.elapsed || stamp->elapsed;
    table_.lacks_year = table_.lacks_year || stamp->lacks_year;
    double zone_s = stamp->zone_s.value_or(0.0);
    if (!clock_.empty()) {
      const auto clock = time_stamp(with_colons ? std::string_view(*with_colons) : clock_, order);
      if (!clock || !clock->clock_s) return false;
      clock_s = *clock->clock_s;
      zone_s = clock->zone_s.value_or(zone_s);
    } else if (plan_.columns[plan_.time.column].kind == ColumnKind::date && !stamp->clock_s) {
      return false;
    }
    clock_s += parts_s_;
    table_.zoned = table_.zoned || stamp->zone_s.has_value();
    const bool is_dated = stamp->day.has_value();
    if (!is_dated && last_day_) {  // the date stands in the first row of a day alone
      const double before_s = table_.time_s.back(),
                   day_s = static_cast<double>(*last_day_ - *table_.first_day) * kDay_s;
      stamp->day = *last_day_ + (day_s + clock_s < before_s - 0.5 * kDay_s ? 1 : 0);
    }
    if (stamp->day) {
      if (!plan_.time.order && is_dated) {
        evidence_.look_at(date_, *stamp);
        if (stamp->either_order && first_either_.empty()) {
          first_either_ = std::string(date_);
          first_either_line_ = line;
        }
      } else if ((order == DateOrder::day_first && stamp->month_first_only) ||
                 (order == DateOrder::month_first && stamp->day_first_only)) {
        throw Error(fmt::format("{}:{}: expected dates with the {} first as in the rows before, found {}.", name_, line,
                                order == DateOrder::day_first ? "day" : "month", in_quotes(date_)));
      }
      if (last_day_ && table_.first_day) {
        const std::int64_t pause_d = *stamp->day - *last_day_;
        clock_is_set_ = (pause_d > kLongestPause_d && is_day_of_unset_clock(*table_.first_day)) ||
                        (pause_d > kYearsOfNoPause_d && is_new_year(*table_.first_day));
      }
      day_ = stamp->day;
      if (clock_is_set_) table_.first_day.reset();
      if (!table_.first_day) {
        table_.first_day = *stamp->day;
        zone_s_ = zone_s;
      }
      time_s = static_cast<double>(*stamp->day - *table_.first_day) * kDay_s + clock_s - (zone_s - zone_s_);
    } else {
      time_s = clock_s;
    }
    return true;
  }

  const LogShape& shape_;
  const LogPlan& plan_;
  const std::string& name_;
  const LogRecipe& recipe_;
  LinesBetween between_;
  bool is_timed_ = false;     // the line has a clock
  std::vector<double> none_;  // numbers that the recipe takes for no value
  std::vector<double> row_;
  std::size_t number_columns_ = 0;
  std::string first_fault_, first_cut_;
  std::map<std::string, std::size_t> bad_words_;  // rows by the word that stands for a number
  std::vector<std::size_t> pending_;              // lines without numbers since the last row
  std::vector<std::size_t> decimals_;             // of each column, the fewest
  std::string_view last_cell_;                    // of the row
  std::string_view date_, clock_, half_day_, channel_;
  std::string in_half_day_;  // the clock with the half of the day behind it
  bool has_hours_ = false, has_calendar_ = false;
  bool clock_is_set_ = false;                   // in the row, and in no row before
  std::optional<std::int64_t> day_, last_day_;  // of the row, and of the row before
  double parts_s_ = 0.0;                        // of the row
  std::array<double, 3> calendar_{};            // year, month and day
  std::string calendar_date_;
  bool has_channels_ = false;
  std::map<std::string, std::uint32_t, std::less<>> channels_;
  double zone_s_ = 0.0;
};

}  // namespace

std::size_t LogTable::line_of(std::size_t row) const {
  const auto after =
      std::upper_bound(lines.begin(), lines.end(), row, [](std::size_t r, const auto& one) { return r < one.first; });
  if (after == lines.begin()) return 0;
  const auto& at = *std::prev(after);
  return at.second + (row - at.first);
}

void keep_rows(const std::vector<std::size_t>& rows, LogTable& table) {
  std::vector<std::pair<std::size_t, std::size_t>> lines;
  std::size_t before = 0;
  for (std::size_t now = 0; now < rows.size(); ++now) {
    const std::size_t line = table.line_of(rows[now]);
    if (now == 0 || line != before + 1) lines.emplace_back(now, line);
    before = line;
  }
  const auto keep = [&](auto& values) {
    if (values.size() != table.rows) return;
    auto kept = values;
    kept.resize(rows.size());
    std::transform(rows.begin(), rows.end(), kept.begin(), [&](std::size_t row) { return values[row]; });
    values = std::move(kept);
  };
  for (std::vector<double>& values : table.values) keep(values);
  keep(table.time_s);
  keep(table.channel_of);
  table.lines = std::move(lines);
  table.rows = rows.size();
}

LogTable log_table(const Source& source, const LogShape& shape, LogPlan& plan, const LogRecipe& given) {
  const std::string& name = source.name();
  const std::size_t text_bytes = source.size() / (shape.encoding.name.starts_with("UTF-16") ? 2 : 1);
  const std::size_t rows = text_bytes / shape.bytes_a_row + text_bytes / shape.bytes_a_row / 32 + 16;
  LogRecipe recipe = given;
  for (;;) {
    Table table(shape, plan, name, recipe, rows);
    table.read(source);
    table.table_.gap_words.assign(recipe.missing.begin() + static_cast<std::ptrdiff_t>(given.missing.size()),
                                  recipe.missing.end());
    if (const std::vector<std::string> words = table.repeated_words(); !words.empty()) {
      recipe.missing.insert(recipe.missing.end(), words.begin(), words.end());
      continue;
    }
    if (plan.time.order || plan.time.kind != TimePlan::Kind::stamps) return table.taken();
    plan.time.order = table.evidence_.order();
    if (!plan.time.order) {
      if (table.first_either_.empty()) {
        plan.time.order = DateOrder::day_first;
        return table.taken();
      }
      throw Error(
          fmt::format("{}:{}: expected an unambiguous date, found {}. {}tate --dates day-first or --dates month-first.",
                      name, table.first_either_line_, in_quotes(table.first_either_),
                      table.table_.lacks_year ? "S" : "The third number is the year; s"));
    }
    if (plan.time.order == DateOrder::day_first) return table.taken();
  }
}

}  // namespace ballbar
