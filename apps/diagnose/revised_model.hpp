// A model's file beside data: its text and its workbench go from revision to revision together. What it holds is
// written by who has it, when all went well.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "ballbar/workbench/workbench.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// The options without the name of a file that is not there yet: there is nothing to read.
ModelOptions readable(ModelOptions options);

class RevisedModel {
 public:
  // model: of the options' file, of one target. `text` is that of the file, begun anew where there is none yet. Throws
  // Error with the file that is at fault.
  RevisedModel(const ModelOptions& options, const std::shared_ptr<const ModelData>& data, const Model& model,
               DiagnosisOptions diagnosis = {});

  bool is_new() const { return is_new_; }  // its file is not there yet
  const std::string& text() const { return text_; }
  Workbench& bench() { return bench_; }
  const Model& model() const { return bench_.model(); }

  // The model with these effects, in the place of those of the labels `replaced`; its file stays until revise().
  // Throws Error where a label is none of the file's.
  void add(const std::vector<Term>& terms, const std::vector<std::string>& replaced = {});

  // The model without the effects of these labels, and with these settings, one for each parameter of each term, in
  // the place of its own; its file stays until revise(). Throws as add().
  void remove(const std::vector<std::string>& labels);
  void set(Model model);

  // What was changed becomes a revision of the file, without a test of it. Returns the row.
  LedgerRow revise_by_hand();
  bool is_by_hand() const { return !by_hand_.empty(); }  // else an effect was added, which revise() tests

  // The text of the file with fitted values to start from; those that are not determined stay, and of several targets
  // all do.
  std::string text_as_fitted();

  // What was added becomes a revision of the file, its row with the test. prune: earlier effects that are no longer
  // needed are taken out. named: they were found by a diagnosis, not chosen.
  struct Choice {
    bool prune = false;
    bool named = false;
  };
  EffectTest revise(const Choice& choice);
  EffectTest revise() { return revise({}); }

  // The model before what was added last, of which there is no revision yet.
  void take_back();

  // The revision that had this text, with all that was computed of it; false: none had.
  bool go_back_to(const std::string& text);

  // Another text, with the same model, such as one of a model that was grown.
  void set_text(std::string text) { text_ = std::move(text); }

 private:
  std::vector<std::size_t> taken_out(const std::vector<std::string>& labels, Model& model) const;
  std::vector<Term> terms_in_file() const;
  std::vector<std::string> data_names() const;
  void put_text(std::string text);

  struct Revision {
    std::string text;       // before it
    std::size_t steps = 0;  // of the workbench
  };

  ModelOptions options_;
  bool is_new_ = false;
  Workbench bench_;
  std::string text_;
  std::size_t not_in_file_ = 0;  // terms at the front of the model that the file does not name
  std::vector<std::string> replaced_;
  std::vector<std::size_t> removed_;  // effects of the file that were replaced
  std::vector<std::string> by_hand_;  // changes without a test, as a row of the ledger has them
  std::size_t steps_ = 0;             // of the workbench since the last revision
  std::vector<Revision> revisions_;
};

}  // namespace ballbar
