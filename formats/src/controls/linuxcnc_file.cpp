#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "controls/control_text.hpp"

namespace ballbar {
namespace {

// The counts of an axis: minus the error.
double counts_at(const LinearCompensation& line, const SensorSlope& sensor, double reading) {
  return -sensor.slope_um_per_K * (reading - sensor.zero) / line.increment.um;
}

}  // namespace

std::string linuxcnc_file(const ControlLine& of) {
  if (of.axis.size() != 1 || std::string_view("xyzuvw").find(of.axis) == std::string_view::npos) {
    throw Error(fmt::format("--to: expected the letter of a linear axis of LinuxCNC, one of x y z u v w, found \"{}\".",
                            of.axis));
  }
  const LinearCompensation& line = of.line;
  const std::string axis = "axis." + of.axis, own = "ballbar-" + of.axis;
  const std::size_t n = line.sensors.size();
  std::vector<std::string> comments{
      fmt::format("Temperature compensation of axis {}, LinuxCNC 2.9, of its own components.", of.axis)};
  comments.insert(comments.end(), of.comments.begin(), of.comments.end());
  const std::vector<std::string> manual{
      "",
      "Manual: lincurve(9), sum2(9), mux2(9), limit2(9), conv_float_s32(9), and2(9), not(9);",
      "external offsets: axis.L.eoffset-counts are counts of axis.L.eoffset-scale.",
      "[HAL]HALFILE after the files that load motmod and the sensors; in the INI file",
      fmt::format("[AXIS_{}]OFFSET_AV_RATIO = 0.2. A component is loaded once: where another file loads",
                  char(of.axis[0] - 32)),
      "it, too, with all names there. A reading beyond an end of its curve takes the value there;",
      "a sensor that drops out is not seen. ballbar-hal holds the offset then.",
  };
  comments.insert(comments.end(), manual.begin(), manual.end());
  std::string curves, twos, text = comment_lines("#", comments);
  for (std::size_t j = 1; j <= n; ++j) {
    curves += fmt::format("{}{}-curve-{}", j > 1 ? "," : "", own, j);
    twos += j > 1 ? ",2" : "2";
  }
  text += fmt::format("\nloadrt lincurve names={} personality={}\n", curves, twos);
  std::string sums;
  for (std::size_t j = 2; j <= n; ++j) sums += fmt::format("{}{}-sum-{}", j > 2 ? "," : "", own, j);
  if (n > 1) text += fmt::format("loadrt sum2 names={}\n", sums);
  text += fmt::format(
      "loadrt and2 names={0}-ready\nloadrt not names={0}-off\nloadrt mux2 names={0}-gate\n"
      "loadrt limit2 names={0}-rate\nloadrt conv_float_s32 names={0}-counts\n",
      own);
  text += fmt::format("addf {0}-ready servo-thread\naddf {0}-off servo-thread\n", own);
  for (std::size_t j = 1; j <= n; ++j) text += fmt::format("addf {}-curve-{} servo-thread\n", own, j);
  for (std::size_t j = 2; j <= n; ++j) text += fmt::format("addf {}-sum-{} servo-thread\n", own, j);
  text += fmt::format("addf {0}-gate servo-thread\naddf {0}-rate servo-thread\naddf {0}-counts servo-thread\n", own);
  text += fmt::format("\n# Counts of {} um against the readings; a line for each sensor, such as\n",
                      decimal(line.increment.um, 6));
  for (std::size_t j = 1; j <= n; ++j) {
    text += fmt::format("#   net {}-reading-{} my-sensors.{}.out => {}-curve-{}.in\n", own, j, j - 1, own, j);
  }
  for (std::size_t j = 1; j <= n; ++j) {
    const SensorSlope& sensor = line.sensors[j - 1];
    text += comment_lines("#", {sensor.column});
    text += fmt::format(
        "setp {0}-curve-{1}.in {2}\n"
        "setp {0}-curve-{1}.x-val-00 {3}\nsetp {0}-curve-{1}.y-val-00 {4}\n"
        "setp {0}-curve-{1}.x-val-01 {5}\nsetp {0}-curve-{1}.y-val-01 {6}\n",
        own, j, decimal(sensor.zero, 1), decimal(sensor.low, 1), decimal(counts_at(line, sensor, sensor.low), 4),
        decimal(sensor.high, 1), decimal(counts_at(line, sensor, sensor.high), 4));
  }
  std::string wanted = own + "-curve-1";
  for (std::size_t j = 2; j <= n; ++j) {
    text += fmt::format(
        "net {0}-part-{1} {2}.out => {0}-sum-{1}.in0\nnet {0}-part-of-{1} {0}-curve-{1}.out => {0}-sum-{1}.in1\n", own,
        j, wanted);
    wanted = fmt::format("{}-sum-{}", own, j);
  }
  text += fmt::format(
      "\n# An offset only while the machine is on and homed: before that it is cleared, and the counts are 0.\n"
      "net {0}-on motion.motion-enabled => {0}-ready.in0\n"
      "net {0}-homed motion.is-all-homed => {0}-ready.in1\n"
      "net {0}-in-force {0}-ready.out => {0}-off.in {0}-gate.sel {1}.eoffset-enable\n"
      "net {0}-clear {0}-off.out => {0}-rate.load {1}.eoffset-clear\n"
      "net {0}-wanted {2}.out => {0}-gate.in1\n"
      "net {0}-gated {0}-gate.out => {0}-rate.in\n"
      "net {0}-limited {0}-rate.out => {0}-counts.in\n"
      "net {0}-eoffset {0}-counts.out => {1}.eoffset-counts\n"
      "setp {0}-rate.maxv {3}\n"
      "setp {1}.eoffset-scale {4}\n"
      "# with LINEAR_UNITS = inch: setp {1}.eoffset-scale {5:.10g}\n",
      own, axis, wanted, decimal(of.rate_um_per_s / line.increment.um, 6), decimal(kMmPerUm * line.increment.um, 9),
      kMmPerUm * line.increment.um / 25.4);
  return text;
}

}  // namespace ballbar
