// Which of the recorded batches to train on for the job at hand.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "ballbar/batches/batch_selection.hpp"
#include "ballbar/formats/text/source.hpp"
#include "batches/batches.hpp"

namespace ballbar {

enum class Take { paper, held_out, weights, all };

struct ChoiceOptions {
  BatchOptions batches;
  Source job;                         // a series of its temperatures; with the target, the choice is checked
  std::optional<std::size_t> method;  // of RegressionMethod
  SelectionOptions selection;
  RandomOptions random;
  std::size_t take = static_cast<std::size_t>(Take::weights);
  std::string out;  // .json; empty: no model is written
  bool every = false;
  bool json = false;
};

// Prints the batches by their likeness to the job and what each choice among them predicts; writes the model of the
// choice that is taken. Throws Error with the file that is at fault.
void choose_batches(ChoiceOptions options);

}  // namespace ballbar
