// Data that a program holds are opened as files are.
#include "ballbar/formats/text/given_data.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"

namespace ballbar {
namespace {

std::shared_ptr<const Series> three_rows() {
  auto series = std::make_shared<Series>();
  series->time_s = {0.0, 60.0, 120.0};
  series->columns = {{"z_um", Role::measured, {0.0, 1.5, 2.0}}, {"T_room_degC", Role::ambient, {20.0, 20.5, 21.0}}};
  return series;
}

Recording circle() {
  Recording recording;
  for (int degree = 0; degree < 360; ++degree) {
    recording.angle_rad.push_back(degree * 0.017453292519943295);
    recording.length_mm.push_back(100.0);
  }
  return recording;
}

TEST(Given, SeriesIsOpenedByItsName) {
  const Given given("<data>", three_rows());
  EXPECT_EQ(open_series("<data>").columns[1].values, three_rows()->columns[1].values);
  const ModelData data = open_model_data({"<data>"}, {}, 600.0);
  EXPECT_EQ(data.level, Level::series);
  EXPECT_EQ(data.targets, std::vector<std::string>{"z_um"});
  EXPECT_EQ(data.series.time_s.size(), 3U);
  EXPECT_EQ(given_recordings("<data>"), nullptr);
}

TEST(Given, RecordingsAreOpenedByTheirName) {
  const Given given("<data>", std::vector<Recording>{circle(), circle()});
  EXPECT_TRUE(is_recording_file("<data>"));
  EXPECT_EQ(open_recording("<data>").recordings.size(), 2U);
  EXPECT_EQ(open_model_data({"<data>"}, {}, 600.0).level, Level::recording);
  EXPECT_EQ(given_series("<data>"), nullptr);
}

TEST(Given, IsGoneWithItsOwnerAndUnknownToOtherThreads) {
  {
    const Given given("<data>", three_rows());
    bool elsewhere = true;
    std::thread([&] { elsewhere = given_series("<data>") != nullptr; }).join();
    EXPECT_FALSE(elsewhere);
    const Series* const outer = given_series("<data>");
    {
      const Given inner("<data>", std::vector<Recording>{circle()});  // as of a call within a call
      EXPECT_EQ(given_series("<data>"), nullptr);
      EXPECT_NE(given_recordings("<data>"), nullptr);
    }
    EXPECT_EQ(given_series("<data>"), outer);
  }
  EXPECT_EQ(given_series("<data>"), nullptr);
  EXPECT_THROW(open_series("<data>"), Error);
}

}  // namespace
}  // namespace ballbar
