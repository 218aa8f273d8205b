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
  static_cast<void>(read_ledger(text_, options_.model.name(), options_.catalogue));
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

void RevisedModel::remove(const std::vector<std::string>& labels) {
  Model rest = bench_.model();
  removed_ = taken_out(labels, rest);
  with_source(options_.data.front().name(), [&] { expect_suits(rest, bench_.data()); });
  bench_.replace(std::move(rest));
  ++steps_;
  for (const std::string& label : labels) by_hand_.push_back("- " + label);
}

void RevisedModel::set(Model model) {
  with_source(options_.data.front().name(), [&] { expect_suits(model, bench_.data()); });
  for (std::size_t t = not_in_file_; t < model.terms.size(); ++t) {
    Term& term = model.terms[t];
    const Term& before = bench_.model().terms[t];
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      Setting& now = term.settings[k];
      const Setting& was = before.settings[k];
      if (now.held == was.held && now.start == was.start) continue;
      now.stated = true;
      const std::string name = label_of(before) + "." + term.effect->parameters[k].name;
      by_hand_.push_back(now.held ? fmt::format("= {} {:.6g} held", name, now.start) : fmt::format("= {} free", name));
    }
  }
  bench_.replace(std::move(model));
  ++steps_;
}

std::vector<Term> RevisedModel::terms_in_file() const {
  const std::vector<Term>& terms = bench_.model().terms;
  return {terms.begin() + static_cast<std::ptrdiff_t>(not_in_file_), terms.end()};
}

std::vector<std::string> RevisedModel::data_names() const {
  std::vector<std::string> names = names_of(options_.data);
  for (const TimeRange& range : options_.left_out) names.push_back("without " + text_of(range));
  return names;
}

void RevisedModel::put_text(std::string text) {
  revisions_.push_back({std::exchange(text_, std::move(text)), std::exchange(steps_, 0)});
  replaced_.clear();
  removed_.clear();
  by_hand_.clear();
}

LedgerRow RevisedModel::revise_by_hand() {
  if (by_hand_.empty()) throw Error("expected a change of the model, found none.");
  LedgerRow before = bench_.row(steps_), row = bench_.row();
  row.change = fmt::format("{}", fmt::join(by_hand_, ", "));
  row.verdict = "by hand";
  before.data = row.data = data_names();
  std::string text = with_revision(text_, options_.model.name(), {}, removed_, before, row, options_.catalogue);
  put_text(with_settings(text, options_.model.name(), terms_in_file(), options_.catalogue));
  return read_ledger(text_, options_.model.name(), options_.catalogue).back();
}

std::string RevisedModel::text_as_fitted() {
  const Model file = read_model(text_, options_.model.name(), options_.catalogue);
  if (file.targets.size() != 1) return text_;  // each has values of its own
  std::vector<Term> terms = terms_in_file();
  const Fit& fit = with_source(
      options_.data.front().name(), [&]() -> auto& { return bench_.check().fit; });
  std::size_t at = 1;  // after the constant
  for (std::size_t t = 0; t < not_in_file_; ++t) at += bench_.model().terms[t].settings.size();
  for (Term& term : terms) {
    for (Setting& setting : term.settings) {
      const FittedParameter& fitted = fit.parameters.at(at++);
      if (setting.held || fitted.state == ParameterState::undetermined || !std::isfinite(fitted.value)) continue;
      setting.start = fitted.value;
      setting.stated = true;
    }
  }
  return with_settings(text_, options_.model.name(), terms, options_.catalogue);
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
  tried.before.data = tried.after.data = data_names();
  // With their shapes begun where they were found: a fit of the file is the fit that is told here.
  const std::vector<Term> begun(tried.model.terms.end() - static_cast<std::ptrdiff_t>(added), tried.model.terms.end());
  std::string text =
      with_revision(text_, options_.model.name(), begun, removed, tried.before, tried.after, options_.catalogue);
  put_text(std::move(text));
  tried.after.revision = read_ledger(text_, options_.model.name(), options_.catalogue).size() - 1;
  return tried;
}

void RevisedModel::take_back() {
  for (; steps_ > 0; --steps_) bench_.undo();
  replaced_.clear();
  removed_.clear();
  by_hand_.clear();
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

}  // namespace ballbar
