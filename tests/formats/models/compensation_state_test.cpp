// Where a compensation stands: written and read to the last bit, gone on from as if nothing had been, and refused where
// a hand or half a disk has been at it.
#include "ballbar/formats/models/compensation_state.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>

#include "ballbar/error.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

Model many_effects() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_b_degC"}), term_of("lagged_expansion", {"T_a_degC"}),
                 term_of("speed_heating", {"speed_rpm"}),
                 expression_term("k * lag(lag(T_a_degC, tau), tau)",
                                 {{.name = "k", .unit = "um/K", .start = 1.0, .lower = -10, .upper = 10},
                                  {.name = "tau", .unit = "s", .start = 70, .lower = 1, .upper = 9000}})};
  for (Term& term : model.terms) term.settings[0].start = 1.0 / 3.0;
  return model;
}

// Sensors that wander, fail and come back; a clock that stands still, jumps and is set back.
class Rows {
 public:
  explicit Rows(unsigned seed) : random_(seed) {}
  double time_s() {
    time_s_ += 0.1 + 0.7 * share();
    const double what = share();
    if (what < 0.01) return kGap;
    if (what < 0.02) return time_s_ - 50.0;
    if (what < 0.025) time_s_ -= 1e4;
    if (what < 0.03) time_s_ += 2000.0;
    return time_s_;
  }
  std::vector<double> values() {
    for (double& value : values_) value += 0.3 * (share() - 0.5);
    std::vector<double> read = values_;
    for (double& value : read) {
      const double what = share();
      if (what < 0.02) value = kGap;
      if (what > 0.98) value = 1e300;
      if (what > 0.99) value = std::numeric_limits<double>::infinity();
    }
    return read;
  }

 private:
  double share() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  std::mt19937 random_;
  double time_s_ = 1e3;
  std::vector<double> values_{22.0, 25.0, 3000.0};
};

// Every number of a state; a sensor's infinity is none, as NaN is.
std::vector<std::uint64_t> bits_of(const StoredAxis& axis) {
  std::vector<std::uint64_t> bits;
  const auto add = [&](double value) {
    bits.push_back(std::bit_cast<std::uint64_t>(std::isnan(value) ? kGap : value));
  };
  const Compensator::State& state = axis.state;
  for (const double value :
       {state.resolution_um, state.time_s, state.clock_s, state.doubtful_s, state.origin_um, state.offset_um}) {
    add(value);
  }
  bits.push_back(static_cast<std::uint64_t>(state.counts));
  bits.push_back(state.timed ? 1 : 0);
  bits.push_back(state.started ? 1 : 0);
  bits.push_back(state.sensors.size());
  for (const Compensator::Sensor& sensor : state.sensors) {
    for (const double value : {sensor.believed, sensor.believed_s, sensor.read, sensor.unchanged_since_s}) {
      add(std::isinf(value) ? kGap : value);
    }
  }
  bits.push_back(axis.live.rows);
  for (const double value : axis.live.time_s) add(value);
  bits.push_back(axis.live.inputs.size());
  for (const double value : axis.live.inputs) add(value);
  bits.push_back(axis.live.kept.size());
  for (const double value : axis.live.kept) add(value);
  return bits;
}

StoredAxis stored(const Compensator& compensator) {
  return {"z", "model\t\"\\\n\xE6\xB8\xA9 # text\r\n", compensator.state(), compensator.model().state()};
}

void expect_same(const StoredAxis& found, const StoredAxis& expected) {
  EXPECT_EQ(found.name, expected.name);
  EXPECT_EQ(found.model, expected.model);
  EXPECT_EQ(bits_of(found), bits_of(expected));
}

TEST(compensation_state, written_and_read_again_is_the_same_to_the_bit) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Rows rows(seed);
    Compensator compensator(many_effects(), {});
    for (int i = 0; i < 3000; ++i) {
      if (i < 20 || i % 100 == 0) {
        const std::vector<StoredAxis> again =
            read_compensation(write_compensation({{stored(compensator)}, {}}), "s.json").axes;
        ASSERT_EQ(again.size(), 1u);
        expect_same(again[0], stored(compensator));
      }
      compensator.next(rows.time_s(), rows.values());
    }
  }
}

TEST(compensation_state, numbers_at_the_edge_of_a_double) {
  StoredAxis axis;
  axis.name = "x";
  axis.model = "m";
  axis.state.resolution_um = std::numeric_limits<double>::denorm_min();
  axis.state.counts = -1'000'000'000'000'000;
  axis.state.time_s = std::numeric_limits<double>::max();
  axis.state.clock_s = -0.0;
  axis.state.offset_um = -0.1 - 0.2;
  axis.state.origin_um = std::numeric_limits<double>::lowest();
  axis.state.sensors.resize(2);  // NaN all of it
  axis.state.sensors[1].read = 1.0 / 3.0;
  axis.live.rows = 2;
  axis.live.time_s = {-1e-300, 5e-324, 12.0};
  axis.live.kept = {9007199254740993.0, -0.0};
  const std::vector<StoredAxis> again = read_compensation(write_compensation({{axis, axis}, {}}), "s.json").axes;
  ASSERT_EQ(again.size(), 2u);
  expect_same(again[0], axis);
  expect_same(again[1], axis);
}

// One goes on all the time, the other is stopped, stored, and another goes on from the text: the same offsets.
TEST(compensation_state, goes_on_from_the_text_as_if_nothing_had_been) {
  for (const int until : {0, 1, 2, 3, 57, 1234}) {
    Rows rows(static_cast<unsigned>(until));
    Compensator all_the_time(many_effects(), {}), restarted(many_effects(), {});
    for (int i = 0; i < until; ++i) {
      const double time_s = rows.time_s();
      all_the_time.next(time_s, rows.values());
    }
    const StoredAxis again = read_compensation(write_compensation({{stored(all_the_time)}, {}}), "s.json").axes[0];
    restarted.resume(again.state, again.live);
    for (int i = 0; i < 1000; ++i) {
      const double time_s = rows.time_s();
      const std::vector<double> values = rows.values();
      const Offset expected = all_the_time.next(time_s, values), found = restarted.next(time_s, values);
      ASSERT_EQ(found.counts, expected.counts) << until << ", " << i;
      ASSERT_EQ(found.hold, expected.hold) << until << ", " << i;
      ASSERT_EQ(found.column, expected.column) << until << ", " << i;
      ASSERT_EQ(found.limited, expected.limited) << until << ", " << i;
      ASSERT_EQ(std::isnan(found.predicted_um), std::isnan(expected.predicted_um)) << until << ", " << i;
      if (!std::isnan(found.predicted_um)) {
        ASSERT_EQ(found.predicted_um, expected.predicted_um) << until << ", " << i;
      }
    }
  }
}

// z = 2 um/K (T_a - 22 degC), at 23.5 degC: an error of 3 um, 30 increments of 0.1 um against it.
constexpr const char* kState = R"({
 "format": "ballbar-compensation 1",
 "signals": {
  "file": "/logs/live.csv",
  "inode": 12,
  "bytes": 345
 },
 "axes": [
  {
   "name": "z",
   "model": "text",
   "resolution_um": 0.1,
   "counts": -30,
   "offset_um": -3.0,
   "timed": true,
   "started": true,
   "believed": 2,
   "contradicted": 0,
   "time_s": 1.0,
   "pace_s": 1.0,
   "clock_s": 0.0,
   "doubtful_s": null,
   "origin_um": 44.0,
   "sensors": [
    {
     "believed": 23.5,
     "believed_s": 1.0,
     "read": 23.5,
     "unchanged_since_s": 1.0
    }
   ],
   "live": {
    "rows": 2,
    "time_s": [
     0.0,
     1.0,
     0.0
    ],
    "inputs": [
     22.0,
     23.5,
     0.0
    ],
    "kept": []
   }
  }
 ]
}
)";

TEST(compensation_state, written) {
  Model model;
  model.targets = {"z_um"};
  model.constant_um = 0.0;
  model.terms = {
      expression_term("k * T_a_degC", {{.name = "k", .unit = "um/K", .start = 2.0, .lower = 0, .upper = 9}})};
  CompensationLimits limits;
  limits.rate_um_per_s = limits.step_um = 100.0;
  Compensator compensator(model, limits);
  compensator.next(0.0, {{22.0}});
  compensator.next(1.0, {{23.5}});
  EXPECT_EQ(write_compensation({{{"z", "text", compensator.state(), compensator.model().state()}},
                                SignalsPlace{"/logs/live.csv", 12, 345}}),
            kState);
  EXPECT_EQ(write_compensation(read_compensation(kState, "s.json")), kState);
}

TEST(compensation_state, no_axis) {
  const StoredCompensation again = read_compensation(write_compensation({}), "s.json");
  EXPECT_TRUE(again.axes.empty());
  EXPECT_FALSE(again.signals);
}

std::string complaint(const std::string& text) {
  try {
    read_compensation(text, "s.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string changed(const std::string& from, const std::string& to) {
  if (from == "*") return to;
  std::string text = kState;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good text lacks what a row changes: " + from);
  return text.replace(at, from.size(), to);
}

// Without the last end of line it is whole.
TEST(compensation_state, cut_anywhere_is_an_error) {
  const std::string text = kState;
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {
    const std::string found = complaint(text.substr(0, size));
    EXPECT_TRUE(found.starts_with("s.json:")) << size << ": " << found;
  }
}

struct Bad {
  std::string from, to;
  std::string message;  // behind the file's name
};

TEST(compensation_state, bad_text) {
  using namespace std::string_literals;
  const std::string keys =
      "name, model, resolution_um, counts, offset_um, timed, started, believed, contradicted, time_s, pace_s, clock_s, "
      "doubtful_s, origin_um, sensors, live";
  const Bad cases[] = {
      {"*", "", "1:1: expected text, found an empty file."},
      {"*", "\0"s, "1:1: expected text, found a NUL byte; this is a binary file."},
      {"*", "time_s,z_um\n", "1:1: expected JSON, found \"time_s\"."},
      {"*", "{}", " expected the key format, found none."},
      {"*", "[]", " expected an object, found an array."},
      {"compensation 1", "compensation 2",
       " expected \"ballbar-compensation 1\" at format, found the text \"ballbar-compensation 2\"."},
      {"\"axes\"", "\"axis\"", " expected one of the keys format, signals, axes, found \"axis\"; the nearest is axes."},
      {"*", "{\"format\": \"ballbar-compensation 1\", \"signals\": null, \"axes\": {}}",
       " expected an array at axes, found an object."},
      {"*", "{\"format\": \"ballbar-compensation 1\", \"signals\": null, \"axes\": [1]}",
       " expected an object at axes[0], found the integer 1."},
      {"\"bytes\": 345", "\"bytes\": -1",
       " expected a whole number not below 0 at signals.bytes, found the integer -1."},
      {"\"believed\": 2", "\"believed\": 3",
       " expected a whole number from 0 to 2 at axes[0].believed, found the integer 3."},
      {"\"name\": \"z\"", "\"name\": 7", " expected a printable text at axes[0].name, found the integer 7."},
      {"\"text\"", "null", " expected a text at axes[0].model, found null."},
      {"\"offset_um\"", "\"offset\"",
       " expected one of the keys " + keys + " in axes[0], found \"offset\"; the nearest is offset_um."},
      {"   \"offset_um\": -3.0,\n", "", " expected the key offset_um in axes[0], found none."},
      {"\"offset_um\": -3.0", "\"offset_um\": null", " expected a number at axes[0].offset_um, found null."},
      {"\"offset_um\": -3.0", "\"offset_um\": 1e999",
       "14:17: expected a number that a double can hold, found \"1e999\"."},
      {"\"counts\": -30", "\"counts\": -30.5", " expected a whole number at axes[0].counts, found the number -30.5."},
      {"\"counts\": -30", "\"counts\": 2e15",
       " expected a whole number at axes[0].counts, found the number 2000000000000000."},
      {"\"counts\": -30", "\"counts\": \"-30\"", " expected a number at axes[0].counts, found the text \"-30\"."},
      {"\"timed\": true", "\"timed\": 1", " expected true or false at axes[0].timed, found the integer 1."},
      {"\"doubtful_s\": null", "\"doubtful_s\": false", " expected a number at axes[0].doubtful_s, found false."},
      {"\"read\": 23.5", "\"read\": \"23.5\"",
       " expected a number at axes[0].sensors[0].read, found the text \"23.5\"."},
      {"     \"read\": 23.5,\n", "", " expected the key read in axes[0].sensors[0], found none."},
      {"\"rows\": 2", "\"rows\": 4", " expected a whole number from 0 to 3 at axes[0].live.rows, found the integer 4."},
      {"\"rows\": 2", "\"rows\": -1",
       " expected a whole number from 0 to 3 at axes[0].live.rows, found the integer -1."},
      {"     1.0,\n     0.0\n", "     1.0\n", " expected 3 numbers at axes[0].live.time_s, found an array."},
      {"     22.0,", "     null,", " expected a number at axes[0].live.inputs[0], found null."},
      {"\"kept\": []", "\"kept\": {}", " expected an array at axes[0].live.kept, found an object."},
  };
  for (const Bad& bad : cases) {
    EXPECT_EQ(complaint(changed(bad.from, bad.to)), "s.json:" + bad.message) << bad.from << " -> " << bad.to;
  }
}

}  // namespace
}  // namespace ballbar
