// Every reader of the list, each in the file of its format; readers.cpp lists them.
#pragma once

#include "ballbar/formats/text/reader.hpp"

namespace ballbar::readers {

extern const Reader kB5r;
extern const Reader kBallbarLog;
extern const Reader kSession;
extern const Reader kRuns;
extern const Reader kModel;
extern const Reader kSeries;
extern const Reader kSchedule;
extern const Reader kCircleTable;
extern const Reader kLogWithoutHeader;
extern const Reader kLog;
extern const Reader kOtherXml;

}  // namespace ballbar::readers
