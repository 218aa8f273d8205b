// The folder of measured data that is not part of the product, or a skipped test.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#define REQUIRE_EXTERNAL_DATA(folder)                                                      \
  const char* const external = std::getenv("BALLBAR_EXTERNAL_DATA");                       \
  if (external == nullptr) GTEST_SKIP() << "BALLBAR_EXTERNAL_DATA does not name a folder"; \
  const std::filesystem::path folder(external);                                            \
  ASSERT_TRUE(std::filesystem::is_directory(folder)) << folder << " is not a folder"
