#include "report/page_calls.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "ballbar/error.hpp"
#include "terminal/command_line.hpp"

namespace ballbar {
namespace {

using Texts = std::vector<std::string>;

ReportRequest request_of(Texts words) {
  CommandLine app;  // with the options of logs
  ReportRequest request;
  add_report_options(app, request);
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    throw Error(error.what());
  }
  return request;
}

}  // namespace

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
  ReportSubject& subject = subject_of(call);
  if (name == "report") return json_of(subject.report(false).page);
  if (name == "fitted") return json_of(subject.fitted());
  if (name == "search") return json_of(subject.found());
  if (name == "hold") return json_of(subject.held(call.at("settings").get<Texts>()));
  if (name == "add") return json_of(subject.add(call.at("effects").get<Texts>()));
  if (name == "change") {
    return json_of(
        subject.change({call.value("removed", Texts()), call.value("held", Texts()), call.value("freed", Texts())}));
  }
  if (name == "choices") return json_of(subject.choices());
  if (name == "compare") return json_of(subject.compare(call.at("hypotheses").get<std::vector<Texts>>()));
  if (name == "text") return json_of(subject.text_as_fitted());
  if (name == "revise") return json_of(subject.revise(call.at("model").get<std::string>()));
  if (name != "take_back") throw Error(fmt::format("expected a call of a page, found {}.", name));
  subject.take_back();
  return nlohmann::ordered_json::object();
}

}  // namespace ballbar
