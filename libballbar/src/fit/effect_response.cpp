#include "ballbar/internal/fit/effect_response.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRows = 240;
constexpr double kConstants = 5.0, kShortest_s = 1800.0;
constexpr double kBefore = 0.1;  // of the time, before the step

std::vector<double> known_of(const std::vector<double>& values) {
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](double v) { return std::isfinite(v); });
  return known;
}

double span_s(const Effect& effect, std::span<const FittedParameter> parameters) {
  double longest_s = 0.0;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const Parameter& parameter = effect.parameters[k];
    const bool time = parameter.unit == "s" && parameter.name.find("onset") == std::string::npos;
    if (time) longest_s = std::max(longest_s, parameters[k].value);
  }
  return std::max(kConstants * longest_s, kShortest_s);
}

}  // namespace

std::vector<double> effect_um(const Term& term, std::span<const FittedParameter> parameters, const Series& data) {
  Model alone;
  alone.level = term.effect->level;
  alone.terms = {term};
  std::vector<FittedParameter> values(1);  // the constant, 0
  values.insert(values.end(), parameters.begin(), parameters.end());
  return predict(alone, values, data).contribution_um.front();
}

std::optional<StepResponse> step_response(const Term& term, std::span<const FittedParameter> parameters,
                                          std::size_t input, const Series& data) {
  const std::string& name = term.columns[input];
  const Column* stepped = find_column(data, name);
  if (stepped == nullptr) return std::nullopt;
  const std::vector<double> values = known_of(stepped->values);
  if (values.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (!(*high > *low)) return std::nullopt;
  const double whole_s = span_s(*term.effect, parameters);
  Series series;
  for (std::size_t i = 0; i < kRows; ++i) {
    series.time_s.push_back(whole_s * (static_cast<double>(i) / (kRows - 1) * (1.0 + kBefore) - kBefore));
  }
  for (const std::string& other : term.columns) {
    if (find_column(series, other) != nullptr) continue;
    const Column* source = find_column(data, other);
    if (source == nullptr) return std::nullopt;
    const std::vector<double> known = known_of(source->values);
    if (known.empty()) return std::nullopt;
    Column filled{other, source->role, std::vector<double>(kRows, median(known))};
    for (std::size_t i = 0; i < kRows && other == name; ++i) filled.values[i] = series.time_s[i] < 0.0 ? *low : *high;
    series.columns.push_back(std::move(filled));
  }
  std::vector<double> response_um = effect_um(term, parameters, series);
  return StepResponse{name, *low, *high, std::move(series.time_s), std::move(response_um)};
}

}  // namespace ballbar
