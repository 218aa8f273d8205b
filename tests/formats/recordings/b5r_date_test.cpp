#include "recordings/b5r_date.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

// 4 September 2025 is day 20335 of the epoch: 55 years of 365 days, 14 leap days, 246 days.
constexpr std::int64_t kMidnight_s = std::int64_t{55 * 365 + 14 + 246} * 86400;
constexpr std::int64_t kAfternoon_s = kMidnight_s + 16 * 3600 + 10 * 60 + 49;

TEST(b5r_date, forms_that_are_read) {
  for (const char* text :
       {"20250904-161049", "2025-09-04T16:10:49", "2025-09-04 16:10:49", "2025-09-04T16:10:49Z",
        "2025-09-04T16:10:49.0270000", "2025-09-04T16:10:49.027Z", "2025-09-04T16:10:49+02:00",
        "2025-09-04T16:10:49.5-0530", "04.09.2025 16:10:49", "4.9.2025 16:10:49", "20250904161049", "20250904T161049",
        "2025/09/04 16:10:49", "2025-09-04T16:10:49 CET", "4 Sept 2025 16:10:49"}) {
    EXPECT_EQ(date_s(text), kAfternoon_s) << text;
  }
  for (const char* text : {"2025-09-04T16:10", "2025-09-04 16:10Z", "04.09.2025 16:10"}) {
    EXPECT_EQ(date_s(text), kAfternoon_s - 49) << text;
  }
  for (const char* text : {"20250904", "2025-09-04", "04.09.2025", "20250904-000000"}) {
    EXPECT_EQ(date_s(text), kMidnight_s) << text;
  }
  EXPECT_EQ(date_s("19691231-235959"), -1);
}

TEST(b5r_date, forms_that_are_not) {
  for (const char* text :
       {"", "-", "03/04/2026", "03-04-2026", "20250230", "20250904-241049", "20250904-166049", "20250904-161060",
        "20250904-1610", "2025-13-04", "2025-09-04T16", "2025-09-04T16:10:49.", "31.04.2025", "16:10:49",
        "2025-09-04T26:10:49", "2025-09-04 10:49.5", "20250904-161049x", "0025090416", "2025-09-04T16:10:49+2"}) {
    EXPECT_EQ(date_s(text), std::nullopt) << text;
  }
}

TEST(b5r_date, is_written_as_the_instrument_does) {
  EXPECT_EQ(stored_date(kAfternoon_s), "20250904-161049");
  EXPECT_EQ(stored_date(-1), "19691231-235959");
  EXPECT_EQ(iso_day(kAfternoon_s), "2025-09-04");
}

}  // namespace
}  // namespace ballbar
