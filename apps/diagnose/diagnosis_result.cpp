#include "diagnose/diagnosis_result.hpp"

namespace ballbar {

std::optional<NextStep> next_step(const DiagnosisReport& report) {
  if (!report.plan_command.empty()) return NextStep{next_text(report), {}, {report.plan_command}};
  if (report.next_tests.empty()) return std::nullopt;
  return NextStep{report.next_tests.front().text, {report.next_tests.front().separation}, {}};
}

}  // namespace ballbar
