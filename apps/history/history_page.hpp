// The history as a page: apps/page/src/report.ts lists the keys.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/history/history.hpp"
#include "history/found_history.hpp"
#include "history/page_parts.hpp"

namespace ballbar {

// `title`: of the folder. One machine with all its quantities; several ranked.
std::variant<HistoryReport, FleetReport> history_report(const std::string& title, const FoundHistory& found);

// Bytes of the .html. `title`: of the folder. One machine with all its quantities; several ranked.
std::string history_page(const std::string& title, const FoundHistory& found);

// The ranking alone; `remarks`: sentences on what was not read, below the conclusion.
std::string ranking_page(const std::string& title, const std::vector<std::filesystem::path>& files,
                         const History& history, const std::vector<std::string>& remarks = {});

}  // namespace ballbar
