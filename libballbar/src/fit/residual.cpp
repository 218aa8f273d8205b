#include "ballbar/fit/residual.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/number_text.hpp"
#include "ballbar/series/runs.hpp"
#include "ballbar/units.hpp"
#include "fit/inlier_rows.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewest = 3;
constexpr std::size_t kParts = 5;  // of a signal's values

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
    if (rows.size() < kFewest) return;
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

// Four digits, or as many as a tenth of the range needs, because a clock may have started long before. In minutes, of
// short records in seconds, of long ones in hours or days.
std::string printed_time(double time_s, double whole_s) {
  constexpr double kHour_s = 3600.0, kDay_s = 86400.0;
  if (whole_s >= 4.0 * kDay_s) {
    const bool in_h = whole_s < 20.0 * kDay_s;
    return fmt::format("{:.12g} {}", std::round(10.0 * time_s / (in_h ? kHour_s : kDay_s)) / 10.0, in_h ? "h" : "d");
  }
  const bool in_s = whole_s < 600.0;
  const double time = in_s ? time_s : min_from_s(time_s);
  const std::string number =
      std::abs(time) < 1000.0 ? fmt::format("{:.4g}", time) : fmt::format("{:.12g}", std::round(10.0 * time) / 10.0);
  return fmt::format("{} {}", number, in_s ? "s" : "min");
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

// "-3.1 ± 0.4": two digits of sigma where its first is 1, else one.
std::string with_sigma(double value, double sigma) {
  if (!(sigma > 0.0) || !std::isfinite(sigma)) return fmt::format("{:.3g}", value);
  const double first = sigma / std::pow(10.0, std::floor(std::log10(sigma)));
  const int decimals = decimals_showing(first < 1.95 ? 2 : 1, sigma);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, sigma, decimals);
}

// Three digits, whole micrometres above 1000, exponents for absurd values.
std::string digits(double value_um) {
  return value_um < 999.5 || value_um >= 1e9 ? fmt::format("{:.3g}", value_um) : fmt::format("{:.0f}", value_um);
}

// What an engineer reads first; how the noise is known comes after that.
std::string of_noise(const Fit& fit) {
  const double noise_um = fit.floor.rms_um;
  const std::string error = fmt::format("Remaining error {} um RMS", digits(fit.rmse_um));
  if (!(noise_um > 0.0) || fit.floor.source.empty()) return error + ". The noise is not known.";
  const std::string noise = fmt::format("The noise is {} um ({}).", digits(noise_um), fit.floor.source);
  const double ratio = fit.rmse_um / noise_um;
  if (ratio < 1.05) return fmt::format("{}, about the noise. {}", error, noise);
  const std::string times =
      ratio < 1e6 ? fmt::format("{:.{}f}", ratio, ratio < 2.0 ? 2 : 1) : fmt::format("{:.1e}", ratio);
  return fmt::format("{}, {} times the noise. {}", error, times, noise);
}

std::string place_of(const Misfit& group) {
  const auto range = [&] {
    if (group.from == group.to) return "at " + group.from;
    const std::size_t unit = group.from.rfind(' '), other = group.to.rfind(' ');
    const bool same =
        unit != std::string::npos && other != std::string::npos && group.from.substr(unit) == group.to.substr(other);
    return fmt::format("from {} to {}", same ? group.from.substr(0, unit) : group.from, group.to);
  };
  if (group.what == "time") return range();
  if (group.what == "regime") {
    if (group.from == name_of(Regime::after_change)) return group.from;
    if (group.from == name_of(Regime::standstill)) return "at standstill";
    return group.from == name_of(Regime::steady) ? "at steady speed" : "while " + group.from;
  }
  return fmt::format("where {} is {}", group.what, range());
}

// The group whose share of the misfit exceeds its share of the readings most, if worth a sentence; nullptr: none.
const Misfit* worst_of(const Fit& fit, const std::vector<Misfit>& where) {
  constexpr double kWorthIt = 0.1;
  const auto n = static_cast<double>(fit.residual_um.size());
  const auto above = [&](const Misfit& group) { return group.share - static_cast<double>(group.n) / n; };
  const Misfit* worst = nullptr;
  for (const Misfit& group : where) {
    if (worst == nullptr || above(group) > above(*worst)) worst = &group;
  }
  return worst == nullptr || above(*worst) < kWorthIt ? nullptr : worst;
}

std::string of_place(const Fit& fit, const std::vector<Misfit>& where) {
  const Misfit* worst = worst_of(fit, where);
  if (worst == nullptr) return "The error is spread evenly over the data.";
  return fmt::format("The model fails most {}: {:.0f} % of the squared error in {:.0f} % of the readings, bias {} um.",
                     place_of(*worst), 100.0 * worst->share,
                     100.0 * static_cast<double>(worst->n) / static_cast<double>(fit.residual_um.size()),
                     with_sigma(worst->bias_um, worst->bias_sigma_um));
}

std::string duration(double time_s) {
  if (time_s < 90.0) return fmt::format("{:.2g} s", time_s);
  const double time_min = min_from_s(time_s);
  return time_min < 100.0 ? fmt::format("{:.2g} min", time_min) : fmt::format("{:.1f} h", time_min / 60.0);
}

std::string of_rest(const Fit& fit, const Whiteness& whiteness) {
  constexpr std::size_t kFewestForWhiteness = 16;
  constexpr double kNotNoise = 0.01, kSlow = 0.1;  // of the variance
  const std::size_t n = fit.residual_um.size();
  if (n < kFewestForWhiteness) return fmt::format("{} readings are too few to tell whether the residual is random.", n);
  const std::string p = p_equals_text(whiteness.p);
  if (whiteness.p < kNotNoise) {
    const Noise noise = fit.noise.correlated_um > 0.0 ? fit.noise : noise_of(fit.time_s, fit.residual_um, fit.sigma_um);
    if (!(noise.correlated_um > 0.0)) return fmt::format("The residual is not noise ({}).", p);
    return fmt::format("The residual is not noise ({}): something that changes slowly (about {}) is missing.", p,
                       duration(noise.correlation_time_s));
  }
  const double slow_um2 = fit.noise.correlated_um * fit.noise.correlated_um;
  const double white_um2 = fit.noise.white_um * fit.noise.white_um;
  if (slow_um2 > kSlow * (slow_um2 + white_um2)) {
    return fmt::format("The residual changes slowly (about {}): slow noise or a missing effect ({}).",
                       duration(fit.noise.correlation_time_s), p);
  }
  return fmt::format("The residual looks like noise ({}).", p);
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
  return !fit.floor.source.empty() && fit.rmse_um <= 1.2 * fit.floor.rms_um && whiteness.p >= 0.01;
}

std::string worst_place(const Fit& fit, const std::vector<Misfit>& where) {
  if (!fit.discounted.empty()) return worst_place(inliers_of(fit), where);
  const Misfit* worst = worst_of(fit, where);
  return worst == nullptr ? "" : place_of(*worst);
}

std::vector<std::string> sentences(const Fit& fit, const std::vector<Misfit>& where, const Whiteness& whiteness) {
  if (!fit.discounted.empty()) return sentences(inliers_of(fit), where, whiteness);
  return {of_noise(fit), of_place(fit, where), of_rest(fit, whiteness)};
}

}  // namespace ballbar
