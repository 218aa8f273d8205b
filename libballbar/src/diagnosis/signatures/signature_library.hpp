// The signatures of all effects of a catalogue on given data, for comparison with a residual.
//
// A family is one effect bound to columns. Each point of its grid of shapes is one signature: one column per gain, with
// the curve of a unit gain.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

struct Family {
  BoundEffect bound;
  std::size_t first = 0, count = 0;    // the range of its grid in SignatureLibrary::signatures
  std::vector<std::size_t> more = {};  // shapes between the points of the grid
};

// All indices of a family into SignatureLibrary::signatures.
std::vector<std::size_t> shapes_of(const Family& family);

struct Signature {
  std::size_t family = 0;
  std::vector<double> point;          // all parameters: the shapes of this point, gains 0
  Eigen::Index first = 0, width = 0;  // range in SignatureLibrary::columns
  double range_um = 0.0;              // range (max - min) of the column of its first gain
};

struct SignatureLibrary {
  std::vector<Family> families;
  std::vector<Signature> signatures;
  Eigen::MatrixXd columns;  // n rows where the target has a value
};

// Whether the effect equals another effect of its first input at this shape. gain: its curve at these rows.
bool is_same_as_input(const Effect& effect, const EffectRows& inputs, const std::vector<std::size_t>& rows,
                      const Eigen::VectorXd& gain);

// Whether an effect of time alone is a jump: a gain, and the time from which it acts.
bool is_jump(const Effect& effect);

// Whether an effect of time alone describes a slow drift and is no cause of it: any but a jump.
bool describes_drift(const Effect& effect);

struct SignatureOptions {
  bool causes_only = false;      // of effects of time alone only jumps: others describe a slow drift, no cause of it
  std::optional<Motion> motion;  // of recordings
  std::vector<std::string> without;  // names of effects to leave out
  std::vector<Term> terms;           // replace the catalogue's terms; their held shapes stay held
  // Half the rate of the rows that are fitted, which signature_library_of sets.
  double highest_Hz = std::numeric_limits<double>::infinity();
};

// For the effects of the catalogue on the level of the model. Left out are families that the model has on the same
// columns (except effects that may repeat), families whose inputs are constant, equal or have gaps, and shapes at which
// an effect equals another one (EffectRules::same_as_input).
SignatureLibrary signature_library_of(const Catalogue& catalogue, const Model& model, const Series& data,
                                      const Fit& fit, SignatureOptions options = {});

// The rows on which an effect bound to these columns is evaluated; `rows` points into `values`.
struct BoundInputs {
  std::vector<std::vector<double>> values;
  EffectRows rows;
  bool usable = true;    // without gaps, and on a series not constant
  bool is_half = false;  // without gaps; one of several temperatures is constant, but their difference is not
  bool has_gaps = false;
};
BoundInputs inputs_of(const Effect& effect, const std::vector<std::string>& names, const Series& data);

struct SignatureProjection {
  Eigen::MatrixXd columns;    // U, as SignatureLibrary::columns; 0 where nothing survives
  std::vector<double> share;  // per signature: |P W g|^2 / |W g|^2 of its weakest direction
  std::vector<double> norm;   // |P W g| of its first column
};

// basis: the columns of the model, n by p, unweighted.
SignatureProjection signature_projection(const SignatureLibrary& library, const Eigen::MatrixXd& basis,
                                         const Whitening& whitening);

// The range in um of one signature with this d; infinite if the model absorbs it.
double detectable_um(const SignatureLibrary& library, const SignatureProjection& projected, std::size_t signature,
                     double d);

// One per effect of the catalogue at the level of the model, without the base effect, in the order of the catalogue.
// time_s: of the fitted rows.
std::vector<Detectability> detectability_of(const Catalogue& catalogue, const SignatureLibrary& library,
                                            const SignatureProjection& projection, const Model& model,
                                            const Series& data, std::optional<Motion> motion,
                                            std::span<const double> time_s);

}  // namespace ballbar
