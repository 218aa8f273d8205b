// What a fit says: its error against the noise, where it fails, and what its residual is.
#pragma once

#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// Three paragraphs: the RMSE against the noise, the worst group, and the nature of the residual.
std::vector<Paragraph> sentences(const Fit& fit, const std::vector<Misfit>& where, const Whiteness& whiteness);

// A phrase: "while warming", "where T_air_degC is from 21 to 22 degC".
Message misfit_place(const Misfit& group);

}  // namespace ballbar
