#include "records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar::study {
namespace {

constexpr double kRow_s = 15.0;
constexpr double kCycle_s = 28800.0, kFirst_s = 465.0;  // of the record: from start to start, the first start
constexpr std::string_view kFake = "T_fake_";

const Series& whole_record() {
  static const Series record = [] {
    const std::string file = BALLBAR_SAMPLE_RUNS "/spindle-46h/measured.csv";
    return read_series(read_bytes(file, std::size_t{1} << 28), file);
  }();
  return record;
}

Series means(std::size_t each, const std::vector<std::pair<std::string, std::string>>& kept) {
  const Series& all = whole_record();
  Series data;
  const std::size_t rows = all.time_s.size() / each;
  for (std::size_t i = 0; i < rows; ++i) data.time_s.push_back(static_cast<double>(i * each) * kRow_s);
  for (const auto& [from, to] : kept) {
    const Column& column = *find_column(all, from);
    Column mean{to, column.role, std::vector<double>(rows, 0.0)};
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < each; ++k) mean.values[i] += column.values[i * each + k] / static_cast<double>(each);
    }
    data.columns.push_back(std::move(mean));
  }
  return data;
}

const std::vector<std::pair<std::string, std::string>> kSignals{{"speed_rpm", "speed_rpm"},
                                                                {"T16_degC", "T_room_degC"},
                                                                {"T4_degC", "T_coolant_degC"},
                                                                {"T5_degC", "T_bearing_degC"},
                                                                {"T3_degC", "T_housing_degC"}};

// Rows [from, to) with their time from 0.
Series cut(const Series& series, std::size_t from, std::size_t to) {
  Series part;
  for (std::size_t i = from; i < to; ++i) part.time_s.push_back(series.time_s[i] - series.time_s[from]);
  for (const Column& column : series.columns) {
    const auto begin = column.values.begin();
    part.columns.push_back({column.name,
                            column.role,
                            {begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(to)}});
  }
  return part;
}

// Speed, the record's room and a bearing that warms with 25 min by 8 K.
Series two_stretches(std::size_t rows, std::size_t change, double before_rpm, double after_rpm) {
  constexpr double kSpeed_rpm = 5000.0, kWarms_s = 1500.0, kWarms_K = 8.0;
  Series data = cut(rich_record().inputs, 0, rows);
  std::vector<double> speed(rows), warm(rows);
  double rise_K = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    speed[i] = i < change ? before_rpm : after_rpm;
    const double last_rpm = i == 0 ? 0.0 : speed[i - 1];
    if (i > 0) rise_K += (kWarms_K * last_rpm / kSpeed_rpm - rise_K) * -std::expm1(-5.0 * kRow_s / kWarms_s);
    warm[i] = 25.0 + rise_K;
  }
  Column room = *find_column(data, "T_room_degC");
  data.columns = {{"speed_rpm", Role::speed, speed}, std::move(room), {"T_bearing_degC", Role::structure, warm}};
  return data;
}

}  // namespace

Record rich_record(std::size_t each) { return {means(each, kSignals), {}, {}}; }

Record other_duty() {
  const Series rich = rich_record().inputs;
  Series data;
  for (const std::size_t cycle : {3, 1, 0, 2}) {
    const double from_s = kFirst_s - 300.0 + kCycle_s * static_cast<double>(cycle);
    const double shift_s = data.time_s.empty() ? 0.0 : data.time_s.back() + 5.0 * kRow_s;
    double first_s = -1.0;
    for (std::size_t i = 0; i < rich.time_s.size(); ++i) {
      if (rich.time_s[i] < from_s || rich.time_s[i] >= from_s + kCycle_s) continue;
      if (first_s < 0.0) first_s = rich.time_s[i];
      data.time_s.push_back(rich.time_s[i] - first_s + shift_s);
      data.columns.resize(rich.columns.size());
      for (std::size_t k = 0; k < rich.columns.size(); ++k) {
        data.columns[k].name = rich.columns[k].name;
        data.columns[k].role = rich.columns[k].role;
        data.columns[k].values.push_back(rich.columns[k].values[i]);
      }
    }
  }
  return {std::move(data), {}, {}};
}

Record poor_record() { return {two_stretches(384, 192, 5000.0, 0.0), {}, {}}; }

Record one_speed_record() {
  Record record{two_stretches(408, 24, 0.0, 5000.0), {}, {}};
  Column load{"load_W", Role::load, find_column(record.inputs, "speed_rpm")->values};
  for (double& value : load.values) value *= 0.3;
  record.inputs.columns.push_back(std::move(load));
  return record;
}

Record with_constant_room(Record record) {
  for (Column& column : record.inputs.columns) {
    if (column.role == Role::ambient) std::fill(column.values.begin(), column.values.end(), column.values.front());
  }
  return record;
}

Record session_record(Random& random) {
  const Series rich = rich_record().inputs;
  const auto below = [&](double count) { return std::floor(simulation::uniform(random) * count); };
  const double tests = 15.0 + below(6.0), apart_s = below(2.0) < 1.0 ? 480.0 : 1200.0;
  // The last cycle of the record is too short for tests that are 20 min apart.
  const double start_s = kFirst_s + kCycle_s * below(apart_s > 600.0 ? 3.0 : 4.0);
  const double from_s = std::max(0.0, start_s - 1800.0 * simulation::uniform(random));
  const auto row_at = [&](double time_s) {
    const auto at = std::lower_bound(rich.time_s.begin(), rich.time_s.end(), time_s);
    return static_cast<std::size_t>(at - rich.time_s.begin());
  };
  const std::size_t first = row_at(from_s);
  const std::size_t end = std::min(rich.time_s.size(), row_at(rich.time_s[first] + (tests - 1.0) * apart_s) + 1);
  Record record{cut(rich, first, end), {}, {}};
  double next_s = 0.0;
  for (std::size_t row = 0; row < record.inputs.time_s.size(); ++row) {
    if (record.inputs.time_s[row] < next_s) continue;
    record.readings.push_back(row);
    record.sigma_um.push_back(0.2 + 0.2 * simulation::uniform(random));
    next_s += apart_s;
  }
  return record;
}

Column logged_again(const Column& column) {
  Column again = column;
  again.name.insert(column.name.rfind('_'), "_2");
  return again;
}

std::vector<Column> fake_temperatures(const std::vector<double>& time_s, std::size_t count, Random& random) {
  std::vector<Column> fakes;
  for (std::size_t k = 0; k < count; ++k) {
    Column fake{fmt::format("{}{}_degC", kFake, k + 1), Role::structure, std::vector<double>(time_s.size(), 0.0)};
    for (int part = 0; part < 2; ++part) {
      const double follows_s = 600.0 * std::pow(20.0, simulation::uniform(random));  // 10 min to 3.3 h
      double walk = 0.0, state = 0.0;
      for (std::size_t i = 1; i < time_s.size(); ++i) {
        const double step_s = time_s[i] - time_s[i - 1];
        walk += std::sqrt(step_s) * simulation::normal(random);
        state += (walk - state) * -std::expm1(-step_s / follows_s);
        fake.values[i] += state;
      }
    }
    double mean = 0.0, square = 0.0;
    for (const double value : fake.values) mean += value / static_cast<double>(time_s.size());
    for (const double value : fake.values) square += (value - mean) * (value - mean);
    const double to_K = 1.0 / std::sqrt(square / static_cast<double>(time_s.size()));
    for (double& value : fake.values) value = 22.0 + to_K * (value - mean) + 0.02 * simulation::normal(random);
    fakes.push_back(std::move(fake));
  }
  return fakes;
}

bool is_fake(const std::string& column) { return column.starts_with(kFake); }

Series measured_record(std::size_t each) {
  std::vector<std::pair<std::string, std::string>> kept = kSignals;
  for (const char* target : {"ch1_um", "ch3_um", "ch5_um"}) kept.emplace_back(target, target);
  return means(each, kept);
}

}  // namespace ballbar::study
