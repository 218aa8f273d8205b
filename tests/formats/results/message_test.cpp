// Sentences by name: the English text, and the keys of a result.
#include "ballbar/formats/results/message.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ballbar/message_catalogue.hpp"

namespace ballbar {
namespace {

struct Said {
  Paragraph sentence;
  std::vector<Paragraph> remarks;
};

}  // namespace

template <>
inline constexpr auto kResult<Said> = ResultType("Said", "Something said.", Field{"sentence", &Said::sentence, "what"},
                                                 Field{"remarks", &Said::remarks});

namespace {

TEST(Message, places_and_plurals) {
  EXPECT_EQ(text_of(messages::error_falls("3.1", "1.2")), "The remaining error falls from 3.1 to 1.2 um.");
  EXPECT_EQ(text_of(messages::limits_pass(1U)), "1 stored result passes the limits in the file");
  EXPECT_EQ(text_of(messages::limits_pass(12U)), "12 stored results pass the limits in the file");
  EXPECT_EQ(text_of(messages::untestable_no_column(EffectLabel{"a {b}"})), "no column for a {b}");
}

TEST(Message, lists) {
  EXPECT_EQ(text_of(enumerated({})), "");
  EXPECT_EQ(text_of(enumerated({"A"})), "A");
  EXPECT_EQ(text_of(enumerated({"A", "B"})), "A and B");
  EXPECT_EQ(text_of(enumerated({"A", EffectLabel{"B"}, "C"})), "A, B and C");
  EXPECT_EQ(text_of(listed({"A", "B", "C"})), "A, B, C");
  EXPECT_EQ(text_of(semicolon_list({"A", "B", "C"})), "A; B; C");
}

TEST(Message, keys_of_a_result) {
  Said said;
  said.sentence = messages::negligible();
  said.sentence += messages::data_support(enumerated(effects_of({"step", "settling"})));
  said.remarks = {as_it_is("read as metres"), messages::fit_not_converged()};
  EXPECT_EQ(json_of(said).dump(),
            R"({"sentence":"That is negligible. The data support step and settling.",)"
            R"("message":[{"name":"negligible","values":{}},{"name":"data_support","values":{"effects":)"
            R"([{"name":"enumeration","values":{"1":{"effect":"step"},"2":{"effect":"settling"}}}]}}],)"
            R"("remarks":["read as metres","The fit did not converge; its parameters are the best it found."],)"
            R"("remarks_message":[[{"name":"","values":{"text":"read as metres"}}],)"
            R"([{"name":"fit_not_converged","values":{}}]]})");
}

TEST(Message, no_key_without_a_name) {
  Said said{as_it_is("An error."), {}};
  EXPECT_EQ(json_of(said).dump(), R"({"sentence":"An error.","remarks":[]})");
}

}  // namespace
}  // namespace ballbar
