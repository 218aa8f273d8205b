#include "diagnose/follow.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "ballbar/diagnosis/follow/follow.hpp"
#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/error.hpp"
#include "diagnose/follow_text.hpp"
#include "diagnose/growing_log.hpp"
#include "diagnose/next_command.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/progress.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

constexpr double kEvery_s = 1.0;   // between looks at the file
constexpr double kPause_s = 0.05;  // in which a signal is heard

volatile std::sig_atomic_t g_end_asked = 0;

// The look at hand is finished. A second signal ends at once.
void end_at_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_end_asked = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// What has come, and the model, which stays.
struct Opened {
  ModelData data;
  Model model;
};

Opened opened(const GrowingLog& log, const ModelOptions& options, bool is_first) {
  try {
    Opened result;
    result.data = open_model_data({options.data.front().like(log.copy())}, {}, options.max_gap_s.value_or(kUsualGap_s));
    if (is_first) {
      for (std::string& remark : result.data.remarks) remark = log.with_its_name(std::move(remark));
      tell(result.data.remarks);
      say_start(options, result.data);
    }
    result.data.title = options.data.front().name();
    result.model = open_model(options, result.data);
    return result;
  } catch (const Error& error) {
    throw Error(log.with_its_name(error.what()));
  }
}

void expect_one_target_to_follow(const Model& model) {
  if (model.targets.size() == 1) return;
  throw Error(fmt::format("--follow: expected one target, found {}: {}; --target chooses one.", model.targets.size(),
                          fmt::join(model.targets, ", ")));
}

std::size_t values_in(const Series& data, const std::string& target) {
  const std::vector<double>& values = find_column(data, target)->values;
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
}

// Without names that are not decided.
Diagnosis with_names(Diagnosis diagnosis, const std::vector<std::string>& decided) {
  const auto is_open = [&](const std::string& label) {
    return std::find(decided.begin(), decided.end(), label) == decided.end();
  };
  std::erase_if(diagnosis.named, [&](const BoundEffect& bound) { return is_open(label_of(bound)); });
  std::erase_if(diagnosis.own, [&](const OwnValue& own) { return is_open(label_of(own)); });
  return diagnosis;
}

// The looks so far, and how many lines the next one takes.
class Following {
 public:
  Following(const ModelOptions& model, const DiagnoseOptions& how, const FollowOptions& options, bool json)
      : options_(model), how_(how), keep_(options.keep), json_(json) {
    state_.planned_hours = options.planned_hours;
  }

  bool has_ended() const { return state_.looks.size() == kMostLooks || (!keep_ && state_.outcome != Outcome::open); }

  // All looks that the lines allow.
  void look(const GrowingLog& log) {
    if (log.lines() < lines_needed_) return;
    show_progress("reading");
    const Opened opened_log = opened(log, options_, !has_opened_);
    const std::string& target = opened_log.model.targets.front();
    expect_one_target_to_follow(opened_log.model);
    if (!std::exchange(has_opened_, true) && !json_) print_follow_heading(options_.data.front().name(), target);
    const std::size_t values = values_in(*opened_log.data.series, target);
    while (!has_ended() && g_end_asked == 0 && next_values() <= values) {
      diagnose_first(opened_log, next_values());
      print_look(state_, json_);
    }
    lines_needed_ = log.lines() + next_values() - std::min(values, next_values());
  }

  void wait(const GrowingLog& log) const {
    show_progress(fmt::format("{} lines, the next look is at {}", log.lines(), lines_needed_));
  }

  void sum() const {
    const std::optional<Diagnosis>& shown = decided_ ? decided_ : last_;
    const bool can_be_typed = shown && options_.data.front().name() != "-";
    print_outcome(state_,
                  !can_be_typed ? NextStep{}
                  : decided_    ? NextStep{next_command(options_, *shown), next_hint(options_, *shown)}
                                : NextStep{diagnose_command(options_, shown->target), ""},
                  json_);
  }

 private:
  std::size_t next_values() const { return values_of_look(state_.looks.size()); }

  void diagnose_first(const Opened& log, std::size_t values) {
    const std::string& target = log.model.targets.front();
    const Series data = first_rows(*log.data.series, target, values);
    const double hours = (data.time_s.back() - data.time_s.front()) / 3600.0;
    state_.logged_twice = columns_logged_twice(data);
    DiagnosisOptions how = how_.diagnosis;
    how.search.motion = log.data.motion;
    how.fit_candidates = false;
    how.search.progress = [&](std::string_view step) { show_progress(fmt::format("{} values: {}", values, step)); };
    try {
      last_ = diagnose(log.model, data, 0, how);
      state_ = followed(std::move(state_), *last_, values, hours);
      if (state_.outcome == Outcome::decided && !decided_) decided_ = with_names(*last_, state_.decided);
    } catch (const Error& error) {
      last_.reset();
      state_ = followed(std::move(state_), error.what(), values, hours);
    }
    show_progress({});
  }

  const ModelOptions& options_;
  const DiagnoseOptions& how_;
  bool keep_ = false, json_ = false, has_opened_ = false;
  FollowState state_;
  std::optional<Diagnosis> last_, decided_;  // of the last look; where it was decided, with those names alone
  std::size_t lines_needed_ = kFirstLook;
};

}  // namespace

void add_follow_options(CLI::App& command, FollowOptions& options) {
  command.add_flag("--follow", options.follow, "read a growing log again and again until there is a verdict");
  command
      .add_option("--hours", options.planned_hours,
                  "with --follow: planned length of the run; warns if it will be too short")
      ->type_name("H")
      ->check(number_above_0());
  take_time(*command.add_option("--look-every", options.every_s,
                                "with --follow: time between looks at the file; default: 1s"),
            true);
  take_time(*command.add_option("--patience", options.patience_s,
                                "with --follow: stop after this time without new rows; default: never"),
            false);
  command.add_flag("--keep", options.keep, "with --follow: continue after the verdict");
}

void expect_follow(const FollowOptions& options) {
  const auto expect = [&](bool given, const char* option) {
    if (given && !options.follow) throw CLI::ValidationError(fmt::format("{}: expected --follow", option));
  };
  expect(options.planned_hours.has_value(), "--hours");
  expect(options.every_s.has_value(), "--look-every");
  expect(options.patience_s.has_value(), "--patience");
  expect(options.keep, "--keep");
}

void follow(const ModelOptions& model, const DiagnoseOptions& how, const FollowOptions& options, bool json) {
  if (model.data.size() != 1) {
    throw Error(fmt::format("--follow: expected one log that grows, found {} files.", model.data.size()));
  }
  const ProgressLine line;
  GrowingLog log(model.data.front().name());
  Following following(model, how, options, json);
  end_at_signals();
  const double every_s = options.every_s.value_or(kEvery_s);
  double silent_s = 0.0;
  while (true) {
    const bool has_grown = log.take();
    following.look(log);
    if (following.has_ended() || log.has_ended() || g_end_asked != 0) break;
    if (has_grown) silent_s = 0.0;
    if (!has_grown && options.patience_s && silent_s >= *options.patience_s) break;
    following.wait(log);
    const double pause_s = std::min(every_s, options.patience_s.value_or(every_s));
    for (double waited_s = 0.0; waited_s < pause_s && g_end_asked == 0; waited_s += kPause_s) {
      usleep(static_cast<useconds_t>(1e6 * std::min(kPause_s, pause_s - waited_s)));
    }
    silent_s += pause_s;
  }
  show_progress({});
  following.sum();
}

}  // namespace ballbar
