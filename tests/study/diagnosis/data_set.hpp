// A data set with something hidden in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/challenge/inject.hpp"
#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/noise/noise.hpp"
#include "records.hpp"

namespace ballbar::study {

// AR(1) from reading to reading, rounded last; where a record states sigmas, white noise of these instead.
struct Scatter {
  double phi = 0.9;
  double sigma_um = 1.0;
  double resolution_um = 0.01;
  bool heavy = false;  // innovations: Student's t with 4 degrees of freedom
};

// A signal that is hidden: an effect of the catalogue, or one that is in none.
struct Hidden {
  std::optional<Injection> injection;
  std::string what;                     // as printed
  std::vector<double> signal_um;        // one a row of the record
  std::vector<BoundEffect> match = {};  // each of them is right, beside the injected one
};

struct DataSet {
  Series data;                      // signals and, last, the target
  Model model;                      // what a user believes
  std::vector<Injection> believed;  // what the model's terms truly are
  std::vector<Hidden> hidden;
  std::vector<BoundEffect> also_true;  // there as well, though nobody asks for it
  std::vector<double> clean_um;        // all without noise, one a row
  std::vector<double> scatter_um;      // the noise, one a reading
  Noise noise;                         // the true one
  Scatter scatter;
  Fit base;  // of the model to its own part
  DiagnosisOptions options;
};

constexpr const char* kTarget = "y_um";

// The base model's part alone; `finish` makes the target once all is hidden.
DataSet data_set(const Record& record, std::vector<Injection> believed, const Scatter& scatter);
void finish(DataSet& set, Random& random);

// 2 um/krpm^(5/3), 2500 s
std::vector<Injection> friction_heat();

// Hides effects of the catalogue until `count` are: driven by logged columns, shapes drawn off their grid, scaled to
// that d: the norm of the signal, whitened by the true noise and freed of the base model. Not hidden are signals of
// which the base model makes 95 %, that need more than 20 d times the noise, or that are another hidden one to 0.9.
// `only`: the name of the effect, empty: any; `reads`: a column that it has to read, empty: any. False where not so
// many suit.
bool hide_effects(DataSet& set, std::size_t count, double d, Random& random, const std::string& only = {},
                  const std::string& reads = {});

// The effect on these columns, shapes drawn; false where it does not suit.
bool hide_effect(DataSet& set, const BoundEffect& bound, double d, Random& random);

// One more signal in the log.
void log_also(DataSet& set, Column column);

// The same for any signal; false, and nothing hidden, where it does not suit.
bool hide(DataSet& set, Hidden hidden, double d);

// Whether what is named is true.
bool is_true(const DataSet& set, const BoundEffect& bound);

// Driven by inputs, and not of the catalogue: a product of two temperatures, a square root of the speed, a square of a
// temperature's rate, turn by turn.
Hidden driven_outsider(const DataSet& set, std::size_t turn);

// Of time alone: three sinusoids of 2 to 12 h.
Hidden curve_of_time(const DataSet& set, Random& random);

}  // namespace ballbar::study
