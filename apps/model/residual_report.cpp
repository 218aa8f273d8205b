#include "model/residual_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/fit/parameter_correlation.hpp"
#include "ballbar/model/measured_input.hpp"
#include "ballbar/number_text.hpp"
#include "ballbar/series/runs.hpp"
#include "terminal/json_number.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string independent_text(double n) { return n < 100.0 ? fmt::format("{:.1f}", n) : fmt::format("{:.0f}", n); }

const char* state_name(ParameterState state) {
  switch (state) {
    case ParameterState::free:
      return "free";
    case ParameterState::held:
      return "held";
    case ParameterState::on_lower_bound:
      return "on lower bound";
    case ParameterState::on_upper_bound:
      return "on upper bound";
    case ParameterState::undetermined:
      return "undetermined";
  }
  return "free";
}

}  // namespace

ResidualReport residual_report_of(const ModelOptions& options, const Model& model, const ModelData& data,
                                  std::size_t target) {
  ResidualReport result;
  result.fit = fit_of(options, model, data, target);
  result.where = where_it_fails(result.fit, data.series);
  result.whiteness = whiteness(result.fit);
  for (const std::string& name : measured_inputs_with_gaps(model, data.series)) {
    const auto& values = find_column(data.series, name)->values;
    const auto known = std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    result.fit.remarks.push_back(fmt::format(
        "{} is an input measured at {} of {} times: between them it is a straight line, outside them the nearest "
        "value.",
        name, known, values.size()));
  }
  return result;
}

std::string heading(const Fit& fit) {
  const std::vector<double> time_s = one_after_another(fit.time_s);
  const std::size_t runs = runs_of(fit.time_s).size();
  return fmt::format("{}, {} values over {}{}", fit.target, fit.residual_um.size(),
                     duration_text(time_s.back() - time_s.front()), runs > 1 ? fmt::format(" in {} runs", runs) : "");
}

void print_sentences(const ResidualReport& residual_report) {
  for (const std::string& sentence : sentences(residual_report.fit, residual_report.where, residual_report.whiteness)) {
    fmt::print("{}", wrapped(sentence));
  }
}

int decimals_of(double rmse_um) {
  if (!(rmse_um > 0.0)) return 2;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(rmse_um))), 2, 6);
}

bool has_floor(const Fit& fit) { return !fit.floor.source.empty() && fit.floor.rms_um > 0.0; }

std::string floor_text(const Fit& fit) {
  const int decimals = decimals_of(fit.rmse_um) + 1;
  const std::string of_floor =
      has_floor(fit) ? fmt::format(", {} times the floor of {} um ({})", fixed(fit.rmse_um / fit.floor.rms_um, 2),
                                   fixed(fit.floor.rms_um, decimals), fit.floor.source)
                     : "";
  const std::string rmse = fit.rmse_um < 1e-6 ? "below 0.000001" : fixed(fit.rmse_um, decimals);
  return fmt::format("RMSE {} um{}. {} values, as good as {} independent ones.", rmse, of_floor, fit.residual_um.size(),
                     independent_text(fit.n_effective));
}

nlohmann::ordered_json json_of(const ResidualReport& residual_report) {
  const Fit& fit = residual_report.fit;
  nlohmann::ordered_json json;
  json["target"] = fit.target;
  json["rmse_um"] = number(fit.rmse_um);
  json["floor_um"] = has_floor(fit) ? number(fit.floor.rms_um) : nullptr;
  json["floor_source"] = fit.floor.source;
  json["n"] = fit.residual_um.size();
  json["n_effective"] = number(fit.n_effective);
  json["adequate"] = is_adequate(fit, residual_report.whiteness);
  json["where"] = nlohmann::ordered_json::array();
  for (const Misfit& misfit : residual_report.where) {
    json["where"].push_back({{"what", misfit.what},
                             {"from", misfit.from},
                             {"to", misfit.to},
                             {"n", misfit.n},
                             {"bias_um", number(misfit.bias_um)},
                             {"bias_sigma_um", number(misfit.bias_sigma_um)},
                             {"rmse_um", number(misfit.rmse_um)},
                             {"share", number(misfit.share)}});
  }
  json["parameters"] = nlohmann::ordered_json::array();
  for (const FittedParameter& parameter : fit.parameters) {
    json["parameters"].push_back({{"effect", parameter.effect},
                                  {"name", parameter.name},
                                  {"value", number(parameter.value)},
                                  {"sigma", number(parameter.sigma)},
                                  {"unit", parameter.unit},
                                  {"state", state_name(parameter.state)}});
  }
  json["correlation"] = nlohmann::ordered_json::array();
  const Eigen::MatrixXd correlation = correlation_of(fit);
  for (Eigen::Index i = 0; i < correlation.rows(); ++i) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (Eigen::Index j = 0; j < correlation.cols(); ++j) row.push_back(number(correlation(i, j)));
    json["correlation"].push_back(std::move(row));
  }
  json["noise"] = {{"white_um", number(fit.noise.white_um)},
                   {"correlated_um", number(fit.noise.correlated_um)},
                   {"correlation_time_s", number(fit.noise.correlation_time_s)}};
  json["whiteness"] = {{"autocorrelation", residual_report.whiteness.autocorrelation},
                       {"periodogram_distance", number(residual_report.whiteness.periodogram_distance)},
                       {"p", number(residual_report.whiteness.p)}};
  json["sentences"] = sentences(fit, residual_report.where, residual_report.whiteness);
  json["converged"] = fit.converged;
  json["remarks"] = fit.remarks;
  return json;
}

}  // namespace ballbar
