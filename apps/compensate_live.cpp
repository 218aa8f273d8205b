#include "compensate_live.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/formats/live_rows.hpp"
#include "offset_text.hpp"
#include "text.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10;  // bytes read at once
constexpr double kStateAge_s = 1.0;                    // of the state's file while counts stay
constexpr useconds_t kPause_us = 50'000;               // between looks at a file that may grow
constexpr std::size_t kMostTold = 100;                 // changes of a hold

volatile std::sig_atomic_t g_stop = 0;

// The row at hand is finished and the state kept. A second signal ends at once, where nobody reads the offsets.
void stop_at_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop = 1; };
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // said as an error
}

class Source {
 public:
  Source(const std::string& name, bool follow) : follow_(follow) {
    if (name != "-") descriptor_ = open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw Error(fmt::format("{}: cannot be opened: {}.", name, std::strerror(errno)));
    name_ = name;
  }
  ~Source() {
    if (descriptor_ > 0) close(descriptor_);
  }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  // What has come; nothing: there is no more.
  std::string_view read() {
    while (g_stop == 0) {
      const ssize_t count = ::read(descriptor_, piece_.data(), piece_.size());
      if (count > 0) return {piece_.data(), static_cast<std::size_t>(count)};
      if (count < 0 && errno != EINTR) throw Error(fmt::format("{}: {}.", name_, std::strerror(errno)));
      if (count == 0 && !follow_) break;
      if (count == 0) expect_grows();
      if (count == 0) usleep(kPause_us);
    }
    return {};
  }

 private:
  // One that begins anew would be read from the middle, or never again.
  void expect_grows() const {
    struct stat now {};
    if (fstat(descriptor_, &now) != 0 || !S_ISREG(now.st_mode)) return;
    if (now.st_size < lseek(descriptor_, 0, SEEK_CUR)) {
      throw Error(fmt::format("{}: expected a file that grows, found it shorter than it was.", name_));
    }
  }

  int descriptor_ = STDIN_FILENO;
  bool follow_ = false;
  std::string name_;
  std::array<char, kPiece> piece_{};
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
class Told {
 public:
  explicit Told(const CompensatedAxes& machine) : machine_(machine), axes_(machine.size()) {}

  void row(double time_s, std::span<const Offset> offsets) {
    for (std::size_t a = 0; a < offsets.size(); ++a) {
      Axis& axis = axes_[a];
      const Offset& offset = offsets[a];
      ++axis.rows[static_cast<std::size_t>(offset.hold)];
      if (offset.hold == axis.hold && (offset.hold == Hold::none || offset.column == axis.column)) continue;
      axis.hold = offset.hold;
      axis.column = offset.column;
      if (told_++ < kMostTold) tell(a, time_s, offset);
    }
  }

  void sum() const {
    if (told_ > kMostTold) fmt::print(stderr, "... and {} more changes\n", told_ - kMostTold);
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      std::string held;
      std::size_t rows = axes_[a].rows[0];
      for (std::size_t kind = 1; kind < kHoldKinds; ++kind) {
        const std::size_t count = axes_[a].rows[kind];
        rows += count;
        if (count > 0) held += fmt::format("{} {} {}", held.empty() ? "; held" : ",", count, name_of(Hold(kind)));
      }
      const Compensator& axis = machine_.axis(a);
      fmt::print(stderr, "{}: {} rows, offset {} um at the end{}\n", machine_.name(a), rows,
                 fixed(static_cast<double>(axis.state().counts) * axis.state().resolution_um, 3), held);
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
      fmt::print(stderr, "{}: goes on{}\n", name, when);
      return;
    }
    const std::string column =
        is_about_a_column(offset.hold) ? " of " + shortened(machine_.axis(a).columns()[offset.column], 60) : "";
    fmt::print(stderr, "{}: held{}, {}{}; the offset stays {} um\n", name, when, name_of(offset.hold), column,
               fixed(offset.offset_um, 3));
  }

  const CompensatedAxes& machine_;
  std::vector<Axis> axes_;
  std::size_t told_ = 0;
};

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
  if (state.resumed()) fmt::print(stderr, "goes on from {}\n", options.state);
  Source input(live.signals, live.follow);
  LiveRows rows(live.signals == "-" ? "standard input" : live.signals,
                {machine.columns().begin(), machine.columns().end()});
  Told told(machine);
  fmt::memory_buffer out;
  append_names(out, live.format, machine);
  const auto take = [&](const LiveRow* row) {
    const std::span<const Offset> offsets = machine.next(row->time_s, row->values);
    append_row(out, live.format, row->time_s, offsets, machine);
    told.row(row->time_s, offsets);
  };
  stop_at_signals();
  for (std::string_view piece = input.read(); !piece.empty(); piece = input.read()) {
    rows.add(piece);
    while (const LiveRow* row = rows.next()) take(row);
    state.keep(machine, kStateAge_s);  // before the control is told: it never knows more than the file
    write_out(out);
  }
  if (g_stop == 0) {
    if (const LiveRow* row = rows.last()) take(row);
  }
  state.keep(machine, 0.0);
  write_out(out);
  told.sum();
}

}  // namespace ballbar
