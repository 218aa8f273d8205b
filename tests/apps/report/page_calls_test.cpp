#include "report/page_calls.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

// 4 um per K of the housing, 2 of the room; the model knows the housing alone.
struct Desk {
  ScratchFolder scratch;
  std::string data, model;

  explicit Desk(int rows = 120) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal(0.0, 0.05);
    std::string text = "time_s,T_housing_degC,T_room_degC,y_um\n";
    for (int i = 0; i < rows; ++i) {
      const double housing = 20.0 + 3.0 * std::sin(0.07 * i), room = 22.0 + std::sin(0.19 * i + 1.0);
      text += fmt::format("{},{:.4f},{:.4f},{:.4f}\n", 60 * i, housing, room,
                          4.0 * (housing - 20.0) + 2.0 * (room - 22.0) + normal(random));
    }
    data = scratch.write("data.csv", text).string();
    model = scratch
                .write("model.toml",
                       "format = \"ballbar-model 1\"\ntarget = \"y_um\"\n\n[[effect]]\nname = \"expansion\"\n"
                       "temperature = \"T_housing_degC\"\n")
                .string();
  }
  Json call(const std::string& name, const Json& more = Json::object()) const {
    Json call{{"call", name}, {"words", {data, "--model", model}}};
    call.update(more);
    return call;
  }
};

double rmse_um(const Json& part) { return part["check"]["targets"][0]["rmse_um"].get<double>(); }

TEST(PageCalls, a_report_is_the_fit_and_a_search_what_is_missing) {
  const Desk desk;
  PageCalls calls;
  const Json report = calls.answer(desk.call("report"));
  EXPECT_EQ(report["title"], "data.csv");
  EXPECT_GT(rmse_um(report), 1.0);
  EXPECT_FALSE(report.contains("diagnose"));
  const Json found = calls.answer(desk.call("search"));
  EXPECT_FALSE(found.contains("check"));
  EXPECT_FALSE(found["diagnose"]["targets"][0]["sentence"].get<std::string>().empty());
}

TEST(PageCalls, an_effect_is_fitted_at_once_and_written_with_its_test) {
  const Desk desk;
  PageCalls calls;
  const double before_um = rmse_um(calls.answer(desk.call("report")));
  const std::string first = read_bytes(desk.model, 1U << 20);
  const Json added = calls.answer(desk.call("add", {{"effects", {"expansion(T_room_degC)"}}}));
  EXPECT_LT(rmse_um(added), 0.1 * before_um);
  EXPECT_EQ(read_bytes(desk.model, 1U << 20), first);
  const Json revised = calls.answer(desk.call("revise", {{"model", desk.model}}));
  EXPECT_TRUE(revised["supported"].get<bool>());
  EXPECT_EQ(revised["ledger"]["rows"].size(), 2U);
  EXPECT_EQ(revised["ledger"]["rows"][1]["rmse_um"], added["check"]["targets"][0]["rmse_um"]);
  EXPECT_NE(read_bytes(desk.model, 1U << 20).find("T_room_degC"), std::string::npos);
  // As a page takes it back: the file has its old bytes.
  write_bytes(desk.model, first);
  EXPECT_EQ(rmse_um(calls.answer(desk.call("fitted"))), before_um);
}

TEST(PageCalls, a_subject_that_was_kept_answers_as_one_that_is_new) {
  const Desk desk;
  PageCalls kept;
  kept.answer(desk.call("search"));
  kept.answer(desk.call("add", {{"effects", {"expansion(T_room_degC)"}}}));
  kept.answer(desk.call("revise", {{"model", desk.model}}));
  EXPECT_EQ(kept.answer(desk.call("search")), PageCalls().answer(desk.call("search")));
  EXPECT_EQ(kept.answer(desk.call("fitted")), PageCalls().answer(desk.call("fitted")));
}

TEST(PageCalls, a_log_is_read_anew_where_it_is_read_in_another_way) {
  const Desk desk;
  const std::string log = desk.scratch.write("log.csv", "T1,dx\n20.1,1\n20.2,2\n20.4,3\n20.3,5\n").string();
  PageCalls calls;
  const auto signals = [&](const std::string& word) -> Json {
    return calls.answer({{"call", "report"}, {"words", {log, word, "--unit=dx=mm"}}})["signals"][0];
  };
  EXPECT_EQ(signals("--every=10s")["time_s"], Json({0.0, 10.0, 20.0, 30.0}));
  EXPECT_EQ(signals("--every=1min")["time_s"], Json({0.0, 60.0, 120.0, 180.0}));
  EXPECT_EQ(signals("--leave-out=T1")["columns"].size(), 1U);
}

TEST(PageCalls, what_was_added_is_taken_back) {
  const Desk desk;
  PageCalls calls;
  const Json before = calls.answer(desk.call("fitted"));
  calls.answer(desk.call("add", {{"effects", {"expansion(T_room_degC)"}}}));
  calls.answer(desk.call("take_back"));
  EXPECT_EQ(calls.answer(desk.call("fitted")), before);
}

TEST(PageCalls, what_is_promised_is_what_comes) {
  const Desk desk;
  PageCalls calls;
  const Json found = calls.answer(desk.call("search"));
  for (const Json& one : found["diagnose"]["targets"][0]["candidates"]) {
    EXPECT_TRUE(one["rmse_after_um"].is_null());  // asked for one by one
    const Json effects{{"effects", {one["label"]}}};
    const double promised_um = calls.answer(desk.call("with", effects))["rmse_um"].get<double>();
    EXPECT_EQ(rmse_um(calls.answer(desk.call("add", effects))), promised_um) << one["label"];
    calls.answer(desk.call("take_back"));
  }
}

TEST(PageCalls, what_the_data_do_not_support_is_kept_only_if_asked) {
  const Desk desk;
  PageCalls calls;
  const std::string first = read_bytes(desk.model, 1U << 20);
  const Json before = calls.answer(desk.call("fitted"));
  const Json drift{{"effects", {"linear_drift"}}};
  calls.answer(desk.call("add", drift));
  const Json refused = calls.answer(desk.call("revise", {{"model", desk.model}}));
  EXPECT_FALSE(refused["kept"].get<bool>());
  EXPECT_FALSE(refused["sentence"].get<std::string>().empty());
  EXPECT_EQ(read_bytes(desk.model, 1U << 20), first);
  EXPECT_EQ(calls.answer(desk.call("fitted")), before);
  calls.answer(desk.call("add", drift));
  const Json kept = calls.answer(desk.call("revise", {{"model", desk.model}, {"keep", true}}));
  EXPECT_TRUE(kept["kept"].get<bool>());
  EXPECT_FALSE(kept["supported"].get<bool>());
  const Json found = calls.answer(desk.call("search"));
  EXPECT_EQ(found["diagnose"]["targets"][0]["unsupported"], Json({"linear_drift"}));
  // Until a later revision finds that it is needed.
  calls.answer(desk.call("add", {{"effects", {"expansion(T_room_degC)"}}}));
  calls.answer(desk.call("revise", {{"model", desk.model}}));
  const auto unsupported = [&] {
    return PageCalls().answer(desk.call("search"))["diagnose"]["targets"][0]["unsupported"];
  };
  EXPECT_EQ(unsupported(), Json({"linear_drift"}));
  std::string file = read_bytes(desk.model, 1U << 20);
  const std::string from = "no_longer_needed = [\"linear_drift\"]";
  ASSERT_NE(file.rfind(from), std::string::npos) << file;
  const std::size_t still = file.rfind("still_needed = [");
  file.insert(still + std::string("still_needed = [").size(), "\"linear_drift\", ");
  file.replace(file.rfind(from), from.size(), "no_longer_needed = []");
  write_bytes(desk.model, file);
  EXPECT_TRUE(unsupported().empty());
}

TEST(PageCalls, values_are_held_and_the_model_stays) {
  const Desk desk;
  PageCalls calls;
  const Json before = calls.answer(desk.call("fitted"));
  const Json held = calls.answer(desk.call("hold", {{"settings", {"expansion(T_housing_degC).gain_um_per_K=1"}}}));
  EXPECT_GT(rmse_um(held), rmse_um(before));
  EXPECT_EQ(calls.answer(desk.call("fitted")), before);
}

TEST(PageCalls, other_data_under_the_same_name_are_opened_anew) {
  const Desk desk;
  const Desk other(60);
  PageCalls calls;
  EXPECT_EQ(calls.answer(desk.call("report"))["check"]["targets"][0]["n"], 120);
  write_bytes(desk.data, read_bytes(other.data, 1U << 20));
  EXPECT_EQ(calls.answer(desk.call("report"))["check"]["targets"][0]["n"], 60);
}

TEST(PageCalls, data_without_a_model_have_a_report_and_are_searched_when_asked) {
  const Desk desk;
  PageCalls calls;
  EXPECT_FALSE(calls.answer({{"call", "report"}, {"words", {desk.data}}}).contains("check"));
  const Json found = calls.answer({{"call", "search"}, {"words", {desk.data, "--diagnose", "--target", "y_um"}}});
  EXPECT_EQ(found["diagnose"]["targets"].size(), 1U);
}

TEST(PageCalls, an_effect_is_removed_and_the_file_without_it_is_a_revision) {
  const Desk desk;
  PageCalls calls;
  calls.answer(desk.call("add", {{"effects", {"expansion(T_room_degC)"}}}));
  const Json added = calls.answer(desk.call("revise", {{"model", desk.model}}));
  const std::string with_both = read_bytes(desk.model, 1U << 20);
  const Json removed = calls.answer(desk.call("change", {{"removed", {"expansion(T_housing_degC)"}}}));
  EXPECT_EQ(read_bytes(desk.model, 1U << 20), with_both);
  const Json revised = calls.answer(desk.call("revise", {{"model", desk.model}}));
  const Json row = revised["ledger"]["rows"].back();
  EXPECT_EQ(row["change"], "- expansion(T_housing_degC)");
  EXPECT_EQ(row["verdict"], "by hand");
  EXPECT_EQ(row["rmse_um"], removed["check"]["targets"][0]["rmse_um"]);
  EXPECT_EQ(row["sentence"].get<std::string>().substr(0, 52), "Revision 2 took out expansion(T_housing_degC). RMSE ");
  EXPECT_EQ(PageCalls().answer(desk.call("fitted")), calls.answer(desk.call("fitted")));
  // As a page takes it back.
  write_bytes(desk.model, with_both);
  EXPECT_EQ(calls.answer(desk.call("fitted"))["ledger"], added["ledger"]);
  EXPECT_THROW(calls.answer(desk.call("change", {{"removed", {"expansion(T_absent_degC)"}}})), std::exception);
}

TEST(PageCalls, a_parameter_is_held_in_the_file_and_freed_from_its_value) {
  const Desk desk;
  write_bytes(desk.model, read_bytes(desk.model, 1U << 20) + "gain_um_per_K = { start = 1.0 }  # the housing\n");
  PageCalls calls;
  const double best_um = rmse_um(calls.answer(desk.call("fitted")));
  const Json held = calls.answer(desk.call("change", {{"held", {"expansion(T_housing_degC).gain_um_per_K=3"}}}));
  EXPECT_GT(rmse_um(held), best_um);
  EXPECT_EQ(held["check"]["targets"][0]["parameters"][1]["state"], "held");
  const Json revised = calls.answer(desk.call("revise", {{"model", desk.model}}));
  EXPECT_EQ(revised["ledger"]["rows"][1]["change"], "= expansion(T_housing_degC).gain_um_per_K 3 held");
  EXPECT_NE(read_bytes(desk.model, 1U << 20).find("\ngain_um_per_K = 3.0  # the housing\n"), std::string::npos);
  EXPECT_EQ(PageCalls().answer(desk.call("fitted"))["check"], held["check"]);
  const Json freed = calls.answer(desk.call("change", {{"freed", {"expansion(T_housing_degC).gain_um_per_K=3"}}}));
  EXPECT_NEAR(rmse_um(freed), best_um, 1e-9);
  calls.answer(desk.call("revise", {{"model", desk.model}}));
  EXPECT_NE(read_bytes(desk.model, 1U << 20).find("gain_um_per_K = { start = 3.0 }"), std::string::npos);
  EXPECT_THROW(calls.answer(desk.call("change", {{"held", {"expansion(T_housing_degC).gain_um_per_K=1e9"}}})), Error);
  EXPECT_NEAR(rmse_um(calls.answer(desk.call("fitted"))), best_um, 1e-9);
}

TEST(PageCalls, the_text_of_a_model_has_its_fitted_values) {
  const Desk desk;
  PageCalls calls;
  const Json fitted = calls.answer(desk.call("fitted"));
  const std::string before = read_bytes(desk.model, 1U << 20);
  const auto text = calls.answer(desk.call("text"))["text"].get<std::string>();
  EXPECT_EQ(read_bytes(desk.model, 1U << 20), before);
  const double gain = fitted["check"]["targets"][0]["parameters"][1]["value"].get<double>();
  EXPECT_EQ(text, before + fmt::format("gain_um_per_K = {{ start = {} }}\n", gain));
  write_bytes(desk.model, text);
  EXPECT_NEAR(rmse_um(calls.answer(desk.call("fitted"))), rmse_um(fitted), 1e-9);
}

TEST(PageCalls, choices_are_the_columns_that_suit_and_are_not_in_the_model_yet) {
  const Desk desk;
  PageCalls calls;
  const Json effects = calls.answer(desk.call("choices"))["effects"];
  const auto labels = [&](const std::string& name) -> Json {
    for (const Json& one : effects) {
      if (one["effect"] == name) return one["labels"];
    }
    return nullptr;
  };
  EXPECT_EQ(labels("expansion"), Json({"expansion(T_room_degC)"}));
  EXPECT_EQ(labels("lagged_expansion").size(), 2U);
  EXPECT_EQ(labels("gradient_bending").size(), 1U);  // the warmer first
  EXPECT_EQ(labels("speed_heating"), Json::array());
  EXPECT_EQ(labels("linear_drift"), Json({"linear_drift"}));
  EXPECT_EQ(labels("circle"), nullptr);
  for (const Json& one : effects) {
    for (const Json& label : one["labels"]) {
      EXPECT_NO_THROW(calls.answer(desk.call("add", {{"effects", {label}}}))) << label;
      calls.answer(desk.call("take_back"));
    }
  }
}

TEST(PageCalls, two_hypotheses_are_fitted_side_by_side_and_the_model_stays) {
  const Desk desk;
  PageCalls calls;
  const Json before = calls.answer(desk.call("fitted"));
  const Json both = calls.answer(
      desk.call("compare", {{"hypotheses", {Json::array(), {"expansion(T_room_degC)"}, {"linear_drift"}}}}));
  EXPECT_EQ(both["hypotheses"][0]["check"], before["check"]);
  EXPECT_LT(rmse_um(both["hypotheses"][1]), 0.1 * rmse_um(before));
  EXPECT_EQ(both["hypotheses"][1]["row"]["verdict"], "supported");
  EXPECT_EQ(both["hypotheses"][1]["row"]["rmse_um"], both["hypotheses"][1]["check"]["targets"][0]["rmse_um"]);
  EXPECT_GT(both["p"][1].get<double>(), 0.999);
  EXPECT_NEAR(both["p"][0].get<double>() + both["p"][1].get<double>() + both["p"][2].get<double>(), 1.0, 1e-12);
  EXPECT_EQ(calls.answer(desk.call("fitted")), before);
}

TEST(PageCalls, times_that_are_left_out_are_left_out_of_every_fit) {
  const Desk desk;
  // The door stood open from row 60 to row 70.
  std::string text = read_bytes(desk.data, 1U << 20);
  std::size_t line = text.find("\n3600,");
  for (int i = 60; i <= 70; ++i) {
    const std::size_t comma = text.rfind(',', text.find('\n', line + 1));
    text.replace(comma, text.find('\n', comma) - comma, ",50");
    line = text.find('\n', line + 1);
  }
  write_bytes(desk.data, text);
  PageCalls calls;
  const Json spoilt = calls.answer(desk.call("fitted"));
  const Json words = {desk.data, "--model", desk.model, "--leave-out-times", "1h..70min"};
  const auto call = [&](const std::string& name, const Json& more = Json::object()) {
    Json one{{"call", name}, {"words", words}};
    one.update(more);
    return calls.answer(one);
  };
  const Json rest = call("report");
  EXPECT_LT(rmse_um(rest), 0.3 * rmse_um(spoilt));
  EXPECT_EQ(rest["check"]["targets"][0]["n"], 109);
  EXPECT_EQ(rest["signals"][0]["time_s"].size(), 120U);
  EXPECT_EQ(rest["check"]["targets"][0]["curve"]["time_s"].size(), 120U);  // the model goes on
  EXPECT_EQ(call("fitted")["check"]["targets"][0]["n"], 109);
  EXPECT_EQ(call("search")["diagnose"]["targets"][0]["n"], 109);
  const Json settings = {{"settings", {"expansion(T_housing_degC).gain_um_per_K=1"}}};
  EXPECT_EQ(call("hold", settings)["check"]["targets"][0]["n"], 109);
  EXPECT_LT(rmse_um(call("add", {{"effects", {"expansion(T_room_degC)"}}})), 0.1);
  const Json ledger = call("revise", {{"model", desk.model}})["ledger"];
  EXPECT_EQ(ledger["rows"][1]["data"], Json({desk.data, "without 3600 s to 4200 s"}));
  EXPECT_EQ(calls.answer(desk.call("fitted"))["check"]["targets"][0]["n"], 120);
  EXPECT_THROW(
      calls.answer({{"call", "fitted"}, {"words", {desk.data, "--model", desk.model, "--leave-out-times", "9h..10h"}}}),
      Error);
  EXPECT_THROW(calls.answer({{"call", "fitted"}, {"words", {desk.data, "--leave-out-times", "2h..1h"}}}), Error);
}

TEST(PageCalls, the_next_action_promises_the_rmse_that_add_leaves) {
  const ScratchFolder scratch;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, 0.3);
  std::string text = "time_s,T_bearing_degC,T_motor_degC,y_um\n";
  double warm = 0.0;  // a spindle that runs and stands still
  for (int i = 0; i < 1200; ++i) {
    warm += ((i / 130 % 2 == 0 ? 30.0 : 0.0) - warm) / 45.0;
    text += fmt::format("{},{:.4f},{:.4f},{:.4f}\n", 60 * i, 20.0 + warm, 30.0 + 4.0 * std::sin(i / 55.0 + 2.0),
                        0.5 * warm + normal(random));
  }
  const Json words = {scratch.write("run.csv", text).string(), "--diagnose"};
  PageCalls calls;
  const Json next = calls.answer({{"call", "search"}, {"words", words}})["diagnose"]["targets"][0]["next_action"];
  EXPECT_EQ(next["action"], "add");
  EXPECT_EQ(next["labels"], Json({"expansion(T_bearing_degC)"}));
  const Json added = calls.answer({{"call", "add"}, {"words", words}, {"effects", next["effects"]}});
  EXPECT_NEAR(rmse_um(added), next["promised_rmse_um"].get<double>(), 1e-6);
}

TEST(PageCalls, gaps_are_told_where_a_fit_is_refused_for_them) {
  const ScratchFolder scratch;
  std::string text = "time_s,T_degC,y_um\n";
  for (int i = 0; i < 300; ++i) {
    const std::string degC = i > 40 && i < 220 ? "" : fmt::format("{:.2f}", 20.0 + 0.01 * i);
    text += fmt::format("{},{},{:.3f}\n", 60 * i, degC, 0.1 * i);
  }
  const std::string data = scratch.write("gaps.csv", text).string();
  PageCalls calls;
  const auto gaps = [&](const Json& words) { return calls.answer({{"call", "gaps"}, {"words", words}})["gap"]; };
  const Json gap = gaps({data});
  EXPECT_EQ(gap["signal"], "T_degC");
  EXPECT_EQ(gap["from_s"], 2400.0);
  EXPECT_EQ(gap["to_s"], 13200.0);
  EXPECT_TRUE(gaps({data, "--max-gap", "3h"}).is_null());
}

TEST(PageCalls, a_call_of_another_name_is_refused) {
  const Desk desk;
  PageCalls calls;
  EXPECT_THROW(calls.answer(desk.call("make_coffee")), Error);
  EXPECT_THROW(calls.answer(desk.call("add", {{"effects", {"expansion(T_absent_degC)"}}})), Error);
  EXPECT_NO_THROW(calls.answer(desk.call("report")));
}

}  // namespace
}  // namespace ballbar
