// `ballbar COMMAND` as a process.
#include <glog/logging.h>
#include <malloc.h>

#include <algorithm>
#include <string>
#include <vector>

#include "program.hpp"

int main(int argc, char** argv) {
  // Matrices of some 100 kB come and go: the memory stays with the process instead of being asked for anew each time.
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  FLAGS_minloglevel = google::GLOG_FATAL;  // of the solver: what it says stands in the results
  return ballbar::program({argv + std::min(argc, 1), argv + argc});
}
