#include "model/expression_linearity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMadeUpRows = 12;
constexpr int kDraws = 2;
constexpr double kTolerance = 1e-9;  // of the values: rounding only

class Random {
 public:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_{20150302};
};

// Values as a column of that name could have.
std::vector<double> made_up(const std::string& column, Random& random) {
  const std::string_view unit = unit_of(column);
  std::vector<double> values(kMadeUpRows);
  for (double& value : values) {
    value = unit == "degC"  ? random.between(15.0, 40.0)
            : unit == "rpm" ? random.between(0.0, 20000.0)
                            : random.between(0.1, 10.0);
  }
  return values;
}

class Prober {
 public:
  Prober(const std::vector<Parameter>& parameters, std::span<const Input> inputs, const Values& values)
      : parameters_(parameters), values_(values) {
    double now_s = 0.0;
    for (std::size_t i = 0; i < kMadeUpRows; ++i) time_s_.push_back(now_s += random_.between(1.0, 600.0));
    for (const Input& input : inputs) inputs_.push_back(made_up(input.role, random_));
    rows_.time_s = time_s_;
    for (const std::vector<double>& input : inputs_) rows_.inputs.emplace_back(input);
  }

  bool is_straight_in(std::size_t k) {
    const Parameter& parameter = parameters_[k];
    std::vector<double> tried{2.0, -1.0, 7.3, 29.7, 1e3, 1e5, -1e4, parameter.start};
    if (std::isfinite(parameter.lower)) tried.push_back(parameter.lower);
    if (std::isfinite(parameter.upper)) tried.push_back(parameter.upper);
    if (std::isfinite(parameter.lower) && std::isfinite(parameter.upper)) {
      tried.push_back(0.5 * (parameter.lower + parameter.upper));
    }
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<double> p = drawn();
      p[k] = 0.0;
      const std::vector<double> at_0 = run(p);
      p[k] = 1.0;
      const std::vector<double> at_1 = run(p);
      for (const double q : tried) {
        p[k] = q;
        const std::vector<double> at_q = run(p);
        for (std::size_t i = 0; i < kMadeUpRows; ++i) {
          const double off = at_q[i] - at_0[i] - q * (at_1[i] - at_0[i]);
          const double size = std::abs(at_q[i]) + (1.0 + std::abs(q)) * (std::abs(at_0[i]) + std::abs(at_1[i]));
          if (!(std::abs(off) <= kTolerance * size)) return false;
        }
      }
    }
    return true;
  }

  // The slope in k does not depend on the gains.
  bool is_straight_with(std::size_t k, const std::vector<std::size_t>& gains) {
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<double> p = drawn();
      const auto at = [&](double value) {
        p[k] = value;
        return run(p);
      };
      const std::vector<double> here_0 = at(0.0), here_1 = at(1.0);
      for (const std::size_t gain : gains) p[gain] = random_.between(-3.0, 3.0);
      const std::vector<double> there_0 = at(0.0), there_1 = at(1.0);
      for (std::size_t i = 0; i < kMadeUpRows; ++i) {
        const double off = (there_1[i] - there_0[i]) - (here_1[i] - here_0[i]);
        const double size = std::abs(there_1[i]) + std::abs(there_0[i]) + std::abs(here_1[i]) + std::abs(here_0[i]);
        if (!(std::abs(off) <= kTolerance * size)) return false;
      }
    }
    return true;
  }

 private:
  std::vector<double> drawn() {
    std::vector<double> p;
    for (const Parameter& parameter : parameters_) {
      const double near = parameter.start == 0.0 ? 1.0 : parameter.start;
      p.push_back(near * random_.between(0.5, 2.0));
      if (p.back() > parameter.upper) p.back() = parameter.upper;
      if (p.back() < parameter.lower) p.back() = parameter.lower;
    }
    return p;
  }

  std::vector<double> run(const std::vector<double>& p) {
    std::vector<double> out(kMadeUpRows);
    values_(rows_, p.data(), out.data());
    return out;
  }

  const std::vector<Parameter>& parameters_;
  const Values& values_;
  Random random_;
  std::vector<double> time_s_;
  std::vector<std::vector<double>> inputs_;
  EffectRows rows_;
};

}  // namespace

void find_kinds(std::vector<Parameter>& parameters, std::span<const Input> inputs, const Values& values) {
  Prober prober(parameters, inputs, values);
  std::vector<std::size_t> gains;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const bool gain = prober.is_straight_in(k) && prober.is_straight_with(k, gains);
    parameters[k].kind = gain ? ParameterKind::gain : ParameterKind::shape;
    if (gain) gains.push_back(k);
  }
}

}  // namespace ballbar
