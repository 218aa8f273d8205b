// The HAL component with its pins as values. The only file that uses the library of LinuxCNC.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/axis.hpp"

namespace ballbar::hal {

class Component {
 public:
  // Connects to HAL and makes the pins; `columns` have a pin each, which is NaN until it is connected, and so is
  // L.applied. L.scale and L.applied are in the machine's unit (LINEAR_UNITS of its INI file), of which one is
  // mm_per_unit: 1 or 25.4. Throws Error where HAL has the name already, or no memory left for pins.
  Component(const std::string& name, std::span<const std::string> columns, std::string_view axes, bool clock,
            double mm_per_unit);
  ~Component();  // the counts stay as they are; L.enable is false, so that what is done with them then moves nothing
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  // Before ready(): connecting a pin gives its value to the signal, which may still have that of a killed component.
  void begin_at(std::size_t axis, std::int64_t counts);
  void ready();  // loadusr -W waits for this

  std::vector<double> values() const;  // as columns
  double clock_s() const;              // of the pin; only with `clock`
  Pins pins(std::size_t axis) const;

  void set(std::size_t axis, const Step& step, double scale_mm);
  void set_reason(Reason reason);
  void count_row();

 private:
  struct Shared;  // pointers that HAL sets when pins are connected
  double mm_per_unit_;
  int id_ = -1;
  Shared* shared_ = nullptr;
  std::size_t columns_ = 0, axes_ = 0;
};

}  // namespace ballbar::hal
