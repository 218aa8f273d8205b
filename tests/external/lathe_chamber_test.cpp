// 29 measured batches of a lathe in a climate chamber: what is wrong with them is found, and a batch left out is
// predicted as well as a separate program (numpy, by eigenvectors of the stacked rows) found it.
#include <gtest/gtest.h>

#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/predict/train.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

struct Lathe {
  BatchColumns columns;
  std::vector<Batch> batches;
};

Lathe lathe(const std::filesystem::path& folder, const char* target) {
  Lathe result;
  for (const ListedRun& run : open_runs(folder / "lathe-chamber" / "runs.csv").runs) {
    const Series series = read_series(read_bytes(run.file, kLargestTable), run.name);
    if (result.batches.empty()) {
      result.columns = batch_columns(series, InputKind::temperature, target, "TC08_degC");
    }
    result.batches.push_back(batch_of(run.name, series, result.columns));
  }
  return result;
}

TEST(LatheChamber, finds_the_sensor_that_broke_and_the_steps) {
  REQUIRE_EXTERNAL_DATA(folder);
  const Lathe found = lathe(folder, "z_um");
  const std::vector<BrokenSensor> broken = broken_sensors(found.batches, found.columns);
  ASSERT_FALSE(broken.empty());
  EXPECT_EQ(broken.front().sensor, "PT10_degC");
  EXPECT_EQ(broken.front().batches.size(), 13U);  // from 2020-08-21 on
  EXPECT_EQ(broken.front().batches.front(), "20200821");
  std::vector<std::string> stepped;
  for (const Batch& batch : found.batches) {
    if (!batch.steps.empty()) stepped.push_back(batch.name);
  }
  EXPECT_EQ(stepped,
            (std::vector<std::string>{"20200723", "20200810", "20200923", "20200928", "20200929", "20201006"}));
}

// Root of the mean square over batches with all sensors but PT10: x 14.90, z 5.89 um with 11 components; x 14.76,
// z 5.99 um with 12.
TEST(LatheChamber, left_out_batches_are_predicted_as_by_stacked_rows) {
  REQUIRE_EXTERNAL_DATA(folder);
  constexpr RegressionSettings kSettings[] = {{RegressionMethod::pcr, 11, 0.0}, {RegressionMethod::pcr, 12, 0.0}};
  const auto rms = [&](const char* target) {
    Lathe kept = lathe(folder, target);
    leave_out_sensors(kept.batches, kept.columns, {"PT10_degC"});
    const Eigen::MatrixXd um = held_out_um(kept.batches, kSettings);
    return Eigen::Vector2d((um.colwise().squaredNorm() / static_cast<double>(um.rows())).cwiseSqrt().transpose());
  };
  const Eigen::Vector2d x = rms("x_um"), z = rms("z_um");
  EXPECT_NEAR(x[0], 14.90, 0.005);  // as printed
  EXPECT_NEAR(x[1], 14.76, 0.005);
  EXPECT_NEAR(z[0], 5.89, 0.005);
  EXPECT_NEAR(z[1], 5.99, 0.005);
}

}  // namespace
}  // namespace ballbar
