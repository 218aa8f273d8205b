#include "text/xml_source.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

std::vector<double> numbers(const std::string& bytes) {
  const SourceText text{bytes, "file"};
  std::vector<double> found;
  each_number(text, {bytes, 0}, "a number", [&](double value, const Text&) { found.push_back(value); });
  return found;
}

// strtod rounds once; so do both ways by which a number is read, the short and the long.
TEST(xml_source, numbers_are_those_of_the_c_library) {
  const bool passed = rc::check([] {
    std::string text = *rc::gen::element<std::string>("", "+", "-");
    const auto whole = *rc::gen::inRange<std::size_t>(0, 12), decimals = *rc::gen::inRange<std::size_t>(1, 12);
    for (std::size_t i = 0; i < whole; ++i) text += *rc::gen::inRange('0', ':');
    if (*rc::gen::arbitrary<bool>() || whole == 0) text += '.';
    for (std::size_t i = 0; i < decimals; ++i) text += *rc::gen::inRange('0', ':');
    const double expected = std::strtod(text.c_str(), nullptr);
    const SourceText source{text, "file"};
    RC_ASSERT(number_of(source, {text, 0}, "a number") == expected);
    RC_ASSERT(numbers(text + " \r\n\t" + text + " " + text) == std::vector<double>(3, expected));
  });
  EXPECT_TRUE(passed);
}

TEST(xml_source, numbers_of_other_forms) {
  EXPECT_EQ(numbers("1e-3 2. .5 +1E2 -0"), (std::vector<double>{1e-3, 2.0, 0.5, 100.0, 0.0}));
  EXPECT_EQ(numbers("123456789012345 1234567890123456 0.0000000000000001 99999999999999999999"),
            (std::vector<double>{123456789012345.0, 1234567890123456.0, 1e-16, 1e20}));
  // Of 16 digits both the whole and the quotient would be rounded.
  EXPECT_EQ(numbers("91399620.84340797 944608837.2433843"),
            (std::vector<double>{91399620.84340797, 944608837.2433843}));
  EXPECT_EQ(numbers(""), std::vector<double>{});
  for (const char* text : {".", "+", "-", "1.2.3", "1,2", "--1", "+-1", "1x", "0x1", "inf", "nan", "1e999"}) {
    EXPECT_THROW(numbers(text), Error) << text;
    const SourceText source{text, "file"};
    EXPECT_THROW(number_of(source, {text, 0}, "a number"), Error) << text;
  }
  const SourceText empty{"", "file"};
  EXPECT_THROW(number_of(empty, Text(), "a number"), Error);
}

}  // namespace
}  // namespace ballbar
