#include "model/residual_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/internal/fit/parameter_correlation.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/series/series.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string independent_text(double n) { return n < 100.0 ? fmt::format("{:.1f}", n) : fmt::format("{:.0f}", n); }

bool has_floor(const Fit& fit) { return !fit.floor.source.empty() && fit.floor.rms_um > 0.0; }

}  // namespace

Workbench workbench_of(const ModelOptions& options, const std::shared_ptr<const ModelData>& data, const Model& model,
                       DiagnosisOptions diagnosis) {
  expect_to_fit(options, model, *data);
  diagnosis.search.motion = data->motion;
  diagnosis.search.catalogue = options.catalogue;
  return {data->series, model, {fit_options(options), std::move(diagnosis)}};
}

std::string heading(const Fit& fit) {
  const std::vector<double> time_s = one_after_another(fit.time_s);
  const std::size_t runs = runs_of(fit.time_s).size();
  const std::size_t far = fit.set_aside.size();
  return fmt::format("{}, {} values over {}{}{}", fit.target, fit.residual_um.size(),
                     duration_text(time_s.back() - time_s.front()), runs > 1 ? fmt::format(" in {} runs", runs) : "",
                     far > 0 ? fmt::format("; {} more, far from their neighbours, set aside", far) : "");
}

std::string faults_text(const ResidualReport& report, const std::vector<FaultKind>& also_said) {
  std::vector<ColumnFault> faults = report.faults;
  std::erase_if(faults, [&](const ColumnFault& fault) {
    if (fault.column != report.fit.target) return false;
    if (fault.kind == FaultKind::far_off) return !report.fit.set_aside.empty();  // the heading says it
    return std::find(also_said.begin(), also_said.end(), fault.kind) != also_said.end();
  });
  return lines_of(faults);
}

void print_sentences(const ResidualReport& residual_report) {
  for (const Paragraph& sentence : sentences(residual_report.fit, residual_report.where, residual_report.whiteness))
    fmt::print("{}", wrapped(sentence));
}

std::vector<std::string> coefficient_texts(const std::vector<Coefficient>& coefficients) {
  std::vector<std::string> texts;
  const auto text_of = [](const Estimate& one) {
    return with_sigma(one.value_um, one.sigma_um,
                      decimals_showing(2, std::isfinite(one.sigma_um) ? one.sigma_um : one.value_um));
  };
  for (const Coefficient& one : coefficients) {
    std::string text =
        fmt::format("{}: {} {}, over {:.3g} K {} um", one.effect,
                    std::isfinite(one.value.sigma_um) ? text_of(one.value) : fmt::format("{:.4g}", one.value.value_um),
                    one.unit, one.size_um / std::abs(one.value.value_um), size_text(one.size_um));
    if (one.rising && one.falling)
      text += fmt::format("; {} while it rises, {} while it falls", text_of(*one.rising), text_of(*one.falling));
    if (!is_usual(one))
      text += fmt::format(". Usual are {:g} to {:g} {} ({})", one.usual_low, one.usual_high, one.unit, one.usual);
    texts.push_back(text + ".");
  }
  return texts;
}

int decimals_of(double rmse_um) { return std::max(2, decimals_showing(2, rmse_um)); }

Paragraph floor_sentences(const Fit& fit) {
  const int decimals = decimals_of(fit.rmse_um) + 1;
  const MessageValue rmse =
      fit.rmse_um < 1e-6 ? MessageValue(messages::below("0.000001")) : fixed(fit.rmse_um, decimals);
  Paragraph text = has_floor(fit) ? messages::fit_error_times(rmse, fixed(fit.rmse_um / fit.floor.rms_um, 2),
                                                              fixed(fit.floor.rms_um, decimals), fit.floor.source)
                                  : messages::fit_error(rmse);
  text += messages::fit_values(fit.residual_um.size(), independent_text(fit.n_effective));
  return text;
}

std::optional<double> floor_um(const ResidualReport& report) {
  return has_floor(report.fit) ? std::optional(report.fit.floor.rms_um) : std::nullopt;
}

}  // namespace ballbar
