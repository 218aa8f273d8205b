// A workbench whose results are arrays: the fit of one target, what it lacks, what effects would change.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/internal/fit/held_model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "diagnose/revision_results.hpp"
#include "model/model_options.hpp"
#include "model/other_data.hpp"
#include "model/residual_report.hpp"
#include "python/arrays.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

std::vector<Source> sources_of(const std::vector<std::string>& places, const std::map<std::string, Data>& held) {
  std::vector<Source> sources;
  for (const std::string& place : places) {
    const auto value = held.find(place);
    sources.push_back(value == held.end() ? Source(place) : source_of(place, value->second));
  }
  return sources;
}

ModelOptions expect_data(ModelOptions options) {
  if (options.data.empty()) throw Error("data: expected a table, a path or recordings, found none.");
  return options;
}

// A model of one target beside its data. Its fit is kept; what else is asked is computed anew.
class Bench {
  template <class Work>
  decltype(auto) of_data(Work work) const {
    return with_source(options_.data.front().name(), work);
  }

 public:
  explicit Bench(ModelOptions options)
      : options_(expect_data(std::move(options))), data_(std::make_shared<const ModelData>(open_data(options_))) {
    const Model model = open_model(options_, *data_);
    if (model.targets.size() != 1) {
      throw Error(fmt::format("target: expected one, found {}; fit(..., target=...) chooses one, fit_all() fits each.",
                              fmt::join(model.targets, ", ")));
    }
    model_ = of_one_target(model, options_, *data_->series, 0);
  }

  [[nodiscard]] const std::string& target() const { return model_.targets.front(); }
  [[nodiscard]] std::vector<std::string> labels() const {
    std::vector<std::string> labels;
    for (const Term& term : model_.terms) labels.push_back(label_of(term));
    return labels;
  }

  // nullptr: recordings. The class of Python, which is bound to what may change, changes none.
  [[nodiscard]] std::shared_ptr<Series> series() const {
    return data_->level == Level::series ? std::const_pointer_cast<Series>(data_->series) : nullptr;
  }

  // Computed once; two threads that ask first compute the same, and one of them is kept. No lock is held meanwhile: an
  // effect of Python may ask its own fit.
  std::shared_ptr<const ResidualReport> check() {
    if (const auto known = report_.load()) return known;
    Workbench bench = workbench();
    const auto report = std::make_shared<const ResidualReport>(of_data([&] { return bench.check(); }));
    report_ = report;
    return report;
  }

  // The JSON, and what is best added as the text of a model.
  [[nodiscard]] std::pair<nlohmann::ordered_json, std::string> diagnose(const DiagnoseOptions& how) const {
    Workbench bench = workbench(how);
    const DiagnosisReport report = diagnosis_report_of(options_, bench);
    Model best;
    best.level = model_.level;
    best.targets = model_.targets;
    for (const BoundEffect& bound : best_of(report.diagnosis))
      best.terms.push_back(as_diagnosed(bound, report.diagnosis));
    return {json_of(report), write_model(best)};
  }

  // The terms of another model's text, added to this one.
  nlohmann::ordered_json test(const std::string& text, const Effects& effects) {
    Workbench bench = workbench();
    const std::vector<Term> terms = read_model(text, "effects", catalogue_with(effects)).terms;
    EffectTest tested = of_data([&] { return bench.effect_test(terms); });
    tested.after.data = names_of(options_.data);
    return json_of(tested);
  }

  // Of other data, with their times, by the parameters of the fit, or as all of them are held.
  std::pair<std::vector<double>, Prediction> predict(const std::vector<std::string>& places,
                                                     const std::map<std::string, Data>& held, bool fitted) {
    if (!fitted && has_free(model_)) {
      throw Error("model: expected all parameters to be held, found one that is free; fit(...).predict() fits it.");
    }
    ModelOptions elsewhere = options_;
    elsewhere.data = sources_of(places, held);
    const OtherData other = open_other(expect_data(std::move(elsewhere)), model_, *data_, options_.data);
    return {other.data.series->time_s, predicted(other)};
  }

  // Of the data of the fit.
  std::pair<std::vector<double>, Prediction> predict() {
    return {data_->series->time_s, predicted(of_its_own(*data_))};
  }

 private:
  Prediction predicted(const OtherData& other) {
    const std::shared_ptr<const ResidualReport> report = has_free(model_) ? check() : nullptr;
    const std::vector<FittedParameter> parameters = report ? report->fit.parameters : held_parameters(model_);
    const Eigen::MatrixXd* const covariance = report ? &report->fit.covariance : nullptr;
    Prediction prediction =
        with_source(other.data.title, [&] { return ballbar::predict(model_, parameters, other, covariance); });
    prediction.sigma_um.resize(prediction.predicted_um.size(), std::nan(""));
    return prediction;
  }

  [[nodiscard]] Workbench workbench(const DiagnoseOptions& how = {}) const {
    DiagnosisOptions options = diagnosis_options(how, target());
    options.search.so_far = nullptr;  // who is told of progress reads texts
    return workbench_of(options_, data_, model_, std::move(options));
  }

  ModelOptions options_;
  std::shared_ptr<const ModelData> data_;
  Model model_;
  std::atomic<std::shared_ptr<const ResidualReport>> report_;
};

py::array whole_numbers(const std::vector<std::size_t>& values) {
  return py::array_t<std::size_t>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::list arrays_of(std::vector<std::vector<double>> all) {
  py::list list;
  for (std::vector<double>& one : all) list.append(array_of(std::move(one)));
  return list;
}

// Of the readings that are kept, with the noise of the fit.
double fit_log_likelihood(const Fit& fit) {
  const auto kept = [&](const std::vector<double>& values) {
    std::vector<double> some;
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (!std::binary_search(fit.discounted.begin(), fit.discounted.end(), row)) some.push_back(values[row]);
    }
    return some;
  };
  return log_likelihood(fit.noise, kept(fit.time_s), kept(fit.residual_um), kept(fit.sigma_um));
}

py::dict arrays_of(const Fit& fit) {
  py::dict arrays;
  arrays["row"] = whole_numbers(fit.row);
  arrays["discounted"] = whole_numbers(fit.discounted);
  arrays["time_s"] = array_of(fit.time_s);
  arrays["elapsed_s"] = array_of(one_after_another(fit.time_s));
  arrays["measured_um"] = array_of(fit.measured_um);
  arrays["predicted_um"] = array_of(fit.predicted_um);
  arrays["residual_um"] = array_of(fit.residual_um);
  arrays["stated_sigma_um"] = array_of(fit.sigma_um);
  arrays["log_likelihood"] = fit_log_likelihood(fit);
  arrays["contribution_um"] = arrays_of(fit.contribution_um);
  arrays["covariance"] = py::cast(fit.covariance);
  return arrays;
}

}  // namespace

void bind_bench(py::module_& module) {
  using Places = std::vector<std::string>;
  using Held = std::map<std::string, Data>;
  py::class_<Bench, std::shared_ptr<Bench>>(module, "Bench")
      .def_property_readonly("target", &Bench::target)
      .def_property_readonly("labels", &Bench::labels)
      .def_property_readonly(
          "series", [](const Bench& bench) { return bench.series(); }, "That was fitted; None of recordings.")
      .def("check",
           [](Bench& bench, const py::object& progress) {
             Listener listener(progress);
             std::shared_ptr<const ResidualReport> report;
             const nlohmann::ordered_json json = listener.hear([&] {
               report = bench.check();
               return json_of(*report);
             });
             return py::make_tuple(to_python(json), arrays_of(report->fit), listener.remarks);
           })
      .def("diagnose",
           [](Bench& bench, double tolerance_um, std::optional<std::size_t> most_rows, const py::object& progress) {
             DiagnoseOptions how;
             how.diagnosis.tolerance_um = tolerance_um;
             if (most_rows) how.diagnosis.most_rows = *most_rows;
             Listener listener(progress);
             const auto [json, best] = listener.hear([&] { return bench.diagnose(how); });
             return py::make_tuple(to_python(json), best, listener.remarks);
           })
      .def("test",
           [](Bench& bench, const std::string& text, const Effects& effects, const py::object& progress) {
             Listener listener(progress);
             const nlohmann::ordered_json json = listener.hear([&] { return bench.test(text, effects); });
             return py::make_tuple(to_python(json), listener.remarks);
           })
      .def("predict", [](Bench& bench, const std::optional<Places>& places, const Held& held, bool fitted,
                         const py::object& progress) {
        Listener listener(progress);
        auto [time_s, found] =
            listener.hear([&] { return places ? bench.predict(*places, held, fitted) : bench.predict(); });
        return py::make_tuple(array_of(std::move(time_s)), array_of(std::move(found.predicted_um)),
                              array_of(std::move(found.sigma_um)), arrays_of(std::move(found.contribution_um)),
                              listener.remarks);
      });
  module.def(
      "bench",
      [](const Places& places, const Held& held, const std::string& text, const Effects& effects,
         const std::vector<std::string>& target, const std::vector<std::string>& also_input,
         const std::vector<std::string>& set, std::optional<double> max_gap_s, bool robust, bool white,
         const py::object& progress) {
        ModelOptions options;
        options.data = sources_of(places, held);
        if (!text.empty()) options.model = Source::of_text("model", text);
        options.catalogue = catalogue_with(effects);
        options.target = target;
        options.also_input = also_input;
        options.set = set;
        options.max_gap_s = max_gap_s;
        options.robust = robust;
        options.white = white;
        options.carries_unit = true;
        Listener listener(progress);
        const auto bench = listener.hear([&] { return std::make_shared<Bench>(std::move(options)); });
        return py::make_tuple(bench, listener.remarks);
      },
      py::arg("places"), py::arg("held"), py::arg("model"), py::arg("effects"), py::kw_only(), py::arg("target"),
      py::arg("also_input"), py::arg("set"), py::arg("max_gap_s"), py::arg("robust"), py::arg("white"),
      py::arg("progress") = py::none());
}

}  // namespace ballbar::python
