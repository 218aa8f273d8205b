#include "ballbar/formats/text/keys.hpp"

namespace ballbar {
namespace {

constexpr Key kTest[] = {
    {"NOMINAL_LENGTH", "mm", "of the bar, above 0; needed"},
    {"PLANE", "text",
     "`TEST_PLANE` is XY, YZ or ZX, or YX, ZY or XZ; the names of its axes decide which is first; needed"},
    {"START_ANGLE", "deg", "where the arc of the readings begins, counter-clockwise; readings need it"},
    {"END_ANGLE", "deg", "where it ends, the same for a full circle; readings need it"},
    {"OVERSHOOT_ANGLE", "deg", "travelled before and after the arc"},
    {"PROGRAMMED_FEEDRATE", "mm/min", "above 0"},
    {"TEST_RADIUS", "mm", "above 0"},
    {"SPINDLE_NUMBER", "text", ""},
    {"NC_PROGRAM_ID", "text", ""},
    {"TEMP_MATERIAL_COEFFICIENT", "ppm/K", "thermal expansion that the test was set up with"},
};

constexpr Key kSpec[] = {
    {"FEATURE_SPEC", "elements", "limits of the result `NAME` in the unit `DT`, wherever it stands"},
    {"TOLERANCE", "elements", "`LEVEL` is WARNING, or another for a tolerance that the result fails"},
    {"LOWER_LIMIT", "that unit", "either may be missing"},
    {"UPPER_LIMIT", "that unit", ""},
};

constexpr Key kDocument[] = {
    {"OPERATOR", "text", ""},
    {"COMMENT", "text", "several are joined"},
    {"DATE_STARTED", "date", "start on the machine's clock; a test in a folder of tests needs it"},
    {"DATE_COMPLETED", "date", ""},
    {"MACHINE_TESTED", "nothing", "`NAME` is the machine"},
};

constexpr Key kEquipment[] = {
    {"MODEL", "text", ""},
    {"SERIAL_NUMBER", "text", ""},
    {"CERTIFICATE_NUMBER", "text", ""},
    {"LAST_CALIBRATED", "date", ""},
    {"SCALE_FACTOR", "1", "of the ballbar, above 0"},
    {"CALIBRATED_LENGTH", "mm", "of the calibrator, above 0"},
    {"EXPANSION_COEFFICIENT", "ppm/K", "of the calibrator"},
    {"TEMPERATURE", "degC", "of the calibrator"},
    {"TITLE", "text", "of the software"},
    {"VERSION", "text", "of the software"},
};

constexpr Key kRun[] = {
    {"RUN_DIRECTION", "text", "CCW or CW; readings need it"},
    {"RUN_TEMPERATURE", "degC", "of the bar"},
    {"READINGS", "mm, list", "length less the nominal one, evenly over the arc"},
    {"START_INDEX", "number", "first reading on the arc, from 0; readings need it"},
    {"END_INDEX", "number", "last reading on the arc; readings need it"},
    {"SAMPLE_RATE", "Hz", "above 0; readings need it"},
};

constexpr Key kResults[] = {
    {"FEATURE", "its unit", "a result `NAME` in the unit `DT`; `VALID` False: declined; `STATUS` against its limits"},
    {"SIMULATION", "mm, list",
     "`AF_SIMULATED_READINGS_CCW`, `_CW`: the software's model, one value a reading of the arc"},
};

}  // namespace

std::vector<KeyTable> b5r_keys() {
  return {{"`DYNAMIC_BALLBAR`, the test as it was set up", kTest},
          {"below `TEST_SPEC`: in `RUN_SPEC` for a run, in `ANALYSIS_SPEC` for an analysis", kSpec},
          {"`TEST_DOCUMENT`", kDocument},
          {"`EQUIPMENT`: `BALLBAR`, `CALIBRATOR`, `SOFTWARE`", kEquipment},
          {"`BALLBAR_RUN`, one a direction", kRun},
          {"`BALLBAR_RUN` and `ANALYSIS`", kResults}};
}

}  // namespace ballbar
