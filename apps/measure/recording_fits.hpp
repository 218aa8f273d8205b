// The results of `ballbar fit`: one entry per recording and one per CCW/CW pair.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/circle/circle.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"

namespace ballbar {

// A named result with the stored value of the file (circle through the polar points).
struct Compared {
  std::string key;    // in JSON: "g_ccw_um"
  std::string label;  // on the terminal
  int decimals = 2;
  double ours = 0.0;
  std::optional<double> stored;
  LimitRange limits{};                   // stated in the file
  std::optional<Judgement> judgement{};  // of our value, by the limits
};

struct FittedRecording {
  std::string file;
  std::size_t index = 0;  // within the file
  std::string test_name;  // that a `.b5r` states
  Recording recording;
  std::optional<Circle> circle;         // kind circle
  std::optional<Circle> least_squares;  // that of G and of ISO 230-4; another one on an arc, whose oval it leaves out
  std::optional<Circularity> circularity;  //   "
  std::optional<AxialLength> axial;        // kind axial
  std::vector<Compared> results;           // with stored values where the file is a `.b5r`
};

struct FittedPair {
  std::string file;               // of the first recording
  std::size_t ccw = 0, cw = 0;    // places in Fitted::recordings
  std::vector<Compared> results;  // ISO 230-4
  std::vector<std::string> remarks;
};

// A value that a `.b5r` stores.
struct StoredValue {
  std::string of;  // run, with its direction, or analysis
  std::string name;
  double value = 0.0;
  std::string unit;
};

// A `.b5r` without readings: nothing to fit.
struct ResultsAlone {
  std::string file;
  B5r b5r;
  std::vector<StoredValue> stored;  // the valid ones
};
ResultsAlone results_alone_of(std::string file, B5r b5r);

struct Fitted {
  std::vector<FittedRecording> recordings;
  std::vector<FittedPair> pairs;
  std::vector<ResultsAlone> results_alone;
  std::vector<SkippedFile> skipped;
  std::vector<std::string> remarks;  // of the readers
};

// The numbers of ISO 230-4 that a file without readings stores.
std::vector<Compared> stored_iso(const B5r& b5r);

enum class Faults { end_all, skip };

// Opens and fits every file. A pair is the two directions of one `.b5r`, or two consecutive logs that differ only
// in direction. Throws Error with the name of the file, or skips that file; throws if all are skipped.
Fitted fit_files(const std::vector<Source>& files, const CircleOptions& options, Faults faults = Faults::end_all,
                 const StatedCircle& stated = {});

}  // namespace ballbar
