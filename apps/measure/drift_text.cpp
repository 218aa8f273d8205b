#include "measure/drift_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string duration(double time_s, double sigma_s) {
  const bool in_hours = time_s >= 2.0 * 3600.0;
  const double of_unit = in_hours ? 3600.0 : 60.0;
  return fmt::format("{} {}",
                     with_sigma(time_s / of_unit, sigma_s / of_unit, decimals_showing(2, sigma_s / of_unit, 2)),
                     in_hours ? "h" : "min");
}

// "2 h 4 min"
std::string span(double time_s) {
  const long minutes = std::lround(min_from_s(time_s));
  if (minutes < 60) return fmt::format("{} min", minutes);
  return minutes % 60 == 0 ? fmt::format("{} h", minutes / 60) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string speeds_text(const std::vector<double>& speeds) {
  constexpr std::size_t kShown = 5;
  std::vector<std::string> each;
  each.reserve(speeds.size());
  for (const double speed : speeds) each.push_back(fmt::format("{:.0f}", speed));
  if (each.size() <= kShown) return fmt::format("{} rpm", fmt::join(each, ", "));
  return fmt::format("{} speeds of {} to {} rpm", each.size(), each.front(), each.back());
}

std::string course_text(const Course& course) {
  const auto with_unit = [](const Estimate& one, const char* unit) {
    return fmt::format("{} {}", with_sigma(one.value_um, one.sigma_um, decimals_showing(2, one.sigma_um, 4)), unit);
  };
  if (course.shape == CourseShape::none) {
    return fmt::format(
        "{}: wanders; a trend, a curve that settles or steps leave {:.2g} um, the readings scatter by {:.2g} um",
        course.axis, course.left_um, course.noise_um);
  }
  std::string text = course.axis + ": ";
  switch (course.shape) {
    case CourseShape::still:
      text += fmt::format("no trend ({})", with_unit(course.trend_um_per_h, "um/h"));
      break;
    case CourseShape::trend:
      text += fmt::format("a trend of {}", with_unit(course.trend_um_per_h, "um/h"));
      break;
    case CourseShape::decay:
      text += fmt::format("settles by {}, time constant about {}", with_unit(course.decay, "um"),
                          span(course.time_constant_s));
      break;
    case CourseShape::none:
      break;
  }
  text += fmt::format(" ({})", percent_text(course.probability));
  for (const CourseStep& step : course.steps)
    text += fmt::format(", a step of {} at {}", with_unit(step.size, "um"), span(step.time_s));
  return text + fmt::format("; noise {:.2g} um", course.noise_um);
}

std::string lack_text(TestLack lack) {
  switch (lack) {
    case TestLack::speed:
      return "the speed of the spindle, which shows which test of ISO 230-3 it is";
    case TestLack::room_temperature:
      return "the temperature of the room (role ambient)";
    case TestLack::structure_temperature:
      return "a temperature of the spindle or the machine";
    case TestLack::a_day:
      return "a whole day, in which the room goes through its cycle";
    case TestLack::rest_after:
      return "10 min at rest after the spindle has turned, which show the cooling";
  }
  return {};
}

}  // namespace

std::vector<std::string> settling_texts(const std::vector<AxisSettling>& settling) {
  std::vector<std::string> texts;
  for (const AxisSettling& one : settling) {
    const std::string band = fmt::format("{} within {:.2g} um", one.axis, one.band_um);
    if (one.is_small || (one.stable && one.stable->time_s == 0.0)) {
      texts.push_back(fmt::format("{} from the start", band));
    } else if (!one.stable) {
      texts.push_back(fmt::format("{}: these rows do not determine it", band));
    } else {
      const StableTime& stable = *one.stable;
      const int decimals = decimals_showing(2, stable.final_sigma_um, 2);
      texts.push_back(fmt::format("{} after {}{}; {:.0f} % of the final {} um at the end", band,
                                  duration(stable.time_s, stable.sigma_s), stable.reached ? "" : ", beyond this record",
                                  100.0 * stable.share_at_end,
                                  with_sigma(stable.final_um, stable.final_sigma_um, decimals)));
    }
  }
  return texts;
}

bool any_has(const DriftSeries& series, std::optional<Estimate> DriftPoint::*member) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [&](const DriftPoint& point) { return (point.*member).has_value(); });
}

std::string time_text(double time_s) {
  const double minutes = min_from_s(time_s);
  return std::abs(minutes) >= 1000.0 ? fmt::format("{:.0f} min", minutes) : fmt::format("{:.4g} min", minutes);
}

std::vector<std::string> largest_texts(const std::vector<LargestDrift>& largest) {
  std::vector<std::string> texts;
  texts.reserve(largest.size());
  for (const LargestDrift& one : largest)
    texts.push_back(fmt::format("{} {} {} at {}", one.axis, with_sigma(one.drift), one.unit, time_text(one.time_s)));
  return texts;
}

Message largest_sentence(const LargestDrift& largest) {
  return messages::largest_drift(largest.axis, fmt::format("{} {}", with_sigma(largest.drift), largest.unit),
                                 time_text(largest.time_s));
}

std::vector<std::string> course_texts(const std::vector<Course>& courses) {
  std::vector<std::string> texts;
  texts.reserve(courses.size());
  for (const Course& one : courses) texts.push_back(course_text(one));
  return texts;
}

std::vector<std::string> thermal_test_texts(const ThermalTest& test) {
  std::vector<std::string> texts;
  const std::string rest = test.rest_after_s > 0.0 ? fmt::format(", then at rest for {}", span(test.rest_after_s)) : "";
  const std::string running = fmt::format("{}{}, by {}", span(test.running_s), rest, test.motion);
  switch (test.kind) {
    case ThermalTestKind::environment:
      texts.push_back(fmt::format("ETVE test of ISO 230-3 (environmental temperature): at rest for {}, by {}.",
                                  span(test.duration_s), test.motion));
      break;
    case ThermalTestKind::spindle:
    case ThermalTestKind::spindle_spectrum:
      texts.push_back(
          fmt::format("Spindle test of ISO 230-3 (rotating spindle): {} for {}.", speeds_text(test.speeds), running));
      break;
    case ThermalTestKind::linear_axes:
      texts.push_back(fmt::format("Linear-axis test of ISO 230-3: in motion for {}.", running));
      break;
    case ThermalTestKind::rotary_axes:
      texts.push_back(fmt::format("Rotary-axis test of ISO 230-3: in motion for {}.", running));
      break;
    case ThermalTestKind::unknown:
      break;
  }
  constexpr std::size_t kShown = 4;
  std::vector<std::string> temperatures;
  for (const TemperatureSpan& one : test.temperatures)
    temperatures.push_back(fmt::format("{} {:.1f} to {:.1f}", one.column, one.least_degC, one.largest_degC));
  if (temperatures.size() > kShown) {
    const std::size_t more = temperatures.size() - kShown;
    temperatures.resize(kShown);
    temperatures.push_back(fmt::format("{} more", more));
  }
  if (!temperatures.empty()) texts.push_back(fmt::format("Temperatures in degC: {}.", fmt::join(temperatures, ", ")));
  std::vector<std::string> lacks;
  for (const TestLack one : test.lacks) lacks.push_back(lack_text(one));
  if (!lacks.empty()) texts.push_back(fmt::format("Not in this record: {}.", fmt::join(lacks, "; ")));
  return texts;
}

}  // namespace ballbar
