// A program that calls commands takes what they say.
#include "terminal/caller.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

TEST(Caller, TakesResultsRemarksAndProgress) {
  std::vector<std::string> heard;
  Caller program;
  program.result = [&](const nlohmann::ordered_json& json) { heard.push_back(json.dump()); };
  program.remark = [&](const std::string& line) { heard.push_back(line); };
  program.progress = [&](std::string_view line) { heard.emplace_back(line); };
  {
    const CalledBy called(program);
    print_json({{"a", 0.1}});
    print_json_text("{\n\"b\": 2}\n");
    print_for_people("not said");
    warning_line("careful");
    show_progress("half");
    EXPECT_TRUE(progress_is_taken());
    bool elsewhere = true;
    std::thread([&] { elsewhere = caller() != nullptr; }).join();
    EXPECT_FALSE(elsewhere);
  }
  EXPECT_EQ(caller(), nullptr);
  EXPECT_FALSE(progress_is_taken());
  EXPECT_EQ(heard, (std::vector<std::string>{"{\"a\":0.1}", "{\"b\":2}", "careful", "half"}));
}

TEST(Caller, TheOneWithinGoesBeforeTheOneAround) {
  std::string heard;
  Caller outer, inner;
  outer.remark = [&](const std::string&) { heard += "o"; };
  inner.remark = [&](const std::string&) { heard += "i"; };
  const CalledBy around(outer);
  {
    const CalledBy within(inner);
    stderr_line("x");
  }
  stderr_line("x");
  EXPECT_EQ(heard, "io");
}

}  // namespace
}  // namespace ballbar
