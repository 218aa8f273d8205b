// A fit and where it fails, as results.
#pragma once

#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/results/message.hpp"

namespace ballbar {

std::string_view name_of(ParameterState state);

template <>
inline constexpr auto kResult<Misfit> =
    ResultType("Misfit", "Some of the readings, and how the model fails there.",
               Field{"what", &Misfit::what, "what they have in common: regime, time, a column"},
               Field{"from", &Misfit::from, "as printed, with unit; a name: also in `to`"}, Field{"to", &Misfit::to},
               Field{"n", &Misfit::n, "readings"}, Field{"bias_um", &Misfit::bias_um, "mean residual"},
               Field{"bias_sigma_um", &Misfit::bias_sigma_um, "of that mean, the noise's memory included"},
               Field{"rmse_um", &Misfit::rmse_um, "root of the mean square of the residual"},
               Field{"share", &Misfit::share, "of the sum of squares of all readings"});

template <>
inline constexpr auto kResult<FittedParameter> =
    ResultType("FittedParameter", "A parameter of a model, fitted or held.",
               Field{"effect", &FittedParameter::effect, "the effect with its columns, or constant"},
               Field{"name", &FittedParameter::name, "with its unit"}, Field{"value", &FittedParameter::value},
               Field{"sigma", &FittedParameter::sigma, "null: held, on a bound, or not determined"},
               Field{"unit", &FittedParameter::unit},
               Field{"state", &FittedParameter::state, "free, held, on lower bound, on upper bound, undetermined"});

template <>
inline constexpr auto kResult<Noise> =
    ResultType("Noise", "Noise of the readings: a white and a correlated part.",
               Field{"white_um", &Noise::white_um, "standard deviation from reading to reading"},
               Field{"correlated_um", &Noise::correlated_um, "standard deviation of the correlated part; 0: none"},
               Field{"correlation_time_s", &Noise::correlation_time_s, "time in which the correlation falls to 1/e"});

template <>
inline constexpr auto kResult<Whiteness> =
    ResultType("Whiteness", "Whether what the model leaves is noise alone.",
               Field{"autocorrelation", &Whiteness::autocorrelation, "of the residual, from lag 1 on"},
               Field{"periodogram_distance", &Whiteness::periodogram_distance,
                     "of the cumulated periodogram of the whitened residual to that of white noise"},
               Field{"p", &Whiteness::p, "of a distance as large by chance"});

}  // namespace ballbar
