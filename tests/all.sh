#!/usr/bin/env bash
# What tests/run.sh leaves out, after it: long tests, studies, all sanitizer tests, clang-tidy, fuzz targets, WebAssembly,
# packages, an empty Debian, benchmarks. Ends with the time of each step and the summaries of ctest.
#
# BALLBAR_SECONDS   seconds within which all steps must end: those that would not are left out; without it none is
# BALLBAR_SLOWNESS  time of the check here, in percent of 20 minutes
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/steps.sh
sh apps/install-packages.sh check
jobs=$(nproc)
budget=${BALLBAR_SECONDS:-} slowness=${BALLBAR_SLOWNESS:-100}

# fits SECONDS STEP: whether a step can still be run that takes so long where the check takes 20 minutes. What is left out
# is said, there and at the end.
fits() {
  [[ -z $budget ]] || ((SECONDS + $1 * slowness / 100 < budget)) && return
  closing_lines+=("$2: left out, for the time is used up ($SECONDS s of $budget s)")
  echo "${closing_lines[-1]}"
  return 1
}

if fits 500 'Long tests'; then
  step 'Long tests and studies, Release'
  cmake -S . -B build-tests -DBALLBAR_STUDIES=ON >/dev/null
  cmake --build build-tests -j "$jobs"
  keep_summary 'Long tests' ctest --test-dir build-tests --output-on-failure -j "$jobs" -L 'long|study' -LE tool \
    --output-junit "$PWD/build-tests/long.xml" --test-output-size-passed 1000000
  python3 tests/skipped.py build-tests/long.xml build-tests/configured.log
fi

# What another machine could change: nothing in the environment, each BLAS of Debian by turns but the one of the run above.
if fits 150 'Each BLAS'; then
  step 'Tests as on another machine, by each BLAS'
  sh tests/strangers.sh build-tests -LE 'slow|tool'
fi

# The rest of the build for the sanitizers. Left out: the studies, statistics that the Release run holds; what takes
# seconds there and minutes here, whose parts are tested here; and the consumer, which is built by the compiler of the
# Release run. Where the time is counted, the check has run the tests of readers and core.
if fits 700 'Sanitizers of the program'; then
  step 'All tests under address and undefined-behaviour sanitizers'
  sh tests/sanitized.sh
  UBSAN_OPTIONS=print_stacktrace=1 keep_summary 'Sanitizers' ctest --test-dir build-fuzz --output-on-failure -j "$jobs" \
    -LE "study|slow${budget:+|core}" -E '^consumer$|^StoredDiagnostics|_NOT_BUILT'
fi
if fits 120 'Fuzz targets'; then
  step 'Fuzz targets, 5 s each'
  sh tests/fuzz/run.sh 5
fi

# With little time only what the last commits touched, at most 12 files. By the commands of a build in which every file is
# compiled alone, without precompiled headers: a missing include is an error here.
if fits 300 'clang-tidy'; then
  step 'clang-tidy'
  cmake -S . -B build-tidy -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release \
    -DBALLBAR_UNITY=OFF -DBALLBAR_PCH=OFF -DBALLBAR_PAGE=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
  sources=('libballbar/*.cpp' 'formats/*.cpp' 'apps/*.cpp')
  { if [[ -n $budget ]] && git rev-parse -q --verify HEAD~3 >/dev/null; then
    git diff --name-only --diff-filter=d HEAD~3 -- "${sources[@]}"
  else
    git ls-files "${sources[@]}"
  fi; } | while read -r source; do if grep -q "/$source\"" build-tidy/compile_commands.json; then echo "$source"; fi; done |
    if [[ -n $budget ]]; then sed -n 1,12p; else cat; fi | xargs -r -n 1 -P "$jobs" clang-tidy --quiet -p build-tidy
fi

if fits 1000 'ballbar.html'; then
  # The program as a module, and the page with it in both browsers.
  step 'ballbar.html: the program as WebAssembly, and its tests'
  sh apps/install-packages.sh tool browsers
  sh apps/page/build-tool.sh
  cmake -S . -B build-tests >/dev/null
  keep_summary 'ballbar.html' ctest --test-dir build-tests --output-on-failure -L tool
fi

if fits 500 'Debian packages'; then
  # Of the Release build: the program is linked anew, as the packages need it (apps/packages/make.sh), and back.
  step 'Debian packages: packed twice, checked, installed in a bare Debian, removed'
  sh apps/install-packages.sh package
  cmake -S . -B build-tests -DBALLBAR_PACKAGES=ON -DBALLBAR_PDF=OFF >/dev/null
  cmake --build build-tests --target ballbar ballbar_python
  sh tests/packages/clean_root.sh build-tests
  cmake -S . -B build-tests -DBALLBAR_PACKAGES=OFF -UBALLBAR_PDF >/dev/null
  cmake --build build-tests --target ballbar ballbar_python
fi

if fits 400 'An empty Debian'; then
  # Its own Node.js and BLAS, and nothing else in the environment.
  step 'Tests in an empty Debian'
  sh apps/install-packages.sh package
  sh tests/empty_root.sh build-tests
fi

# By hand and with --all alone: no figure is judged here.
if [[ -z $budget ]]; then
  step 'Benchmarks run (figures of a reduced run; nothing is judged by them)'
  sh apps/install-packages.sh bench
  BALLBAR_BUILD=build-tests sh tests/bench/run.sh --reduced
fi
closing
