// Effects that a program adds stand beside those of src/effects.
#include "effects/known_effects.hpp"

#include <gtest/gtest.h>

#include <array>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

std::shared_ptr<const Effect> named(const std::string& name, const std::string& summary) {
  auto effect = std::make_shared<Effect>();
  effect->name = name;
  effect->explanation.summary = summary;
  return effect;
}

TEST(KnownEffects, GrowAndKeepWhatWasSeen) {
  const std::shared_ptr<const Effect> own = named("own", "built in");
  const std::array<const Effect*, 1> built_in{own.get()};
  KnownEffects known(built_in);
  const Catalogue& before = known.all();
  known.add(named("mine", "first"));
  known.add(named("yours", ""));
  EXPECT_EQ(before.size(), 1U);
  EXPECT_EQ(known.all().size(), 3U);
  known.add(named("mine", "second"));
  ASSERT_EQ(known.all().size(), 3U);
  EXPECT_EQ(find_effect("mine", Level::series, known.all())->explanation.summary, "second");
  EXPECT_THROW(known.add(named("own", "mine")), Error);
  EXPECT_EQ(find_effect("own", Level::series, known.all()), own.get());
}

TEST(KnownEffects, HoldTheCatalogue) {
  EXPECT_EQ(&built_in_catalogue(), &known_effects().all());
  EXPECT_THROW(add_to_catalogue(named("expansion", "another")), Error);
}

}  // namespace
}  // namespace ballbar
