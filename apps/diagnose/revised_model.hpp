// The file of a model with data: its text and its workbench are revised together. The caller writes the text to the
// file after success.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "ballbar/workbench/workbench.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// The options without the name of a model file that does not exist yet.
ModelOptions readable(ModelOptions options);

class RevisedModel {
 public:
  // model: that of the file in the options, with one target. `text` is that of the file, or a new one if there is no
  // file. Throws Error with the faulty file.
  RevisedModel(const ModelOptions& options, const std::shared_ptr<const ModelData>& data, const Model& model,
               DiagnosisOptions diagnosis = {});

  bool is_new() const { return is_new_; }  // its file does not exist yet
  const std::string& text() const { return text_; }
  Workbench& bench() { return bench_; }
  const Model& model() const { return bench_.model(); }

  // Adds these effects to the model, replacing those with the labels `replaced`. The file does not change before
  // revise(). Throws Error for a label that the file does not have.
  void add(const std::vector<Term>& terms, const std::vector<std::string>& replaced = {});

  // Removes the effects with these labels and sets these settings, one per parameter of each term. The file does not
  // change before revise(). Throws Error as add() does.
  void remove(const std::vector<std::string>& labels);
  void set(Model model);

  // Writes the change as a revision of the file, without a test. Returns the row.
  LedgerRow revise_by_hand();
  bool is_by_hand() const { return !by_hand_.empty(); }  // false: an effect was added, which revise() tests

  // The text of the file with the fitted values as starts. Undetermined parameters keep their starts; with several
  // targets all do.
  std::string text_as_fitted();

  // Writes the added effects as a revision of the file, with their test in the row. prune: remove earlier effects that
  // are no longer needed. named: the effects were found by a diagnosis, not chosen.
  struct Choice {
    bool prune = false;
    bool named = false;
  };
  EffectTest revise(const Choice& choice);
  EffectTest revise() { return revise({}); }

  // Returns to the model before the last addition, which has no revision yet.
  void take_back();

  // Returns to the revision with this text, with all its results; false: there is none.
  bool go_back_to(const std::string& text);

  // Sets another text with the same model, such as that of a grown model.
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
  std::size_t not_in_file_ = 0;  // number of leading terms of the model that are not in the file
  std::vector<std::string> replaced_;
  std::vector<std::size_t> removed_;  // effects of the file that were replaced
  std::vector<std::string> by_hand_;  // changes without a test, as a row of the ledger has them
  std::size_t steps_ = 0;             // of the workbench since the last revision
  std::vector<Revision> revisions_;
};

}  // namespace ballbar
