// The data of a report with a model that may change, opened and computed once. `report` makes one report of it. A page
// keeps it and requests the parts that a step changes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "diagnose/revised_model.hpp"
#include "report/report_data.hpp"

namespace ballbar {

// A change of the model by the user.
struct HandChange {
  std::vector<std::string> removed;      // labels of effects
  std::vector<std::string> held, freed;  // EFFECT.PARAMETER=VALUE: held there; free from there
};

class ReportSubject {
 public:
  explicit ReportSubject(ReportRequest request);

  // The report, with the fit if there is a model; search: also with the diagnosis.
  Report report(bool search);

  // Parts of a report, by its keys. Each throws Error if there is not exactly one target.
  ModelPart fitted();                                                 // the fit
  ModelPart found();                                                  // the diagnosis
  Targets<CheckPart> held(const std::vector<std::string>& settings);  // the fit with these values, as --set has them
  ModelPart add(const std::vector<std::string>& effects);             // the fit with them; the file does not change
  double with(const std::vector<std::string>& effects);               // the RMSE after add()
  ModelPart change(const HandChange& change);                         // the fit after it; the file does not change
  // Writes the result of add() or change() to the file. Reverts an addition that the data do not support, unless keep.
  RevisedPart revise(const std::string& file, bool keep);
  void take_back();                                                             // reverts add() or change()
  std::vector<EffectChoice> choices();                                          // effects that can be added
  Hypotheses compare(const std::vector<std::vector<std::string>>& hypotheses);  // effects of each; the model stays
  std::string text_as_fitted();                                                 // of the model's file

  // Whether the request is for the same data with the same recipe, and no file has changed since.
  bool is_of(const ReportRequest& request) const;
  // Sets another target or model for the same data; reads a changed model file again.
  void look_at(const ReportRequest& request);

 private:
  using Mark = std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>;
  enum class Parts { fitted, all };

  std::vector<Mark> marks() const;
  void open_model_file();
  RevisedModel& only_one();
  void add_model(ModelPart& made, Parts parts);
  void add_target(ModelPart& made, RevisedModel& model, Parts parts);
  ModelPart of_model(Parts parts);
  std::vector<std::filesystem::path> files() const;  // all files of the report

  ReportRequest request_, given_;  // with folders replaced by their files; as given
  ReportData data_;
  std::vector<Mark> marks_;
  std::vector<std::string> targets_;
  std::vector<std::unique_ptr<RevisedModel>> models_;  // of each target; null: it cannot be fitted
  std::vector<std::string> faults_;                    // of each target, why
};

}  // namespace ballbar
