// A program of someone else's, built against the installed package: a circle from readings in the code, a
// log from a string.
#include <ballbar/circle/circle_fit.hpp>
#include <ballbar/error.hpp>
#include <ballbar/formats/recordings/ballbar_log.hpp>
#include <ballbar/units.hpp>
#include <cmath>
#include <iostream>

int main() {
  ballbar::Recording recording;
  for (int degree = 0; degree < 360; ++degree) {
    const double angle_rad = ballbar::rad_from_deg(degree);
    recording.angle_rad.push_back(angle_rad);
    recording.length_mm.push_back(100.0 + 0.005 * std::cos(angle_rad));
  }
  const ballbar::Circle circle = ballbar::fit_circle(recording);
  std::cout << "centre a " << circle.centre_a_um << " um, sigma " << circle.sigma_centre_a_um() << " um\n";

  const ballbar::Recording log = ballbar::read_ballbar_log(
      "# format = \"ballbar-log 1\"\n# kind = \"axial\"\n# nominal_length_mm = 100.0\n"
      "time_s,length_mm\n0.0,99.9990\n1.0,99.9991\n",
      "in-code.csv");
  const bool log_read = log.length_mm.size() == 2 && log.length_mm[1] == 99.9991;

  bool refused = false;
  try {
    ballbar::read_ballbar_log("time_s\n", "bad.csv");
  } catch (const ballbar::Error& error) {
    refused = true;
    std::cout << error.what() << '\n';
  }

  // 5 um of offset on a 100 mm bar: the second order of the length equation is 0.1 nm.
  return std::abs(circle.centre_a_um - 5.0) < 1e-3 && log_read && refused ? 0 : 1;
}
