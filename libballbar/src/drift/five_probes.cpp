#include "ballbar/drift/five_probes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "ballbar/error.hpp"
#include "ballbar/message_catalogue.hpp"
#include "drift/name_words.hpp"
#include "drift/row_scatter.hpp"
#include "drift/smooth_curve.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kHour_s = 3600.0;
constexpr const char* kResolution = "probe resolution";
constexpr const char* kScatter = "probe scatter";

using Columns = std::array<const Column*, 5>;  // as kProbes; nullptr: no such probe

FiveProbe stated(const Series& series) { return series.five_probe.value_or(FiveProbe{}); }

// The probe's column, in capitals or not; else the only one in um with that word in its name.
const Column* find_probe(const Series& series, std::string_view name) {
  if (const Column* column = find_column(series, name)) return column;
  const auto found = std::find_if(series.columns.begin(), series.columns.end(),
                                  [&](const Column& one) { return is_same_but_for_capitals(one.name, name); });
  if (found != series.columns.end()) return &*found;
  const std::string_view word = name.substr(0, name.find('_'));  // X1 of X1_um
  const auto is_probe = [&](const Column& one) {
    return unit_of(one.name) == "um" && (has_word(one.name, word) || (word == "Z" && has_word(one.name, "Z1")));
  };
  const auto with_word = std::find_if(series.columns.begin(), series.columns.end(), is_probe);
  const bool is_one = with_word != series.columns.end() &&
                      std::find_if(with_word + 1, series.columns.end(), is_probe) == series.columns.end();
  return is_one ? &*with_word : nullptr;
}

Columns probes_of(const Series& series, const FiveProbe& probe) {
  Columns columns{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i] = find_probe(series, probe.columns[i]);
    if (columns[i] == nullptr) continue;
    const std::vector<double>& readings = columns[i]->values;
    if (!readings.empty() &&
        std::all_of(readings.begin(), readings.end(), [](double value) { return std::isnan(value); })) {
      columns[i] = nullptr;  // a dead probe is none
      continue;
    }
    for (std::size_t before = 0; before < i; ++before) {
      if (columns[before] == columns[i]) {
        throw Error(fmt::format("expected a column of its own for each probe, found {} for {} and {}.",
                                probe.columns[i], kProbes[before], kProbes[i]));
      }
    }
    if (unit_of(columns[i]->name) != "um") {
      throw Error(
          fmt::format("expected readings in um for the probe {}, found the column {}.", kProbes[i], columns[i]->name));
    }
  }
  return columns;
}

// The row nearest to reference_s in which all probes have a reading.
std::size_t reference_row(const Series& series, const Columns& columns, std::optional<double> reference_s) {
  const double first_s = series.time_s.empty() ? 0.0 : series.time_s.front();
  const double wanted_s = reference_s.value_or(first_s);
  std::optional<std::size_t> best;
  for (std::size_t row = 0; row < series.time_s.size(); ++row) {
    const double away_s = std::abs(series.time_s[row] - wanted_s);
    if (best && away_s >= std::abs(series.time_s[*best] - wanted_s)) continue;
    const bool whole = std::all_of(columns.begin(), columns.end(), [&](const Column* column) {
      return column == nullptr || !std::isnan(column->values[row]);
    });
    if (whole) best = row;
  }
  if (!best) throw Error("expected a row in which every probe has a reading, as the reference, found none.");
  return *best;
}

// One axis as a weighted sum of probes; the pair whose tilt moves it where s is not known well.
struct Combination {
  const char* name;
  const char* unit;
  std::vector<std::pair<std::size_t, double>> parts;  // probe and weight
  double tilt_per_mm = 0.0;                           // d(value)/ds is this times the difference of the pair; 0: none
  std::size_t pair_first = 0;                         // the pair's probe in plane 1; the next one is in plane 2
};

class Reduction {
 public:
  Reduction(const Series& series, const FiveProbe& probe, const Columns& columns, std::size_t reference,
            const FivePointOptions& options, const FivePoint& found)
      : series_(series), probe_(probe), columns_(columns), reference_(reference), options_(options), found_(found) {}

  DriftAxis axis(const Combination& combination) const {
    DriftAxis axis{combination.name, combination.unit, {}, {}};
    const std::size_t rows = series_.time_s.size();
    axis.value.assign(rows, 0.0);
    for (const auto& [probe, weight] : combination.parts) {
      const std::vector<double>& reading = columns_[probe]->values;
      const double zero = reading[reference_];
      for (std::size_t row = 0; row < rows; ++row) axis.value[row] += weight * (reading[row] - zero);
    }
    add_constant(axis, kResolution, resolution_variance(combination));
    add_constant(axis, kScatter, scatter_variance(combination));
    if (probe_.linearity_percent) axis.budget.push_back({"probe linearity", linearity(combination), true});
    if (options_.from_plane_1_sigma_mm > 0.0 && combination.tilt_per_mm != 0.0) {
      axis.budget.push_back({"place of the ball", place(combination), true});
    }
    return axis;
  }

 private:
  // The same in every row but the reference's.
  void add_constant(DriftAxis& axis, const char* source, std::optional<double> variance) const {
    if (!variance) return;
    std::vector<double> sigma(series_.time_s.size(), std::sqrt(*variance));
    sigma[reference_] = 0.0;
    axis.budget.push_back({source, std::move(sigma), false, true});
  }

  std::optional<double> resolution_variance(const Combination& combination) const {
    if (!probe_.resolution_um) return std::nullopt;
    double weights = 0.0;
    for (const auto& [probe, weight] : combination.parts) weights += weight * weight;
    return 2.0 * weights * *probe_.resolution_um * *probe_.resolution_um / 12.0;
  }

  std::optional<double> scatter_variance(const Combination& combination) const {
    double variance = 0.0;
    const double step_um = probe_.resolution_um.value_or(0.0);
    for (const auto& [probe, weight] : combination.parts) {
      if (!found_.scatter_um[probe]) return std::nullopt;
      const double scatter_um = *found_.scatter_um[probe];
      variance += 2.0 * weight * weight * std::max(0.0, scatter_um * scatter_um - step_um * step_um / 12.0);
    }
    return variance;
  }

  std::vector<double> linearity(const Combination& combination) const {
    std::vector<double> sigma(series_.time_s.size(), 0.0);
    const double limit = *probe_.linearity_percent / 100.0;
    for (std::size_t row = 0; row < sigma.size(); ++row) {
      double variance = 0.0;
      for (const auto& [probe, weight] : combination.parts) {
        const std::vector<double>& reading = columns_[probe]->values;
        const double error = weight * limit * (reading[row] - reading[reference_]);
        variance += error * error / 3.0;
      }
      sigma[row] = std::sqrt(variance);
    }
    return sigma;
  }

  std::vector<double> place(const Combination& combination) const {
    std::vector<double> sigma(series_.time_s.size(), 0.0);
    const std::vector<double>& first = columns_[combination.pair_first]->values;
    const std::vector<double>& second = columns_[combination.pair_first + 1]->values;
    for (std::size_t row = 0; row < sigma.size(); ++row) {
      const double pair = second[row] - second[reference_] - (first[row] - first[reference_]);
      sigma[row] = std::abs(combination.tilt_per_mm * pair) * options_.from_plane_1_sigma_mm;
    }
    return sigma;
  }

  const Series& series_;
  const FiveProbe& probe_;
  const Columns& columns_;
  std::size_t reference_;
  const FivePointOptions& options_;
  const FivePoint& found_;
};

// The drift of a pair of probes at s if known, else a remark on the reason.
std::optional<Combination> drift_of_pair(const char* name, std::size_t first, const Columns& columns,
                                         const FiveProbe& probe, double s_mm, std::vector<Paragraph>& remarks) {
  const std::size_t second = first + 1;
  const bool has_first = columns[first] != nullptr;
  const bool has_second = columns[second] != nullptr;
  if (!has_first && !has_second) {
    remarks.emplace_back(messages::probes_neither(name, kProbes[first], kProbes[second]));
    return std::nullopt;
  }
  const double tilt_per_mm = has_first && has_second && probe.spacing_mm ? 1.0 / *probe.spacing_mm : 0.0;
  if (s_mm == 0.0 && has_first) return Combination{name, "um", {{first, 1.0}}, tilt_per_mm, first};
  if (probe.spacing_mm && s_mm == *probe.spacing_mm && has_second) {
    return Combination{name, "um", {{second, 1.0}}, tilt_per_mm, first};
  }
  if (has_first && has_second) {
    const double share = s_mm / *probe.spacing_mm;
    return Combination{name, "um", {{first, 1.0 - share}, {second, share}}, tilt_per_mm, first};
  }
  const Message there = has_first          ? messages::probes_at_plane_1()
                        : probe.spacing_mm ? messages::probes_at_plane_2(fmt::format("{:g}", *probe.spacing_mm))
                                           : messages::probes_at_plane_2_somewhere();
  remarks.emplace_back(
      messages::probes_not_there(name, fmt::format("{:g}", s_mm), kProbes[has_first ? second : first], there));
  return std::nullopt;
}

}  // namespace

bool is_five_probe(const Series& series) {
  const FiveProbe probe = stated(series);
  // Z alone may be a drift along Z.
  return series.five_probe.has_value() ||
         std::any_of(probe.columns.begin(), probe.columns.begin() + 4,
                     [&](const std::string& name) { return find_probe(series, name) != nullptr; });
}

FivePoint five_point(const Series& series, const FivePointOptions& options) {
  const FiveProbe probe = stated(series);
  const Columns columns = probes_of(series, probe);
  if (std::all_of(columns.begin(), columns.end(), [](const Column* column) { return column == nullptr; })) {
    throw Error(fmt::format("expected a column of a probe, one of {}, found none.", fmt::join(probe.columns, ", ")));
  }
  if (options.from_plane_1_mm != 0.0 && !probe.spacing_mm) {
    throw Error(fmt::format(
        "expected the spacing of the probes' planes, which a drift {:g} mm from plane 1 needs, found none: state "
        "spacing_mm under [five_probe].",
        options.from_plane_1_mm));
  }
  const std::size_t reference = reference_row(series, columns, options.reference_s);
  FivePoint found;
  MeasuredDrift& drift = found.drift;
  drift.method = "five_probe";
  drift.what = probe.spacing_mm ? fmt::format("five probes, {:g} mm from plane 1", options.from_plane_1_mm)
                                : "five probes, at plane 1";
  drift.reference_s = series.time_s[reference];
  drift.time_s = series.time_s;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] != nullptr) found.scatter_um[i] = row_scatter(series.time_s, columns[i]->values);
  }
  const Reduction reduction(series, probe, columns, reference, options, found);
  struct Pair {
    const char *name, *tilt;
    std::size_t first;
  };
  for (const Pair& pair : {Pair{"x", "B", 0}, Pair{"y", "A", 2}}) {
    const auto combination =
        drift_of_pair(pair.name, pair.first, columns, probe, options.from_plane_1_mm, drift.remarks);
    if (!combination) continue;
    drift.axes.push_back(reduction.axis(*combination));
    if (options.from_plane_1_sigma_mm > 0.0 && combination->tilt_per_mm == 0.0) {
      drift.remarks.emplace_back(messages::probes_ball_place(pair.name, pair.tilt));
    }
  }
  if (columns[4] != nullptr) {
    drift.axes.push_back(reduction.axis({"z", "um", {{4, 1.0}}}));
  } else {
    drift.remarks.emplace_back(messages::probes_no_z());
  }
  struct Tilt {
    const char *name, *difference, *about;
    std::size_t first;
    double sign;
  };
  for (const Tilt& tilt : {Tilt{"tilt_a", "y2_minus_y1", "A", 2, -1.0}, Tilt{"tilt_b", "x2_minus_x1", "B", 0, 1.0}}) {
    const std::size_t second = tilt.first + 1;
    if (columns[tilt.first] == nullptr || columns[second] == nullptr) {
      const std::size_t missing = columns[tilt.first] == nullptr ? tilt.first : second;
      drift.remarks.emplace_back(messages::probes_no_tilt(tilt.about, kProbes[missing]));
    } else if (probe.spacing_mm) {
      const double urad_per_um = 1e3 / *probe.spacing_mm;
      drift.axes.push_back(reduction.axis(
          {tilt.name, "urad", {{tilt.first, -tilt.sign * urad_per_um}, {second, tilt.sign * urad_per_um}}}));
    } else {
      drift.remarks.emplace_back(messages::probes_no_spacing(tilt.about, kProbes[second], kProbes[tilt.first]));
      drift.axes.push_back(reduction.axis({tilt.difference, "um", {{tilt.first, -1.0}, {second, 1.0}}}));
    }
  }
  std::vector<std::string_view> unknown;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] != nullptr && !found.scatter_um[i]) unknown.push_back(kProbes[i]);
  }
  if (!unknown.empty() && series.time_s.size() < kRowsForScatter) {
    drift.remarks.emplace_back(messages::probes_scatter_rows(kRowsForScatter, series.time_s.size()));
  } else if (!unknown.empty()) {
    drift.remarks.emplace_back(
        messages::probes_scatter_gaps(listed({unknown.begin(), unknown.end()}), kRowsForScatter - 2));
  }
  if (!probe.resolution_um || !probe.linearity_percent) {
    drift.remarks.emplace_back(probe.resolution_um       ? messages::probes_no_linearity()
                               : probe.linearity_percent ? messages::probes_no_resolution()
                                                         : messages::probes_no_resolution_and_linearity());
  }
  return found;
}

DriftRange range_of(const DriftAxis& axis, const std::vector<double>& time_s, std::size_t begin, std::size_t end) {
  struct Extremes {
    std::optional<std::size_t> low, high;
  };
  Extremes first, after, last_hour, total;
  const double last_hour_s =
      end > begin && time_s[end - 1] - time_s[begin] > kHour_s ? time_s[end - 1] - kHour_s : kUnknown;
  std::optional<std::size_t> start, last;
  const auto take = [&](Extremes& extremes, std::size_t row) {
    if (!extremes.low || axis.value[row] < axis.value[*extremes.low]) extremes.low = row;
    if (!extremes.high || axis.value[row] > axis.value[*extremes.high]) extremes.high = row;
  };
  for (std::size_t row = begin; row < end; ++row) {
    if (std::isnan(axis.value[row])) continue;
    if (!start) start = row;
    last = row;
    take(total, row);
    take(time_s[row] - time_s[begin] <= kHour_s ? first : after, row);
    if (time_s[row] >= last_hour_s) take(last_hour, row);
  }
  // Each row's sigma holds the reference's share, which cancels between two rows; added all the same.
  const auto change = [&](std::optional<std::size_t> from, std::optional<std::size_t> to) -> std::optional<Estimate> {
    if (!from || !to) return std::nullopt;
    const double sigma = *from == *to ? 0.0 : std::hypot(sigma_of(axis, *from), sigma_of(axis, *to));
    return Estimate{axis.value[*to] - axis.value[*from], sigma};
  };
  DriftRange range{change(first.low, first.high), change(after.low, after.high), change(last_hour.low, last_hour.high),
                   change(total.low, total.high), change(start, last),           axis.unit};
  std::vector<double> times, values;
  std::size_t in_first = 0, in_last = 0;
  for (std::size_t row = begin; row < end; ++row) {
    if (std::isnan(axis.value[row])) continue;
    times.push_back(time_s[row]);
    values.push_back(axis.value[row]);
    if (time_s[row] - time_s[begin] <= kHour_s) ++in_first;
    if (time_s[row] >= last_hour_s) ++in_last;
  }
  if (values.size() < kFewestForCurve) return range;
  const std::size_t block = average_blocks(times, values, kMostOfCurve);
  in_first = std::min(in_first / block, values.size());
  in_last = std::min(in_last / block, values.size());
  // Of the curve through the rows, with what is stated beside the noise.
  std::vector<std::pair<std::size_t, std::size_t>> windows{{0, values.size()}};
  std::vector<std::optional<Estimate>*> of{&range.total};
  std::vector<Extremes> rows{total};
  const auto add = [&](std::optional<Estimate>& one, std::size_t from, std::size_t to, const Extremes& extremes) {
    if (to < from + 2) return;
    windows.emplace_back(from, to);
    of.push_back(&one);
    rows.push_back(extremes);
  };
  add(range.first_60_min, 0, in_first, first);
  add(range.after_60_min, in_first, values.size(), after);
  if (range.last_60_min) add(range.last_60_min, values.size() - in_last, values.size(), last_hour);
  std::vector<Estimate> smooth = smooth_ranges(times, values, windows);
  for (std::size_t k = 1; k < smooth.size(); ++k) {  // no part is larger than the whole
    if (smooth[k].value_um > smooth[0].value_um) smooth[0] = smooth[k];
  }
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    double square = smooth[k].sigma_um * smooth[k].sigma_um;
    for (const Contribution& one : axis.budget) {
      if (one.noise) continue;
      for (const std::size_t row : {*rows[k].low, *rows[k].high})
        if (std::isfinite(one.sigma[row])) square += one.sigma[row] * one.sigma[row];
    }
    const bool is_stated = !std::isnan(of[k]->value().sigma_um);
    *of[k] = Estimate{smooth[k].value_um, is_stated ? std::sqrt(square) : kUnknown};
  }
  return range;
}

}  // namespace ballbar
