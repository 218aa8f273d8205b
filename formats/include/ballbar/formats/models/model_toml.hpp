// Model `.toml`: what to explain and the sum of effects that does, as a user writes it.
//
//   format = "ballbar-model 1"
//   target = "z_um"                          # or ["x_um", "z_um"], each by its own fit
//   # level = "recording"                    # effects on ballbar recordings; the target is deviation_um then
//   # constant_um = 0.0                      # held there; without it the constant is free
//   [[effect]]
//   name = "lagged_expansion"
//   temperature = "T_air_degC"               # role = column; on recordings columns bind by themselves
//   gain_um_per_K = 2.2                      # a plain number is held
//   time_constant_s = { start = 600, lower = 60, upper = 7200 }  # free; what is not named is the catalogue's
//   [[effect]]
//   name = "expression"                      # see expression.hpp
//   formula = "k * lag(T_oil_degC - T_air_degC, tau)"
//   k = { start = 0.0, unit = "um/K" }       # bounds not named are infinite; held = true holds it
//   tau = { start = 600.0, lower = 10.0, upper = 20000.0, unit = "s" }
//   [[history]]                              # anything; the ledger's
//
// Above the effects a model that runs live (compensation.hpp) states what its columns were while it was fitted:
//
//   [trained]
//   T_oil_degC = [20.5, 38.9]                # lowest and highest
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ballbar/model/model.hpp"

namespace ballbar {

// With effects of the catalogue. `name` stands in messages. Throws Error with name:line:column: what is not TOML, an
// unknown key, effect, role or parameter (with the nearest name), a missing role, a value of another type, bounds
// crossed or a start outside them, a fault in a formula. Whether columns are in the data is for expect_suits.
Model read_model(std::string_view bytes, std::string_view name, const Catalogue& catalogue = built_in_catalogue());

// What reads back to the same model, without comments and history.
std::string write_model(const Model& model);

// To change a file that a user wrote: its text with one more [[effect]] after the others, before any [[history]];
// comments, order and all else stay as they are. `name` stands in messages; throws Error as read_model.
std::string with_effect(std::string_view bytes, std::string_view name, const Term& term,
                        const Catalogue& catalogue = built_in_catalogue());

// The same with other settings: `terms`, one for each effect of the file, in its order, say how each parameter enters.
std::string with_settings(std::string_view bytes, std::string_view name, std::span<const Term> terms,
                          const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
