// Sets of effects held against the data of one diagnosis: by their likelihood on the grid of shapes, and fitted.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/search/search_options.hpp"
#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/model/bound_effect.hpp"
#include "diagnosis/search/best_subset.hpp"
#include "diagnosis/search/max_score_null.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/statistics/likelihood_ratio.hpp"
#include "diagnosis/statistics/ml_noise_fit.hpp"

namespace ballbar {

// Sets on the grid of shapes, each by its rising signatures.
using Evaluations = std::map<Set, GlsFit>;
const GlsFit& evaluation_of(const Evaluations& known, Set set);

// Terms of a set added to the model and fitted.
struct SubsetFit {
  Set set;
  Model model;
  NoiseFit noise_fit;
  double penalised = 0.0;  // 2 ln L less thresholds
};

// Everything the steps of a diagnosis share; nothing in it changes. Refers to model and data.
class SubsetFits {
 public:
  SubsetFits(const Model& model, const Series& data, std::size_t target, const Fit& base, const SearchOptions& options);

  const SignatureLibrary& signatures() const { return library_; }
  const LinearisedFit& linearised() const { return linearised_; }
  const Signature& at(std::size_t index) const { return library_.signatures[index]; }
  const Family& family(std::size_t index) const { return library_.families[at(index).family]; }
  const BoundEffect& bound(std::size_t index) const { return family(index).bound; }
  const Model& model() const { return model_; }
  bool has_few_rows() const { return linearised_.residual_um.size() < kFewestForNoise; }

  // Says what comes next.
  void tell(std::string_view step) const {
    if (progress_) progress_(step);
  }

  // Most effects that may be added together: one for four values that are left, at most three.
  std::size_t largest_set() const;

  Eigen::MatrixXd columns(const Set& set) const;
  Projected projected_by(const Noise& noise) const;

  // `known`, and those of the sets that are not in it. The noise from which an evaluation starts matters for few rows
  // alone: then none by another is to be known.
  Evaluations evaluated(Evaluations known, const std::vector<Set>& sets, const Noise& start) const;

  // Terms of the set added to the model, shapes free from their grid point, held ones held there; fitted. Throws Error
  // as fit does.
  SubsetFit refitted(const Set& set, const Noise& noise) const;

  // The same by the noise of another fitted set, what the two share from where that has it: a grid point far from the
  // truth would end in a hollow of its own.
  SubsetFit refitted_from(const SubsetFit& near, const Set& set) const;

  // Without the effect at `place` of the set, by the noise with it: the shapes of the model start from where they are.
  SubsetFit without(const SubsetFit& whole, std::size_t place) const;

 private:
  // The effect with its shapes at this point of the grid.
  Term term_at(std::size_t index) const;

  SubsetFit fitted(Set set, Model model, const Noise& noise) const;

  const Model& model_;
  const Series& data_;
  std::size_t target_;
  std::function<void(std::string_view)> progress_;
  LinearisedFit linearised_;
  SignatureLibrary library_;
};

// The set by which the noise is told: from the base residual and from the residual of the best sets found so far,
// whichever makes the data most likely. Empty: the model alone. With all that was evaluated on the way.
struct FirstGuess {
  Set set;
  Evaluations evaluated;
};
FirstGuess first_guess(const SubsetFits& now, const Noise& base_noise, Evaluations known);

// The best shape of every family in the place of one of the set, where it explains nearly as much.
std::vector<Set> swaps(const SubsetFits& now, const Projected& seen, const Set& set);

// The best shapes of other families, at most 8, that in the place of one of a fitted set would explain nearly as much,
// thresholds taken off: by the residual without it, freed of what the others can make with their shapes free.
std::vector<std::size_t> in_place_of(const SubsetFits& now, const SubsetFit& whole, std::size_t place,
                                     const MaxScoreNull& null);

bool has(const SubsetFits& now, const Set& set, const BoundEffect& bound);

// `set` has the effects of `whole` but that at `place`.
bool is_without(const SubsetFits& now, const Set& set, const Set& whole, std::size_t place);

}  // namespace ballbar
