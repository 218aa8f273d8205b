// What every effect of a catalogue could add to given data, ready to be held against a residual.
//
// A family is one effect bound to columns; each point of its grid of shapes is one signature: what a unit of each of
// its gains adds, a column each. Whitened by the noise (noise.hpp) and freed of the columns of the model's Jacobian,
// the columns of a signature are made orthonormal, so that
//
//   score = |U' r|^2     fall of chi^2 when this signature alone is added, r the whitened, projected residual
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/diagnosis/signatures/identifiability.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/bound_effect.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

struct Family {
  BoundEffect bound;
  std::size_t first = 0, count = 0;    // of SignatureLibrary::signatures: its grid
  std::vector<std::size_t> more = {};  // shapes between the points of the grid
};

// Of SignatureLibrary::signatures, all of a family.
std::vector<std::size_t> shapes_of(const Family& family);

struct Signature {
  std::size_t family = 0;
  std::vector<double> point;          // of all parameters: shapes as here, gains 0
  Eigen::Index first = 0, width = 0;  // of SignatureLibrary::columns
  double range_um = 0.0;              // largest less smallest value of its first gain's column
};

struct SignatureLibrary {
  std::vector<Family> families;
  std::vector<Signature> signatures;
  Eigen::MatrixXd columns;  // n rows where the target has a value
};

struct SignatureOptions {
  std::optional<Motion> motion;      // of recordings
  bool every_onset = true;           // up to 400 of them; else 7
  std::vector<std::string> without;  // names of effects that are left out
  std::vector<Term> terms;           // in the place of what the catalogue has of them: held where they hold a shape
  // Half the rate of the rows that are fitted, which signature_library_of sets.
  double highest_Hz = std::numeric_limits<double>::infinity();
};

// Of the effects of the catalogue on the model's level. Families that are in the model on the same columns are left
// out, but for effects that may repeat, and those whose inputs are constant or have gaps; and shapes with which an
// effect is another one (EffectRules::same_as_input).
SignatureLibrary signature_library_of(const Catalogue& catalogue, const Model& model, const Series& data,
                                      const Fit& fit, SignatureOptions options = {});

// What an effect bound to these columns is evaluated on; `rows` points into `values`.
struct BoundInputs {
  std::vector<std::vector<double>> values;
  EffectRows rows;
  bool usable = true;    // whole, and on a series not constant
  bool is_half = false;  // whole, but one of several temperatures stands still: a difference to it moves all the same
  bool has_gaps = false;
};
BoundInputs inputs_of(const Effect& effect, const std::vector<std::string>& names, const Series& data);

// Points of the grid of an effect's shapes on these rows, held ones that have a grid included.
std::vector<std::vector<double>> shapes_of(const Effect& effect, const EffectRows& rows,
                                           const SignatureOptions& options);

struct Projected {
  Eigen::VectorXd residual;   // r, n
  Eigen::MatrixXd columns;    // U, as SignatureLibrary::columns; 0 where nothing survives
  std::vector<double> share;  // of each signature: |P W g|^2 / |W g|^2, of its weakest direction
  std::vector<double> norm;   // |P W g| of its first column
  Eigen::MatrixXd model;      // orthonormal basis of W J, n by p
};

// basis: columns that the model already makes, n by p, unweighted.
Projected projected(const SignatureLibrary& library, const Eigen::VectorXd& residual_um, const Eigen::MatrixXd& basis,
                    const Whitening& whitening);

// Range of the effect with this d, of one signature; infinite where the model absorbs it.
double detectable_um(const SignatureLibrary& library, const Projected& projected, std::size_t signature, double d);

// One an effect of the catalogue at the model's level, but for the base that every model has, in its order. time_s: of
// the rows that are fitted.
std::vector<Detectability> detectability_of(const Catalogue& catalogue, const SignatureLibrary& library,
                                            const Projected& projection, const Model& model, const Series& data,
                                            std::optional<Motion> motion, std::span<const double> time_s);

}  // namespace ballbar
