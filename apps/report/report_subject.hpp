// Data that are looked at, with a model beside them that may change: opened once, computed once. `report` makes one
// report of it; a page keeps it, and asks for the parts that a step changes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "diagnose/revised_model.hpp"
#include "report/report_data.hpp"

namespace ballbar {

// A change of a model that nobody proposed.
struct HandChange {
  std::vector<std::string> removed;      // labels of effects
  std::vector<std::string> held, freed;  // EFFECT.PARAMETER=VALUE: held there; free from there
};

class ReportSubject {
 public:
  explicit ReportSubject(ReportRequest request);

  // Where there is a model, with its fit; search: and with what is missing from it.
  Report report(bool search);

  // Parts of a report, by its keys. Each throws Error where there is no target, or several.
  ModelPart fitted();                                       // the fit
  ModelPart found();                                        // what is missing
  HeldPart held(const std::vector<std::string>& settings);  // the fit with these values, as --set has them
  ModelPart add(const std::vector<std::string>& effects);   // the fit with them; its file stays as it was
  WithPart with(const std::vector<std::string>& effects);   // what add() would leave
  ModelPart change(const HandChange& change);               // the fit after it; its file stays as it was
  // What add() or change() changed, written to the file; an addition that the data do not support is taken back, but
  // for keep.
  RevisedPart revise(const std::string& file, bool keep);
  void take_back();                                                             // what add() or change() changed
  EffectChoices choices();                                                      // what could be added
  Hypotheses compare(const std::vector<std::vector<std::string>>& hypotheses);  // effects of each; the model stays
  ModelText text_as_fitted();                                                   // of the model's file

  // Whether the request is of these data, read as they were, none of whose files has changed since.
  bool is_of(const ReportRequest& request) const;
  // Another target or model of the same data; a model whose file has changed is read anew.
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
  std::vector<std::filesystem::path> files() const;  // that a report is made of

  ReportRequest request_, given_;  // with folders as the files in them; as it came
  ReportData data_;
  std::vector<Mark> marks_;
  std::vector<std::string> targets_;
  std::vector<std::unique_ptr<RevisedModel>> models_;  // of each target; null: it cannot be fitted
  std::vector<std::string> faults_;                    // of each target, why
};

}  // namespace ballbar
