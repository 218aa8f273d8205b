// Effects hidden in made data: does the diagnosis name them, and nothing else?
//
//   study_diagnosis [SEEDS [CELL...]]          with VERBOSE set: every data set
//
// Prints a line a cell in per cent: right (named, all of it and nothing else), wrong (something false is named), in set
// (named or among those that cannot be told apart), called (any verdict but nothing); fails where a gate is clearly
// missed.
//
// Speed plan, room and temperatures of the measured 46 h record (sample-runs/spindle-46h), every 75 s; on them a base
// model (speed_heating) and hidden effects whose shapes are drawn off the grid, of a stated d: the norm of the hidden
// signal, whitened by the true noise and freed of the base model. Noise AR(1), rounded to 0.01 um.
#include "ballbar/diagnosis.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "ballbar/formats/bytes.hpp"
#include "ballbar/formats/series_csv.hpp"

namespace {

using namespace ballbar;

struct Noisy {
  double phi = 0.9;
  bool heavy = false;  // Student's t with 4 degrees of freedom
};

struct Truth {
  std::vector<BoundEffect> hidden;
  double d = 0.0;
};

Series plan() {
  const std::string file = BALLBAR_SAMPLE_RUNS "/spindle-46h/measured.csv";
  const Series all = read_series(read_bytes(file, std::size_t{1} << 28), file);
  Series data;
  const std::vector<std::pair<std::string, std::string>> kept{{"speed_rpm", "speed_rpm"},
                                                              {"T16_degC", "T_room_degC"},
                                                              {"T4_degC", "T_coolant_degC"},
                                                              {"T5_degC", "T_bearing_degC"},
                                                              {"T3_degC", "T_housing_degC"}};
  constexpr std::size_t kEach = 5;
  const std::size_t rows = all.time_s.size() / kEach;
  for (std::size_t i = 0; i < rows; ++i) data.time_s.push_back(static_cast<double>(i) * 75.0);
  for (const auto& [from, to] : kept) {
    const Column& column = *find_column(all, from);
    Column mean{to, column.role, std::vector<double>(rows, 0.0)};
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < kEach; ++k) mean.values[i] += column.values[i * kEach + k] / kEach;
    }
    data.columns.push_back(std::move(mean));
  }
  return data;
}

// 4 h at one speed, 4 h at rest: the lines of the plan for which the room is known, the rest made to fit.
Series poor_plan(const Series& rich) {
  Series data;
  const std::size_t rows = 384;
  for (std::size_t i = 0; i < rows; ++i) data.time_s.push_back(static_cast<double>(i) * 75.0);
  std::vector<double> speed(rows), warm(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    speed[i] = i < rows / 2 ? 5000.0 : 0.0;
    const double into = (i < rows / 2 ? data.time_s[i] : data.time_s[i] - data.time_s[rows / 2]) / 1500.0;
    warm[i] = 25.0 + 8.0 * (i < rows / 2 ? 1.0 - std::exp(-into) : std::exp(-into));
  }
  std::vector<double> room(find_column(rich, "T_room_degC")->values);
  room.resize(rows);
  data.columns = {{"speed_rpm", Role::speed, speed},
                  {"T_room_degC", Role::ambient, room},
                  {"T_bearing_degC", Role::structure, warm}};
  return data;
}

std::vector<double> noise(std::size_t n, const Noisy& kind, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::student_t_distribution<double> student(4.0);
  const auto draw = [&] { return kind.heavy ? student(random) / std::sqrt(2.0) : normal(random); };
  std::vector<double> values(n);
  double last = normal(random);
  for (double& value : values) {
    value = last;
    last = kind.phi * last + std::sqrt(1.0 - kind.phi * kind.phi) * draw();
  }
  return values;
}

// Shapes anywhere between the second and the last but one of their grid, evenly in the logarithm.
std::vector<double> drawn_point(const Effect& effect, const Series& data, std::mt19937_64& random) {
  std::vector<double> point;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const Parameter& parameter : effect.parameters) {
    double value = parameter.start;
    if (parameter.kind == ParameterKind::gain) value = share(random) < 0.5 ? 1.0 : -1.0;
    if (parameter.kind == ParameterKind::shape && !parameter.held && parameter.grid.size() > 2) {
      const double low = std::max(parameter.grid[1], 1e-9), high = parameter.grid[parameter.grid.size() - 2];
      value = low * std::pow(high / low, share(random));
      if (low <= 0.0) value = low + share(random) * (high - low);
    }
    if (parameter.name == "onset_s") value = data.time_s.back() * (0.1 + 0.8 * share(random));
    if (parameter.name == "threshold_unit") value = 1.0 + 4.0 * share(random);
    if (parameter.name == "half_width_unit") value = 0.3 + 1.2 * share(random);
    point.push_back(value);
  }
  return point;
}

std::vector<double> signal_of(const BoundEffect& bound, const Series& data, const std::vector<double>& point) {
  EffectRows rows;
  rows.time_s = data.time_s;
  for (const std::string& name : bound.columns) rows.inputs.emplace_back(find_column(data, name)->values);
  std::vector<double> values(data.time_s.size());
  bound.effect->evaluate(rows, point.data(), values.data(), nullptr);
  return values;
}

// Norm of the whitened signal freed of the base model's columns.
double norm_of(const std::vector<double>& signal, const Fit& base, const Whitening& whitening) {
  Eigen::MatrixXd x(base.jacobian.rows(), base.jacobian.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const Eigen::VectorXd unit = base.jacobian.col(k) / std::max(base.jacobian.col(k).norm(), 1e-300);
    whitening.apply(unit.data(), 1, x.col(k).data(), 1);
  }
  Eigen::VectorXd white(x.rows());
  whitening.apply(signal.data(), 1, white.data(), 1);
  const Eigen::VectorXd left = white - x * x.completeOrthogonalDecomposition().solve(white);
  return left.norm();
}

struct Outcome {
  bool right = false, wrong = false, in_set = false, called = false;
  Verdict verdict = Verdict::nothing;
};

struct Cell {
  std::string name;
  int hidden = 1;
  double d = 10.0;
  Noisy noise;
  bool rich = true;
};

// Counts that a study of so many seeds may show without anything being wrong: three standard deviations and one more.
bool clearly_above(int count, int seeds, double share) {
  return count > share * seeds + 3.0 * std::sqrt(share * (1.0 - share) * seeds) + 1.0;
}

// What is measured now, with a margin; the aims are in the heading of the table.
bool clearly_missed(const Cell& cell, int wrong, int in_set, int called, int seeds) {
  if (cell.hidden == 0) return clearly_above(called, seeds, 0.05);
  if (cell.hidden > 1) return clearly_above(wrong, seeds, 0.15);
  return clearly_above(wrong, seeds, 0.05) || (cell.d >= 10.0 && clearly_above(seeds - in_set, seeds, 0.15));
}

const std::vector<std::string> kInputDriven{"expansion",         "lagged_expansion",   "centrifugal_shift",
                                            "cooling_asymmetry", "viscosity_feedback", "gradient_bending",
                                            "preload_loss",      "play_hysteresis"};
const std::vector<std::string> kTimeOnly{"linear_drift", "step", "settling", "day_cycle", "thermostat_cycle"};

Outcome outcome(const Cell& cell, const Series& plan, std::uint64_t seed, bool verbose) {
  std::mt19937_64 random(seed * 7919 + 13);
  Series data = plan;
  const std::size_t n = data.time_s.size();
  Model model;
  model.targets = {"y_um"};
  model.terms = {term_of("speed_heating", {"speed_rpm"})};
  std::vector<double> base = signal_of({model.terms[0].effect.get(), {"speed_rpm"}}, data, {2.0, 2500.0, 5.0 / 3.0});
  const std::vector<double> random_noise = noise(n, cell.noise, random);
  Noise truth{1e-6, 1.0, -75.0 / std::log(cell.noise.phi), 0.0};
  const Whitening whitening(truth, data.time_s, {});

  Column target{"y_um", Role::measured, base};
  data.columns.push_back(target);
  const Fit ideal = fit(model, data, 0, {.white = true});

  Truth hidden;
  for (int tries = 0; static_cast<int>(hidden.hidden.size()) < cell.hidden && tries < 200; ++tries) {
    const auto& names = kInputDriven;
    const std::string name = names[std::uniform_int_distribution<std::size_t>(0, names.size() - 1)(random)];
    const Effect& effect = *find_effect(name, Level::series);
    BoundEffect bound{&effect, {}};
    for (const Input& input : effect.inputs) {
      std::vector<std::string> choices;
      for (const Column& column : plan.columns) {
        const std::string unit(unit_of(column.name));
        const bool suits = std::find(input.units.begin(), input.units.end(), unit) != input.units.end();
        const bool taken = std::find(bound.columns.begin(), bound.columns.end(), column.name) != bound.columns.end();
        if (suits && !taken) choices.push_back(column.name);
      }
      if (choices.empty()) break;
      bound.columns.push_back(choices[std::uniform_int_distribution<std::size_t>(0, choices.size() - 1)(random)]);
    }
    if (bound.columns.size() != effect.inputs.size()) continue;
    if (name == "gradient_bending") {
      const auto mean = [&](const std::string& column) {
        double sum = 0.0;
        for (const double v : find_column(data, column)->values) sum += v;
        return sum;
      };
      if (mean(bound.columns[0]) < mean(bound.columns[1])) std::swap(bound.columns[0], bound.columns[1]);
    }
    if (std::find(hidden.hidden.begin(), hidden.hidden.end(), bound) != hidden.hidden.end()) continue;
    const std::vector<double> point = drawn_point(effect, data, random);
    const std::vector<double> signal = signal_of(bound, data, point);
    const double norm = norm_of(signal, ideal, whitening);
    double whole = 0.0;
    for (const double v : signal) whole = std::max(whole, std::abs(v));
    if (!(norm > 1e-3 * whole)) continue;
    for (std::size_t i = 0; i < n; ++i) base[i] += cell.d / norm * signal[i];
    hidden.hidden.push_back(bound);
  }
  for (std::size_t i = 0; i < n; ++i)
    data.columns.back().values[i] = std::round((base[i] + random_noise[i]) * 100.0) / 100.0;

  DiagnosisOptions options;
  options.seed = seed;
  const Diagnosis found = diagnose(model, data, 0, options);
  Outcome result;
  result.verdict = found.verdict;
  result.called =
      found.verdict == Verdict::named || found.verdict == Verdict::equivalent || found.verdict == Verdict::unexplained;
  const auto is_true = [&](const BoundEffect& bound) {
    return std::find(hidden.hidden.begin(), hidden.hidden.end(), bound) != hidden.hidden.end();
  };
  result.wrong = std::any_of(found.named.begin(), found.named.end(), [&](const BoundEffect& b) { return !is_true(b); });
  result.right = found.verdict == Verdict::named && found.equivalent.empty() &&
                 found.named.size() == hidden.hidden.size() && !result.wrong;
  result.in_set = std::all_of(hidden.hidden.begin(), hidden.hidden.end(), [&](const BoundEffect& truth_one) {
    if (std::find(found.named.begin(), found.named.end(), truth_one) != found.named.end()) return true;
    return std::any_of(found.equivalent.begin(), found.equivalent.end(), [&](const std::vector<BoundEffect>& group) {
      return std::find(group.begin(), group.end(), truth_one) != group.end();
    });
  });
  if (verbose) {
    std::string truths, named, equivalent;
    for (const BoundEffect& b : hidden.hidden) truths += label_of(b) + " ";
    for (const BoundEffect& b : found.named) named += label_of(b) + " ";
    for (const auto& group : found.equivalent) {
      equivalent += "{";
      for (const BoundEffect& b : group) equivalent += label_of(b) + " ";
      equivalent += "}";
    }
    fmt::print("{:4} {} truth [{}] {} named [{}] equivalent [{}] p {:.4f} smooth {:.1f}\n", seed,
               result.right    ? "RIGHT"
               : result.wrong  ? "WRONG"
               : result.in_set ? "inset"
                               : "miss ",
               truths, name_of(found.verdict), named, equivalent, found.p_anything, found.smooth_evidence);
    for (const std::string& reason : found.reasons) fmt::print("       {}\n", reason);
    for (const Candidate& c : found.candidates) {
      fmt::print(
          "       {:60} {:8.2f} evidence {:7.1f} threshold {:5.1f} p {:.4f} same {:.3f} held {:.3f}->{:.3f} fake "
          "{:.1f}\n",
          label_of(c.bound), c.amplitude_um, c.evidence, c.threshold, c.p_search, c.p_same_gain, c.held_out_before_um,
          c.held_out_after_um, c.best_fake_gain);
    }
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
  const std::vector<Cell> cells{
      {"nothing, AR 0.9", 0, 0.0, {0.9, false}},     {"nothing, AR 0.98", 0, 0.0, {0.98, false}},
      {"nothing, heavy tails", 0, 0.0, {0.9, true}}, {"one d=10, AR 0.9", 1, 10.0, {0.9, false}},
      {"one d=10, AR 0.98", 1, 10.0, {0.98, false}}, {"one d=7.5, AR 0.9", 1, 7.5, {0.9, false}},
      {"one d=5, AR 0.9", 1, 5.0, {0.9, false}},     {"two d=12, AR 0.9", 2, 12.0, {0.9, false}},
      {"three d=12, AR 0.9", 3, 12.0, {0.9, false}}, {"one d=10, poor", 1, 10.0, {0.9, false}, false},
  };
  const Series rich = plan();
  const Series poor = poor_plan(rich);
  const bool verbose = std::getenv("VERBOSE") != nullptr;
  bool missed = false;
  fmt::print("{:24} {:>6} {:>7} {:>7} {:>7} {:>7}\n", "cell", "seeds", "right", "wrong", "in set", "called");
  for (std::size_t c = 0; c < cells.size(); ++c) {
    bool wanted = argc <= 2;
    for (int k = 2; k < argc; ++k) wanted = wanted || std::atoi(argv[k]) == static_cast<int>(c);
    if (!wanted) continue;
    int right = 0, wrong = 0, in_set = 0, called = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Outcome one = outcome(cells[c], cells[c].rich ? rich : poor, static_cast<std::uint64_t>(seed), verbose);
      right += one.right;
      wrong += one.wrong;
      in_set += one.in_set;
      called += one.called;
    }
    const auto percent = [&](int count) { return fmt::format("{:.1f}", 100.0 * count / seeds); };
    fmt::print("{:24} {:>6} {:>7} {:>7} {:>7} {:>7}\n", cells[c].name, seeds, percent(right), percent(wrong),
               percent(in_set), percent(called));
    std::fflush(stdout);
    missed = missed || clearly_missed(cells[c], wrong, in_set, called, seeds);
  }
  return missed ? 1 : 0;
}
