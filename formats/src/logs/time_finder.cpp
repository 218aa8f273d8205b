#include "logs/time_finder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/log_interval.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "logs/time_stamp.hpp"

namespace ballbar {
namespace {

constexpr double kUnixToMatlab_d = 719529.0, kUnixToJulian_d = 2440587.5;
constexpr std::string_view kNoTime = "none";  // of a recipe

class TimeFinder {
 public:
  TimeFinder(const LogShape& shape, const std::string& name, const LogRecipe& recipe,
             const std::vector<ColumnSample>& samples, LogPlan& plan)
      : shape_(shape), name_(name), recipe_(recipe), plan_(plan), samples_(samples) {}

  void find() {
    if (recipe_.every_s) return by_rows(*recipe_.every_s, "the option");
    if (recipe_.time == kNoTime) return by_number();
    if (!recipe_.time.empty()) return of_column(named_by_recipe());
    const auto clocks = first([](const ColumnSample& s) { return s.mostly(s.clocks); });
    const auto fractions = fractions_of_a_day();
    // Spreadsheets show a date at midnight where the time of day is in a column of its own.
    const auto is_date = [&](const ColumnSample& s) {
      return s.mostly(s.dates) || ((clocks || fractions) && s.mostly(s.stamps) && s.midnights == s.stamps);
    };
    const auto stamps =
        first([&](const ColumnSample& s) { return s.mostly(s.stamps) && s.numbers == 0 && !is_date(s); });
    auto dates = first([&](const ColumnSample& s) { return s.numbers == 0 && is_date(s); });
    // "13-4-26" beside a clock may be the number of a part.
    if (dates && clocks && plan_.columns[*dates].headed && samples_[*dates].sure_dates < samples_[*dates].dates &&
        !names_a_date(plan_.columns[*dates].name))
      dates.reset();
    const auto number = number_of_time();
    // A stamp to whole seconds beside a finer number: the number tells the rows apart.
    if (number && (stamps || clocks) && !is_absolute(*number)) {
      const bool finer = !all_whole(samples_[*number]);
      if (finer && tells_the_same(*number, stamps ? *stamps : *clocks)) return of_number(*number);
    }
    if (stamps && number && samples_[*stamps].lacks_year > 0) return of_number(*number);
    if (stamps) return of_stamp(*stamps);
    if (dates && clocks) return of_date_and_clock(*dates, *clocks);
    if (dates && fractions) return of_date_and_fraction(*dates, *fractions);
    if (const auto packed = packed_stamps()) return of_stamp(*packed);
    if (const auto packed = packed_date_and_clock()) return of_date_and_clock(packed->first, packed->second);
    const auto parts = number ? std::nullopt : parts_of_time(dates, clocks);
    if (parts) return of_parts(dates, *parts);
    if (clocks) return of_stamp(*clocks);
    if (const auto packed = packed_clocks()) return of_stamp(*packed);
    if (number) return of_number(*number);
    if (const auto every_s = interval_of(shape_)) return by_rows(*every_s, "the lines above the table");
    if (dates) return of_stamp(*dates);
    by_number();
  }

 private:
  [[noreturn]] void fail(const std::string& expected, const std::string& found, const std::string& mend) const {
    const std::size_t line = shape_.header_line > 0 ? shape_.header_line : shape_.first_row_line;
    throw Error(fmt::format("{}:{}: expected {}, found {}; {}.", name_, line, expected, found, mend));
  }

  template <class Suits>
  std::optional<std::size_t> first(Suits suits) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (!suits(samples_[i])) continue;
      if (is_time_name(plan_.columns[i].name)) return i;
      if (!found) found = i;
    }
    return found;
  }

  std::size_t named_by_recipe() const {
    Headers headers;
    for (const PlannedColumn& column : plan_.columns) headers.emplace_back(column.source, column.name);
    const std::vector<std::size_t> found = columns_named(recipe_.time, headers, comparables_of(headers));
    if (!found.empty()) return found.front();
    std::vector<std::string_view> known;
    for (const auto& header : headers) known.emplace_back(header.first);
    fail(fmt::format("a column {} for the time", in_quotes(recipe_.time)), "none",
         fmt::format("the nearest is {}", in_quotes(nearest_name(recipe_.time, known))));
  }

  // A number of time that runs as long as the stamps do.
  bool tells_the_same(std::size_t number, std::size_t stamps) const {
    const auto unit_s = unit_of_number(number);
    if (!unit_s || !samples_[stamps].first_s) return false;
    return runs_as_long(samples_[number], *unit_s, samples_[stamps]);
  }

  // 20261122 and 130510 in two columns, the second perhaps without its leading 0.
  std::optional<std::pair<std::size_t, std::size_t>> packed_date_and_clock() const {
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
      const ColumnSample& date = samples_[i];
      const ColumnSample& clock = samples_[i + 1];
      if (date.numbers == 0 || date.packed_dates != date.written()) continue;
      if (clock.packed_clocks == 0 || clock.packed_clocks != clock.written() ||
          !is_time_name(plan_.columns[i + 1].name))
        continue;
      return std::pair{i, i + 1};
    }
    return std::nullopt;
  }

  // A time of day in a spreadsheet's cell that is shown as a plain number.
  std::optional<std::size_t> fractions_of_a_day() const {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const ColumnSample& sample = samples_[i];
      const auto is_fraction = [](double value) { return value >= 0.0 && value < 1.0; };
      if (is_time_name(plan_.columns[i].name) && plan_.columns[i].unit.empty() && sample.mostly(sample.numbers) &&
          !all_whole(sample) && std::all_of(sample.values.begin(), sample.values.end(), is_fraction))
        return i;
    }
    return std::nullopt;
  }

  // Columns of whole numbers that are together a time: hour, minute and second, year, month and day.
  struct TimeParts {
    std::vector<std::size_t> calendar;                  // year, month, day; empty: none
    std::optional<std::size_t> clock;                   // a column of clocks beside them
    std::vector<std::pair<std::size_t, double>> parts;  // columns and their units, s
  };
  static std::size_t first_of(const TimeParts& time) {
    return !time.calendar.empty() ? time.calendar.front() : time.parts.front().first;
  }

  // Whether all cells of the column are such numbers, under one of these names and no unit but that of time.
  bool is_part(std::size_t i, std::string_view names, double least, double below, bool is_whole) const {
    if (i >= samples_.size()) return false;
    const ColumnSample& sample = samples_[i];
    const PlannedColumn& column = plan_.columns[i];
    if (!is_one_of(names, folded(column.name)) || !(column.unit.empty() || is_one_of(names, folded(column.unit))))
      return false;
    return !sample.values.empty() && sample.values.size() == sample.written() && (!is_whole || all_whole(sample)) &&
           std::all_of(sample.values.begin(), sample.values.end(),
                       [&](double value) { return value >= least && value < below; });
  }

  // Year, month and day in neighbouring columns, or the other way about; empty: there are none.
  std::vector<std::size_t> calendar_columns() const {
    constexpr std::string_view kYears = "year|yyyy|yy|jahr|annee|anno|ano|年", kDays = "day|dd|tag|jour|giorno|dia|日";
    for (std::size_t month = 1; month + 1 < samples_.size(); ++month) {
      if (!is_part(month, "month|mon|mm|mo|monat|mois|mese|mes|月", 1.0, 13.0, true)) continue;
      for (const auto& [year, day] : {std::pair{month - 1, month + 1}, std::pair{month + 1, month - 1}}) {
        if (is_part(year, kYears, 0.0, 2070.0, true) && is_part(day, kDays, 1.0, 32.0, true)) return {year, month, day};
      }
    }
    return {};
  }

  // Without a date a clock falls at midnight alone.
  bool runs_on(const std::vector<std::pair<std::size_t, double>>& parts) const {
    double before_s = 0.0;
    for (std::size_t row = 0; row < samples_[parts.front().first].values.size(); ++row) {
      double now_s = 0.0;
      for (const auto& [column, part_s] : parts) {
        if (row >= samples_[column].values.size()) return false;
        now_s += part_s * samples_[column].values[row];
      }
      if (now_s < before_s && now_s > before_s - 0.5 * kDay_s) return false;
      before_s = now_s;
    }
    return true;
  }

  std::optional<TimeParts> parts_of_time(const std::optional<std::size_t>& date,
                                         const std::optional<std::size_t>& clock) const {
    constexpr std::string_view kHours =
        "hour|hours|hr|hrs|hh|h|stunde|stunden|std|heure|heures|ora|ore|hora|horas|时|小时|時";
    constexpr std::string_view kWords = "hour|hours|stunde|heure|ora|hora|时|小时|時";  // that mean no height
    constexpr std::string_view kMinutes = "minute|minutes|min|mins|mm|m|mi|minuten|minuti|minuto|minutos|分|分钟";
    constexpr std::string_view kSeconds =
        "second|seconds|sec|secs|ss|s|sekunde|sekunden|sek|seconde|secondi|segundo|秒";
    TimeParts time;
    if (!date) time.calendar = calendar_columns();
    const bool has_date = date || !time.calendar.empty();
    if (clock) {
      time.clock = clock;
      return time.calendar.empty() ? std::nullopt : std::optional(time);
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (!is_part(i, kHours, 0.0, has_date ? 25.0 : 1e4, false)) continue;
      time.parts = {{i, 3600.0}};
      const bool has_minutes = all_whole(samples_[i]) && is_part(i + 1, kMinutes, 0.0, 60.0, false);
      if (has_minutes) time.parts.emplace_back(i + 1, 60.0);
      if (has_minutes && all_whole(samples_[i + 1]) && is_part(i + 2, kSeconds, 0.0, 60.0, false))
        time.parts.emplace_back(i + 2, 1.0);
      const bool is_surely = has_minutes || (has_date && is_part(i, kWords, 0.0, 25.0, false));
      if (is_surely && (has_date || runs_on(time.parts))) return time;
    }
    return std::nullopt;
  }

  static bool names_a_date(std::string_view name) {
    constexpr std::string_view kNames =
        "day|dag|tag|jour|giorno|dia|pvm|paiva|dato|measured|recorded|recorded on|when|created|aufnahme|messung|"
        "gemessen|mesure|medida|misura|registrato|날짜|日|测量|记录";
    const std::string key = folded(name);
    constexpr std::string_view kParts[] = {"dat", "fecha", "time", "zeit", "tag",
                                           "day", "日期",  "日付", "时间", "時間"};
    return is_time_name(name) || is_one_of(kNames, key) ||
           std::any_of(std::begin(kParts), std::end(kParts),
                       [&](std::string_view part) { return key.find(part) != std::string::npos; });
  }

  // 075800, all with their leading 0, under a name of time without a unit.
  std::optional<std::size_t> packed_clocks() const {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const ColumnSample& sample = samples_[i];
      if (sample.numbers > 1 && sample.packed_clocks == sample.written() && is_time_name(plan_.columns[i].name) &&
          plan_.columns[i].unit.empty() && recipe_.time_unit.empty())
        return i;
    }
    return std::nullopt;
  }

  // 20261122130510, without a sign, under a name of time.
  std::optional<std::size_t> packed_stamps() const {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (samples_[i].numbers > 0 && samples_[i].stamps == samples_[i].numbers) return i;
    }
    return std::nullopt;
  }

  // Seconds since 1970 and days since 1899 or year 0 of a plausible date; how long a unit of it is.
  struct Absolute {
    double unit_s, zero_s, resolution_s;
    std::string_view text;
  };
  static std::optional<Absolute> absolute(const ColumnSample& sample) {
    if (sample.values.size() < 2 || !sample.ever_rises) return std::nullopt;
    const auto [least, most] = std::minmax_element(sample.values.begin(), sample.values.end());
    const double first = *least, last = *most;  // of channels below each other it falls where the next one begins
    const bool days =
        sample.rises && (last - first) / static_cast<double>(sample.values.size() - 1) < 1.1 && !all_whole(sample);
    struct Range {
      double low, high;
      Absolute time;
    };
    constexpr Range kRanges[] = {
        {3e8, 3e9, {1.0, 0.0, 1e-6, "seconds since 1970"}},
        {3e9, 6e9, {1.0, -2082844800.0, 1e-6, "seconds since 1904"}},  // of LabVIEW
        {3e11, 6e12, {1e-3, 0.0, 1e-6, "ms since 1970"}},
        {3e14, 6e15, {1e-6, 0.0, 1e-6, "us since 1970"}},
        {7e17, 6e18, {1e-9, 0.0, 1e-6, "ns since 1970"}},
        {1.2e17, 1.7e17, {1e-7, -11644473600.0, 1e-4, "ticks of 100 ns since 1601"}},  // of Windows
        {6.2e17, 6.8e17, {1e-7, -62135596800.0, 1e-4, "ticks of 100 ns since year 1"}},
        {29000.0, 80000.0, {kDay_s, -kUnixToExcel_d * kDay_s, 1e-3, "days of a spreadsheet, since 1899-12-30"}},
        {715000.0, 780000.0, {kDay_s, -kUnixToMatlab_d * kDay_s, 1e-3, "days of MATLAB's datenum"}},
        {2.4e6, 2.5e6, {kDay_s, -kUnixToJulian_d * kDay_s, 1e-3, "Julian days"}},
    };
    for (const Range& range : kRanges) {
      if (first >= range.low && last <= range.high && (range.time.unit_s < kDay_s || days)) return range.time;
    }
    return std::nullopt;
  }
  [[nodiscard]] bool is_absolute(std::size_t i) const { return absolute(samples_[i]).has_value(); }

  std::optional<double> unit_of_number(std::size_t i) const {
    if (!recipe_.time_unit.empty()) return time_unit_s(recipe_.time_unit);
    if (const auto unit_s = time_unit_s(plan_.columns[i].unit)) return unit_s;
    const std::string key = folded(plan_.columns[i].name);  // of Arduino's clock
    return key == "millis" ? std::optional(1e-3) : key == "micros" ? std::optional(1e-6) : std::nullopt;
  }

  // Rising numbers: with a unit of time and a name, with a unit, with a name, or days and seconds of a date.
  std::optional<std::size_t> number_of_time() const {
    std::optional<std::size_t> best;
    int best_rank = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const ColumnSample& sample = samples_[i];
      if (!sample.mostly(sample.numbers) || !sample.ever_rises) continue;
      const bool named = is_time_name(plan_.columns[i].name) || starts_with_time(plan_.columns[i].name);
      const bool unit = time_unit_s(plan_.columns[i].unit).has_value();
      const bool dated = absolute(sample).has_value();
      if (!sample.rises && !(named && (unit || dated)))
        continue;  // of one that is surely meant, the row that falls is told
      const int rank = named && unit ? 5 : unit ? 4 : named && dated ? 3 : named ? 2 : dated && i == 0 ? 1 : 0;
      if (rank <= best_rank) continue;
      best = i;
      best_rank = rank;
    }
    return best;
  }

  // "mm:ss", "(min:s)", but not "h:mm:ss".
  static bool states_minutes_and_seconds(std::string_view header) {
    constexpr std::string_view kForms = "mm:ss|m:ss|m:s|min:s|min:ss|min:sec";
    for (std::size_t begin = 0; begin < header.size();) {
      const std::size_t end = std::min(header.find_first_of(" \t()[]{}_/,", begin), header.size());
      if (is_one_of(kForms, small(header.substr(begin, end - begin)))) return true;
      begin = end + 1;
    }
    return false;
  }

  static bool starts_with_time(std::string_view name) {
    const std::string key = folded(name);
    return key.starts_with("time ") || key.starts_with("zeit ") || key.ends_with(" time") || key.ends_with("zeit") ||
           key.starts_with("timestamp") || key.ends_with("timestamp");
  }

  void by_rows(double every_s, std::string_view from) {
    plan_.time.kind = TimePlan::Kind::rows;
    plan_.time.every_s = every_s;
    plan_.time.text = fmt::format("rows every {:g} s, by {}", every_s, from);
  }

  void by_number() {
    plan_.time.kind = TimePlan::Kind::rows;
    plan_.time.every_s = 1.0;
    plan_.time.numbered = true;
    plan_.time.text = "none: the rows are numbered";
    if (recipe_.time == kNoTime || plan_.columns.size() < 2 || plan_.columns.front().headed) return;
    const ColumnSample& first = samples_.front();
    if (first.mostly(first.numbers) && first.rises && first.ever_rises && !counts_rows(first, true))
      plan_.time.likely = plan_.columns.front().source;
  }

  void of_column(std::size_t i) {
    const ColumnSample& sample = samples_[i];
    const auto clocks = first([](const ColumnSample& s) { return s.mostly(s.clocks); });
    const std::optional<std::size_t> date = sample.mostly(sample.dates) ? std::optional(i) : std::nullopt;
    const auto parts = date && clocks ? std::nullopt : parts_of_time(date, clocks);
    if (parts && (date || i == first_of(*parts))) return of_parts(date, *parts);
    if (sample.mostly(sample.numbers) && sample.stamps != sample.numbers) return of_number(i);
    if (sample.mostly(sample.dates) || (sample.stamps > 0 && sample.midnights == sample.stamps)) {
      if (clocks) return of_date_and_clock(i, *clocks);
    }
    if (!sample.mostly(sample.stamps + sample.dates + sample.clocks)) {
      fail(fmt::format("times in the column {}", in_quotes(plan_.columns[i].source)), "other text",
           "name another with --time, or give the interval with --every, such as --every 1s");
    }
    of_stamp(i);
  }

  void of_number(std::size_t i) {
    TimePlan& time = plan_.time;
    time.kind = TimePlan::Kind::number;
    time.column = i;
    PlannedColumn& column = plan_.columns[i];
    column.kind = ColumnKind::number;
    if (const auto dated = absolute(samples_[i]); dated && recipe_.time_unit.empty()) {
      time.unit_s = dated->unit_s;
      time.zero_s = dated->zero_s;
      time.resolution_s = dated->resolution_s;
      time.text = fmt::format("{}, {}", in_quotes(column.source), dated->text);
      return;
    }
    const auto unit_s = unit_of_number(i);
    if (!unit_s) {
      fail(fmt::format("the unit of the time {}", in_quotes(column.source)), "none",
           "state --time-unit s, ms, min, h or d");
    }
    time.unit_s = *unit_s;
    time.resolution_s = *unit_s == 1.0 ? 0.0 : 1e-9;
    time.text = fmt::format("{} in {}", in_quotes(column.source),
                            recipe_.time_unit.empty() ? folded_unit(column.unit) : recipe_.time_unit);
  }

  void decide_order(const ColumnSample& sample) {
    if (sample.day_first && sample.month_first) {
      throw Error(fmt::format("{}:{}: expected dates of one order, found days and months that change places.", name_,
                              shape_.first_row_line));
    }
    TimePlan& time = plan_.time;
    if (sample.day_first) time.order = DateOrder::day_first;
    if (sample.month_first) time.order = DateOrder::month_first;
    if (time.order) return;
    if (recipe_.month_first)
      time.order = *recipe_.month_first ? DateOrder::month_first : DateOrder::day_first;
    else if (!sample.either || shape_.day_first)
      time.order = DateOrder::day_first;
  }

  void of_stamp(std::size_t i) {
    TimePlan& time = plan_.time;
    time.kind = TimePlan::Kind::stamps;
    time.column = i;
    const std::string header = plan_.columns[i].source + " " + shape_.units[i];
    // "5:00" is five minutes where the unit is the minute, and where "1:05:00" stands below it.
    const bool has_minutes = time_unit_s(plan_.columns[i].unit) == 60.0 ||
                             (!recipe_.time_unit.empty() && time_unit_s(recipe_.time_unit) == 60.0);
    const bool has_both =
        samples_[i].has_three_fields && !samples_[i].two_fields_return && samples_[i].minutes_and_seconds == 0;
    time.two_fields_are_minutes = samples_[i].two_fields > 0 && samples_[i].stamps == 0 &&
                                  (states_minutes_and_seconds(header) || has_minutes || has_both);
    time.two_fields_are_hours = samples_[i].two_fields > 0 && samples_[i].stamps == 0 && !time.two_fields_are_minutes;
    time.minutes_and_seconds = time.two_fields_are_minutes || (samples_[i].minutes_and_seconds > 0 &&
                                                               samples_[i].minutes_and_seconds == samples_[i].clocks);
    time.dotted_clock = samples_[i].has_dotted_clocks;
    plan_.columns[i].kind = ColumnKind::stamp;
    decide_order(samples_[i]);
    time.text = in_quotes(plan_.columns[i].source);
    find_half_day(i);
    find_milli(i);
  }

  void of_date_and_clock(std::size_t date, std::size_t clock) {
    of_stamp(date);
    plan_.columns[date].kind = ColumnKind::date;
    plan_.columns[clock].kind = ColumnKind::clock;
    plan_.time.dotted_clock = samples_[clock].has_dotted_clocks;
    plan_.time.text =
        fmt::format("{} and {}", in_quotes(plan_.columns[date].source), in_quotes(plan_.columns[clock].source));
    find_half_day(clock);
    find_milli(clock);
  }

  void of_date_and_fraction(std::size_t date, std::size_t fraction) {
    of_stamp(date);
    plan_.columns[fraction].kind = ColumnKind::part;
    plan_.columns[fraction].part_s = kDay_s;
    plan_.time.text = fmt::format("{} and {}, a fraction of the day", in_quotes(plan_.columns[date].source),
                                  in_quotes(plan_.columns[fraction].source));
  }

  void of_parts(const std::optional<std::size_t>& date, const TimeParts& parts) {
    TimePlan& time = plan_.time;
    std::vector<std::string> names;
    const auto take = [&](std::size_t column, ColumnKind kind) {
      plan_.columns[column].kind = kind;
      names.push_back(in_quotes(plan_.columns[column].source));
    };
    if (date) {
      of_stamp(*date);
      take(*date, ColumnKind::date);
    } else {
      time.kind = TimePlan::Kind::stamps;
      time.column = first_of(parts);
      time.order = DateOrder::day_first;  // no date is ambiguous
    }
    constexpr ColumnKind kCalendar[] = {ColumnKind::year, ColumnKind::month, ColumnKind::day};
    for (std::size_t k = 0; k < parts.calendar.size(); ++k) take(parts.calendar[k], kCalendar[k]);
    if (parts.clock) {
      time.dotted_clock = samples_[*parts.clock].has_dotted_clocks;
      take(*parts.clock, ColumnKind::clock);
    }
    for (const auto& [column, part_s] : parts.parts) {
      plan_.columns[column].part_s = part_s;
      take(column, ColumnKind::part);
    }
    time.text = fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
    if (parts.clock) find_half_day(*parts.clock);
    find_milli(parts.clock ? *parts.clock : parts.parts.back().first);
  }

  // A column of AM and PM beside a clock.
  void find_half_day(std::size_t clock) {
    for (const std::size_t i : {clock + 1, clock - 1}) {
      if (i >= samples_.size()) continue;
      const ColumnSample& sample = samples_[i];
      if (sample.texts == 0 || sample.texts != sample.written() ||
          !std::all_of(sample.words.begin(), sample.words.end(), is_half_day))
        continue;
      plan_.columns[i].kind = ColumnKind::half_day;
      plan_.time.text += fmt::format(" and {}", in_quotes(plan_.columns[i].source));
      return;
    }
  }

  // A column of milliseconds right behind a clock to whole seconds.
  void find_milli(std::size_t clock) {
    if (clock + 1 >= samples_.size()) return;
    PlannedColumn& next = plan_.columns[clock + 1];
    const std::string key = folded(next.name);
    const bool named = key == "ms" || key == "msec" || key == "millisecond" || key == "milliseconds" ||
                       key == "millis" || key == "毫秒" || key == "ミリ秒";
    const bool micro = key == "us" || key == "usec" || key == "microseconds";
    const ColumnSample& sample = samples_[clock + 1];
    const bool suits = !sample.values.empty() && all_whole(sample) &&
                       std::all_of(sample.values.begin(), sample.values.end(),
                                   [&](double v) { return v >= 0.0 && v < (micro ? 1e6 : 1e3); });
    if (!(named || micro) || !suits) return;
    next.kind = ColumnKind::part;
    next.part_s = micro ? 1e-6 : 1e-3;
    plan_.time.text += fmt::format(" and {}", in_quotes(next.source));
  }

  const LogShape& shape_;
  const std::string& name_;
  const LogRecipe& recipe_;
  LogPlan& plan_;
  const std::vector<ColumnSample>& samples_;
};

}  // namespace

void find_time(const LogShape& shape, const std::string& name, const LogRecipe& recipe,
               const std::vector<ColumnSample>& samples, LogPlan& plan) {
  TimeFinder(shape, name, recipe, samples, plan).find();
}

}  // namespace ballbar
