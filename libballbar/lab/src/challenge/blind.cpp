#include "ballbar/lab/challenge/blind.hpp"

#include <array>
#include <cmath>

#include "ballbar/effects/effect.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "challenge/blind_parts.hpp"

namespace ballbar {
namespace {

using blind::HiddenEffect;
using blind::Random;
using blind::Scatter;
using blind::Workshop;

struct NamedKind {
  BlindKind kind;
  std::string_view name;
  double share;
};
constexpr std::array kKinds{NamedKind{BlindKind::nothing, "nothing", 0.20},
                            NamedKind{BlindKind::one, "one", 0.30},
                            NamedKind{BlindKind::two, "two", 0.15},
                            NamedKind{BlindKind::outside, "outside", 0.15},
                            NamedKind{BlindKind::inseparable, "inseparable", 0.10},
                            NamedKind{BlindKind::spindle, "spindle", 0.10}};

constexpr double kLeastShare = 0.05;    // of a hidden signal that the base model cannot make
constexpr double kLargestCosine = 0.9;  // of two hidden signals, whitened and freed of the base model
constexpr double kLargestRange_um = 200.0;
constexpr int kMostTries = 300;

// What the sets are written with, as a user writes a model.
Term friction_heat() { return term_of("speed_heating", {"speed_rpm"}); }

Term expansion_of(const std::string& column) { return term_of("expansion", {column}); }

// What a user believes: friction heat, a warm spindle, or both.
Model usual_model(std::string target, Random& random) {
  Model model;
  model.targets = {std::move(target)};
  if (!blind::chance(random, 0.3)) model.terms.push_back(friction_heat());
  if (model.terms.empty() || blind::chance(random, 0.4)) {
    model.terms.push_back(expansion_of("T_front_degC"));
  }
  return model;
}

BoundEffect bound_of(const Term& term) { return {term.effect.get(), term.columns}; }

// A constant and 5 to 30 um of every effect.
std::vector<double> clean_of(const Model& model, const Series& logged, Random& random) {
  std::vector<double> clean(logged.time_s.size(), blind::between(random, -5.0, 5.0));
  for (const Term& term : model.terms) {
    const Injection injection = blind::drawn_injection(bound_of(term), logged, random);
    const std::vector<double> signal = signal_of(injection, logged);
    const double scale = blind::between(random, 5.0, 30.0) / range_of(signal);
    for (std::size_t i = 0; i < clean.size(); ++i) clean[i] += scale * signal[i];
  }
  return clean;
}

Fit base_fit(const Model& model, const Series& logged, const std::vector<double>& target_um) {
  Series data = logged;
  data.columns.push_back({model.targets.front(), Role::measured, target_um});
  return fit(model, data, 0, {.white = true});
}

double cosine(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += a[i] * b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
  }
  return ab / std::sqrt(aa * bb);
}

// Takes hidden signals as `next` offers them, each scaled to a d, until there are enough; false where there never are.
template <class Next>
bool hide(BlindSet& set, std::size_t count, const Fit& base, const Noise& noise, Random& random, Next next) {
  std::vector<std::vector<double>> taken;
  for (int tries = 0; set.hidden_um.size() < count && tries < kMostTries; ++tries) {
    std::optional<HiddenEffect> hidden = next();
    if (!hidden) continue;
    Survival survival = survival_of(hidden->signal_um, base, noise);
    if (!(survival.share > kLeastShare) || !std::isfinite(survival.d)) continue;
    const double d = blind::between(random, 6.0, 20.0);
    const double scale = d / survival.d;
    const double range_um = scale * range_of(hidden->signal_um);
    if (!(range_um < kLargestRange_um)) continue;
    if (!taken.empty() && std::abs(cosine(taken.front(), survival.left)) > kLargestCosine) continue;
    taken.push_back(std::move(survival.left));
    for (double& value : hidden->signal_um) value *= scale;
    set.hidden_um.push_back(std::move(hidden->signal_um));
    set.answer.what += (set.answer.what.empty() ? "" : " and ") + hidden->what;
    if (hidden->bound) set.answer.hidden.push_back(*hidden->bound);
    set.answer.match = std::move(hidden->match);
    set.answer.d.push_back(d);
    set.answer.amplitude_um.push_back(range_um);
  }
  return set.hidden_um.size() == count;
}

// Two sensors that log the same; a load in proportion to the only speed; a difference to a constant room.
enum class Twins { sensors, load, room };

std::optional<HiddenEffect> twin_effect(Twins twins, const Series& logged, Random& random) {
  const auto of = [&](std::string_view effect, std::vector<std::string> columns) {
    return bound_of(term_of(effect, std::move(columns)));
  };
  BoundEffect bound;
  if (twins == Twins::sensors) {
    bound =
        blind::chance(random, 0.5) ? bound_of(expansion_of("T_head_degC")) : of("lagged_expansion", {"T_head_degC"});
  } else if (twins == Twins::load) {
    const bool by_load = blind::chance(random, 0.5);
    bound = by_load ? of("load_heating", {"load_W"}) : bound_of(friction_heat());
  } else {
    bound = of("gradient_bending", {"T_front_degC", "T_room_degC"});
  }
  Injection injection = blind::drawn_injection(bound, logged, random);
  if (twins != Twins::room) {
    return HiddenEffect{label_of(bound), bound, {}, signal_of(injection, logged)};
  }
  // The room does not move: the same as the other temperature alone.
  const BoundEffect alone = of("lagged_expansion", {"T_front_degC"});
  return HiddenEffect{label_of(bound), bound, {}, signal_of({alone, injection.parameters}, logged)};
}

void log_head_twice(Series& logged, const Series& sensors) {
  std::erase_if(logged.columns, [](const Column& column) { return column.name == "T_head_degC"; });
  Column head = *find_column(sensors, "T_head_degC");
  for (double& value : head.values) value = simulation::rounded(value, 0.1);
  logged.columns.push_back(head);
  head.name = "T_head_2_degC";
  logged.columns.push_back(std::move(head));
}

std::vector<double> sum_of_others(const Series& causes, std::string_view target, const HiddenEffect& cause) {
  std::vector<double> sum = find_column(causes, target)->values;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] -= cause.signal_um[i];
  return sum;
}

bool fill(BlindSet& set, BlindKind kind, Random& random) {
  set.answer.kind = kind;
  const std::string target = blind::chance(random, 0.5) ? "y_um" : "z_um";
  const Twins twins = blind::one_of(random, std::array{Twins::sensors, Twins::load, Twins::room});
  blind::Plan plan = blind::Plan::usual;
  if (kind == BlindKind::inseparable && twins == Twins::load) plan = blind::Plan::one_speed;
  if (kind == BlindKind::inseparable && twins == Twins::room) plan = blind::Plan::constant_room;
  const Workshop workshop = blind::workshop_of(plan, random);
  const Scatter scatter = blind::drawn_scatter(random);
  const Noise noise = blind::noise_model(scatter, workshop.logged.time_s[1] - workshop.logged.time_s[0]);
  set.data = workshop.logged;
  set.noise = noise;

  if (kind == BlindKind::spindle) {
    set.model.targets = {target};
    set.model.terms = {friction_heat()};
    for (const HiddenEffect& cause : blind::drawn_causes(workshop, target, random)) {
      const Fit base = base_fit(set.model, set.data, sum_of_others(workshop.causes, target, cause));
      set.clean_um = predict(set.model, base.parameters, set.data).predicted_um;
      bool offered = false;
      const auto next = [&]() -> std::optional<HiddenEffect> {
        if (offered) return std::nullopt;
        offered = true;
        return cause;
      };
      if (hide(set, 1, base, noise, random, next)) break;
    }
    if (set.hidden_um.empty()) return false;
  } else {
    set.model = usual_model(target, random);
    if (kind == BlindKind::inseparable && twins == Twins::load) {
      set.model.terms = {expansion_of("T_room_degC")};
    }
    if (kind == BlindKind::inseparable && twins == Twins::room) {
      set.model.terms = {friction_heat()};
    }
    if (kind == BlindKind::inseparable && twins == Twins::sensors) log_head_twice(set.data, workshop.sensors);
    set.clean_um = clean_of(set.model, set.data, random);
    const Fit base = base_fit(set.model, set.data, set.clean_um);
    const std::size_t count = kind == BlindKind::nothing ? 0 : kind == BlindKind::two ? 2 : 1;
    const auto next = [&]() -> std::optional<HiddenEffect> {
      if (kind == BlindKind::outside) return blind::drawn_outsider(workshop.sensors, random);
      if (kind == BlindKind::inseparable) return twin_effect(twins, set.data, random);
      return blind::drawn_effect(set.model, set.data, random);
    };
    if (!hide(set, count, base, noise, random, next)) return false;
  }
  if (kind == BlindKind::nothing) set.answer.what = "nothing";

  Column measured{target, Role::measured, set.clean_um};
  const std::vector<double> scattered_um = blind::noise_um(measured.values.size(), scatter, random);
  for (std::size_t i = 0; i < measured.values.size(); ++i) {
    double& value = measured.values[i];
    for (const std::vector<double>& hidden_um : set.hidden_um) value += hidden_um[i];
    value = simulation::rounded(value + scattered_um[i], scatter.resolution_um) + 0.0;
  }
  set.data.columns.push_back(std::move(measured));
  return true;
}

}  // namespace

std::string_view name_of(BlindKind kind) {
  return std::find_if(kKinds.begin(), kKinds.end(), [&](const NamedKind& one) { return one.kind == kind; })->name;
}

std::optional<BlindKind> blind_kind_from_name(std::string_view name) {
  const auto at = std::find_if(kKinds.begin(), kKinds.end(), [&](const NamedKind& one) { return one.name == name; });
  if (at == kKinds.end()) return std::nullopt;
  return at->kind;
}

BlindKind blind_kind(std::uint64_t seed) {
  Random random = simulation::stream_of(seed, simulation::Stream::blind_kind, 0);
  double left = simulation::uniform(random);
  for (const NamedKind& one : kKinds) {
    if (left < one.share) return one.kind;
    left -= one.share;
  }
  return kKinds.back().kind;
}

BlindSet blind_set(BlindKind kind, std::uint64_t seed) {
  // A draw in which nothing can be hidden (all at rest, say) is drawn again.
  for (std::uint64_t attempt = 0;; ++attempt) {
    Random random = simulation::stream_of(seed, simulation::Stream::blind_set, attempt);
    BlindSet set;
    if (fill(set, kind, random)) return set;
  }
}

}  // namespace ballbar
