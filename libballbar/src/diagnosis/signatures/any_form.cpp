#include "diagnosis/signatures/any_form.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"
#include "effects/low_pass.hpp"
#include "model/measured_input.hpp"

namespace ballbar {
namespace {

constexpr std::array<double, 3> kFormLagsSquared_s{300.0, 2000.0, 10000.0};
constexpr std::array<double, 5> kFormLagsOfSquare_s{0.0, 200.0, 700.0, 2500.0, 8000.0};
constexpr std::array<double, 8> kFormLags_s{0.0, 120.0, 300.0, 800.0, 2000.0, 5000.0, 12000.0, 30000.0};  // of any form

// The input since its first row over its range, and its square, behind low passes; the square of what is behind one.
std::vector<Eigen::VectorXd> forms_of(const std::vector<double>& time_s, const std::vector<double>& values,
                                      const std::vector<std::size_t>& rows) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double range = *high - *low;
  const std::vector<RowRange> runs = runs_of(time_s);
  std::vector<Eigen::VectorXd> forms;
  std::vector<double> passed(values.size());
  const auto add = [&](bool is_squared, double tau_s) {
    for (const RowRange& run : runs) {
      const auto input = [&](std::size_t i) {
        const double u = (values[run.begin + i] - values.front()) / range;
        return is_squared ? u * u : u;
      };
      low_pass<double>(std::span(time_s).subspan(run.begin, run.end - run.begin), input, tau_s,
                       passed.data() + run.begin);
    }
    Eigen::VectorXd column(static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) column[static_cast<Eigen::Index>(i)] = passed[rows[i]];
    forms.push_back(std::move(column));
  };
  for (const double tau_s : kFormLags_s) add(false, tau_s);
  for (const double tau_s : kFormLagsOfSquare_s) add(true, tau_s);
  for (const double tau_s : kFormLagsSquared_s) {
    add(false, tau_s);
    forms.back() = forms.back().cwiseProduct(forms.back().cwiseAbs());
  }
  return forms;
}

}  // namespace

const Effect& any_form() {
  static const Effect effect{"any form", Level::series, {}, {{"input", {}, "an input whose form is open"}}, {}, {}};
  return effect;
}

void add_any_forms(SignatureLibrary& library, const Series& data, const std::vector<std::size_t>& rows) {
  std::vector<std::string> inputs;
  for (const Family& family : library.families) {
    for (const std::string& name : family.bound.columns) {
      if (std::find(inputs.begin(), inputs.end(), name) == inputs.end()) inputs.push_back(name);
    }
  }
  for (const std::string& name : inputs) {
    const std::vector<double> values = input_values(data, *find_column(data, name));
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) continue;
    if (!(*std::max_element(values.begin(), values.end()) > *std::min_element(values.begin(), values.end()))) continue;
    const std::vector<Eigen::VectorXd> forms = forms_of(data.time_s, values, rows);
    const Eigen::Index first = library.columns.cols();
    library.columns.conservativeResize(Eigen::NoChange, first + static_cast<Eigen::Index>(forms.size()));
    for (std::size_t k = 0; k < forms.size(); ++k) library.columns.col(first + static_cast<Eigen::Index>(k)) = forms[k];
    library.families.push_back({{&any_form(), {name}}, library.signatures.size(), 1});
    library.signatures.push_back(
        {library.families.size() - 1, {}, first, static_cast<Eigen::Index>(forms.size()), 1.0});
  }
}

}  // namespace ballbar
