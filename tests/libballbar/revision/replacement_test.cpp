// An effect that stood in for others is asked again.
#include <gtest/gtest.h>

#include "ballbar/revision/revision.hpp"
#include "diagnosis/made_drift.hpp"

namespace ballbar {
namespace {

// The room behind 1500 s moves it; a model that has the bearing instead.
TEST(Replacement, names_what_an_effect_stood_in_for) {
  const Series data = made::drift({3.0, 1, 300});
  Model model = made::by_speed();
  model.terms.push_back(term_of("expansion", {"T_bearing_degC"}));
  const std::size_t added[] = {1};
  const std::vector<Replacement> found = replacements(model, added, data, 0, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().term, 1U);
  EXPECT_EQ(found.front().label, "expansion(T_bearing_degC)");
  EXPECT_LT(found.front().p, 0.05);
  EXPECT_EQ(made::labels_of(found.front().without.named), (std::vector<std::string>{"lagged_expansion(T_room_degC)"}));
}

TEST(Replacement, leaves_what_is_there) {
  const Series data = made::drift({3.0, 1, 300});
  Model model = made::by_speed();
  model.terms.push_back(term_of("lagged_expansion", {"T_room_degC"}));
  const std::size_t all[] = {0, 1};
  for (const Replacement& one : replacements(model, all, data, 0, {})) ADD_FAILURE() << one.label;
  EXPECT_TRUE(replacements(model, {}, data, 0, {}).empty());
}

}  // namespace
}  // namespace ballbar
