#include "logs/time_stamp.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include "ballbar/formats/logs/log.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"

namespace ballbar {
namespace {

constexpr std::int64_t kYearOfNone = 2001;  // as most, without 29 February

// Months by their first letters, folded: English, German, French, Italian, Spanish.
constexpr std::pair<std::string_view, unsigned> kMonths[] = {
    {"jan", 1}, {"gen", 1},  {"ene", 1},  {"feb", 2},  {"fev", 2},  {"mar", 3},  {"mrz", 3},  {"maerz", 3},
    {"apr", 4}, {"avr", 4},  {"abr", 4},  {"mai", 5},  {"may", 5},  {"mag", 5},  {"juin", 6}, {"jun", 6},
    {"giu", 6}, {"juil", 7}, {"jul", 7},  {"lug", 7},  {"aug", 8},  {"aou", 8},  {"ago", 8},  {"sep", 9},
    {"set", 9}, {"okt", 10}, {"oct", 10}, {"ott", 10}, {"nov", 11}, {"dez", 12}, {"dec", 12}, {"dic", 12},
};

// The rest of a cell, read from its front.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return text_.empty(); }
  [[nodiscard]] std::string_view rest() const { return text_; }
  [[nodiscard]] char peek() const { return text_.empty() ? '\0' : text_.front(); }

  bool take(std::string_view what) {
    if (!text_.starts_with(what)) return false;
    text_.remove_prefix(what.size());
    return true;
  }

  char take_any(std::string_view signs) {
    if (text_.empty() || signs.find(text_.front()) == std::string_view::npos) return '\0';
    const char c = text_.front();
    text_.remove_prefix(1);
    return c;
  }

  void skip_blanks() {
    while (take(" ") || take("\t") || take("\u00A0") || take("\u202F")) continue;
  }

  // All digits in front, `least` to `most` of them.
  std::optional<std::int64_t> number(std::size_t least, std::size_t most) {
    std::size_t count = 0;
    while (count < text_.size() && is_digit(text_[count])) ++count;
    if (count < least || count > most) return std::nullopt;
    std::int64_t value = 0;
    std::from_chars(text_.data(), text_.data() + count, value);
    digits_ = count;
    text_.remove_prefix(count);
    return value;
  }
  [[nodiscard]] std::size_t digits() const { return digits_; }

  // Letters, UTF-8 included, and a dot behind them.
  std::string_view word() {
    std::size_t count = 0;
    while (count < text_.size() && ((text_[count] >= 'a' && text_[count] <= 'z') ||
                                    (text_[count] >= 'A' && text_[count] <= 'Z') || (text_[count] & 0x80) != 0)) {
      ++count;
    }
    const std::string_view found = text_.substr(0, count);
    text_.remove_prefix(count);
    if (count > 0) take(".");
    return found;
  }

 private:
  std::string_view text_;
  std::size_t digits_ = 0;
};

std::optional<unsigned> month_of(std::string_view word) {
  if (word.size() < 3) return std::nullopt;
  const std::string key = folded(word);
  for (const auto& [start, month] : kMonths) {
    if (key.starts_with(start)) return month;
  }
  return std::nullopt;
}

std::optional<std::int64_t> day_of(std::int64_t year, std::int64_t month, std::int64_t day) {
  if (month < 1 || month > 12 || day < 1 || day > 31 || year < 1900 || year > 2200) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

// 130510 -> 13 h 5 min 10 s.
double seconds_of_digits(std::int64_t digits) {
  const std::int64_t hours = digits / 10000, minutes = digits / 100 % 100;
  return static_cast<double>(hours * 3600 + minutes * 60 + digits % 100);
}

std::int64_t whole_year(std::int64_t year, std::size_t digits) {
  if (digits > 2) return year;
  return year < 70 ? 2000 + year : 1900 + year;
}

bool set_day(TimeStamp& stamp, std::int64_t year, std::int64_t month, std::int64_t day) {
  stamp.day = day_of(year, month, day);
  return stamp.day.has_value();
}

// A blank and the hour of a clock.
bool clock_follows(Cursor cursor) {
  if (cursor.take_any(" T_") == '\0') return false;
  cursor.skip_blanks();
  return cursor.number(1, 2) && cursor.take(":");
}

// 22/11/2026, 22.11.26, 22-11-2026; before a clock 22.11., 22/11.
bool take_numbers(Cursor& cursor, std::int64_t first, char separator, DateOrder order, TimeStamp& stamp) {
  const auto second = cursor.number(1, 2);
  if (!second) return false;
  const bool is_closed = cursor.take_any(std::string_view(&separator, 1)) != '\0';
  stamp.lacks_year = (!is_closed || separator == '.') && clock_follows(cursor);
  if (!is_closed && !stamp.lacks_year) return false;
  std::int64_t whole = kYearOfNone;
  if (!stamp.lacks_year) {
    const auto year = cursor.number(2, 4);
    if (!year || cursor.digits() == 3) return false;
    whole = whole_year(*year, cursor.digits());
  }
  if (separator == '.') return set_day(stamp, whole, *second, first);
  stamp.either_order = first <= 12 && *second <= 12 && first != *second;
  stamp.month_first_only = first <= 12 && *second > 12;
  stamp.day_first_only = first > 12;
  const bool month_first = stamp.month_first_only || (!stamp.day_first_only && order == DateOrder::month_first);
  return month_first ? set_day(stamp, whole, first, *second) : set_day(stamp, whole, *second, first);
}

// 22-Nov-2026, 22. November 2026, 22 nov. 26, after the day.
bool take_named_month(Cursor& cursor, std::int64_t day, TimeStamp& stamp) {
  cursor.take_any(".-/ ");
  cursor.skip_blanks();
  const auto month = month_of(cursor.word());
  if (!month) return false;
  cursor.take_any("-/ ,");
  cursor.skip_blanks();
  const auto year = cursor.number(2, 4);
  if (!year || cursor.digits() == 3) return false;
  return set_day(stamp, whole_year(*year, cursor.digits()), *month, day);
}

// Nov 22, 2026, and with a clock between: Nov 22 13:05:10 2026.
bool take_month_before_day(Cursor& cursor, unsigned month, TimeStamp& stamp, bool& year_is_last, std::int64_t& day) {
  cursor.skip_blanks();
  const auto found = cursor.number(1, 2);
  if (!found) return false;
  day = *found;
  cursor.take(",");
  cursor.skip_blanks();
  Cursor ahead = cursor;
  const auto year = ahead.number(4, 4);
  year_is_last = !year;
  if (year_is_last) return set_day(stamp, 2000, month, day);  // it may have a 29 February
  cursor = ahead;
  return set_day(stamp, *year, month, day);
}

bool take_date(Cursor& cursor, DateOrder order, TimeStamp& stamp) {
  const auto first = cursor.number(1, 14);
  if (!first) return false;
  const std::size_t digits = cursor.digits();
  if (digits == 8) return set_day(stamp, *first / 10000, *first / 100 % 100, *first % 100);  // 20261122
  if (digits == 14) {                                                                        // 20261122130510
    const std::int64_t clock = *first % 1000000;
    if (clock / 10000 > 23 || clock / 100 % 100 > 59 || clock % 100 > 59) return false;
    stamp.clock_s = seconds_of_digits(clock);
    return set_day(stamp, *first / 10000000000, *first / 100000000 % 100, *first / 1000000 % 100);
  }
  if (digits == 6) {  // 261122-130510
    Cursor ahead = cursor;
    if (ahead.take_any("-_T ") == '\0' || !ahead.number(6, 6) || !ahead.at_end()) return false;
    return set_day(stamp, whole_year(*first / 10000, 2), *first / 100 % 100, *first % 100);
  }
  if (digits == 4) {  // 2026-11-22, 2026/11/22, 2026.11.22, 2026年11月22日
    const bool named = cursor.take("年");
    if (!named && cursor.take_any("-/.") == '\0') return false;
    const auto month = cursor.number(1, 2);
    if (!month || (named ? !cursor.take("月") : cursor.take_any("-/.") == '\0')) return false;
    const auto day = cursor.number(1, 2);
    if (named) cursor.take("日");
    return day && set_day(stamp, *first, *month, *day);
  }
  if (digits > 2) return false;
  Cursor ahead = cursor;
  const char separator = ahead.take_any("/.-");
  if (separator != '\0' && is_digit(ahead.peek())) {
    cursor = ahead;
    return take_numbers(cursor, *first, separator, order, stamp);
  }
  return take_named_month(cursor, *first, stamp);
}

// .5, ,5 or :500 behind the seconds.
double fraction(Cursor& cursor) {
  Cursor ahead = cursor;
  if (ahead.take_any(".,:") == '\0' || !is_digit(ahead.peek())) return 0.0;
  double value = 0.0, unit = 0.1;
  while (is_digit(ahead.peek())) {
    value += unit * (ahead.peek() - '0');
    unit *= 0.1;
    ahead.take_any("0123456789");
  }
  cursor = ahead;
  return std::round(value * 1e9) * 1e-9;
}

bool take_half_day(Cursor& cursor, double& clock_s) {
  cursor.skip_blanks();
  Cursor ahead = cursor;
  const char half = ahead.take_any("aApP");
  ahead.take(".");
  ahead.skip_blanks();
  if (half == '\0' || ahead.take_any("mM") == '\0') return true;
  ahead.take(".");
  cursor = ahead;
  if (clock_s >= 13.0 * 3600.0) return false;
  if (clock_s >= 12.0 * 3600.0) clock_s -= 12.0 * 3600.0;
  if (half == 'p' || half == 'P') clock_s += 12.0 * 3600.0;
  return true;
}

bool take_clock(Cursor& cursor, TimeStamp& stamp) {
  const bool after_noon = cursor.take("下午") || cursor.take("午後");
  const bool before_noon = !after_noon && (cursor.take("上午") || cursor.take("午前"));
  cursor.skip_blanks();
  const auto hours = cursor.number(1, 6);
  if (!hours) return false;
  if (cursor.digits() == 6 && cursor.peek() != ':') {  // 130510
    if (*hours / 10000 > 23 || *hours / 100 % 100 > 59 || *hours % 100 > 59) return false;
    stamp.clock_s = seconds_of_digits(*hours) + fraction(cursor);
    return true;
  }
  const bool named = cursor.take("时") || cursor.take("時") || cursor.take("点");
  // Behind a date 13.05.10 and 13-05-10 are clocks too.
  const std::string_view between = stamp.day ? ":h.-" : ":h";
  const char sign = named ? '\0' : cursor.take_any(between);
  if (!named && sign == '\0') return false;
  const auto minutes = cursor.number(1, 2);
  if (!minutes || *minutes > 59) return false;
  double clock_s = static_cast<double>(*hours) * 3600.0 + static_cast<double>(*minutes) * 60.0;
  const bool seconds_follow = named ? cursor.take("分") && is_digit(cursor.peek())
                                    : (cursor.peek() == sign || cursor.peek() == ':' || cursor.peek() == 'm') &&
                                          cursor.take_any(":m.-") != '\0';
  if (seconds_follow) {
    const auto seconds = cursor.number(1, 2);
    if (!seconds || *seconds > 60) return false;
    clock_s += static_cast<double>(*seconds) + fraction(cursor);
    if (named)
      cursor.take("秒");
    else
      cursor.take_any("s");
  } else if (cursor.peek() == '.' || cursor.peek() == ',') {  // 05:10.3
    clock_s = static_cast<double>(*hours) * 60.0 + static_cast<double>(*minutes) + fraction(cursor);
    stamp.minutes_and_seconds = true;
  } else {
    stamp.two_fields = !named;
  }
  stamp.elapsed = stamp.elapsed || clock_s > 86400.0;
  if (after_noon && clock_s < 12.0 * 3600.0) clock_s += 12.0 * 3600.0;
  if (before_noon && clock_s >= 12.0 * 3600.0) clock_s -= 12.0 * 3600.0;
  if (!take_half_day(cursor, clock_s)) return false;
  Cursor ahead = cursor;
  ahead.skip_blanks();
  if (ahead.take("Uhr")) cursor = ahead;
  stamp.clock_s = clock_s;
  return true;
}

// What letters behind a clock say of its zone, hours east of Greenwich.
constexpr std::pair<std::string_view, double> kZones[] = {
    {"CEST", 2.0}, {"CET", 1.0},  {"MESZ", 2.0}, {"MEZ", 1.0},  {"BST", 1.0},  {"WEST", 1.0}, {"WET", 0.0},
    {"EEST", 3.0}, {"EET", 2.0},  {"EST", -5.0}, {"EDT", -4.0}, {"CST", -6.0}, {"CDT", -5.0}, {"MST", -7.0},
    {"MDT", -6.0}, {"PST", -8.0}, {"PDT", -7.0}, {"JST", 9.0},  {"KST", 9.0}};

// "Europe/Berlin", "[Europe/Berlin]", "CET" behind the hours of the zone: they say no more.
void skip_region(Cursor& cursor) {
  Cursor ahead = cursor;
  ahead.skip_blanks();
  ahead.take("[");
  const std::string_view word = ahead.word();
  const bool is_zone =
      std::any_of(std::begin(kZones), std::end(kZones), [&](const auto& zone) { return zone.first == word; });
  if (ahead.take("/") ? ahead.word().empty() : !is_zone) return;
  while (ahead.take_any("/_") != '\0') ahead.word();
  ahead.take("]");
  cursor = ahead;
}

bool take_zone(Cursor& cursor, TimeStamp& stamp) {
  cursor.skip_blanks();
  for (const auto& [name, hours] : kZones) {
    if (!cursor.take(name)) continue;
    stamp.zone_s = hours * 3600.0;
    return true;
  }
  if (cursor.take("Z") || cursor.take("UTC") || cursor.take("GMT")) {
    stamp.zone_s = 0.0;
    if (cursor.peek() != '+' && cursor.peek() != '-') return true;
  }
  const char sign = cursor.take_any("+-");
  if (sign == '\0') {
    skip_region(cursor);
    return true;
  }
  const auto hours = cursor.number(2, 4);
  if (!hours) return false;
  double zone_s = static_cast<double>(*hours) * 3600.0;
  if (cursor.digits() == 4) zone_s = seconds_of_digits(*hours * 100);
  if (cursor.take(":")) {
    const auto minutes = cursor.number(2, 2);
    if (!minutes) return false;
    zone_s += static_cast<double>(*minutes) * 60.0;
  }
  stamp.zone_s = sign == '-' ? -zone_s : zone_s;
  skip_region(cursor);
  return true;
}

// Mon, Sonntag ...: letters in front of a date that are no month.
void skip_weekday(Cursor& cursor) {
  Cursor ahead = cursor;
  const std::string_view word = ahead.word();
  if (word.empty() || month_of(word)) return;
  if (static_cast<unsigned char>(word.front()) >= 0x80) return;
  ahead.take(",");
  ahead.skip_blanks();
  cursor = ahead;
}

// Days and a clock, without a word between: "1-05:30", "1.02:30:00", "1T05:30", "1:02:30:00", "000 02:30:00". Where
// four fields of two digits stand, the last is a fraction.
bool take_days_and_clock(Cursor cursor, TimeStamp& stamp) {
  const auto days = cursor.number(1, 5);
  if (!days) return false;
  const bool may_be_hours = cursor.digits() == 2;
  const char sign = cursor.take_any(".-T: ");
  const std::string_view clock = cursor.rest();
  const bool needs_seconds = sign == ' ' || sign == ':';
  if (sign == '\0' || clock.find(':') > 2 || (needs_seconds && std::count(clock.begin(), clock.end(), ':') != 2) ||
      (sign == ':' && may_be_hours) || !take_clock(cursor, stamp) || !cursor.at_end())
    return false;
  stamp.clock_s = *stamp.clock_s + kDay_s * static_cast<double>(*days);
  return true;
}

// A time since a start: "0.5 sec", "1h 30min", "1d 05:30", "0 days 00:00:30", "P1DT5H30M", and as above.
std::optional<TimeStamp> elapsed_time(std::string_view text) {
  TimeStamp stamp;
  const bool is_iso = text.starts_with('P') && text.find('T') != std::string_view::npos;
  Cursor cursor(text);
  if (!cursor.take(is_iso ? "P" : "T#")) cursor.take("+");  // T#5h30m of a PLC
  double sum_s = 0.0, last_unit_s = 0.0;
  if (!take_days_and_clock(cursor, stamp)) {
    while (!cursor.at_end()) {
      if (is_iso) cursor.take("T");
      if (last_unit_s == kDay_s && cursor.rest().find(':') != std::string_view::npos) {
        if (!take_clock(cursor, stamp) || !cursor.at_end()) return std::nullopt;
        break;
      }
      const std::string_view rest = cursor.rest();
      double value = 0.0;
      const std::size_t end = std::min(rest.find_first_not_of("0123456789."), rest.size());
      if (std::from_chars(rest.data(), rest.data() + end, value).ptr != rest.data() + end || end == 0)
        return std::nullopt;
      cursor = Cursor(rest.substr(end));
      cursor.skip_blanks();
      const bool is_small = cursor.peek() < 'A' || cursor.peek() > 'Z';
      const std::string_view unit = is_iso ? cursor.rest().substr(0, 1) : cursor.word();
      if (is_iso) cursor.take(unit);
      cursor.skip_blanks();
      // 5 m is a length, 10 S a conductance.
      const bool is_minutes = small(unit) == "m" && (last_unit_s > 0.0 || !cursor.at_end());
      const auto unit_s = is_minutes ? std::optional(60.0) : time_unit_s(unit);
      if (unit.empty() || !unit_s || !(is_small || is_iso || unit.size() > 2)) return std::nullopt;
      sum_s += value * *unit_s;
      last_unit_s = *unit_s;
    }
    if (last_unit_s == 0.0) return std::nullopt;
  }
  stamp.clock_s = sum_s + stamp.clock_s.value_or(0.0);
  stamp.elapsed = true;
  stamp.two_fields = false;
  return stamp;
}

// 211122-130510, whose front may be a clock as well.
bool is_packed_pair(std::string_view text) {
  return text.size() == 13 && std::string_view("-_T ").find(text[6]) != std::string_view::npos &&
         std::count_if(text.begin(), text.end(), [](char c) { return is_digit(c); }) == 12;
}

}  // namespace

std::optional<TimeStamp> time_stamp(std::string_view text, DateOrder order) {
  if (text.starts_with('[')) text.remove_prefix(1);  // "[2026-11-22 13:05:10]" of terminal programs
  if (text.ends_with(']') && text.find('[') == std::string_view::npos) text.remove_suffix(1);
  Cursor cursor(text);
  cursor.skip_blanks();
  TimeStamp stamp;
  if (const auto elapsed = elapsed_time(cursor.rest())) return elapsed;
  // A clock in front of the date, or alone.
  Cursor clock = cursor;
  if (!is_packed_pair(cursor.rest()) && take_clock(clock, stamp)) {
    if (!take_zone(clock, stamp)) return std::nullopt;
    clock.take_any(",;");
    clock.skip_blanks();
    if (clock.at_end()) return stamp;
    if (!take_date(clock, order, stamp)) return std::nullopt;
    clock.skip_blanks();
    return clock.at_end() ? std::optional(stamp) : std::nullopt;
  }
  stamp = {};
  skip_weekday(cursor);
  bool year_is_last = false;
  std::int64_t day = 0;
  Cursor ahead = cursor;
  const auto month = month_of(ahead.word());
  if (month) {
    cursor = ahead;
    if (!take_month_before_day(cursor, *month, stamp, year_is_last, day)) return std::nullopt;
  } else if (!take_date(cursor, order, stamp)) {
    return std::nullopt;
  }
  cursor.skip_blanks();
  cursor.take_any("T,;_-t");
  cursor.skip_blanks();
  if (!cursor.at_end() && !stamp.clock_s && !take_clock(cursor, stamp)) return std::nullopt;
  if (year_is_last) {
    cursor.skip_blanks();
    const auto year = cursor.number(4, 4);
    stamp.lacks_year = !year && stamp.clock_s && cursor.at_end();
    if ((!year && !stamp.lacks_year) || !set_day(stamp, year.value_or(kYearOfNone), *month, day)) return std::nullopt;
  }
  if (!take_zone(cursor, stamp)) return std::nullopt;
  cursor.skip_blanks();
  return cursor.at_end() ? std::optional(stamp) : std::nullopt;
}

std::string stamp_text(double seconds) {
  const long long all_ms = std::llround(seconds * 1e3), milli = (all_ms % 1000 + 1000) % 1000;
  std::string text =
      fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(static_cast<std::time_t>((all_ms - milli) / 1000)));
  if (milli != 0) text += fmt::format(".{:03}", milli);
  return text;
}

bool is_half_day(std::string_view word) { return is_one_of("am|pm|a.m.|p.m.|a. m.|p. m.", small(word)); }

std::optional<std::string> clock_of_dots(std::string_view text, bool may_lack_seconds) {
  if (text.ends_with("Uhr")) text = text.substr(0, text.find_last_not_of(' ', text.size() - 4) + 1);
  Cursor cursor(text);
  const auto hours = cursor.number(1, 2);
  if (!hours || !cursor.take(".")) return std::nullopt;
  const auto minutes = cursor.number(2, 2);
  if (!minutes || *minutes > 59) return std::nullopt;
  if (may_lack_seconds && cursor.at_end()) return fmt::format("{:02}:{:02}", *hours, *minutes);
  if (!cursor.take(".")) return std::nullopt;
  const auto seconds = cursor.number(2, 2);
  if (!seconds || *seconds > 59) return std::nullopt;
  const std::string_view rest = cursor.rest();
  if (fraction(cursor); !cursor.at_end()) return std::nullopt;
  return fmt::format("{:02}:{:02}:{:02}{}", *hours, *minutes, *seconds, rest);
}

}  // namespace ballbar
