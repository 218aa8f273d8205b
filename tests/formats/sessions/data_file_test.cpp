#include "ballbar/formats/sessions/data_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

// Two days of 60 readings a minute apart, 14 h between them. The probe begins the second day at so many um.
Source two_days(double second_begins_um) {
  Series data;
  data.started = "2026-11-22T07:00:00";
  data.unread = {"state"};
  Column z{"z_um", Role::measured, {}, {}}, room{"room_degC", Role::ambient, {}, {}};
  for (std::size_t i = 0; i < 120; ++i) {
    const double minute = static_cast<double>(i % 60), sign = i % 2 == 0 ? 1.0 : -1.0;
    data.time_s.push_back(60.0 * minute + (i < 60 ? 0.0 : 15.0 * 3600.0));
    z.values.push_back(30.0 * (1.0 - std::exp(-minute / 20.0)) + (i % 60 == 0 ? 0.0 : 0.2 * sign) +
                       (i < 60 ? 0.0 : second_begins_um));
    room.values.push_back((i < 60 ? 20.0 : 20.5) + 0.01 * minute);
  }
  data.columns = {z, room};
  return {"<data>", std::make_shared<const Series>(std::move(data))};
}

TEST(open_model_data, a_probe_that_is_set_to_zero_begins_a_run) {
  const ModelData data = open_model_data({two_days(0.0)}, {}, std::nullopt);
  ASSERT_EQ(data.series->runs.size(), 2U);
  EXPECT_EQ(data.series->runs[1].name, "from 2026-11-22T22:00:00");
  EXPECT_EQ(data.series->runs[1].start, RunStart::rest);
  EXPECT_EQ(data.series->time_s.size(), 120U);
  EXPECT_EQ(data.series->unread, std::vector<std::string>{"state"});
  ASSERT_EQ(data.remarks.size(), 1U);
  EXPECT_EQ(data.remarks[0],
            "<data>: behind a pause the measured values begin at what a probe is set to, such as zero. The 2 "
            "parts are read as runs, each with its own zero.");
}

TEST(open_model_data, a_probe_that_goes_on_does_not) {
  const ModelData data = open_model_data({two_days(12.0)}, {}, std::nullopt);
  EXPECT_TRUE(data.series->runs.empty());
  EXPECT_TRUE(data.remarks.empty());
}

}  // namespace
}  // namespace ballbar
