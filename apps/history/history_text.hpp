// The output of `ballbar history`.
#pragma once

#include <string>
#include <vector>

#include "ballbar/history/history.hpp"
#include "ballbar/message.hpp"
#include "errors/test_files.hpp"
#include "history/found_history.hpp"

namespace ballbar {

// One machine: the conclusion, one table per group, squareness and scales. Several machines: the ranking. Then undated
// tests and skipped files. `all`: also quantities without findings, and all machines.
std::string history_text(const FoundHistory& found, bool all);

// One machine, for the page and the text: the conclusion above the tables, and the rows of the table of a group. Its
// columns are quantity, unit, last, change, sigmas, a year, tolerance, met; "-": no value.
std::vector<Paragraph> machine_conclusion(const History& history);
std::vector<std::string> quantity_row(const MachineHistory& machine, std::size_t series);

std::string group_text(const TestGroup& group);  // "XY, 100 mm, 1000 mm/min, 360 deg"

// The outlook of a series; nullptr: it has no tolerance.
const ToleranceOutlook* outlook_for(const MachineHistory& machine, std::size_t series);
// Whether a finding of such a kind names the series.
bool is_found(const MachineHistory& machine, std::size_t series, bool lasting);

struct GeometryTexts {
  std::string heading;
  std::vector<std::vector<std::string>> rows;  // what, um/m, from
  std::vector<Paragraph> sentences;            // whether the tests agree, and what scales are against
};

GeometryTexts geometry_texts(const TestFiles& files, const MachineGeometry& geometry, bool all = true);

// Empty where no test tells them. Places of the geometry are those in files.tests.
std::string geometry_text(const TestFiles& files, const MachineGeometry& geometry, bool all);

// Many machines on one screen: the conclusion, the machines that need attention, and the remedies.
// all: every machine that needs something, else the first of them. `remarks`: sentences on what was not read, below the
// conclusion.
std::string ranking_text(const History& history, bool all = false, const std::vector<std::string>& remarks = {});

// "2 of 40 machines are beyond a tolerance.", for the text and the page.
std::vector<Paragraph> conclusion(const History& history);
Message quantities_tested(const History& history);

// The reason for the rank of a machine, its findings and the remedies.
std::string explanation(const MachineHistory& machine);

// For the table of machines that need attention.
std::vector<std::string> ranking_heading();
std::vector<std::string> ranking_row(const MachineHistory& machine);

}  // namespace ballbar
