#!/bin/sh
# The Debian packages of ballbar, made in BUILD, build-package/ unless another folder is named:
#
#   sh apps/packages/make.sh [BUILD]
#
# The same sources give the same bytes, in whatever folder and whenever they are built: apps/packages/reproducible.sh.
set -eu
build=$(realpath -m "${1:-$(dirname "$0")/../../build-package}")
cd "$(dirname "$0")/../.."
# What makes other bytes of the same sources. Generators differ in the order in which they link.
unset CMAKE_GENERATOR CC CXX CFLAGS CXXFLAGS CPPFLAGS LDFLAGS
umask 022
export LC_ALL=C.UTF-8 TZ=UTC
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(sh apps/packages/epoch.sh)}
export SOURCE_DATE_EPOCH

step() { printf '\n== %s\n' "$1"; }

step 'Packages to build with'
sh apps/install-packages.sh build page images mat python package

step 'ballbar.html'
sh apps/page/build-tool.sh

step "Build (Release, in $build)"
cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DBALLBAR_PACKAGES=ON \
  -DBALLBAR_PAGE=ON -DBALLBAR_IMAGES=ON -DBALLBAR_MAT=ON -DBALLBAR_PDF=OFF -DBALLBAR_XLSX=ON -DBALLBAR_PYTHON=ON -DBALLBAR_HAL=OFF
cmake --build "$build" --target ballbar ballbar_python ballbar_python_files -j "$(nproc)"

step 'Packages'
sh apps/packages/pack.sh "$build" "$build/debian"

step 'Where they are'
ls -s --block-size=kB "$build"/debian/*.deb
echo "As root: apt-get install '$build'/debian/ballbar_*.deb"
