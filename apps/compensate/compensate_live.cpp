#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <numeric>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/live_rows.hpp"
#include "compensate/compensate.hpp"
#include "compensate/offset_text.hpp"
#include "compensate/signal_source.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kStateAge_s = 1.0;        // of the state's file while counts stay
constexpr std::size_t kMostChanges = 100;  // changes of a hold

volatile std::sig_atomic_t g_stop = 0;

// The row at hand is finished and the state kept. A second signal ends at once, where nobody reads the offsets.
void stop_at_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // said as an error
}

void write_out(fmt::memory_buffer& out) {
  for (std::size_t written = 0; written < out.size();) {
    const ssize_t count = ::write(STDOUT_FILENO, out.data() + written, out.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(fmt::format("the offsets could not be written: {}.", std::strerror(errno)));
    written += static_cast<std::size_t>(count);
  }
  out.clear();
}

// What is held and goes on again, as it changes.
class HoldLog {
 public:
  HoldLog(const CompensatedAxes& machine, double gap_s) : machine_(machine), gap_s_(gap_s), axes_(machine.size()) {}

  void row(double time_s, std::span<const Offset> offsets) {
    for (std::size_t a = 0; a < offsets.size(); ++a) {
      Axis& axis = axes_[a];
      const Offset& offset = offsets[a];
      ++axis.rows[static_cast<std::size_t>(offset.hold)];
      if (offset.hold == axis.hold && (offset.hold == Hold::none || offset.column == axis.column)) continue;
      axis.hold = offset.hold;
      axis.column = offset.column;
      if (changes_++ < kMostChanges) tell(a, time_s, offset);
    }
  }

  void sum() const {
    if (changes_ > kMostChanges) stderr_line(fmt::format("... and {} more changes", changes_ - kMostChanges));
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const std::string held = held_text(axes_[a].rows);
      const std::size_t rows = std::accumulate(axes_[a].rows.begin(), axes_[a].rows.end(), std::size_t{0});
      const Compensator& axis = machine_.axis(a);
      stderr_line(fmt::format("{}: {} rows, offset {} um at the end{}{}", machine_.name(a), rows,
                              fixed(static_cast<double>(axis.state().counts) * axis.state().resolution_um, 3),
                              held.empty() ? "" : "; held ", held));
    }
  }

 private:
  struct Axis {
    Hold hold = Hold::none;
    std::size_t column = 0;
    std::array<std::size_t, kHoldKinds> rows{};
  };

  void tell(std::size_t a, double time_s, const Offset& offset) const {
    const std::string& name = machine_.name(a);
    const std::string when = std::isfinite(time_s) ? fmt::format(" at {} s", time_s) : "";
    if (offset.hold == Hold::none) {
      stderr_line(fmt::format("{}: goes on{}", name, when));
      return;
    }
    const std::string column =
        is_about_a_column(offset.hold) ? " of " + shortened(machine_.axis(a).columns()[offset.column], 60) : "";
    const bool slow = offset.hold == Hold::clock_gap;
    stderr_line(fmt::format("{}: held{}, {}{}; the offset stays {} um{}", name, when, name_of(offset.hold), column,
                            fixed(offset.offset_um, 3),
                            slow ? fmt::format(" (rows more than --gap-s {:g} apart)", gap_s_) : ""));
  }

  const CompensatedAxes& machine_;
  double gap_s_ = 0.0;
  std::vector<Axis> axes_;
  std::size_t changes_ = 0;
};

void say_unranged(const std::vector<CompensatedAxis>& axes, const CompensatedAxes& machine) {
  for (const std::string& column : machine.columns()) {
    const bool ranged = std::any_of(axes.begin(), axes.end(), [&](const CompensatedAxis& axis) {
      return std::any_of(axis.model.trained.begin(), axis.model.trained.end(),
                         [&](const ColumnRange& range) { return range.column == column; });
    });
    if (!ranged) {
      stderr_line(fmt::format("{} has no trained range: it is believed however far it goes", shortened(column, 60)));
    }
  }
}

void append_names(fmt::memory_buffer& out, OffsetFormat format, const CompensatedAxes& machine) {
  if (format == OffsetFormat::csv) append_csv_names(out, machine);
  if (format == OffsetFormat::word) append_word_names(out, machine);
}

void append_row(fmt::memory_buffer& out, OffsetFormat format, double time_s, std::span<const Offset> offsets,
                const CompensatedAxes& machine) {
  if (format == OffsetFormat::csv) append_csv(out, time_s, offsets);
  if (format == OffsetFormat::jsonl) append_jsonl(out, time_s, offsets, machine);
  if (format == OffsetFormat::word) append_words(out, time_s, offsets);
}

}  // namespace

void compensate_live(const CompensationOptions& options, const LiveOptions& live) {
  CompensationLimits limits = options.limits;
  if (live.format == OffsetFormat::word) {
    limits.largest_um = std::min(limits.largest_um, kLargestWord * limits.resolution_um);
  }
  const std::vector<CompensatedAxis> axes = axes_of(options);
  CompensatedAxes machine(axes, limits);
  KeptState state(options.state, axes, machine);
  SignalSource source(live.signals, live.follow, limits.gap_s, g_stop);
  const std::string name = live.signals == "-" ? "standard input" : live.signals;
  const std::vector<std::string> columns(machine.columns().begin(), machine.columns().end());
  LiveRows rows(name, columns);
  std::optional<SignalsPlace> place = source.place();
  std::uint64_t known = state.bytes_of(place);
  if (state.resumed()) stderr_line(fmt::format("goes on from {}", options.state));
  say_unranged(axes, machine);
  HoldLog holds(machine, limits.gap_s);
  fmt::memory_buffer out;
  append_names(out, live.format, machine);
  std::vector<std::int64_t> written;  // counts that the control has
  for (std::size_t a = 0; a < machine.size(); ++a) written.push_back(machine.axis(a).state().counts);
  const auto hand_over = [&] {
    if (place) place->bytes = std::max(known, rows.taken());
    state.keep(machine, place, kStateAge_s);  // before the control is told: it never knows more than the file
    write_out(out);
    for (std::size_t a = 0; a < machine.size(); ++a) written[a] = machine.axis(a).state().counts;
  };
  const auto take = [&](const LiveRow* row) {
    if (rows.taken() <= known) return;  // before a restart
    const std::span<const Offset> offsets = machine.next(row->time_s, row->values);
    append_row(out, live.format, row->time_s, offsets, machine);
    holds.row(row->time_s, offsets);
    // What is stored and not yet written is less than a step, so that a restart makes none.
    for (std::size_t a = 0; a < offsets.size(); ++a) {
      if (2.0 * std::abs(static_cast<double>(offsets[a].counts - written[a])) * limits.resolution_um > limits.step_um) {
        hand_over();
      }
    }
  };
  stop_at_signals();
  if (place) place->bytes = known;
  state.keep(machine, place, 0.0);  // one that cannot be written is said before a row is taken
  while (true) {
    const std::string_view piece = source.read();
    if (piece.empty()) {
      if (g_stop != 0 || !source.reopened()) break;
      stderr_line(fmt::format("{}: goes on with the file that has its name now", name));
      rows = LiveRows(name, columns);
      place = source.place();
      known = 0;
      continue;
    }
    rows.add(piece);
    while (const LiveRow* row = rows.next()) take(row);
    hand_over();
  }
  if (g_stop == 0) {
    if (const LiveRow* row = rows.last()) take(row);
  }
  if (place) place->bytes = std::max(known, rows.taken());
  state.keep(machine, place, 0.0);
  write_out(out);
  holds.sum();
}

}  // namespace ballbar
