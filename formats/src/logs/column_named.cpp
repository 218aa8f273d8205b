#include "ballbar/formats/logs/column_named.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"

namespace ballbar {
namespace {

// What a counter counts in, where a header ends in it: no unit of a quantity, but no part of the name either.
constexpr std::string_view kCounts[] = {"step",       "steps",     "count", "counts", "cts",   "pulse", "pulses",
                                        "increments", "increment", "incr",  "ticks",  "digit", "digits"};

// The same of all spellings of a unit.
std::string unit_key(std::string_view unit) {
  const auto known = scaled_unit(unit);
  return known ? fmt::format("{} {} {}", known->canonical, known->factor, known->offset) : folded_unit(unit);
}

template <class Suits>
std::vector<std::size_t> places(std::size_t count, Suits suits) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < count; ++i) {
    if (suits(i)) found.push_back(i);
  }
  return found;
}

ComparableName comparable(std::string_view name) {
  ComparableName all;
  if (const std::string_view unit = unit_of(name); !unit.empty()) {
    all = {folded(name.substr(0, name.size() - unit.size() - 1)), unit_key(unit)};
  } else {
    const NameAndUnit split = name_and_unit(name);
    all = split.name.empty() ? ComparableName{folded(name), {}}
                             : ComparableName{folded(split.name), unit_key(split.unit)};
  }
  const std::size_t last = all.stem.rfind(' ');
  if (last == std::string::npos) return all;
  const std::string count = all.stem.substr(last + 1);
  if (std::find(std::begin(kCounts), std::end(kCounts), count) == std::end(kCounts)) return all;
  all.stem.resize(last);
  if (all.unit.empty()) all.unit = count;
  return all;
}

}  // namespace

std::vector<std::size_t> columns_named(std::string_view typed, const Headers& headers,
                                       const std::vector<ComparableName>& comparables) {
  const std::size_t count = headers.size();
  std::vector<std::size_t> found = places(count, [&](std::size_t i) { return headers[i].first == typed; });
  if (!found.empty()) return found;
  const ComparableName name = comparable(typed);
  found = places(count, [&](std::size_t i) {
    return headers[i].second == typed || (!name.stem.empty() && comparables[i].stem == name.stem);
  });
  const auto narrow = [&](auto suits) {
    std::vector<std::size_t> some;
    std::copy_if(found.begin(), found.end(), std::back_inserter(some), suits);
    if (!some.empty()) found = std::move(some);
  };
  narrow([&](std::size_t i) { return comparables[i].unit == name.unit; });
  narrow([&](std::size_t i) { return headers[i].second == typed; });  // in capitals or not, with accents or without
  return found;
}

std::vector<ComparableName> comparables_of(const Headers& headers) {
  std::vector<ComparableName> all;
  all.reserve(headers.size());
  for (const auto& header : headers) all.push_back(comparable(header.first));
  return all;
}

std::string column_named(const Series& data, const std::string& typed) {
  if (find_column(data, typed) != nullptr) return typed;
  Headers names, headers;
  for (const Column& column : data.columns) {
    const std::string& header = column.header.empty() ? column.name : column.header;
    names.emplace_back(column.name, "");
    headers.emplace_back(header, name_and_unit(header).name);
  }
  std::vector<std::size_t> found = columns_named(typed, headers, comparables_of(headers));
  if (found.empty()) found = columns_named(typed, names, comparables_of(names));
  if (found.empty()) return typed;
  if (found.size() == 1) return names[found.front()].first;
  std::vector<std::string> several;
  several.reserve(found.size());
  for (const std::size_t i : found) several.push_back(in_quotes(headers[i].first));
  throw Error(fmt::format("expected the name of one column, found {}, which may be {}; state its unit too.",
                          in_quotes(typed), fmt::join(several, " or ")));
}

std::vector<std::string> columns_named(const Series& data, std::vector<std::string> typed) {
  for (std::string& one : typed) one = column_named(data, one);
  return typed;
}

}  // namespace ballbar
