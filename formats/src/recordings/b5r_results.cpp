// Limits and curves of a `.b5r`.
#include <fmt/format.h>

#include <algorithm>

#include "ballbar/units.hpp"
#include "recordings/b5r_parts.hpp"

namespace ballbar {
namespace {

// The element after `node` in the order of the file, below `top`; null at its end. Without recursion: how deep
// elements are nested is the file's choice.
pugi::xml_node element_after(pugi::xml_node node, pugi::xml_node top) {
  if (node.first_child()) return node.first_child();
  while (node != top && !node.next_sibling()) node = node.parent();
  return node == top ? pugi::xml_node() : node.next_sibling();
}

void add_limits(const SourceText& text, pugi::xml_node spec, B5r& test, B5rRemarks& remarks) {
  constexpr std::string_view kLeftOut = "the limits are left out";
  Limit limit;
  const pugi::xml_node parent = spec.parent();
  limit.parent = std::string_view(parent.name()) == "ANALYSIS_SPEC" ? analysis_name(parent) : parent.name();
  limit.name = spec.attribute("NAME").value();
  limit.data_type = spec.attribute("DT").value();
  for (const pugi::xml_node tolerance : spec.children("TOLERANCE")) {
    if (limit.name.empty() || limit.data_type.empty()) {
      remarks.add(offset_of(spec),
                  fmt::format("expected a FEATURE_SPEC with NAME and DT, found one without; {}.", kLeftOut));
      return;
    }
    limit.level = tolerance.attribute("LEVEL").value();
    const auto end = [&](const char* name) {
      return remarks.or_remark("it is ignored", [&] { return stated_number(text, tolerance, name); });
    };
    limit.lower = end("LOWER_LIMIT");
    limit.upper = end("UPPER_LIMIT");
    if (limit.lower && limit.upper && *limit.lower > *limit.upper) {
      remarks.add(offset_of(tolerance),
                  fmt::format("expected a LOWER_LIMIT at or below UPPER_LIMIT {} for {}, found {}; {}.", *limit.upper,
                              limit.name, *limit.lower, kLeftOut));
    } else if (limit.lower || limit.upper) {
      test.limits.push_back(limit);
    }
  }
}

// The first recording of that direction; null where there is none.
const Recording* run_in(const B5r& test, Direction direction) {
  const auto run = std::find_if(test.runs.begin(), test.runs.end(),
                                [&](const Recording& one) { return one.direction == direction; });
  return run == test.runs.end() ? nullptr : &*run;
}

void add_curve(const SourceText& text, pugi::xml_node simulation, Direction direction, B5r& test, B5rRemarks& remarks) {
  const std::string_view name = simulation.attribute("NAME").value();
  const Recording* const run = run_in(test, direction);
  if (run == nullptr) {
    if (test.runs.empty()) return;  // said of all of the file
    remarks.add(offset_of(simulation), fmt::format("expected readings of the {} run for the curve {}, found none; the "
                                                   "curve is left out.",
                                                   name_of(direction), name));
    return;
  }
  SimulatedCurve curve{direction, {}};
  curve.deviation_um.reserve(run->length_mm.size());
  const bool whole = remarks.or_remark("the curve is left out", [&] {
    each_number(text, text_of(text, simulation), name,
                [&](double value_mm, const Text&) { curve.deviation_um.push_back(um_from_mm(value_mm)); });
    return true;
  });
  if (!whole) return;
  if (curve.deviation_um.size() != run->length_mm.size()) {
    remarks.add(offset_of(simulation),
                fmt::format("expected {} values in {}, as many as the {} run has used readings, found {}; the curve is "
                            "left out.",
                            run->length_mm.size(), name, name_of(direction), curve.deviation_um.size()));
    return;
  }
  test.simulated_um.push_back(std::move(curve));
}

}  // namespace

std::string analysis_name(pugi::xml_node analysis) {
  const std::string_view version = analysis.attribute("version").value();
  return fmt::format("{}{}{}", analysis.attribute("NAME").value(), version.empty() ? "" : " ", version);
}

void read_limits(const SourceText& text, pugi::xml_node test_spec, B5r& test, B5rRemarks& remarks) {
  for (pugi::xml_node node = test_spec; node; node = element_after(node, test_spec)) {
    if (std::string_view(node.name()) == "FEATURE_SPEC") add_limits(text, node, test, remarks);
  }
}

void read_curves(const SourceText& text, pugi::xml_node document, B5r& test, B5rRemarks& remarks) {
  constexpr std::pair<std::string_view, Direction> kCurves[] = {{"AF_SIMULATED_READINGS_CCW", Direction::CCW},
                                                                {"AF_SIMULATED_READINGS_CW", Direction::CW}};
  const pugi::xml_node analysis = document.find_child_by_attribute("ANALYSIS", "NAME", kCurveAnalysis);
  for (const auto& [name, direction] : kCurves) {
    const pugi::xml_node simulation = analysis.find_child_by_attribute("SIMULATION", "NAME", std::string(name).c_str());
    if (simulation) {
      add_curve(text, simulation, direction, test, remarks);
    } else if (analysis.child("FEATURE") && run_in(test, direction) != nullptr) {
      remarks.add(offset_of(analysis), fmt::format("expected the curve {} beside the values of RENISHAW_DIAGNOSTICS, "
                                                   "found none; the stored values stand without it.",
                                                   name));
    }
  }
}

std::string_view unit_of_data_type(std::string_view data_type) {
  constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
      {"UT_LENGTH_MM", "mm"},      {"UT_LENGTH_UM", "um"},    {"UT_FEEDRATE", "mm/min"},
      {"UT_ANGLE", "deg"},         {"UT_SQUARENESS", "um/m"}, {"UT_SCALE_ERROR", "ppm"},
      {"UT_SERVO_MISMATCH", "ms"}, {"UT_PERCENT", "%"},       {"UT_RANKING", ""},
  };
  for (const auto& [type, unit] : kUnits) {
    if (type == data_type) return unit;
  }
  return data_type;
}

const SimulatedCurve* simulated_curve(const B5r& test, Direction direction) {
  for (const SimulatedCurve& curve : test.simulated_um) {
    if (curve.direction == direction) return &curve;
  }
  return nullptr;
}

}  // namespace ballbar
