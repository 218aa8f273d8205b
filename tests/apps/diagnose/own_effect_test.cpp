// Commands with models know the effects that their caller has beside the catalogue's, in the model's history too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "program.hpp"
#include "report/report_subject.hpp"
#include "scratch_folder.hpp"
#include "terminal/caller.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

Catalogue with_square_of_a_rise() {
  const auto square = [](const EffectRows& rows, std::size_t i) {
    const double rise = rows.inputs[0][i] - rows.inputs[0][0];
    return rise * rise;
  };
  Effect effect;
  effect.name = "square_of_a_rise";
  effect.explanation.summary = "The square of a rise.";
  effect.inputs = {{"temperature", {"degC"}, "any temperature"}};
  effect.parameters = {
      {"gain_um_per_K2", "um/K^2", ParameterKind::gain, 0.0, -10.0, 10.0, {}, "for a rise of one kelvin"}};
  effect.evaluate.all = [square](const EffectRows& rows, const double* p, double* values, double* derivatives) {
    for (std::size_t i = 0; i < rows.time_s.size(); ++i) {
      values[i] = p[0] * square(rows, i);
      if (derivatives != nullptr) derivatives[i] = square(rows, i);
    }
  };
  effect.evaluate.rows = [square](const EffectRows& rows, std::size_t begin, std::size_t end, const double* p, double*,
                                  double* values) {
    for (std::size_t i = begin; i < end; ++i) values[i - begin] = p[0] * square(rows, i);
  };
  effect.evaluate.parameters = 1;
  Catalogue catalogue = built_in_catalogue();
  catalogue.push_back(std::make_shared<const Effect>(std::move(effect)));
  return catalogue;
}

// 0.5 um per K^2 of the housing, by the effect of the caller, and 2 um per K of the room.
struct Call {
  ScratchFolder scratch;
  std::string data;
  std::string text =
      "format = \"ballbar-model 1\"\ntarget = \"y_um\"\n\n[[effect]]\nname = \"square_of_a_rise\"\n"
      "temperature = \"T_housing_degC\"\n";

  Call() {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal(0.0, 0.05);
    std::string rows = "time_s,T_housing_degC,T_room_degC,y_um\n";
    for (int i = 0; i < 120; ++i) {
      const double housing = 20.0 + 3.0 * std::sin(0.07 * i), room = 22.0 + std::sin(0.19 * i + 1.0);
      rows += fmt::format("{},{:.4f},{:.4f},{:.4f}\n", 60 * i, housing, room,
                          0.5 * (housing - 20.0) * (housing - 20.0) + 2.0 * (room - 22.0) + normal(random));
    }
    data = scratch.write("data.csv", rows).string();
  }
  Source model() const { return Source::of_text("model", text); }
  Json answer(const std::string& command, const std::vector<std::string>& places,
              std::vector<std::pair<std::string, CommandCall::Value>> options = {}) const {
    options.emplace_back("json", true);
    options.emplace_back("model", std::vector<std::string>{"model"});
    Json result;
    Caller program;
    program.result = [&](const Json& json) { result = json; };
    program.remark = [](const std::string&) {};
    const CalledBy called(program);
    run_command({command, places, options, {{"model", model()}}, with_square_of_a_rise()});
    return result;
  }
};

TEST(OwnEffect, is_known_in_every_revision_of_a_model) {
  Call call;
  const std::string before = call.text;
  call.text = call.answer("add", {"expansion(T_room_degC)", call.data})["text"];
  EXPECT_EQ(call.answer("ledger", {})["rows"].size(), 2U);
  const Json found = call.answer("diagnose", {call.data});
  EXPECT_FALSE(found["sentence"].get<std::string>().empty());
  EXPECT_EQ(call.answer("undo", {})["text"], before);
}

TEST(OwnEffect, is_known_to_a_page_that_changes_the_model) {
  Call call;
  ReportRequest request;
  request.model.data = {Source(call.data)};
  request.model.model = call.model();
  request.model.catalogue = with_square_of_a_rise();
  ReportSubject subject(request);
  subject.add({"expansion(T_room_degC)"});
  const RevisedPart revised = subject.revise((call.scratch.path() / "revised.toml").string(), true);
  EXPECT_EQ(revised.ledger.rows.size(), 2U);
  EXPECT_EQ(subject.report(false).page.model.ledger->rows.size(), 2U);
  EXPECT_FALSE(subject.text_as_fitted().empty());
}

TEST(OwnEffect, is_compensated) {
  const Call call;
  EXPECT_FALSE(call.answer("compensate", {},
                           {{"fit", std::vector<std::string>{call.data}}, {"on", std::vector<std::string>{call.data}}})
                   .empty());
}

}  // namespace
}  // namespace ballbar
