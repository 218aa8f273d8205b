// A model beside data, and what was computed from both: the fit, where it fails, what is missing, what an added effect
// changed. Each is computed when it is first asked for, and kept as long as the model is that one; a model that comes
// back by undo() has its results still. Results are values: nothing is read, written or printed.
//
// A workbench is used by one thread at a time; two in two threads do not meet.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/fit/residual.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/predict/predictability.hpp"
#include "ballbar/revision/effect_test.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct FittedModel;
struct Inference;

// A model fitted, and where it fails.
struct ResidualReport {
  Fit fit;
  std::vector<Misfit> where;
  Whiteness whiteness;
};

// Of one target of the model. Throws Error as fit does.
ResidualReport residual_report_of(const Model& model, const Series& data, std::size_t target,
                                  const FitOptions& options);

struct WorkbenchOptions {
  FitOptions fit;              // of check()
  DiagnosisOptions diagnosis;  // where: not used, the workbench knows
};

class Workbench {
 public:
  // Of the model's first target.
  Workbench(std::shared_ptr<const Series> data, Model model, WorkbenchOptions options = {});
  Workbench(Workbench&& other) noexcept;
  Workbench& operator=(Workbench&& other) noexcept;
  ~Workbench();

  const Series& data() const;
  const Model& model() const;

  // Each throws Error as fit does, and then is as it was.
  const ResidualReport& check();
  const Diagnosis& diagnosis();
  // What a regression on every effect predicts that the model does not; nothing where none can be made.
  const std::optional<Predictability>& predictability();
  // The RMSE that add() would leave; the model stays.
  double rmse_um_with(const std::vector<Term>& terms);
  // What the effects would change; the model stays.
  EffectTest effect_test(const std::vector<Term>& terms);

  // The model with these effects. Throws Error where they do not suit the data (expect_suits), or as fit does. Their
  // shapes begin where they are likeliest, so that a fit of the model is the fit that added() tells.
  void add(const std::vector<Term>& terms);
  // What was added last.
  const EffectTest& added();
  // The figures of the model as the ledger has them; back: of the model so many steps before.
  LedgerRow row(std::size_t back = 0);
  // Another model, such as one with effects taken out.
  void replace(Model model);
  // The model before the last add() or replace(); false: there is none.
  bool undo();

 private:
  struct Step;
  Step& now() const;
  std::unique_ptr<Step> step_with(const std::vector<Term>& terms);
  const Fit& plain_fit(Step& step) const;
  FittedModel fitted(Step& step) const;
  Inference& inference(Step& step) const;

  std::shared_ptr<const Series> data_;
  WorkbenchOptions options_;
  std::vector<std::unique_ptr<Step>> steps_;
};

}  // namespace ballbar
