#include "ballbar/formats/series/profile_csv.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

using Values = std::vector<double>;

TEST(profile_csv, columns_are_states_and_sigma_goes_to_its_own) {
  const auto profiles = read_profiles(
      "# a shaft\nx_mm,T_600s_degC,T_600s_sigma_degC,T_3600s_degC\n0,30,0.1,40\n10,29.5,0.2,38\n", "shaft.csv");
  ASSERT_EQ(profiles.size(), 2u);
  EXPECT_EQ(profiles[0].name, "T_600s_degC");
  EXPECT_EQ(profiles[0].profile.x_mm, (Values{0, 10}));
  EXPECT_EQ(profiles[0].profile.degC, (Values{30, 29.5}));
  EXPECT_EQ(profiles[0].profile.sigma_degC, (Values{0.1, 0.2}));
  EXPECT_EQ(profiles[1].profile.degC, (Values{40, 38}));
  EXPECT_TRUE(profiles[1].profile.sigma_degC.empty());
}

TEST(profile_csv, written_and_read_is_the_same) {
  const std::vector<NamedProfile> profiles{{"T_degC", {{0.1, 1.0 / 3.0, 7}, {22.1, 1e2 / 7.0, 30}, {0.1, 0.2, 0.3}}},
                                           {"U_degC", {{0.1, 1.0 / 3.0, 7}, {1, 2, 3}, {}}}};
  const std::string text = write_profiles(profiles);
  EXPECT_EQ(text.substr(0, text.find('\n')), "x_mm,T_degC,T_sigma_degC,U_degC");
  const auto read = read_profiles(text, "file");
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(read[k].profile.x_mm, profiles[k].profile.x_mm);
    EXPECT_EQ(read[k].profile.degC, profiles[k].profile.degC);
    EXPECT_EQ(read[k].profile.sigma_degC, profiles[k].profile.sigma_degC);
  }
}

TEST(profile_csv, bad_text_and_what_is_said) {
  const std::pair<const char*, const char*> table[] = {
      {"", "file:1:1: expected text, found an empty file."},
      {"x,T_degC\n0,1\n1,2\n", "file:1:1: expected x_mm as the first column, found \"x\"."},
      {"x_mm\n0\n1\n", "file:2:1: expected a column of temperatures after x_mm, found none."},
      {"x_mm,T_K\n0,1\n1,2\n", "file:1:6: expected a column of temperatures, whose name ends in _degC, found \"T_K\"."},
      {"x_mm,T_degC\n0,1\n0,2\n", "file:3:1: expected x_mm above 0 of the row before, found \"0\"."},
      {"x_mm,T_degC\n0,1\n", "file:3:1: expected at least two rows, found one."},
      {"x_mm,T_degC\n0,1\n1,\n", "file:3:3: expected a number for T_degC, found nothing."},
      {"x_mm,T_degC,U_sigma_degC\n0,1,1\n1,2,1\n",
       "file:1:13: expected a column U_degC that this is the sigma of, found \"U_sigma_degC\"."},
      {"x_mm,T_degC,T_sigma_degC\n0,1,1\n1,2,-1\n",
       "file:3:5: expected a standard uncertainty of 0 or more, found \"-1\"."},
  };
  for (const auto& [text, message] : table) {
    try {
      read_profiles(text, "file");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), message);
    }
  }
}

}  // namespace
}  // namespace ballbar
