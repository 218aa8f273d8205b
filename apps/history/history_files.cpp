#include "history/history_files.hpp"

#include <fmt/format.h>

#include <iterator>

#include "history/quantity_text.hpp"

namespace ballbar {

std::string history_csv(const std::vector<MachineTest>& tests) {
  std::string text = "file,date,plane,length_mm,feed_mm_per_min,arc_deg,quantity,value,sigma,unit\n";
  for (const MachineTest& test : tests) {
    const std::string of_test =
        fmt::format("{},{},{},{},{},{:.1f}", csv_text(test.file), test.started_s ? iso_date_text(*test.started_s) : "",
                    name_of(test.plane), test.nominal_length_mm,
                    test.feed_mm_per_min ? fmt::format("{:.1f}", *test.feed_mm_per_min) : "", test.arc_deg);
    for (const TestQuantity& quantity : test.quantities) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", of_test, quantity.name, csv_number(quantity.value),
                     csv_number(quantity.sigma), quantity.unit);
    }
  }
  return text;
}

}  // namespace ballbar
