#include "diagnose/revised_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "model/residual_report.hpp"

namespace ballbar {
namespace {

// Without a file, or with the name of one that is not there.
bool is_new_model(const ModelOptions& options) {
  std::error_code error;  // told where it is read
  if (options.model.empty()) return true;
  return options.model.is_path() &&
         std::filesystem::symlink_status(options.model.path(), error).type() == std::filesystem::file_type::not_found;
}

// Of its file before any effect is added: a line that says what made it, level and targets.
std::string new_model_text(const Model& model) {
  Model start;
  start.level = model.level;
  start.targets = model.targets;
  return fmt::format("# Made by ballbar add: what is below, and {}.\n{}", start_of(model.level), write_model(start));
}

}  // namespace

ModelOptions readable(ModelOptions options) {
  if (is_new_model(options)) options.model = {};
  return options;
}

RevisedModel::RevisedModel(const ModelOptions& options, const std::shared_ptr<const ModelData>& data,
                           const Model& model, DiagnosisOptions diagnosis)
    : options_(options),
      is_new_(is_new_model(options)),
      bench_(workbench_of(readable(options), data, model, std::move(diagnosis))),
      text_(is_new_ ? new_model_text(model) : options.model.bytes(kLargestText)),
      not_in_file_(model.terms.size() - read_model(text_, options.model.name(), options.catalogue).terms.size()) {
  static_cast<void>(read_ledger(text_, options_.model.name()));
}

// Takes the effects out; their numbers in the file, rising.
std::vector<std::size_t> RevisedModel::taken_out(const std::vector<std::string>& labels, Model& model) const {
  std::vector<std::size_t> places;
  for (const std::string& label : labels) {
    const auto at =
        std::find_if(model.terms.begin(), model.terms.end(), [&](const Term& term) { return label_of(term) == label; });
    const auto place = static_cast<std::size_t>(at - model.terms.begin());
    if (at == model.terms.end() || place < not_in_file_) {
      std::vector<std::string> known;
      for (std::size_t t = not_in_file_; t < model.terms.size(); ++t) known.push_back(label_of(model.terms[t]));
      throw CLI::ValidationError("--replace", fmt::format("expected an effect of {}, one of {}, found {}",
                                                          options_.model.name(), fmt::join(known, ", "), label));
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    model.terms.erase(model.terms.begin() + static_cast<std::ptrdiff_t>(*place));
  for (std::size_t& place : places) place -= not_in_file_;
  return places;
}

void RevisedModel::add(const std::vector<Term>& terms, const std::vector<std::string>& replaced) {
  replaced_ = replaced;
  removed_.clear();
  if (!replaced.empty()) {
    Model rest = bench_.model();
    removed_ = taken_out(replaced, rest);
    bench_.replace(std::move(rest));
    ++steps_;
  }
  with_source(options_.data.front().name(), [&] { bench_.add(terms); });
  ++steps_;
}

EffectTest RevisedModel::revise(const Choice& choice) {
  EffectTest tried = with_source(options_.data.front().name(), [&] { return bench_.added(); });
  const std::size_t added = tried.added.size();
  for (const std::string& label : replaced_) tried.after.change += ", - " + label;
  std::vector<std::size_t> removed = removed_;
  if (choice.prune) {
    Pruned smaller = with_source(options_.data.front().name(), [&] { return pruned(std::move(tried), bench_.data()); });
    tried = std::move(smaller.effect_test);
    for (std::size_t term : smaller.removed) {
      term -= not_in_file_;
      for (const std::size_t gone : removed_) term += gone <= term ? 1 : 0;
      removed.insert(std::upper_bound(removed.begin(), removed.end(), term), term);
    }
    if (!smaller.removed.empty()) {
      bench_.replace(tried.model);
      ++steps_;
    }
  }
  if (choice.named) tried.after.verdict = name_of(Verdict::named);
  tried.before.data = tried.after.data = names_of(options_.data);
  // With their shapes begun where they were found: a fit of the file is the fit that is told here.
  const std::vector<Term> begun(tried.model.terms.end() - static_cast<std::ptrdiff_t>(added), tried.model.terms.end());
  std::string text = with_revision(text_, options_.model.name(), begun, removed, tried.before, tried.after);
  revisions_.push_back({std::exchange(text_, std::move(text)), std::exchange(steps_, 0)});
  tried.after.revision = read_ledger(text_, options_.model.name()).size() - 1;
  replaced_.clear();
  removed_.clear();
  return tried;
}

void RevisedModel::take_back() {
  for (; steps_ > 0; --steps_) bench_.undo();
  replaced_.clear();
  removed_.clear();
}

bool RevisedModel::go_back_to(const std::string& text) {
  const auto had = std::find_if(revisions_.begin(), revisions_.end(),
                                [&](const Revision& revision) { return revision.text == text; });
  if (had == revisions_.end()) return false;
  take_back();
  for (auto revision = revisions_.end(); revision != had;) {
    --revision;
    for (std::size_t step = 0; step < revision->steps; ++step) bench_.undo();
  }
  revisions_.erase(had, revisions_.end());
  text_ = text;
  return true;
}

std::string RevisedModel::text_with_values() {
  if (read_model(text_, options_.model.name(), options_.catalogue).targets.size() > 1) return text_;
  const std::vector<FittedParameter>& fitted =
      with_source(
          options_.data.front().name(), [&]() -> auto& { return bench_.check(); })
          .fit.parameters;
  std::vector<Term> terms = bench_.model().terms;
  std::size_t parameters = 0;
  for (const Term& term : terms) parameters += term.settings.size();
  std::size_t at = fitted.size() - parameters;  // after the constant, where there is one
  for (Term& term : terms) {
    for (Setting& setting : term.settings) {
      const double value = fitted[at++].value;
      if (setting.held || !std::isfinite(value)) continue;
      setting.start = std::clamp(value, setting.lower, setting.upper);
      setting.stated = true;
    }
  }
  return with_settings(text_, options_.model.name(), std::span(terms).subspan(not_in_file_), options_.catalogue);
}

}  // namespace ballbar
