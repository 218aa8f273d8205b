#include "challenge/digest.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

// FIPS 180-4, the examples published with it.
TEST(Digest, Sha256OfThePublishedExamples) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

// RFC 4648, section 10.
TEST(Digest, Base64OfThePublishedExamples) {
  const std::pair<std::string, std::string> examples[] = {{"f", "Zg=="},         {"fo", "Zm8="},
                                                          {"foo", "Zm9v"},       {"foob", "Zm9vYg=="},
                                                          {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : examples) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

TEST(Digest, WhatIsNotBase64IsNotRead) {
  for (const char* text : {"", "Zg", "Zg=", "Z===", "Zm9v\n", "Zm 9v", "Zh==", "Zm9*"}) {
    EXPECT_EQ(from_base64(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace ballbar
