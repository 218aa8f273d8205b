// Any bytes as rows that arrive in any pieces: LiveRows gives rows or throws Error, the same rows in other pieces, and
// the compensators behind it keep within their limits whatever comes: a step is never exceeded, nor the largest offset,
// and a held row moves nothing. The first byte chooses the pieces.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/series/live_rows.hpp"
#include "ballbar/model/model.hpp"

namespace {

using ballbar::term_of;

void expect(bool holds) {
  if (!holds) std::abort();
}

constexpr std::int64_t kStep = 3, kLargest = 120;  // counts

std::vector<ballbar::CompensatedAxis> axes() {
  ballbar::Model z, x;
  z.targets = {"z_um"};
  z.terms = {term_of("expansion", {"T_a_degC"}), term_of("lagged_expansion", {"T_b_degC"}),
             term_of("speed_heating", {"speed_rpm"}),
             ballbar::expression_term("lag(min(exp(T_b_degC), 9), tau)", {{.name = "tau", .unit = "s", .start = 70}})};
  for (ballbar::Term& term : z.terms) term.settings[0].start = 2.0;
  z.trained = {{"T_a_degC", -50.0, 150.0}};
  x.targets = {"x_um"};
  x.terms = {term_of("axial_crosstalk", {"z_um"})};
  x.terms[0].settings[0].start = 0.5;
  return {{"z", z}, {"x", x}};
}

ballbar::CompensationLimits limits() {
  ballbar::CompensationLimits limits;
  limits.step_um = 0.35;
  limits.largest_um = 12.0;
  limits.rate_um_per_s = 5.0;
  return limits;
}

// Every number of every row, as bits; false: an Error at the end, which the rows before it do not know of.
struct Found {
  std::vector<std::uint64_t> bits;
  bool read = true;
};

template <class Take>
Found rows_of(std::string_view bytes, std::size_t piece, const std::vector<std::string>& columns, const Take& take) {
  ballbar::LiveRows rows("fuzz", columns);
  Found found;
  const auto all = [&](const ballbar::LiveRow* row) {
    expect(row->values.size() == columns.size());
    const auto add = [&](double value) {
      found.bits.push_back(std::isnan(value) ? 1 : std::bit_cast<std::uint64_t>(value));
    };
    add(row->time_s);
    for (const double value : row->values) add(value);
    take(*row);
  };
  try {
    for (std::size_t at = 0; at < bytes.size(); at += std::min(piece, bytes.size() - at)) {
      rows.add(bytes.substr(at, piece));
      while (const ballbar::LiveRow* row = rows.next()) all(row);
    }
    if (const ballbar::LiveRow* row = rows.last()) all(row);
  } catch (const ballbar::Error&) {
    found.read = false;
  }
  return found;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const std::vector<ballbar::CompensatedAxis> models = axes();
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  ballbar::CompensatedAxes machine(models, limits());
  const std::vector<std::string> columns(machine.columns().begin(), machine.columns().end());
  std::array<std::int64_t, 2> counts{};
  const Found whole = rows_of(bytes, bytes.size() + 1, columns, [&](const ballbar::LiveRow& row) {
    const std::span<const ballbar::Offset> offsets = machine.next(row.time_s, row.values);
    for (std::size_t a = 0; a < counts.size(); ++a) {
      const ballbar::Offset& offset = offsets[a];
      expect(std::abs(offset.counts - counts[a]) <= kStep);
      expect(std::abs(offset.counts) <= kLargest);
      expect(offset.hold == ballbar::Hold::none || offset.counts == counts[a]);
      expect(std::isfinite(offset.predicted_um) == (offset.hold == ballbar::Hold::none));
      counts[a] = offset.counts;
      const ballbar::LiveModel::State& live = machine.axis(a).model().state();
      for (std::size_t i = 1; i < live.rows; ++i) expect(live.time_s[i] > live.time_s[i - 1]);
    }
  });
  ballbar::CompensatedAxes again(models, limits());  // wherever it stands, another can go on from there
  for (std::size_t a = 0; a < machine.size(); ++a) {
    again.axis(a).resume(machine.axis(a).state(), machine.axis(a).model().state());
  }
  const Found pieces = rows_of(bytes, std::size_t{1} + data[0], columns, [](const ballbar::LiveRow&) {});
  expect(pieces.bits == whole.bits && pieces.read == whole.read);
  return 0;
}
