#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numeric>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/live_rows.hpp"
#include "compensate/compensate.hpp"
#include "compensate/offset_text.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kStateAge_s = 1.0;        // of the state's file while counts stay
constexpr int kPause_ms = 50;              // between looks at a file that may grow
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

bool is_file(const struct stat& status) { return S_ISREG(status.st_mode); }

// Bytes of signals as they come: from the standard input, a file, or a file that a logger still writes.
class SignalSource {
 public:
  // "-": the standard input. follow: waits at the end of a file for more. silence_s: how long nothing may come before
  // that is said. Throws Error where it cannot be opened.
  SignalSource(const std::string& name, bool follow, double silence_s)
      : name_(name), follow_(follow), silence_s_(silence_s) {
    if (name != "-") open_file();
  }
  ~SignalSource() {
    if (descriptor_ > 0) close(descriptor_);
  }
  SignalSource(const SignalSource&) = delete;
  SignalSource& operator=(const SignalSource&) = delete;

  // What has come, until the next call; empty: no more will, or another file has taken the name. Throws Error where
  // reading fails, or the file became shorter than what was read of it.
  std::string_view read() {
    double waited_s = 0.0;
    while (g_stop == 0) {
      struct pollfd ready {
        descriptor_, POLLIN, 0
      };
      const int found = poll(&ready, 1, kPause_ms);
      if (found < 0 && errno != EINTR) throw Error(fmt::format("{}: {}.", name_, std::strerror(errno)));
      if (found <= 0) {
        if (found == 0) wait(waited_s);
        continue;
      }
      const ssize_t count = ::read(descriptor_, piece_.data(), piece_.size());
      if (count > 0) return {piece_.data(), static_cast<std::size_t>(count)};
      if (count < 0 && errno != EINTR) throw Error(fmt::format("{}: {}.", name_, std::strerror(errno)));
      if (count != 0) continue;
      if (!follow_) return {};
      expect_grows();
      if (replaced()) {
        open_file();
        reopened_ = true;
        return {};
      }
      usleep(kPause_ms * 1000);
      wait(waited_s);
    }
    return {};
  }

  // With follow: another file has taken the name, as where logs are rotated. Then read() goes on with that.
  bool reopened() { return std::exchange(reopened_, false); }

  // Which file this is, at 0 bytes; nothing for what is no regular file.
  std::optional<SignalsPlace> place() const {
    struct stat now {};
    if (descriptor_ == 0 || fstat(descriptor_, &now) != 0 || !is_file(now)) return std::nullopt;
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(name_, error);
    return SignalsPlace{error ? name_ : whole.string(), now.st_ino, 0};
  }

 private:
  void open_file() {
    const int opened = open(name_.c_str(), O_RDONLY | O_CLOEXEC);
    if (opened < 0) throw Error(fmt::format("{}: cannot be opened: {}.", name_, std::strerror(errno)));
    if (descriptor_ > 0) close(descriptor_);
    descriptor_ = opened;
  }

  // Says once when nothing has come for too long.
  void wait(double& waited_s) const {
    const double before_s = waited_s;
    waited_s += 1e-3 * kPause_ms;
    if (before_s <= silence_s_ && waited_s > silence_s_) {
      stderr_line(
          fmt::format("{}: no row for {:g} s; the offsets stay", name_ == "-" ? "standard input" : name_, silence_s_));
    }
  }

  bool replaced() const {
    struct stat ours {
    }, named{};
    if (fstat(descriptor_, &ours) != 0 || !is_file(ours) || stat(name_.c_str(), &named) != 0) return false;
    return is_file(named) && (named.st_ino != ours.st_ino || named.st_dev != ours.st_dev);
  }

  // One that begins anew would be read from the middle, or never again.
  void expect_grows() const {
    struct stat now {};
    if (fstat(descriptor_, &now) != 0 || !is_file(now)) return;
    if (now.st_size < lseek(descriptor_, 0, SEEK_CUR)) {
      throw Error(fmt::format("{}: expected a file that grows, found it shorter than it was.", name_));
    }
  }

  std::string name_;
  bool follow_ = false;
  double silence_s_ = 0.0;
  int descriptor_ = 0;
  bool reopened_ = false;
  std::array<char, std::size_t{64} << 10> piece_{};
};

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
  SignalSource source(live.signals, live.follow, limits.gap_s);
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
