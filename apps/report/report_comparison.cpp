// Tests before and after as a part of a report.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ballbar/error.hpp"
#include "errors/stored_test.hpp"
#include "report/report_data.hpp"
#include "report/report_results.hpp"

namespace ballbar {
namespace {

struct PlacedTest {
  MachineTest test;
  std::optional<std::size_t> place;  // in machine_errors
  bool is_after = false;
  bool taken = false;
};

// A page is mailed: the name of its file alone.
MachineTest named(MachineTest test, const std::vector<std::string>& files, const B5r* b5r) {
  test.file = file_name(files.front());
  if (files.size() > 1) test.second_file = file_name(files.back());
  if (b5r != nullptr) {
    test.machine = b5r->machine;
    test.bar = b5r->serial_number;
  }
  return test;
}

std::vector<PlacedTest> tests_of(const Fitted& fitted, const std::vector<MachineErrorsOfTest>& errors,
                                 const std::vector<std::string>& after) {
  const auto is_after = [&](const std::string& file) {
    return std::find(after.begin(), after.end(), file) != after.end();
  };
  std::vector<PlacedTest> tests;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const ErrorsReport& report = errors[k].report;
    tests.push_back(
        {named(machine_test(report.found, report.recordings), report.files, report.b5r ? &*report.b5r : nullptr), k,
         is_after(report.files.front())});
  }
  for (const ResultsAlone& alone : fitted.results_alone) {
    MachineTest test = stored_test(alone.b5r);
    if (test.quantities.empty()) continue;
    tests.push_back({named(std::move(test), {alone.file}, &alone.b5r), std::nullopt, is_after(alone.file)});
  }
  return tests;
}

PlacedTest* partner_of(const MachineTest& before, std::vector<PlacedTest>& tests) {
  PlacedTest* best = nullptr;
  std::size_t fewest = 0;
  for (PlacedTest& one : tests) {
    if (!one.is_after || one.taken || one.test.plane != before.plane) continue;
    const std::size_t differing = differing_conditions(before, one.test).size();
    if (best != nullptr && differing >= fewest) continue;
    best = &one;
    fewest = differing;
  }
  return best;
}

}  // namespace

std::vector<ComparedTests> compared_tests_of(const Fitted& fitted, const std::vector<MachineErrorsOfTest>& errors,
                                             const std::vector<std::string>& after, std::vector<std::string>& without) {
  std::vector<PlacedTest> tests = tests_of(fitted, errors, after);
  std::vector<ComparedTests> compared;
  for (PlacedTest& before : tests) {
    if (before.is_after) continue;
    PlacedTest* const other = partner_of(before.test, tests);
    if (other == nullptr) continue;
    before.taken = other->taken = true;
    compared.push_back({compared_tests(before.test, other->test), before.place, other->place});
  }
  for (const PlacedTest& one : tests) {
    if (one.taken) continue;
    without.push_back(fmt::format("{} ({}): expected another test of its plane to compare with, found none.",
                                  one.test.file, name_of(one.test.plane)));
  }
  if (compared.empty()) {
    throw Error(fmt::format("--compare: expected two tests of one plane, before and after, found none{}{}",
                            without.empty() ? "." : ": ", without.empty() ? "" : without.front()));
  }
  return compared;
}

}  // namespace ballbar
