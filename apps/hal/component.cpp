#include "hal/component.hpp"

#include <fmt/format.h>
#include <hal.h>

#include <array>
#include <limits>

#include "ballbar/error.hpp"
#include "hal/hal_names.hpp"

namespace ballbar::hal {
namespace {

constexpr std::size_t kMostColumns = 64, kMostAxes = 6;

struct ColumnPin {
  hal_float_t* value;
};

struct AxisPins {
  hal_s32_t* counts;
  hal_float_t* scale;
  hal_float_t* offset_um;
  hal_float_t* applied;
  hal_bit_t* enable;
};

void expect(int status, const std::string& what) {
  if (status < 0) throw Error(fmt::format("HAL: {}: error {}.", what, status));
}

}  // namespace

// In HAL's memory: it changes the pointers of pins when they are connected to signals.
struct Component::Shared {
  hal_bit_t* enable;
  hal_float_t* clock_s;
  hal_bit_t* held;
  hal_s32_t* hold_reason;
  hal_s32_t* rows;
  std::array<ColumnPin, kMostColumns> columns;
  std::array<AxisPins, kMostAxes> axes;
};

Component::Component(const std::string& name, std::span<const std::string> columns, std::string_view axes, bool clock,
                     double mm_per_unit)
    : mm_per_unit_(mm_per_unit), columns_(columns.size()), axes_(axes.size()) {
  const std::vector<std::string> signals = signal_pins(name, columns);
  if (columns.size() > kMostColumns) {
    throw Error(fmt::format("expected at most {} columns in all models, found {}.", kMostColumns, columns.size()));
  }
  id_ = hal_init(name.c_str());
  if (id_ < 0) {
    throw Error(
        fmt::format("HAL takes no component '{}': error {}; where one of this name is there, alive or killed, "
                    "choose another with --name.",
                    name, id_));
  }
  try {
    shared_ = static_cast<Shared*>(hal_malloc(sizeof(Shared)));
    if (shared_ == nullptr) throw Error("HAL: no memory left for pins.");
    const auto bit = [&](const std::string& pin, hal_pin_dir_t direction, hal_bit_t** at) {
      expect(hal_pin_bit_new((name + "." + pin).c_str(), direction, at, id_), pin);
      **at = false;
    };
    const auto s32 = [&](const std::string& pin, hal_s32_t** at) {
      expect(hal_pin_s32_new((name + "." + pin).c_str(), HAL_OUT, at, id_), pin);
      **at = 0;
    };
    const auto real = [&](const std::string& pin, hal_pin_dir_t direction, hal_float_t** at, double value) {
      expect(hal_pin_float_new(pin.c_str(), direction, at, id_), pin);
      **at = value;
    };
    constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
    bit("enable", HAL_IN, &shared_->enable);
    bit("held", HAL_OUT, &shared_->held);
    s32("hold-reason", &shared_->hold_reason);
    s32("rows", &shared_->rows);
    if (clock) real(name + ".clock-s", HAL_IN, &shared_->clock_s, kNoNumber);
    for (std::size_t c = 0; c < signals.size(); ++c) real(signals[c], HAL_IN, &shared_->columns[c].value, kNoNumber);
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const std::string letter(1, axes[a]), axis = name + "." + letter;
      AxisPins& pins = shared_->axes[a];
      s32(letter + ".counts", &pins.counts);
      real(axis + ".scale", HAL_OUT, &pins.scale, 0.0);
      real(axis + ".offset-um", HAL_OUT, &pins.offset_um, 0.0);
      real(axis + ".applied", HAL_IN, &pins.applied, kNoNumber);
      bit(letter + ".enable", HAL_OUT, &pins.enable);
    }
  } catch (...) {
    hal_exit(id_);
    throw;
  }
}

Component::~Component() {
  for (std::size_t a = 0; a < axes_; ++a) *shared_->axes[a].enable = false;
  hal_exit(id_);
}

void Component::begin_at(std::size_t axis, std::int64_t counts) {
  *shared_->axes[axis].counts = static_cast<rtapi_s32>(counts);
}

void Component::ready() { expect(hal_ready(id_), "ready"); }

std::vector<double> Component::values() const {
  std::vector<double> values(columns_);
  for (std::size_t c = 0; c < columns_; ++c) values[c] = *shared_->columns[c].value;
  return values;
}

double Component::clock_s() const { return *shared_->clock_s; }

Pins Component::pins(std::size_t axis) const {
  const AxisPins& pins = shared_->axes[axis];
  return {*shared_->enable, *pins.applied * mm_per_unit_};
}

// The scale and the enable first: LinuxCNC may look in between, and a change of counts it sees before is lost.
void Component::set(std::size_t axis, const Step& step, double scale_mm) {
  const AxisPins& pins = shared_->axes[axis];
  *pins.scale = scale_mm / mm_per_unit_;
  *pins.enable = step.enable;
  if (step.change != 0) *pins.counts = static_cast<rtapi_s32>(*pins.counts + step.change);
  *pins.offset_um = step.offset.offset_um;
}

void Component::set_reason(Reason reason) {
  *shared_->hold_reason = static_cast<rtapi_s32>(reason);
  *shared_->held = reason != Reason::none;
}

void Component::count_row() { *shared_->rows = *shared_->rows + 1; }

}  // namespace ballbar::hal
