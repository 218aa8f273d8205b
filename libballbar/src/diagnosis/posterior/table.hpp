// Every set of effects that has been weighed, at each likely covariance.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

struct SetKey {
  std::size_t own = 0;                // as Variant::own
  std::vector<std::size_t> families;  // rising

  friend bool operator<(const SetKey& left, const SetKey& right) {
    return std::tie(left.own, left.families) < std::tie(right.own, right.families);
  }
  friend bool operator==(const SetKey&, const SetKey&) = default;
};

// A set at one covariance and variant, its shapes summed.
struct FoundSet {
  double log_weight = kLogZero;         // ln of prior times evidence
  double most = kLogZero;               // the same of its likeliest shapes alone
  std::vector<std::size_t> signatures;  // these shapes
  std::size_t variant = 0;              // of SetTable::variants
};

struct SetTable {
  std::vector<Point> points;
  std::vector<Variant> variants;
  std::map<SetKey, std::vector<FoundSet>> sets;  // at each point; of variants of one `own` the best counts

  // What was found with this variant at some of the points, each point with its sets.
  void add(const std::vector<std::size_t>& at, std::size_t variant, std::vector<std::map<SetKey, FoundSet>> found);
};

double log_weight_of(const std::vector<FoundSet>& at);                        // all points together
std::optional<std::size_t> likeliest_point(const std::vector<FoundSet>& at);  // by `most`; nothing: none
std::vector<std::size_t> likeliest_points(const std::vector<FoundSet>& at, std::size_t most);
std::vector<std::size_t> best_points(const SetTable& table, std::size_t own,
                                     std::size_t most);  // by the best set there

// Families of effects by their weight alone.
std::vector<std::size_t> strongest_families(const Problem& problem, const SetTable& table, std::size_t own,
                                            std::size_t most);

}  // namespace ballbar
