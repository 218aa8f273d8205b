#include "report/page_calls.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "ballbar/error.hpp"
#include "errors/test_results.hpp"
#include "history/found_history.hpp"
#include "history/history_page.hpp"
#include "terminal/command_line.hpp"

namespace ballbar {
namespace {

using Texts = std::vector<std::string>;

ReportRequest request_of(Texts words) {
  CommandLine app;  // with the options of logs
  ReportRequest request;
  add_report_options(app, request);
  request.how.diagnosis.fit_candidates = false;  // a page asks for each: with
  std::reverse(words.begin(), words.end());      // as CLI11 takes them
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    throw Error(error.what());
  }
  return request;
}

std::vector<TestHead> tests_of(const nlohmann::json& call) {
  const ReportRequest request = request_of(call.at("words").get<Texts>());
  TestFiles files = test_heads_below(names_of(request.model.data), request.model.circle);
  std::vector<TestHead> heads;
  for (MachineTest& test : files.tests) heads.push_back({std::move(test)});
  return heads;
}

nlohmann::ordered_json history_of(const nlohmann::json& call) {
  const ReportRequest request = request_of(call.at("words").get<Texts>());
  const Texts names = names_of(request.model.data);
  const FoundHistory found = found_history(read_tests(names, false, request.model.circle), {}, {});
  return json_of(history_report(call.at("title").get<std::string>(), found));
}

std::optional<SignalGap> longest_gap_of(const nlohmann::json& call) {
  const ReportRequest request = request_of(call.at("words").get<Texts>());
  std::optional<SignalGap> longest;
  for (const Source& source : request.model.data) {
    if (is_recording_file(source)) continue;
    const std::optional<SignalGap> one = longest_gap(open_drift_data(source), request.model.max_gap_s);
    if (!one || (longest && longest->to_s - longest->from_s >= one->to_s - one->from_s)) continue;
    longest = one;
  }
  return longest;
}

}  // namespace

TestsReport PageCalls::table_of(const nlohmann::json& call) {
  auto words = call.at("words").get<Texts>();
  if (!tests_ || words != words_of_tests_) {
    const ReportRequest request = request_of(words);
    tests_.reset();
    tests_ = tests_report(call.at("title").get<std::string>(), names_of(request.model.data), request.model.circle);
    words_of_tests_ = std::move(words);
  }
  const auto tolerance = call.find("tolerance_um");
  return judged(*tests_, tolerance == call.end() ? std::nullopt : std::optional(tolerance->get<double>()));
}

ReportSubject& PageCalls::subject_of(const nlohmann::json& call) {
  const ReportRequest request = request_of(call.at("words").get<Texts>());
  if (!subject_ || !subject_->is_of(request)) {
    subject_.reset();  // the memory of the one before is free for it
    subject_ = std::make_unique<ReportSubject>(request);
  } else {
    subject_->look_at(request);
  }
  return *subject_;
}

nlohmann::ordered_json PageCalls::answer(const nlohmann::json& call) {
  const auto name = call.at("call").get<std::string>();
  if (name == "tests") return {{"tests", json_value(tests_of(call))}};
  if (name == "history") return history_of(call);
  if (name == "table") return json_of(table_of(call));
  if (name == "gaps") return {{"gap", json_value(longest_gap_of(call))}};
  ReportSubject& subject = subject_of(call);
  if (name == "report") return json_of(subject.report(false).page);
  if (name == "fitted") return json_of(subject.fitted());
  if (name == "search") return json_of(subject.found());
  if (name == "hold") return {{"check", json_value(subject.held(call.at("settings").get<Texts>()))}};
  if (name == "add") return json_of(subject.add(call.at("effects").get<Texts>()));
  if (name == "with") return {{"rmse_um", json_value(subject.with(call.at("effects").get<Texts>()))}};
  if (name == "change") {
    return json_of(
        subject.change({call.value("removed", Texts()), call.value("held", Texts()), call.value("freed", Texts())}));
  }
  if (name == "choices") return {{"effects", json_value(subject.choices())}};
  if (name == "compare") return json_of(subject.compare(call.at("hypotheses").get<std::vector<Texts>>()));
  if (name == "text") return {{"text", subject.text_as_fitted()}};
  if (name == "revise") return json_of(subject.revise(call.at("model").get<std::string>(), call.value("keep", false)));
  if (name != "take_back") throw Error(fmt::format("expected a call of a page, found {}.", name));
  subject.take_back();
  return nlohmann::ordered_json::object();
}

}  // namespace ballbar
