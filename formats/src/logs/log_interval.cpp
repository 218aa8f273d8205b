#include "logs/log_interval.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "logs/log_cells.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"
#include "logs/time_stamp.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kIntervals =
    "interval|sampling cycle|sample cycle|sampling period|sample period|sample time|sampling time|abtastzeit|"
    "abtastintervall|messintervall|intervall|delta x|cycle time|zykluszeit|time step|dt|periode|"
    "periode d echantillonnage|intervalle|intervallo|intervalo|采样周期|采样间隔|サンプリング周期|サンプリング間隔|"
    "记录间隔|記録間隔|taktzeit|recording interval|logging interval|abtasttakt";
constexpr std::string_view kRates =
    "sampling rate|sample rate|sampling frequency|sample frequency|abtastrate|messrate|abtastfrequenz|"
    "frequence d echantillonnage|采样率|采样频率|サンプリング周波数|frequenza di campionamento|"
    "frecuencia de muestreo|rate|samplerate|scan rate|data rate";

bool holds(const std::string& key, std::string_view words) {
  return any_word(words, [&](std::string_view word) {
    return key == word || (word.size() < 5 ? key.starts_with(std::string(word) + " ") : key.find(word) != key.npos);
  });
}

std::optional<double> frequency_Hz(std::string_view unit) {
  const std::string key = folded_unit(trimmed_cell(unit));
  if (key == "hz" || key == "s/s" || key == "1/s" || key == "samples/s" || key == "sps" || key == "/s") return 1.0;
  if (key == "khz" || key == "ks/s") return 1e3;
  return std::nullopt;
}

// The number at the start of a text and what follows it: "100 ms" -> 100 and "ms".
struct Quantity {
  double value = 0.0;
  std::string unit;
};
std::optional<Quantity> quantity_of(std::string_view text) {
  text = trimmed_cell(text);
  const std::size_t end = std::min(text.find_first_not_of("0123456789.,+-eE"), text.size());
  for (std::size_t size = end; size > 0; --size) {
    for (const char decimal : {'.', ','}) {
      const auto value = cell_number(text.substr(0, size), decimal);
      if (value && *value > 0.0) return Quantity{*value, std::string(trimmed_cell(text.substr(size)))};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> interval_of(const LogShape& shape) {
  for (const HeadLine& line : shape.preamble) {
    // The first sign that parts a key from what it says.
    std::size_t cut = line.text.find_first_of(std::string(":=;\t") + (shape.delimiter == ' ' ? "" : ","));
    const std::size_t is = line.text.find(" is ");  // "Sampling period is 1000000 ns"
    if (is != std::string::npos) cut = std::min(cut, is + 2);
    if (cut == std::string::npos) continue;
    const NameAndUnit key = name_and_unit(line.text.substr(0, is == std::string::npos ? cut : std::min(cut, is)));
    std::string name = folded(key.name);
    const std::string whole = folded(line.text.substr(0, cut));
    const bool is_rate = holds(name, kRates) || holds(whole, kRates),
               is_interval = holds(name, kIntervals) || holds(whole, kIntervals);
    if (!is_rate && !is_interval) continue;
    std::vector<std::string_view> cells;
    split_cells(std::string_view(line.text).substr(cut + 1), shape.delimiter == ' ' ? '\t' : shape.delimiter, cells);
    if (is_interval && !cells.empty()) {  // "Interval;00:05:00"
      const auto stamp = time_stamp(trimmed_cell(cells.front()), DateOrder::day_first);
      if (stamp && !stamp->day && !stamp->two_fields && stamp->clock_s.value_or(0.0) > 0.0) return stamp->clock_s;
    }
    const auto quantity = cells.empty() ? std::nullopt : quantity_of(cells.front());
    if (!quantity) continue;
    std::string unit = quantity->unit;
    if (unit.empty() && cells.size() > 1) unit = std::string(trimmed_cell(cells[1]));
    if (unit.empty()) unit = key.unit;
    if (unit.empty()) {  // "Sampling period (ms)": no unit of what a column holds
      const std::size_t open = line.text.find_first_of("[("), close = line.text.find_first_of("])");
      if (open < close && close < cut) unit = line.text.substr(open + 1, close - open - 1);
    }
    if (const auto hertz = frequency_Hz(unit)) return 1.0 / (quantity->value * *hertz);
    if (const auto unit_s = time_unit_s(unit); unit_s && is_interval) return quantity->value * *unit_s;
    if (name == "delta x") return quantity->value;  // of LabVIEW's measurement files, s
  }
  return std::nullopt;
}

}  // namespace ballbar
