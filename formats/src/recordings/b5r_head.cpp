#include <fmt/format.h>

#include "recordings/b5r_date.hpp"
#include "recordings/b5r_parts.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kNotStated = "it is ignored";

std::string stated(std::string_view text) {
  text = trimmed(text, kBlank);
  return std::string(text == "-" ? "" : text);
}

// The head of a file: what is not plain there is a remark.
struct Head {
  const SourceText& text;
  B5rRemarks& remarks;

  Text found(pugi::xml_node parent, const char* name) const {
    return remarks.or_remark(kNotStated, [&] { return text_of(text, parent.child(name)); });
  }

  std::string words(pugi::xml_node parent, const char* name) const { return stated(found(parent, name).value); }

  std::optional<double> number(pugi::xml_node parent, const char* name) const {
    return remarks.or_remark(kNotStated, [&] { return stated_number(text, parent, name); });
  }

  std::optional<double> above_0(pugi::xml_node parent, const char* name) const {
    const std::optional<double> value = number(parent, name);
    if (!value || *value > 0.0) return value;
    const Text at = found(parent, name);
    remarks.add(at.offset, fmt::format("expected {} above 0, found {}; {}.", name, in_quotes(at.value), kNotStated));
    return std::nullopt;
  }

  std::optional<std::int64_t> date(pugi::xml_node parent, const char* name, std::string_view without) const {
    const Text at = found(parent, name);
    if (stated(at.value).empty()) return std::nullopt;
    const std::optional<std::int64_t> read = date_s(at.value);
    if (!read) {
      remarks.add(at.offset, fmt::format("expected a date such as 20250904-161049 or 2025-09-04T16:10:49 for {}, found "
                                         "{}; {}.",
                                         name, in_quotes(at.value), without));
    }
    return read;
  }

  std::string calibration_day(pugi::xml_node parent) const {
    const auto read = date(parent, "LAST_CALIBRATED", "it stays as it is");
    return read ? iso_day(*read) : words(parent, "LAST_CALIBRATED");
  }
};

}  // namespace

void B5rRemarks::add(std::size_t offset, std::string_view sentence) {
  if (!full()) sentences_.push_back(located(text_, offset, sentence));
}

void B5rRemarks::add_fault(std::string_view message, std::string_view consequence) {
  if (message.ends_with('.')) message.remove_suffix(1);
  if (!full()) sentences_.push_back(fmt::format("{}; {}.", message, consequence));
}

std::optional<double> stated_number(const SourceText& text, pugi::xml_node parent, const char* name) {
  const Text found = text_of(text, parent.child(name));
  if (found.value.empty() || found.value == "-") return std::nullopt;
  return number_of(text, found, name);
}

void read_head(const SourceText& text, pugi::xml_node document, B5r& test, B5rRemarks& remarks) {
  const Head head{text, remarks};
  test.machine = stated(document.child("MACHINE_TESTED").attribute("NAME").value());
  test.operator_name = head.words(document, "OPERATOR");
  for (const pugi::xml_node node : document.children("COMMENT")) {
    const std::string one = remarks.or_remark(kNotStated, [&] { return stated(text_of(text, node).value); });
    if (!one.empty()) test.comment += (test.comment.empty() ? "" : "; ") + one;
  }
  test.started_s = head.date(document, "DATE_STARTED", "the test is read without a date");
  test.completed_s = head.date(document, "DATE_COMPLETED", kNotStated);

  const pugi::xml_node equipment = document.child("EQUIPMENT");
  const pugi::xml_node bar = equipment.child("BALLBAR");
  test.ballbar_model = head.words(bar, "MODEL");
  test.serial_number = head.words(bar, "SERIAL_NUMBER");
  test.certificate = head.words(bar, "CERTIFICATE_NUMBER");
  test.last_calibrated = head.calibration_day(bar);
  test.scale_factor = head.above_0(bar, "SCALE_FACTOR");
  const pugi::xml_node calibrator = equipment.child("CALIBRATOR");
  test.calibrator.model = head.words(calibrator, "MODEL");
  test.calibrator.serial_number = head.words(calibrator, "SERIAL_NUMBER");
  test.calibrator.certificate = head.words(calibrator, "CERTIFICATE_NUMBER");
  test.calibrator.last_calibrated = head.calibration_day(calibrator);
  test.calibrator.calibrated_length_mm = head.above_0(calibrator, "CALIBRATED_LENGTH");
  test.calibrator.expansion_ppm_per_K = head.number(calibrator, "EXPANSION_COEFFICIENT");
  test.calibrator.temperature_degC = head.number(calibrator, "TEMPERATURE");
  test.software_title = head.words(equipment.child("SOFTWARE"), "TITLE");
  test.software_version = head.words(equipment.child("SOFTWARE"), "VERSION");

  const pugi::xml_node ballbar = document.child("TEST_SPEC").child("INSTRUMENT").child("DYNAMIC_BALLBAR");
  test.test_radius_mm = head.above_0(ballbar, "TEST_RADIUS");
  test.overshoot_deg = head.number(ballbar, "OVERSHOOT_ANGLE");
  test.programmed_feed_mm_per_min = head.above_0(ballbar, "PROGRAMMED_FEEDRATE");
  test.material_expansion_ppm_per_K = head.number(ballbar, "TEMP_MATERIAL_COEFFICIENT");
  test.spindle_number = head.words(ballbar, "SPINDLE_NUMBER");
  test.nc_program = head.words(ballbar, "NC_PROGRAM_ID");
}

}  // namespace ballbar
