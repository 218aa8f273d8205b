// What `could --json` prints of all effects.
#pragma once

#include <string_view>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/formats/results/message.hpp"
#include "model/testability_text.hpp"

namespace ballbar {

// A phrase: "residual of the model".
std::string_view text_of(NoiseSource source);

// Of an effect that can be tested.
constexpr bool is_testable(const Detectability& of) { return of.testability == Testability::testable; }
constexpr bool is_untestable(const Detectability& of) { return !is_testable(of); }
constexpr auto if_testable(auto get) { return where(&is_testable, get); }

template <>
inline constexpr auto kResult<Detectability> = ResultType(
    "Detectability", "What data could show of an effect.",
    Field{"effect", in(&Detectability::effect, &Effect::name), "as `ballbar effects` lists it"},
    Field{"testability", &Detectability::testability,
          "testable, input missing, input constant, absorbed by the model, in the model, other motion"},
    Field{"columns", &Detectability::columns, "that suit it best"},
    Field{"bindings", &Detectability::bindings, "choices of columns that the data offer"},
    Field{"surviving_share", if_testable(&Detectability::surviving_share), "what of it the model cannot make"},
    Field{"detectable_um", if_testable(&Detectability::detectable_um), "range from which it is seen"},
    Field{"identifiable_um", if_testable(&Detectability::identifiable_um), "range from which it is named"},
    Field{"inseparable_from", if_testable(&Detectability::inseparable_from),
          "effects that these data do not tell from it"},
    Field{"why", where(&is_untestable, &reason_of), "it is not testable"});

template <>
inline constexpr auto kResult<Preflight> = ResultType(
    "Preflight", "What data could show, before any residual.",
    Field{"target", &Preflight::target, "column that is explained"}, Field{"n", &Preflight::n, "readings"},
    Field{"noise_source", [](const Preflight& of) { return text_of(of.noise_source); }, "where the noise is from"},
    Field{"effects", &Preflight::detectability, "of the catalogue"});

template <>
inline constexpr std::string_view kTargetsName<Preflight> = "PreflightTargets";

}  // namespace ballbar
