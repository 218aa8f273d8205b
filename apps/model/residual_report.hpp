// The comparison of a model with data, as `check` and `diagnose` show it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/formats/results/fit_results.hpp"
#include "ballbar/formats/results/message.hpp"
#include "ballbar/internal/fit/parameter_correlation.hpp"
#include "ballbar/workbench/workbench.hpp"
#include "model/column_fault_text.hpp"
#include "model/model_options.hpp"
#include "model/residual_sentences.hpp"

namespace ballbar {

// The workbench of a request. model: with one target. Throws Error with the faulty file if the model does not suit the
// data.
Workbench workbench_of(const ModelOptions& options, const std::shared_ptr<const ModelData>& data, const Model& model,
                       DiagnosisOptions diagnosis = {});

// "z_um, 6669 values over 27.8 h"
std::string heading(const Fit& fit);

// Faults of columns that no other line says, a wrapped line each. `also_said`: kinds of the target.
std::string faults_text(const ResidualReport& report, const std::vector<FaultKind>& also_said = {});

// The three sentences, wrapped.
void print_sentences(const ResidualReport& residual_report);

// The span is that of the temperature as the effect takes it, with its delay.
// "expansion(T_degC): 3.53 ± 0.02 um/K, over 9.1 K 32 um; 3.5 ± 0.1 while it rises, 3.6 ± 0.1 while it falls", a line
// each.
std::vector<std::string> coefficient_texts(const std::vector<Coefficient>& coefficients);

// RMSE, the floor with its source, and the effective number of values.
Paragraph floor_sentences(const Fit& fit);

// The number of decimals for two significant digits of a residual of this size.
int decimals_of(double rmse_um);

// Absent if not known.
std::optional<double> floor_um(const ResidualReport& report);

template <>
inline constexpr auto kResult<Coefficient> = ResultType(
    "Coefficient", "The coefficient of an effect of one temperature.", Field{"effect", &Coefficient::effect},
    Field{"column", &Coefficient::column}, Field{"value_um_per_K", in(&Coefficient::value, &Estimate::value_um)},
    Field{"sigma_um_per_K", in(&Coefficient::value, &Estimate::sigma_um), "null: held"},
    Field{"span_K", &Coefficient::span_K, "of the column in the fitted rows"},
    Field{"change_um", &Coefficient::size_um, "of the effect there, largest less smallest"},
    estimate("rising_um_per_K", "rising_sigma_um_per_K", "while the effect rises", &Coefficient::rising),
    estimate("falling_um_per_K", "falling_sigma_um_per_K", "while it falls", &Coefficient::falling),
    Field{"is_usual", &is_usual, "within the range of the page of the effect, or none is known"});

constexpr auto of_fit(auto... get) { return in(&ResidualReport::fit, get...); }

// What `check --json` prints of one target.
inline constexpr FieldList kResidualReportFigures{
    Field{"target", of_fit(&Fit::target), "column that is explained"},
    Field{"target_unit", of_fit(&Fit::target, &unit_of),
          "for which um stands in the other keys; empty: the column states none"},
    Field{"rmse_um", of_fit(&Fit::rmse_um), "of the residual"},
    Field{"floor_um", &floor_um, "the noise, which no model explains; null: not known"},
    Field{"floor_source", of_fit(&Fit::floor, &Floor::source), "where the noise is taken from"},
    Field{"n", count(of_fit(&Fit::residual_um)), "readings"},
    Field{"n_effective", of_fit(&Fit::n_effective), "independent readings that they are worth"},
    Field{"adequate", [](const ResidualReport& of) { return is_adequate(of.fit, of.whiteness); },
          "whether the model leaves noise alone"}};
inline constexpr Field kConverged{"converged", of_fit(&Fit::converged), "whether the fit came to an end"};

template <>
inline constexpr auto kResult<ResidualReport> = ResultType(
    "Checked", "A model fitted, and where it fails.", kResidualReportFigures,
    Field{"where", &ResidualReport::where, "where it fails"}, Field{"parameters", of_fit(&Fit::parameters)},
    Field{"correlation", of_fit(&correlation_of), "of the parameters, row by row"},
    Field{"noise", of_fit(&Fit::noise), "of the residual"}, Field{"whiteness", &ResidualReport::whiteness},
    Field{"sentences", [](const ResidualReport& of) { return sentences(of.fit, of.where, of.whiteness); },
          "error against noise, where worst, what the residual is"},
    kConverged,
    Field{"n_set_aside", count(of_fit(&Fit::set_aside)), "readings far from their neighbours, which are not in n"},
    Field{"coefficients", &ResidualReport::coefficients, "um/K of each effect of one temperature"},
    Field{"faults", &ResidualReport::faults, "of columns, that bear on what is said"},
    Field{"remarks", of_fit(&Fit::remarks)});

template <>
inline constexpr std::string_view kTargetsName<ResidualReport> = "CheckedTargets";

}  // namespace ballbar
