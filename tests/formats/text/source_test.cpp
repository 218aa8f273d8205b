// Data of files and data that a program holds are opened alike; a file is opened once.
#include "ballbar/formats/text/source.hpp"

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <limits>
#include <memory>
#include <string>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

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

// How often a file is opened while it lives.
class Openings {
 public:
  explicit Openings(const std::filesystem::path& file) : events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    EXPECT_GE(inotify_add_watch(events_, file.c_str(), IN_OPEN), 0);
  }
  Openings(const Openings&) = delete;
  Openings& operator=(const Openings&) = delete;
  ~Openings() { close(events_); }

  int count() {
    alignas(inotify_event) std::array<char, 4096> bytes{};
    ssize_t size = 0;
    while ((size = read(events_, bytes.data(), bytes.size())) > 0)
      count_ += static_cast<int>(size / static_cast<ssize_t>(sizeof(inotify_event)));
    return count_;
  }

 private:
  int events_;
  int count_ = 0;
};

TEST(Source, ASeriesInMemoryIsNotCopied) {
  const auto series = three_rows();
  const Source source("<data>", series);
  EXPECT_EQ(open_drift_data(source).series, series);
  const ModelData data = open_model_data({source}, {}, 600.0);
  EXPECT_EQ(data.series, series);
  EXPECT_EQ(data.level, Level::series);
  EXPECT_EQ(data.targets, std::vector<std::string>{"z_um"});
  EXPECT_EQ(data.title, "<data>");
  EXPECT_TRUE(data.files.empty());
}

TEST(Source, AGapOfASignalIsClosedInACopy) {
  auto series = std::make_shared<Series>(*three_rows());
  series->started = "2026-11-26T08:00:00";
  series->columns[1].values[1] = std::numeric_limits<double>::quiet_NaN();
  const ModelData data = open_model_data({Source("<data>", series)}, {}, 600.0);
  EXPECT_EQ(data.series->columns[1].values, (std::vector<double>{20.0, 20.5, 21.0}));
  EXPECT_EQ(data.series->started, series->started);
  const ModelData shorter = open_model_data({Source("<data>", series)}, {}, 100.0);
  EXPECT_EQ(shorter.series->time_s.size(), 2U);
  ASSERT_EQ(shorter.remarks.size(), 1U);
  EXPECT_EQ(shorter.remarks[0],
            "<data>: 1 row left out, because T_room_degC has no value there within 100 s. State a longer "
            "--max-gap to interpolate.");
  const auto whole = three_rows();  // nothing is to be closed, however far apart its rows are
  EXPECT_EQ(open_model_data({Source("<data>", whole)}, {}, 50.0).series, whole);
}

TEST(Source, RecordingsInMemoryAreOpenedAsAFileOfThem) {
  const Source source("<data>", std::vector<Recording>{circle(), circle()});
  EXPECT_TRUE(is_recording_file(source));
  EXPECT_FALSE(source.is_path());
  EXPECT_EQ(open_recording(source).recordings.size(), 2U);
  EXPECT_EQ(open_model_data({source}, {}, 600.0).level, Level::recording);
  EXPECT_THROW(open_series(source), Error);
}

TEST(Source, ATextIsWhatAFileWouldHold) {
  const ScratchFolder folder;
  const Source source = Source::of_text("<text>", "time_s,x_um\n0,1\n60,2\n");
  EXPECT_EQ(open_series(source).columns[0].values, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(source.head(6), "time_s");
  EXPECT_EQ(complaint(folder, [&] { static_cast<void>(source.bytes(3)); }),
            "<text>: expected at most 0 MiB, found more.");
}

TEST(Source, IsOpenedOnceForItsFormatAndItsValues) {
  const ScratchFolder folder;
  const std::string series = "# format = \"ballbar-series 1\"\ntime_s,x_um\n0,1\n60,2\n";
  for (const std::string& text : {series, std::string("time [s];x [um]\n0;1,5\n60;2,5\n120;3,5\n")}) {
    const auto file = folder.write("data.csv", text);
    Openings openings(file);
    EXPECT_GE(open_model_data({file}, {}, 600.0).series->time_s.size(), 2U);
    EXPECT_EQ(openings.count(), 1) << text;
  }
}

TEST(Source, SaysWhatCannotBeRead) {
  const ScratchFolder folder;
  EXPECT_EQ(complaint(folder, [&] { static_cast<void>(Source(folder.path() / "none").bytes(10)); }),
            "DIR/none: expected a file, found nothing of that name.");
  EXPECT_EQ(complaint(folder, [&] { static_cast<void>(Source(folder.path()).bytes(10)); }),
            "DIR: expected a file, found a directory.");
  const auto file = folder.write("a.csv", "time_s,x_um\n0,1\n");
  EXPECT_EQ(complaint(folder,
                      [&] {
                        expect_once({file, folder.path() / "." / "a.csv"});
                      })
                .substr(0, 60),
            "DIR/./a.csv: expected each file once, found it again, the sa");
}

}  // namespace
}  // namespace ballbar
