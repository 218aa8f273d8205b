// What a posterior says of single effects, columns and values, and of what may stand in the place of an effect.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct Probabilities {
  std::vector<double> family;            // of effects
  std::map<std::string, double> column;  // that drives an effect
  std::vector<double> own;
  double nothing = 0.0, discrepancy = 0.0, time_alone = 0.0;
  double log_bayes_factor = 0.0;  // of any effect or other value against none of them
};

Probabilities probabilities_of(const Problem& problem, const Posterior& posterior);

// Of drivers, inputs of any form beside sets of effects; the most probable first.
std::vector<Driver> drivers_of(const Posterior& posterior, const Problem& problem,
                               const std::map<std::string, double>& by_effects);

// For each member of the best set what may stand in its place, families; p: of each family.
std::vector<std::vector<std::size_t>> groups_of(const Posterior& posterior, const EffectSet& best,
                                                const std::vector<double>& p);

}  // namespace ballbar
