// One model beside one data set, and the results computed from both: the fit, where it fails, which effect is missing,
// what an added effect changed.
//
// The loop of ballbar in five calls:
//
//   Workbench bench(data, model);
//   bench.check();                            the fit and the rows where it fails
//   bench.diagnosis();                        the effect that is missing, or that the data cannot tell
//   bench.add({term_of("lagged_expansion", {"T_front_degC"})});
//   bench.added();                            RMSE before and after, evidence, effects still needed
//   bench.undo();
//
// A result is computed on first request and kept with its model. undo() brings back the previous model with its
// results. All figures of one model are those of one posterior, so that the numbers of diagnosis(), effect_test() and
// added() agree.
//
// The workbench reads, writes and prints nothing. Use one workbench from one thread at a time; two workbenches in two
// threads share no state. A long call is ended by an Interruption (internal/numerics), and the workbench stays as it
// was.
//
// Cost: check() is a fit, O(rows). diagnosis() is seconds for thousands of rows and tens of columns, because at most
// 1000 values of the target are used. effect_test() costs about a diagnosis, once for a model.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/revision/revision.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct FittedModel;
struct Inference;

// The fit of a model, the groups of rows where it fails most, and a test whether its residual is white.
struct ResidualReport {
  Fit fit;
  std::vector<Misfit> where;
  Whiteness whiteness;
  std::vector<ColumnFault> faults;  // of a series: those that bear on what is said of the target
  std::vector<Coefficient> coefficients;
};

// Fits one target of the model (an index into model.targets). Throws Error as fit() does.
ResidualReport residual_report_of(const Model& model, const Series& data, std::size_t target,
                                  const FitOptions& options);

struct WorkbenchOptions {
  FitOptions fit;              // for check()
  DiagnosisOptions diagnosis;  // `where` is ignored: the workbench fills it in
};

// The results are references that stay valid until the model changes: until add(), replace() or undo().
class Workbench {
 public:
  // Works on the model's first target.
  Workbench(std::shared_ptr<const Series> data, Model model, WorkbenchOptions options = {});
  Workbench(Workbench&& other) noexcept;
  Workbench& operator=(Workbench&& other) noexcept;
  ~Workbench();

  const Series& data() const;
  const Model& model() const;

  // The functions below throw Error as fit() does. The workbench is unchanged after an error.
  const ResidualReport& check();
  const Diagnosis& diagnosis();
  // How much a regression on all effects predicts beyond the model; nullopt where the data allow no regression.
  const std::optional<Predictability>& predictability();
  // RMSE in um of the model with these terms added. Does not change the model.
  double rmse_um_with(const std::vector<Term>& terms);
  // What adding these terms would change. Does not change the model.
  EffectTest effect_test(const std::vector<Term>& terms);

  // Adds these terms to the model. Their shape parameters start at the most likely values, so that a later fit of the
  // model equals the fit in added(). Throws Error where a term does not suit the data (expect_suits), or as fit() does.
  void add(const std::vector<Term>& terms);
  // The test of the terms that were added last.
  const EffectTest& added();
  // The ledger's row of the current model, or of the model `back` steps earlier.
  LedgerRow row(std::size_t back = 0);
  // Sets another model, such as one with an effect removed.
  void replace(Model model);
  // Returns to the model before the last add() or replace(). Returns false where there is none.
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
