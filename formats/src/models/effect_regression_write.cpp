#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <span>
#include <vector>

#include "ballbar/formats/models/effect_regression_json.hpp"
#include "text/json_text.hpp"

namespace ballbar {
namespace {

std::string json_of(std::span<const double> numbers) {
  return json_text(Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size())));
}

std::string json_of(const Forecasts& forecasts) {
  return fmt::format("{{\"count\": {}, \"error_um\": {}, \"rmse_um\": {}, \"held_um\": {}, \"within_share\": {}}}",
                     forecasts.count, json_text(forecasts.error_um), json_text(forecasts.rmse_um),
                     std::isnan(forecasts.held_um) ? "null" : json_text(forecasts.held_um),
                     json_text(forecasts.within_share));
}

std::string columns_text(const EffectRegression& regression) {
  std::vector<std::string> lines;
  for (std::size_t c = 0; c < regression.model.trained.size(); ++c) {
    const ColumnRange& range = regression.model.trained[c];
    lines.push_back(fmt::format("    {{\"name\": {}, \"role\": \"{}\", \"low\": {}, \"high\": {}}}",
                                json_text(range.column), name_of(regression.roles[c]), json_text(range.low),
                                json_text(range.high)));
  }
  return fmt::format("{}", fmt::join(lines, ",\n"));
}

std::string terms_text(const EffectRegression& regression) {
  std::vector<std::string> lines;
  for (std::size_t t = 0; t < regression.model.terms.size(); ++t) {
    const Term& term = regression.model.terms[t];
    std::vector<double> parameters;
    parameters.reserve(term.settings.size());
    for (const Setting& setting : term.settings) parameters.push_back(setting.start);
    const auto at = static_cast<Eigen::Index>(t);
    lines.push_back(
        fmt::format("    {{\"effect\": {}, \"columns\": {}, \"parameters\": {}, \"mean_um\": {}, \"sd_um\": {}}}",
                    json_text(term.effect->name), json_text(term.columns), json_of(parameters),
                    json_text(regression.mean_um[at]), json_text(regression.sd_um[at])));
  }
  return fmt::format("{}", fmt::join(lines, ",\n"));
}

// Most of the file: rounded, which the half width alone shows.
std::string factor_text(const Eigen::MatrixXd& factor) {
  std::string out;
  for (Eigen::Index i = 0; i < factor.rows(); ++i) {
    out += i == 0 ? "    [" : ",\n    [";
    for (Eigen::Index j = 0; j <= i; ++j) {
      if (!std::isfinite(factor(i, j))) json_text(factor(i, j));
      out += fmt::format("{}{:.9g}", j == 0 ? "" : ", ", factor(i, j) + 0.0);  // "-0" would be an integer
    }
    out += ']';
  }
  return out;
}

}  // namespace

std::string write_effect_regression(const EffectRegression& regression) {
  std::string out = fmt::format("{{\n  \"format\": \"{}\",\n", kRegressionFormat);
  out += fmt::format("  \"target\": {},\n", json_text(regression.model.targets.front()));
  out += fmt::format("  \"dictionary\": {},\n", json_text(regression.dictionary));
  out += fmt::format("  \"prior_variance\": {},\n", json_text(regression.prior_variance));
  out += fmt::format("  \"sigma_um\": {},\n", json_text(regression.sigma_um));
  out += fmt::format("  \"length_s\": {},\n", json_text(regression.length_s));
  out += fmt::format("  \"interval_scale\": {},\n", json_text(regression.interval_scale));
  out += fmt::format("  \"rows\": {},\n  \"runs\": {},\n", regression.rows, regression.runs);
  out += fmt::format("  \"rmse_um\": {},\n", json_text(regression.rmse_um));
  out += fmt::format("  \"forecasts\": {},\n", regression.forecasts ? json_of(*regression.forecasts) : "null");
  out += fmt::format("  \"columns\": [\n{}\n  ],\n", columns_text(regression));
  out += fmt::format("  \"left_out\": {},\n", json_text(regression.left_out));
  out += fmt::format("  \"constant_um\": {},\n", json_text(regression.model.constant_um.value_or(0.0)));
  out += fmt::format("  \"terms\": [\n{}\n  ],\n", terms_text(regression));
  out += fmt::format("  \"factor_um\": [\n{}\n  ],\n", factor_text(regression.factor_um));
  const LiveModel::State& end = regression.end;
  out += fmt::format("  \"end\": {{\n    \"time_s\": {},\n    \"step_s\": {},\n    \"discrepancy_um\": {},\n",
                     json_text(regression.end_s), json_text(regression.end_step_s),
                     json_text(regression.end_discrepancy_um));
  out += fmt::format("    \"rows\": {},\n    \"times_s\": {},\n", end.rows, json_of(end.time_s));
  return out + fmt::format("    \"inputs\": {},\n    \"kept\": {}\n  }}\n}}\n", json_of(end.inputs), json_of(end.kept));
}

}  // namespace ballbar
