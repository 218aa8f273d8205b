// A fit with its most likely noise: what the evidence of an effect and its figures in the ledger are made of.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/revision/ledger.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/statistics/evidence.hpp"

namespace ballbar {

struct Likely {
  Leftover leftover;
  Noise noise;
  double log_likelihood = 0.0;
  std::vector<std::size_t> cycle;  // of every row that was fitted
  bool of_recordings = false;
};

// Model fitted to as many rows as are tested: by the fit's own noise, then in turn by the most likely one (fit() keeps
// plain least squares where a memory is long), as long as that is more likely.
struct Seen {
  Fit fit;
  Likely likely;
};
Seen seen_of(const Model& model, const Series& data, std::size_t target);

// The same with this noise to begin with.
Seen seen_by(const Noise& noise, const Model& model, const Series& data, std::size_t target);

// The model with its free parameters starting from where the fit has them.
Model from_where_it_is(Model model, const Fit& fit);

// fit: to all rows; seen: to as many as are tested.
LedgerRow row_of(const Fit& fit, const Likely& seen);

}  // namespace ballbar
