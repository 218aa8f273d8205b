#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/drift/drift.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/series/far_readings.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "drift/drift_methods.hpp"
#include "drift/row_scatter.hpp"
#include "numerics/not_finite.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kSigma = "_sigma";
constexpr double kLargestDrift_um = 1000.0;

// Bar's temperature of a test, from the first of its recordings that states one.
std::optional<double> bar_temperature_degC(const SessionTest& test) {
  for (const auto* recording : {&test.axial, &test.rotation, &test.c_arc, &test.a_arc}) {
    if (*recording && (*recording)->bar_temperature_degC) return (*recording)->bar_temperature_degC;
  }
  for (const Recording& circle : test.circles) {
    if (circle.bar_temperature_degC) return circle.bar_temperature_degC;
  }
  return std::nullopt;
}

// Standard uncertainty of the bar's growth since the reference, um; empty with a remark where it is not known.
std::vector<double> bar_growth_sigma_um(const DriftSeries& drift, const Session& session,
                                        std::vector<Paragraph>& remarks) {
  if (!session.bar_expansion_ppm_per_K) {
    remarks.emplace_back(messages::bar_growth_no_expansion());
    return {};
  }
  std::optional<double> reference_degC;
  for (std::size_t i = 0; i < drift.points.size(); ++i) {
    if (drift.points[i].time_s == drift.reference_s) reference_degC = bar_temperature_degC(session.tests[i]);
  }
  std::vector<double> sigma_um;
  bool known = reference_degC.has_value();
  for (const SessionTest& test : session.tests) {
    const std::optional<double> now_degC = bar_temperature_degC(test);
    known = known && now_degC.has_value();
    if (!known) break;
    const double growth_um = *session.bar_expansion_ppm_per_K * 1e-6 * um_from_mm(session.nominal_length_mm) *
                             std::abs(*now_degC - *reference_degC);
    sigma_um.push_back(growth_um / std::sqrt(3.0));
  }
  if (known) return sigma_um;
  remarks.emplace_back(messages::bar_growth_no_temperature());
  return {};
}

bool is_measured(const Column& column) {
  const std::string_view unit = unit_of(column.name);
  return column.role == Role::measured && (unit == "um" || unit == "mm" || unit == "urad");
}

}  // namespace

double sigma_of(const DriftAxis& axis, std::size_t row) {
  double variance = 0.0;
  bool known = false;
  for (const Contribution& contribution : axis.budget) {
    const double sigma = contribution.sigma[row];
    if (std::isnan(sigma)) continue;
    known = true;
    variance += sigma * sigma;
  }
  return known ? std::sqrt(variance) : kUnknown;
}

const DriftAxis* find_axis(const MeasuredDrift& drift, std::string_view name) {
  const auto axis =
      std::find_if(drift.axes.begin(), drift.axes.end(), [&](const DriftAxis& a) { return a.name == name; });
  return axis == drift.axes.end() ? nullptr : &*axis;
}

MeasuredDrift measured(const DriftSeries& drift, const Session& session) {
  MeasuredDrift result;
  result.what = fmt::format("ballbar, {}", name_of(drift.method));
  result.method = name_of(drift.method);
  result.reference_s = drift.reference_s;
  for (const DriftPoint& point : drift.points) result.time_s.push_back(point.time_s);
  for (const auto& [name, member] : kDriftQuantities) {
    DriftAxis axis{name, "um", {}, {}};
    Contribution fits{"circle fits", {}};
    bool any = false;
    for (const DriftPoint& point : drift.points) {
      const std::optional<Estimate>& estimate = point.*member;
      any = any || estimate.has_value();
      axis.value.push_back(estimate ? estimate->value_um : kUnknown);
      fits.sigma.push_back(estimate ? estimate->sigma_um : kUnknown);
    }
    if (!any) continue;
    const bool known = std::any_of(fits.sigma.begin(), fits.sigma.end(), [](double s) { return s > 0.0; });
    if (known) axis.budget.push_back(std::move(fits));
    if (axis.name == "axial") {
      std::vector<double> growth_um = bar_growth_sigma_um(drift, session, result.remarks);
      if (!growth_um.empty()) axis.budget.push_back({"bar's thermal growth", std::move(growth_um), true});
    } else if (session.bar_expansion_ppm_per_K) {
      axis.budget.push_back({"bar's thermal growth", std::vector<double>(drift.points.size(), 0.0)});
    }
    result.axes.push_back(std::move(axis));
  }
  return result;
}

MeasuredDrift measured(const Series& series, std::string what) {
  if (series.time_s.empty()) throw Error(fmt::format("expected rows, found none in {}.", what));
  MeasuredDrift result;
  result.what = std::move(what);
  result.method = "log";
  result.time_s = series.time_s;
  result.reference_s = series.time_s.front();
  for (const Column& column : series.columns) {
    const std::string unit(unit_of(column.name));
    if (!is_measured(column)) continue;
    const std::string name = column.name.substr(0, column.name.size() - unit.size() - 1);
    if (name.ends_with(kSigma)) continue;
    DriftAxis axis{name, unit, column.values, {}};
    if (const Column* sigma = find_column(series, fmt::format("{}{}_{}", name, kSigma, unit))) {
      axis.budget.push_back({"sigma of " + result.what, sigma->values});
    }
    result.axes.push_back(std::move(axis));
  }
  return result;
}

MeasuredDrift since_reference(MeasuredDrift drift, std::optional<double> reference_s) {
  const std::size_t reference = reference_index(drift.time_s, reference_s);
  drift.reference_s = drift.time_s[reference];
  std::vector<std::string> empty, still, far;
  std::erase_if(drift.axes, [&](const DriftAxis& axis) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double value : axis.value) {
      if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
    }
    const double limit = axis.unit == "mm" ? mm_from_um(kLargestDrift_um) : kLargestDrift_um;
    std::vector<std::string>* why = nullptr;
    if (!(most >= least)) {
      why = &empty;
    } else if (!(most > least)) {
      why = &still;
    } else if (axis.unit != "urad" && most - least > limit) {
      why = &far;
    }
    if (why != nullptr) why->push_back(axis.name);
    return why != nullptr;
  });
  const auto say = [&](const std::vector<std::string>& names, auto remark) {
    if (!names.empty()) drift.remarks.emplace_back(remark(listed({names.begin(), names.end()})));
  };
  say(empty, messages::left_out_empty);
  say(still, messages::left_out_still);
  say(far, messages::left_out_far);
  for (DriftAxis& axis : drift.axes) {
    const std::vector<std::size_t> away = far_readings(axis.value);
    for (const std::size_t one : away) axis.value[one] = kUnknown;
    if (!away.empty()) {
      std::vector<std::string> times;
      for (std::size_t k = 0; k < std::min<std::size_t>(away.size(), 5); ++k)
        times.push_back(fmt::format("{:.4g}", min_from_s(drift.time_s[away[k]])));
      drift.remarks.emplace_back(messages::set_aside(
          away.size(), axis.name, fmt::format("{}{}", fmt::join(times, ", "), away.size() > 5 ? ", ..." : "")));
    }
    std::size_t row = reference;
    while (row < axis.value.size() && std::isnan(axis.value[row])) ++row;
    if (row == axis.value.size()) row = reference;
    while (std::isnan(axis.value[row])) --row;  // it has a value
    const double scale = axis.unit == "mm" ? um_from_mm(1.0) : 1.0, origin = axis.value[row];
    if (axis.unit == "mm") axis.unit = "um";
    for (double& value : axis.value) value = scale * (value - origin);
    for (Contribution& one : axis.budget) {
      const double of_origin = one.sigma[row];
      for (double& sigma : one.sigma) sigma = scale * std::hypot(sigma, of_origin);
      one.sigma[row] = 0.0;
    }
    if (!axis.budget.empty()) continue;
    std::vector<double> times, values;
    for (std::size_t i = 0; i < axis.value.size(); ++i) {
      if (std::isfinite(axis.value[i])) times.push_back(drift.time_s[i]), values.push_back(axis.value[i]);
    }
    if (const std::optional<double> scatter = row_scatter(times, values)) {
      const double noise = std::max(*scatter, resolution_of(values) / std::sqrt(12.0));
      axis.budget.push_back(
          {"scatter of the rows", std::vector<double>(axis.value.size(), std::sqrt(2.0) * noise), false, true});
      axis.budget.back().sigma[row] = 0.0;
    }
  }
  return drift;
}

Series series_of(const MeasuredDrift& drift) {
  Series series;
  series.time_s = drift.time_s;
  for (const DriftAxis& axis : drift.axes) {
    series.columns.push_back({fmt::format("{}_{}", axis.name, axis.unit), Role::measured, axis.value});
    Column sigma{fmt::format("{}{}_{}", axis.name, kSigma, axis.unit), Role::measured, {}};
    sigma.values.reserve(drift.time_s.size());
    for (std::size_t row = 0; row < drift.time_s.size(); ++row) sigma.values.push_back(sigma_of(axis, row));
    const bool known = std::any_of(sigma.values.begin(), sigma.values.end(), [](double s) { return !std::isnan(s); });
    if (known) series.columns.push_back(std::move(sigma));
  }
  return series;
}

}  // namespace ballbar
