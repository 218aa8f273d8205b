// Reads the parts of a `.b5r` other than its runs into the B5r. A fault there causes a remark, not an error.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "ballbar/formats/recordings/b5r.hpp"
#include "text/xml_source.hpp"

namespace ballbar {

// NAME of the ANALYSIS that has the simulated curves.
inline constexpr const char* kCurveAnalysis = "RENISHAW_DIAGNOSTICS";

// Sentences with their place. No more than 20, and after those nothing more is read that would cost one: to say where
// costs a pass through the file.
class B5rRemarks {
 public:
  B5rRemarks(const SourceText& text, std::vector<std::string>& sentences) : text_(text), sentences_(sentences) {}

  void add(std::size_t offset, std::string_view sentence);

  // What `read` returns, or, where it throws Error, its default and a remark: the message and then `consequence`. The
  // default too where there are 20.
  template <class Read>
  auto or_remark(std::string_view consequence, Read read) -> decltype(read());

 private:
  bool full() const { return sentences_.size() >= 20; }
  void add_fault(std::string_view message, std::string_view consequence);

  const SourceText& text_;
  std::vector<std::string>& sentences_;
};

// Machine, operator, dates, equipment, and what DYNAMIC_BALLBAR states beside the arc.
void read_head(const SourceText& text, pugi::xml_node document, B5r& test, B5rRemarks& remarks);

// Every FEATURE_SPEC below TEST_SPEC.
void read_limits(const SourceText& text, pugi::xml_node test_spec, B5r& test, B5rRemarks& remarks);

// The curves of the analysis that has them. After the runs: a curve has as many values as the run has readings.
void read_curves(const SourceText& text, pugi::xml_node document, B5r& test, B5rRemarks& remarks);

// "RENISHAW_DIAGNOSTICS 2.1": under what the values of an ANALYSIS, or the limits of an ANALYSIS_SPEC, stand.
std::string analysis_name(pugi::xml_node analysis);

// nullopt: there is no such child, or it is "-" or empty.
std::optional<double> stated_number(const SourceText& text, pugi::xml_node parent, const char* name);

}  // namespace ballbar

#include "ballbar/error.hpp"

template <class Read>
auto ballbar::B5rRemarks::or_remark(std::string_view consequence, Read read) -> decltype(read()) {
  if (full()) return {};
  try {
    return read();
  } catch (const Error& error) {
    add_fault(error.what(), consequence);
    return {};
  }
}
