#include "diagnosis/search/nested_effects.hpp"

#include <algorithm>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {

bool becomes(const BoundEffect& rich, const BoundEffect& plain) {
  return rich.effect->rules.becomes == plain.effect->name &&
         std::all_of(plain.columns.begin(), plain.columns.end(), [&](const std::string& name) {
           return std::find(rich.columns.begin(), rich.columns.end(), name) != rich.columns.end();
         });
}

namespace {

// A shape lies on its lower bound: a lag of 10 s where the plain effect has none.
bool is_at_its_least(const SubsetFits& now, const SubsetFit& with, std::size_t place) {
  const std::size_t term = now.model().terms.size() + place;
  const std::size_t first = first_parameter(with.model, term), count = with.model.terms[term].settings.size();
  return std::any_of(with.noise_fit.fit.parameters.begin() + static_cast<std::ptrdiff_t>(first),
                     with.noise_fit.fit.parameters.begin() + static_cast<std::ptrdiff_t>(first + count),
                     [](const FittedParameter& one) {
                       return one.kind == ParameterKind::shape && one.state == ParameterState::on_lower_bound;
                     });
}

}  // namespace

bool draws_the_same(const SubsetFits& now, const SubsetFit& plain, std::size_t m, const SubsetFit& rich,
                    std::size_t k) {
  if (!becomes(now.bound(rich.set[k]), now.bound(plain.set[m]))) return false;
  const Whitening whitening(plain.noise_fit.noise, plain.noise_fit.linearised.time_s,
                            plain.noise_fit.linearised.sigma_um);
  const auto curve = [&](const SubsetFit& of, std::size_t place) -> Eigen::VectorXd {
    const std::vector<double>& um = of.noise_fit.fit.contribution_um[now.model().terms.size() + place];
    return whitened(whitening, Eigen::Map<const Eigen::VectorXd>(um.data(), static_cast<Eigen::Index>(um.size())));
  };
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, now.linearised().model));
  const Eigen::VectorXd one = freed(curve(plain, m), basis), other = freed(curve(rich, k), basis);
  const double square = other.squaredNorm();
  if (!(square > 0.0)) return false;
  const double apart = (one - one.dot(other) / square * other).squaredNorm();
  return apart < kSameCurve || (is_at_its_least(now, rich, k) && apart < kSameShare * one.squaredNorm());
}

bool redrawn(const SubsetFits& now, const SubsetFit& plain, const SubsetFit& rich) {
  if (plain.set.size() != rich.set.size()) return false;
  std::vector<std::size_t> own, others;  // places of what the other has not
  for (std::size_t m = 0; m < rich.set.size(); ++m) {
    if (!has(now, plain.set, now.bound(rich.set[m]))) own.push_back(m);
    if (!has(now, rich.set, now.bound(plain.set[m]))) others.push_back(m);
  }
  return own.size() == 1 && others.size() == 1 && draws_the_same(now, plain, others.front(), rich, own.front());
}

}  // namespace ballbar
