#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/series/series.hpp"
#include "ballbar/units.hpp"
#include "fit/inlier_rows.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kSmallestGroup = 3;
constexpr double kNotNoise = 0.01;  // p of a white residual
constexpr std::size_t kParts = 5;   // of a signal's values

// Rows of the fit that belong together.
class Groups {
 public:
  explicit Groups(const Fit& fit) : fit_(fit) {
    for (const double r : fit.residual_um) squares_ += r * r;
  }

  // Those of the fit's rows, by their number from 0, of which `is_in` says so.
  template <class IsIn>
  void add(const std::string& what, const std::string& from, const std::string& to, IsIn is_in) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < fit_.row.size(); ++i) {
      if (is_in(i)) rows.push_back(i);
    }
    if (rows.size() < kSmallestGroup) return;
    Misfit misfit{what, from, to, rows.size()};
    std::vector<double> time_s, sigma_um;
    double squares = 0.0;
    for (const std::size_t row : rows) {
      const double r = fit_.residual_um[row];
      misfit.bias_um += r / static_cast<double>(misfit.n);
      squares += r * r;
      time_s.push_back(fit_.time_s[row]);
      if (!fit_.sigma_um.empty()) sigma_um.push_back(fit_.sigma_um[row]);
    }
    misfit.bias_sigma_um = sigma_of_mean(fit_.noise, time_s, sigma_um);
    misfit.rmse_um = std::sqrt(squares / static_cast<double>(misfit.n));
    misfit.share = squares_ > 0.0 ? squares / squares_ : 0.0;
    misfits_.push_back(std::move(misfit));
  }

  std::vector<Misfit> taken() && { return std::move(misfits_); }

 private:
  const Fit& fit_;
  double squares_ = 0.0;
  std::vector<Misfit> misfits_;
};

void by_regime(const Fit& fit, const Series& data, Groups& groups) {
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  if (speed == data.columns.end()) return;
  const std::vector<Regime> regime = regimes(data.time_s, *speed);
  if (regime.empty()) return;
  for (const Regime each :
       {Regime::standstill, Regime::after_change, Regime::warming, Regime::steady, Regime::cooling}) {
    const std::string name(name_of(each));
    groups.add("regime", name, name, [&](std::size_t i) { return regime[fit.row[i]] == each; });
  }
}

// In seconds below 10 min of record, in minutes below 6 h, in days from 20 d, else in hours; to a hundredth, from 100
// on to a tenth.
std::string printed_time(double time_s, double whole_s) {
  constexpr double kMinute_s = 60.0, kHour_s = 3600.0, kDay_s = 86400.0;
  const auto in = [&](double unit_s, const char* unit) {
    const double time = time_s / unit_s, digits = std::abs(time) < 100.0 ? 100.0 : 10.0;
    return fmt::format("{:.12g} {}", std::round(digits * time) / digits, unit);
  };
  if (whole_s < 10.0 * kMinute_s) return in(1.0, "s");
  if (whole_s < 6.0 * kHour_s) return in(kMinute_s, "min");
  return whole_s < 20.0 * kDay_s ? in(kHour_s, "h") : in(kDay_s, "d");
}

void by_run(const Fit& fit, const Series& data, const std::vector<RowRange>& runs, Groups& groups) {
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const std::string name = run < data.runs.size() ? data.runs[run].name : std::string();
    const std::string number = fmt::format("{}{}{}", run + 1, name.empty() ? "" : " ", name);
    groups.add("run", number, number,
               [&](std::size_t i) { return fit.row[i] >= runs[run].begin && fit.row[i] < runs[run].end; });
  }
}

void by_time(const Fit& fit, const Series& data, Groups& groups) {
  const std::vector<RowRange> runs = runs_of(data.time_s);
  if (runs.size() > 1 && find_column(data, "angle_rad") == nullptr) return by_run(fit, data, runs, groups);
  constexpr std::size_t kTenths = 10;
  const double begin_s = fit.time_s.front(), whole_s = fit.time_s.back() - begin_s;
  const auto at = [&](std::size_t tenth) { return begin_s + whole_s * static_cast<double>(tenth) / kTenths; };
  for (std::size_t tenth = 0; tenth < kTenths; ++tenth) {
    groups.add("time", printed_time(at(tenth), whole_s), printed_time(at(tenth + 1), whole_s), [&](std::size_t i) {
      const bool last = tenth + 1 == kTenths;
      return fit.time_s[i] >= at(tenth) && (last || fit.time_s[i] < at(tenth + 1));
    });
  }
}

void by_signal(const Fit& fit, const Column& column, Groups& groups) {
  const std::string unit(unit_of(column.name));
  int digits = 4;
  const auto rounded = [&](double value) { return std::stod(fmt::format("{:.{}g}", value, digits)); };
  const auto printed = [&](double value) {  // 12000, not 1.2e+04
    return fmt::format("{:.12g}{}{}", rounded(value), unit.empty() ? "" : " ", unit);
  };
  std::vector<double> sorted;
  for (const std::size_t row : fit.row) {
    if (!std::isnan(column.values[row])) sorted.push_back(column.values[row]);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> bounds = sorted;  // group k: [bounds k, bounds k + 1), the last one with its end
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  if (bounds.size() < 2) return;
  const bool by_value = bounds.size() <= kParts;
  if (!by_value) {
    bounds.clear();
    for (std::size_t k = 0; k <= kParts; ++k) bounds.push_back(sorted[(sorted.size() - 1) * k / kParts]);
    bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  }
  const auto looks_same = [&](double low, double high) { return rounded(low) == rounded(high); };
  while (digits < 10 && std::adjacent_find(bounds.begin(), bounds.end(), looks_same) != bounds.end()) ++digits;
  for (std::size_t k = 0; k + (by_value ? 0 : 1) < bounds.size(); ++k) {
    const double low = bounds[k], high = by_value ? low : bounds[k + 1];
    const bool end = by_value || k + 2 == bounds.size();
    groups.add(column.name, printed(low), printed(high), [&](std::size_t i) {
      const double value = column.values[fit.row[i]];
      return value >= low && (value < high || (end && value == high));
    });
  }
}

void by_angle(const Fit& fit, const Series& data, const Column& angle, Groups& groups) {
  const Column* direction = find_column(data, "direction");
  const std::vector<double> ways = direction == nullptr ? std::vector<double>{0.0} : std::vector<double>{1.0, -1.0};
  for (const bool is_quadrant : {false, true}) {
    const char* const what = is_quadrant ? "quadrant" : "angle";
    const int width_deg = is_quadrant ? 90 : 30;
    for (const double way : ways) {
      const std::string name = way == 0.0 ? std::string(what) : fmt::format("{}, {}", what, way > 0.0 ? "CCW" : "CW");
      for (int low = 0; low < 360; low += width_deg) {
        groups.add(name, fmt::format("{} deg", low), fmt::format("{} deg", low + width_deg), [&](std::size_t i) {
          const std::size_t row = fit.row[i];
          if (way != 0.0 && direction->values[row] != way) return false;
          const double deg = deg_from_rad(angle.values[row]);
          const double turned = deg - 360.0 * std::floor(deg / 360.0);
          return turned >= low && turned < low + width_deg;
        });
      }
    }
  }
}

}  // namespace

std::vector<Misfit> where_it_fails(const Fit& fit, const Series& data) {
  if (fit.residual_um.empty()) return {};
  if (!fit.discounted.empty()) return where_it_fails(inliers_of(fit), data);
  Groups groups(fit);
  by_regime(fit, data, groups);
  by_time(fit, data, groups);
  if (const Column* angle = find_column(data, "angle_rad")) {
    by_angle(fit, data, *angle, groups);
  } else {
    for (const Column& column : data.columns) {
      if (column.role != Role::measured && column.role != Role::event) by_signal(fit, column, groups);
    }
  }
  return std::move(groups).taken();
}

bool is_adequate(const Fit& fit, const Whiteness& whiteness) {
  return !fit.floor.source.empty() && fit.rmse_um <= 1.2 * fit.floor.rms_um && whiteness.p >= kNotNoise;
}

std::optional<Misfit> worst_place(const Fit& fit, const std::vector<Misfit>& where) {
  constexpr double kWorthIt = 0.1;
  const std::size_t inliers = fit.residual_um.size() - fit.discounted.size();
  const auto n = static_cast<double>(inliers);
  const auto above = [&](const Misfit& group) { return group.share - static_cast<double>(group.n) / n; };
  const auto worst = std::max_element(where.begin(), where.end(),
                                      [&](const Misfit& a, const Misfit& b) { return above(a) < above(b); });
  return worst == where.end() || above(*worst) < kWorthIt ? std::nullopt : std::optional(*worst);
}

ResidualNature residual_nature(const Fit& fit, const Whiteness& whiteness) {
  constexpr std::size_t kFewestForWhiteness = 16;
  constexpr double kSlow = 0.1;  // of the variance
  if (!fit.discounted.empty()) return residual_nature(inliers_of(fit), whiteness);
  if (fit.residual_um.size() < kFewestForWhiteness) return {ResidualKind::too_few, 0.0};
  if (whiteness.p < kNotNoise) {
    const Noise noise = fit.noise.correlated_um > 0.0 ? fit.noise : noise_of(fit.time_s, fit.residual_um, fit.sigma_um);
    return noise.correlated_um > 0.0 ? ResidualNature{ResidualKind::slow_not_noise, noise.correlation_time_s}
                                     : ResidualNature{ResidualKind::not_noise, 0.0};
  }
  const double slow_um2 = fit.noise.correlated_um * fit.noise.correlated_um;
  const double white_um2 = fit.noise.white_um * fit.noise.white_um;
  if (slow_um2 > kSlow * (slow_um2 + white_um2)) return {ResidualKind::slow, fit.noise.correlation_time_s};
  return {ResidualKind::noise, 0.0};
}

}  // namespace ballbar
