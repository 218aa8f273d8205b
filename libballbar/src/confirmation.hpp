// Whether what fits a residual is a cause: the same in every cycle, found again where it was not fitted, better than
// fakes of the same smoothness.
#pragma once

#include <cstdint>
#include <vector>

#include "bank.hpp"
#include "evidence.hpp"

namespace ballbar {

// Of a trace the column that numbers its recordings; nullptr: a drift series.
const Column* recording_numbers(const Series& data);

// Cycle of every row: stretches between changes of speed, the short ones joined to their neighbour, at most 12; without
// a speed that changes five parts of the time. Of a trace each recording is one; a single recording is left out by
// quarters of its sweep.
std::vector<std::size_t> cycles_of(const Series& data, const std::vector<std::size_t>& rows);

// Cycles by which the gains of these columns can be tested: as `cycle`, but where a gain belongs to one recording (a
// vibration has a phase of its own in each direction) that recording cannot be told from the others, and quarters of
// all sweeps are left out.
std::vector<std::size_t> cycles_that_tell(const Series& data, const std::vector<std::size_t>& rows,
                                          const std::vector<std::size_t>& cycle, const Eigen::MatrixXd& columns);

// Each cycle's rows predicted from the others'. The model is taken as linear about its fit, so that shapes move too;
// the cycle left out counts as a gap in the noise's memory. What the model has for that cycle alone, such as the circle
// of its recording, is fitted to it.
struct HeldOut {
  double rmse_um = 0.0;  // of all rows
  double chi2 = 0.0;     // whitened by the noise within each cycle: what a slow noise adds to the RMSE counts little
};
// of_recordings: what moves in the cycle left out alone is that recording's own and fitted to it; in a drift series it
// is predicted by nothing.
HeldOut held_out(const Leftover& leftover, const Noise& noise, const std::vector<std::size_t>& cycle,
                 bool of_recordings);

// Of the residual freed of the model's columns.
double chi2(const Leftover& leftover, const Noise& noise);

// Where a term's parameters begin in Fit::parameters: the constant comes first.
std::size_t first_parameter(const Model& model, std::size_t term);

// Columns of the Jacobian that are gains of the term.
Eigen::MatrixXd gain_columns(const Fit& fit, const Model& model, std::size_t term);

inline constexpr double kSameGain = 0.001;  // p_same_gain below which gains differ

// Chance of gains as different from cycle to cycle as these: chi^2 of one gain for each cycle against one for all.
// columns: of the candidate alone, n by its gains; leftover.model the rest.
double p_same_gain(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise,
                   const std::vector<std::size_t>& cycle);

// Largest share of one cycle in the square of the columns, whitened and freed of the model.
double share_of_one_cycle(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise,
                          const std::vector<std::size_t>& cycle);

// Fall of chi^2 by the columns beside the model where no whitened reading counts for more than 4 sigma.
double gain_of_many(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise);

// The best of `count` fakes: the family's signatures with their phases scrambled, the same spectrum and no cause.
struct BestFake {
  double gain = 0.0;  // largest fall of chi^2
  double fall = 0.0;  // largest relative fall of the RMSE by least squares
};
BestFake best_fake(const Family& family, const Bank& bank, const Series& data, const std::vector<std::size_t>& rows,
                   const Leftover& leftover, const Noise& noise, std::size_t count, std::uint64_t seed);

}  // namespace ballbar
