// `ballbar check DATA --model M`: the model fitted, and where it fails.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "ballbar/internal/fit/parameter_correlation.hpp"
#include "ballbar/internal/number_text.hpp"
#include "commands.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"
#include "terminal/caller.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

constexpr std::size_t kGroupsShown = 8;  // with --details
constexpr std::size_t kWorstShown = 6;   // without
constexpr std::size_t kParametersShown = 12;

struct CheckArguments {
  ModelOptions model;
  bool details = false;
  bool json = false;
};

// The parameter that varies with it most, where that matters.
std::string correlation_text(const Fit& fit, std::size_t k) {
  const std::optional<Correlation> strongest = strongest_correlation(fit, k);
  if (!strongest || std::abs(strongest->value) < 0.5) return "-";
  const FittedParameter& other = fit.parameters[strongest->with];
  if (other.name == "constant_um") return fmt::format("{:.2f} constant", strongest->value);
  const auto same = [&](const FittedParameter& parameter) { return parameter.name == other.name; };
  const bool unique = std::count_if(fit.parameters.begin(), fit.parameters.end(), same) == 1;
  return fmt::format("{:.2f} {}{}", strongest->value, other.name, unique ? "" : ", " + one_line(other.effect));
}

void add_parameters(Table& table, const Fit& fit, const std::string& target) {
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const FittedParameter& parameter = fit.parameters[k];
    if (k == 0 && parameter.state == ParameterState::held && parameter.value == 0.0) continue;  // recordings have none
    if (parameter.shape_of == ShapeOf::recording) continue;  // the label has it: circle 1
    std::vector<std::string> row{target + one_line(parameter.effect), one_line(parameter.name), value_text(parameter),
                                 one_line(parameter.unit)};
    if (target.empty()) row.push_back(correlation_text(fit, k));
    table.add(std::move(row));
  }
}

// The groups that hold more of the misfit than their share of the rows; in front of them, with --details, regimes and
// quadrants whole.
std::vector<Misfit> worth_showing(const ResidualReport& residual_report, bool details) {
  std::vector<Misfit> shown, rest;
  for (const Misfit& misfit : residual_report.where) {
    const bool is_whole = misfit.what == "regime" || misfit.what == "quadrant" || misfit.what == "run";
    (details && is_whole ? shown : rest).push_back(misfit);
  }
  const auto n = static_cast<double>(residual_report.fit.residual_um.size() - residual_report.fit.discounted.size());
  const auto excess = [&](const Misfit& misfit) { return misfit.share / (static_cast<double>(misfit.n) / n); };
  std::stable_sort(rest.begin(), rest.end(),
                   [&](const Misfit& left, const Misfit& right) { return excess(left) > excess(right); });
  rest.resize(std::min(rest.size(), details ? kGroupsShown : kWorstShown));
  shown.insert(shown.end(), rest.begin(), rest.end());
  return shown;
}

Table misfit_table(const ResidualReport& residual_report, bool details) {
  Table table({"where", "from", "to", "rows", "bias um", "RMSE um", "% of misfit"});
  const int decimals = decimals_of(residual_report.fit.rmse_um);
  for (const Misfit& misfit : worth_showing(residual_report, details)) {
    table.add({one_line(misfit.what), misfit.from, misfit.from == misfit.to ? "" : misfit.to,
               fmt::format("{}", misfit.n), with_sigma(misfit.bias_um, misfit.bias_sigma_um, decimals),
               fixed(misfit.rmse_um, decimals + 1), fmt::format("{:.0f}", 100.0 * misfit.share)});
  }
  return table;
}

std::string noise_text(const Noise& noise) {
  if (!(noise.correlated_um > 0.0))
    return fmt::format("Noise of the residual: white, {:.3g} um.", std::abs(noise.white_um));
  const std::string white =
      noise.white_um > 0.0005 * noise.correlated_um ? fmt::format("{:.3g} um white, ", noise.white_um) : "";
  return fmt::format("Noise of the residual: {}{:.3g} um slow, correlated over {}.", white, noise.correlated_um,
                     duration_text(noise.correlation_time_s));
}

std::string whiteness_text(const Whiteness& whiteness, std::size_t n) {
  std::vector<std::string> lags;
  for (std::size_t k = 0; k < std::min<std::size_t>(5, whiteness.autocorrelation.size()); ++k) {
    lags.push_back(fixed(whiteness.autocorrelation[k], 2));
  }
  std::string text;
  if (!lags.empty()) {
    text = fmt::format(" Autocorrelation of the residual at lags 1 to {}: {}.", lags.size(), fmt::join(lags, ", "));
  }
  if (n < 16) return text;
  return text + fmt::format(" Cumulated periodogram of the whitened residual: distance {:.3f}, {}.",
                            whiteness.periodogram_distance, p_equals_text(whiteness.p));
}

void print_remarks(const Fit& fit) {
  const std::size_t discounted = fit.discounted.size();
  if (discounted > 0 || !fit.remarks.empty()) fmt::print("\n");
  if (discounted > 0) fmt::print("{} {} discounted.\n", discounted, discounted == 1 ? "value was" : "values were");
  for (const Paragraph& remark : fit.remarks) fmt::print("{}", wrapped(remark));
}

void print_text(const ResidualReport& residual_report, const std::string& title, bool details) {
  const Fit& fit = residual_report.fit;
  const std::string faults = faults_text(residual_report);
  fmt::print("{}\n{}\n\n{}{}", title, heading(fit), faults, faults.empty() ? "" : "\n");
  print_sentences(residual_report);
  if (!residual_report.coefficients.empty()) fmt::print("\n");
  for (const std::string& text : coefficient_texts(residual_report.coefficients)) fmt::print("{}", wrapped(text));
  if (details || fit.parameters.size() <= kParametersShown) {
    Table table({"effect", "parameter", "value", "unit", "correlated most with"});
    add_parameters(table, fit, "");
    fmt::print("\n{}", table.text(table_width()));
  }
  if (details) fmt::print("{}", wrapped(floor_sentences(fit)));
  if (!residual_report.where.empty()) fmt::print("\n{}", misfit_table(residual_report, details).text(table_width()));
  if (details) {
    fmt::print("\n{}",
               wrapped(noise_text(fit.noise) + whiteness_text(residual_report.whiteness, fit.residual_um.size())));
  }
  print_remarks(fit);
  if (!details) fmt::print("\n{}", details_text("all parameters, all regimes and the noise of the residual"));
}

// Several targets: the sentences of each; with --details one table of all parameters.
void print_targets(const std::vector<ResidualReport>& all, const std::string& title, bool details) {
  fmt::print("{}\n", title);
  Table table({"target: effect", "parameter", "value", "unit"});
  for (const ResidualReport& residual_report : all) {
    fmt::print("\n{}\n{}", heading(residual_report.fit), faults_text(residual_report));
    print_sentences(residual_report);
    if (details) print_remarks(residual_report.fit);
    add_parameters(table, residual_report.fit, residual_report.fit.target + ": ");
  }
  if (details) fmt::print("\n{}", table.text(table_width()));
  fmt::print("\n--target {} shows one target in full.\n", all.front().fit.target);
  if (!details) fmt::print("{}", details_text("the parameters of all targets, and the remarks on their fits"));
}

void run(const CheckArguments& options) {
  const auto data = std::make_shared<const ModelData>(open_data(options.model));
  const Model model = open_model(options.model, *data);
  say_start(options.model, *data);
  std::vector<ResidualReport> all;
  for (std::size_t target = 0; target < model.targets.size(); ++target) {
    Workbench bench = workbench_of(options.model, data, of_one_target(model, options.model, *data->series, target));
    all.push_back(with_source(options.model.data.front().name(), [&] { return bench.check(); }));
  }
  if (options.json) {
    print_json(all.size() == 1 ? json_of(all.front()) : json_of(Targets<ResidualReport>{all}));
  } else if (all.size() == 1) {
    print_text(all.front(), data->title, options.details);
  } else {
    print_targets(all, data->title, options.details);
  }
}

}  // namespace

void add_check(CLI::App& app) {
  const auto options = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check", "Fit a model, and show where it fails");
  add_model_options(*command, options->model, false);
  add_also_input(*command, options->model);
  add_fit_options(*command, options->model);
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Example:\n"
      "  ballbar check sample-runs/two-arcs-he2015 --model sample-runs/two-arcs-he2015/model.toml");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
