// Model `.toml`: a target and a sum of effects, as a user writes it.
//
//   format = "ballbar-model 1"
//   target = "z_um"                          # or ["x_um", "z_um"], each by its own fit
//   # level = "recording"                    # effects on ballbar recordings; the target is then deviation_um
//   # constant_um = 0.0                      # holds the constant; without it the constant is free
//   [[effect]]
//   name = "lagged_expansion"
//   temperature = "T_air_degC"               # role = column; not needed on recordings
//   gain_um_per_K = 2.2                      # a plain number is held
//   time_constant_s = { start = 600, lower = 60, upper = 7200 }  # free; default: values of the catalogue
//   [[effect]]
//   name = "expression"                      # see model.hpp
//   formula = "k * lag(T_oil_degC - T_air_degC, tau)"
//   k = { start = 0.0, unit = "um/K" }       # bounds are infinite by default; held = true holds it
//   tau = { start = 600.0, lower = 10.0, upper = 20000.0, unit = "s" }
//   [[history]]                              # the ledger; ignored here
//
// A model that runs live (compensation.hpp) states the trained range of its columns above the effects:
//
//   [trained]
//   T_oil_degC = [20.5, 38.9]                # lowest and highest
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ballbar/model/model.hpp"

namespace ballbar {

// `name` is used in messages. Throws Error with name:line:column: invalid TOML, an unknown key, effect, role or
// parameter (with the nearest name), a missing role, a value of another type, a lower bound above the upper, a start
// outside its bounds, an error in a formula. expect_suits() checks the columns against the data.
Model read_model(std::string_view bytes, std::string_view name, const Catalogue& catalogue = built_in_catalogue());

// The text of the model, without comments and history. It reads back to the same model.
std::string write_model(const Model& model);

// The text of a user's file with one more [[effect]] after the others, before any [[history]]. Comments, order and all
// other text stay. `name` is used in messages. Throws Error as read_model() does.
std::string with_effect(std::string_view bytes, std::string_view name, const Term& term,
                        const Catalogue& catalogue = built_in_catalogue());

// The text with other settings. `terms` has one entry per effect of the file, in its order, with the new settings.
std::string with_settings(std::string_view bytes, std::string_view name, std::span<const Term> terms,
                          const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
