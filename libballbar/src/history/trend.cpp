#include <algorithm>
#include <cmath>

#include "ballbar/history/history.hpp"
#include "history/quantity_series.hpp"
#include "numerics/median.hpp"
#include "numerics/root.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kGrid = 28;      // tau from 1/50 to 100 of the scale of values about their line
constexpr double kLeastWeight = 1e-7;  // lines below say nothing

double normal_below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

struct Values {
  std::vector<double> x_years, y, variance;
  double usual_sigma = 0.0;  // 0: no value has one
};

Values with_sigmas(std::span<const DatedValue> values, double last_s) {
  Values prepared;
  std::vector<double> known;
  known.reserve(values.size());
  for (const DatedValue& one : values) {
    if (std::isfinite(one.sigma)) known.push_back(one.sigma);
  }
  if (!known.empty()) prepared.usual_sigma = median(known);
  for (const DatedValue& one : values) {
    constexpr double kLeast = 1e-3;  // of the usual sigma: none is certain among the others
    const double sigma =
        std::isfinite(one.sigma) ? std::max(one.sigma, kLeast * prepared.usual_sigma) : prepared.usual_sigma;
    prepared.x_years.push_back((one.time_s - last_s) / kYear_s);
    prepared.y.push_back(one.value);
    prepared.variance.push_back(sigma * sigma);
  }
  return prepared;
}

// Weighted least squares with tau^2 added; `weight` its restricted log likelihood.
TrendLine line_of(const Values& values, double tau2) {
  double w0 = 0.0, w1 = 0.0, w2 = 0.0, y0 = 0.0, y1 = 0.0, log_variance = 0.0;
  for (std::size_t i = 0; i < values.y.size(); ++i) {
    const double variance = values.variance[i] + tau2;
    const double w = 1.0 / variance;
    const double x = values.x_years[i];
    w0 += w;
    w1 += w * x;
    w2 += w * x * x;
    y0 += w * values.y[i];
    y1 += w * x * values.y[i];
    log_variance += std::log(variance);
  }
  const double determinant = w0 * w2 - w1 * w1;
  TrendLine line;
  line.value = (w2 * y0 - w1 * y1) / determinant;
  line.rate_per_year = (w0 * y1 - w1 * y0) / determinant;
  line.value_variance = w2 / determinant;
  line.covariance = -w1 / determinant;
  line.rate_variance = w0 / determinant;
  double squares = 0.0;
  for (std::size_t i = 0; i < values.y.size(); ++i) {
    const double left = values.y[i] - line.value - line.rate_per_year * values.x_years[i];
    squares += left * left / (values.variance[i] + tau2);
  }
  line.weight = -0.5 * (log_variance + std::log(determinant) + squares);
  return line;
}

// Mean and variance of what the line says at x years.
struct Normal {
  double mean = 0.0, sigma = 0.0;
};

Normal at(const TrendLine& line, double x_years) {
  const double variance =
      line.value_variance + 2.0 * x_years * line.covariance + x_years * x_years * line.rate_variance;
  return {line.value + line.rate_per_year * x_years, std::sqrt(std::max(variance, 0.0))};
}

Normal rate_of(const TrendLine& line) { return {line.rate_per_year, std::sqrt(line.rate_variance)}; }

double below(const Normal& normal, double value) {
  if (normal.sigma > 0.0) return normal_below((value - normal.mean) / normal.sigma);
  return value < normal.mean ? 0.0 : value > normal.mean ? 1.0 : 0.5;
}

template <class Of>
double chance_below(const Trend& trend, const Of& of, double value) {
  double chance = 0.0;
  for (const TrendLine& line : trend.lines) chance += line.weight * below(of(line), value);
  return chance;
}

// Value below which what the lines say lies with that chance.
template <class Of>
double quantile_of(const Trend& trend, const Of& of, double chance) {
  constexpr double kFar = 9.0;  // sigmas
  const Normal first = of(trend.lines.front());
  double low = first.mean, high = first.mean;
  for (const TrendLine& line : trend.lines) {
    const Normal normal = of(line);
    low = std::min(low, normal.mean - kFar * normal.sigma);
    high = std::max(high, normal.mean + kFar * normal.sigma);
  }
  return root_between([&](double value) { return chance_below(trend, of, value) < chance; }, low, high).second;
}

// One line a tau, with the posterior as weights.
std::vector<TrendLine> lines_of(const Values& values, double scale, std::vector<double>& taus) {
  const bool stated = values.usual_sigma > 0.0;
  const double prior_scale = 3.0 * values.usual_sigma;  // machines differ from test to test by a few sigmas
  const double least = scale / 50.0, step = std::log(5000.0) / static_cast<double>(kGrid - 1);
  std::vector<TrendLine> lines;
  lines.reserve(kGrid + 1);
  if (stated) {
    taus.push_back(0.0);
    lines.push_back(line_of(values, 0.0));
    lines.back().weight += std::log(std::atan(least / prior_scale));
  }
  for (std::size_t k = 0; k < kGrid; ++k) {
    const double tau = least * std::exp(step * static_cast<double>(k));
    const double ratio = tau / prior_scale;
    taus.push_back(tau);
    lines.push_back(line_of(values, tau * tau));
    // Density of the prior times the step of tau.
    if (stated) lines.back().weight += std::log(step * ratio / (1.0 + ratio * ratio));
  }
  double most = lines.front().weight;
  for (const TrendLine& line : lines) most = std::max(most, line.weight);
  double sum = 0.0;
  for (TrendLine& line : lines) sum += line.weight = std::exp(line.weight - most);
  for (TrendLine& line : lines) line.weight /= sum;
  return lines;
}

double median_of(const std::vector<TrendLine>& lines, const std::vector<double>& taus) {
  double chance = 0.0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    chance += lines[k].weight;
    if (chance >= 0.5) return taus[k];
  }
  return taus.back();
}

constexpr int kSteps = 120;  // a month each

// The first time from the last test on when the line is beyond the limit with that chance.
std::optional<double> reached_s(const Trend& trend, double limit, bool upper, double chance) {
  const auto beyond = [&](double time_s) {
    const double above = chance_above(trend, time_s, limit);
    return (upper ? above : 1.0 - above) >= chance;
  };
  const double step_s = kForecast_years * kYear_s / kSteps;
  for (int step = 0; step <= kSteps; ++step) {
    const double after_s = trend.last_s + step_s * step;
    if (!beyond(after_s)) continue;
    const double before_s = std::max(after_s - step_s, trend.last_s);
    return root_between([&](double time_s) { return !beyond(time_s); }, before_s, after_s).second;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Trend> trend_of(std::span<const DatedValue> values) {
  if (values.size() < kTestsOfTrend) return std::nullopt;
  const auto by_time = [](const DatedValue& left, const DatedValue& right) { return left.time_s < right.time_s; };
  const auto [first, last] = std::minmax_element(values.begin(), values.end(), by_time);
  if (last->time_s - first->time_s < kSpanOfTrend_s) return std::nullopt;
  Trend trend;
  trend.tests = values.size();
  trend.last_s = last->time_s;
  const Values prepared = with_sigmas(values, trend.last_s);

  // What all lines have about them is set by the sigmas and by the scatter about the plain line.
  Values plain = prepared;
  std::fill(plain.variance.begin(), plain.variance.end(), 0.0);
  TrendLine line = line_of(plain, 1.0);
  double squares = 0.0;
  for (std::size_t i = 0; i < plain.y.size(); ++i) {
    squares += std::pow(plain.y[i] - line.value - line.rate_per_year * plain.x_years[i], 2);
  }
  const double residual2 = squares / static_cast<double>(values.size() - 2);
  const double scale = std::sqrt(residual2 + prepared.usual_sigma * prepared.usual_sigma);
  constexpr double kNothing = 1e-9;  // of values on a line, without a sigma: then the line is as it is
  double largest = 0.0;
  for (const double y : plain.y) largest = std::max(largest, std::abs(y));
  if (!(scale > kNothing * largest)) {
    line.weight = 1.0;
    line.value_variance = line.covariance = line.rate_variance = 0.0;
    trend.lines = {line};
    trend.rate_per_year = line.rate_per_year;
    trend.significant = std::abs(line.rate_per_year) > kNothing * largest;
    trend.p_value = trend.significant ? 0.0 : 1.0;
    return trend;
  }

  std::vector<double> taus;
  std::vector<TrendLine> lines = lines_of(prepared, scale, taus);
  trend.scatter = median_of(lines, taus);
  std::erase_if(lines, [](const TrendLine& one) { return one.weight < kLeastWeight; });
  trend.lines = std::move(lines);
  for (const TrendLine& one : trend.lines) trend.rate_per_year += one.weight * one.rate_per_year;
  const double one_sigma = normal_below(1.0);
  trend.sigma_per_year = 0.5 * (quantile_of(trend, rate_of, one_sigma) - quantile_of(trend, rate_of, 1.0 - one_sigma));
  const double falls = chance_below(trend, rate_of, 0.0);
  trend.p_value = 2.0 * std::min(falls, 1.0 - falls);
  trend.significant = trend.p_value < 2.0 * normal_below(-kSignificantSigmas);
  return trend;
}

double chance_above(const Trend& trend, double time_s, double limit) {
  const double x_years = (time_s - trend.last_s) / kYear_s;
  return 1.0 - chance_below(
                   trend, [&](const TrendLine& line) { return at(line, x_years); }, limit);
}

double quantile(const Trend& trend, double time_s, double chance) {
  const double x_years = (time_s - trend.last_s) / kYear_s;
  return quantile_of(
      trend, [&](const TrendLine& line) { return at(line, x_years); }, chance);
}

ToleranceDate tolerance_date(const Tolerance& tolerance, double last_value, const std::optional<Trend>& trend) {
  ToleranceDate date;
  if (!within(tolerance, last_value)) {
    date.outlook = Outlook::beyond;
    date.limit = tolerance.upper && last_value > *tolerance.upper ? tolerance.upper : tolerance.lower;
    return date;
  }
  if (!trend || !trend->significant) return date;
  const bool upper = trend->rate_per_year > 0.0;
  date.outlook = Outlook::away;
  date.limit = upper ? tolerance.upper : tolerance.lower;
  if (!date.limit) return date;
  date.at_s = reached_s(*trend, *date.limit, upper, 0.5);
  if (!date.at_s) return date;
  date.outlook = Outlook::expected;
  date.earliest_s = reached_s(*trend, *date.limit, upper, 0.025).value_or(*date.at_s);
  date.latest_s = reached_s(*trend, *date.limit, upper, 0.975);
  return date;
}

}  // namespace ballbar
