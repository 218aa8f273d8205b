#include "measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ballbar::study {
namespace {

constexpr std::array kChannels{"ch3_um", "ch1_um", "ch5_um"};

DataSet measured_set(std::uint64_t seed) {
  DataSet set;
  set.data = measured_record(5);
  const std::string target = kChannels[(seed - 1) % kChannels.size()];
  std::erase_if(set.data.columns,
                [&](const Column& column) { return column.role == Role::measured && column.name != target; });
  set.model.targets = {target};
  Term heating = term_of("speed_heating", {"speed_rpm"});
  for (std::size_t k = 0; k < heating.settings.size(); ++k) {
    if (heating.effect->parameters[k].name == "exponent") heating.settings[k].start = 2.0;
  }
  set.model.terms.push_back(std::move(heating));
  set.options.search.seed = seed;
  return set;
}

bool reads_room(const BoundEffect& bound) {
  return std::find(bound.columns.begin(), bound.columns.end(), "T_room_degC") != bound.columns.end();
}

}  // namespace

std::optional<Outcome> measured_room(std::uint64_t seed) {
  if (seed > kChannels.size()) return std::nullopt;
  const DataSet set = measured_set(seed);
  const Diagnosis found = diagnose(set.model, set.data, 0, set.options);
  Outcome outcome = judged(set, found, Expected::nothing);
  const bool named = std::any_of(found.named.begin(), found.named.end(), reads_room);
  const bool associations = std::any_of(found.associations.begin(), found.associations.end(),
                                        [](const Candidate& candidate) { return reads_room(candidate.bound); });
  outcome.in_set = named || associations ||
                   std::any_of(found.equivalent.begin(), found.equivalent.end(),
                               [](const auto& group) { return std::any_of(group.begin(), group.end(), reads_room); });
  double training = 0.0, held_out = 0.0;
  std::vector<Candidate> seen = found.candidates;
  seen.insert(seen.end(), found.associations.begin(), found.associations.end());
  for (const Candidate& candidate : seen) {
    if (!reads_room(candidate.bound)) continue;
    training = std::max(training, 1.0 - candidate.rmse_after_um / found.base.rmse_um);
    held_out = std::max(held_out, 1.0 - candidate.held_out_after_um / candidate.held_out_before_um);
  }
  const bool axial = found.target == "ch5_um";
  outcome.right = axial ? !named : *outcome.in_set && training >= 0.55 && held_out >= 0.5;
  outcome.wrong = axial && named;
  if (is_verbose()) {
    print(set, found, outcome);
    fmt::print("       with the room: RMSE falls by {:.0f} %, cycles left out by {:.0f} %\n", 100.0 * training,
               100.0 * held_out);
  }
  return outcome;
}

Outcome measured_fakes(std::uint64_t seed) {
  DataSet set = measured_set(seed);
  Random random(seed * 7919 + 13);
  for (Column& fake : fake_temperatures(set.data.time_s, 20, random)) log_also(set, std::move(fake));
  const Diagnosis found = diagnose(set.model, set.data, 0, set.options);
  Outcome outcome = judged(set, found, Expected::nothing);
  outcome.wrong = *outcome.fake;
  outcome.right = !*outcome.fake;
  if (is_verbose()) print(set, found, outcome);
  return outcome;
}

}  // namespace ballbar::study
