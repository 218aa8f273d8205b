#!/bin/sh
# The one list of the Debian packages ballbar needs, and their installation.
#
#   sh apps/install-packages.sh GROUP...
#
# build                         the least to read, fit, report and diagnose
# page images mat pdf hal       a component each, built where its packages are: the page of `ballbar report`; pictures;
#                               .mat files; a test as PDF; LinuxCNC
# python fleet                  the package of Python; many machines at once with it, by Dask
# tool                          the whole program as a page, apps/page/build-tool.sh
# package                       the Debian packages, apps/packages/make.sh
# test browsers bench check     what the developers need besides; browsers: for the tests of tool
#
# Installs what is missing; where nothing is, no package tool is called and no rights are needed.
set -eu

build='g++ make cmake libeigen3-dev libceres-dev libfmt-dev libpugixml-dev libtomlplusplus-dev nlohmann-json3-dev
  libcli11-dev libmuparser-dev libboost-dev libfast-float-dev libzip-dev'
# Node.js comes with npm from elsewhere too, and then Debian's own two exclude it.
command -v node >/dev/null && command -v npm >/dev/null && page= || page='nodejs npm'
images='libopencv-imgproc-dev libspng-dev libjpeg62-turbo-dev'
mat=libmatio-dev
pdf='librsvg2-dev pkg-config'
# Beside build, whose headers it takes.
tool='emscripten dpkg-dev xz-utils'
python='pybind11-dev python3-dev python3-numpy python3-pandas python3-venv'
# Many machines at once, tables and pictures in Python.
fleet='python3-distributed python3-matplotlib python3-tqdm'
hal='linuxcnc-uspace linuxcnc-uspace-dev'
package='dpkg-dev file help2man lintian mmdebstrap uidmap desktop-file-utils shared-mime-info libglib2.0-bin'
test='libgtest-dev librapidcheck-dev python3 python3-numpy python3-pandas python3-sklearn python3-nbclient python3-ipykernel mypy chromium fonts-dejavu-core'
browsers='chromium firefox-esr fonts-dejavu-core'
bench='libbenchmark-dev python3 python3-numpy python3-scipy python3-sklearn'
# Every BLAS that Debian has, for tests by each (tests/strangers.sh).
check='git mypy clang clang-format clang-tidy libclang-rt-14-dev libblas3 libatlas3-base libopenblas0-pthread'

wanted=
for group in "$@"; do
  case $group in
    build) wanted="$wanted $build" ;;
    page) wanted="$wanted $page" ;;
    images) wanted="$wanted $images" ;;
    mat) wanted="$wanted $mat" ;;
    pdf) wanted="$wanted $pdf" ;;
    python) wanted="$wanted $python" ;;
    fleet) wanted="$wanted $fleet" ;;
    tool) wanted="$wanted $tool" ;;
    hal) wanted="$wanted $hal" ;;
    package) wanted="$wanted $package" ;;
    test) wanted="$wanted $test" ;;
    browsers) wanted="$wanted $browsers" ;;
    bench) wanted="$wanted $bench" ;;
    check) wanted="$wanted $check" ;;
    *)
      echo "install-packages.sh: no group '$group'; the groups are build, page, images, mat, pdf, python, fleet," \
        "tool, hal, package, test, browsers, bench, check" >&2
      exit 2
      ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  echo "This is not a Debian system. These packages, or what they are called here, must be installed:"
  echo "$wanted"
  exit 0
fi

missing=
for package in $wanted; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
if [ -z "$missing" ]; then
  echo "Packages: all installed."
  exit 0
fi

echo "Packages to install:$missing"
if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "install-packages.sh: needs root to install packages and there is no sudo here; as root, run" >&2
  echo "  apt-get install --no-install-recommends$missing" >&2
  exit 1
fi
$as_root apt-get update -q
# shellcheck disable=SC2086  # the list is meant to be split
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
