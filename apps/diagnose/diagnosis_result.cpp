#include "diagnose/diagnosis_result.hpp"

namespace ballbar {

std::optional<DecidingTest> deciding_test(const DiagnosisReport& report) {
  if (!report.plan_command.empty()) return DecidingTest{next_text(report), {}, {report.plan_command}};
  if (report.next_tests.empty()) return std::nullopt;
  return DecidingTest{report.next_tests.front().text, {report.next_tests.front().separation}, {}};
}

}  // namespace ballbar
