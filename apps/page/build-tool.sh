#!/bin/sh
# ballbar.html: the page and the whole program, compiled to WebAssembly, in one file. Made in build-tool/.
#
#   sh apps/page/build-tool.sh
#
# `ballbar report --tool` copies it from there, `cmake --install` installs it with the program.
set -eu
cd "$(dirname "$0")/../.."

made=$PWD/build-tool
jobs=$(nproc)
step() { printf '\n== %s\n' "$1"; }

step 'Packages'
sh apps/install-packages.sh build page tool

step 'Libraries, from their Debian sources'
flags="-fwasm-exceptions -isystem $made/prefix/include -ffile-prefix-map=$PWD=." # no path of this machine in the module
sh apps/page/engine/libraries.sh "$made" "$jobs" "$flags"

step 'The program as a module'
export NODE_PATH=/usr/share/nodejs # of the compiler's own script
launcher=
if command -v ccache >/dev/null; then launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
# shellcheck disable=SC2086  # nothing where there is no ccache
emcmake cmake -S . -B "$made/engine" -DCMAKE_BUILD_TYPE=Release $launcher -DCMAKE_FIND_ROOT_PATH="$made/prefix" \
  -DBALLBAR_PAGE=OFF -DBALLBAR_IMAGES=OFF -DBALLBAR_MAT=OFF -DBALLBAR_PDF=OFF -DBALLBAR_HAL=OFF -DBALLBAR_PYTHON=OFF -DBALLBAR_XLSX=ON \
  -DEigen3_DIR=/usr/share/eigen3/cmake -Dnlohmann_json_DIR="$made/prefix/lib/cmake/nlohmann_json" \
  -Dtomlplusplus_DIR="$made/prefix/lib/cmake/tomlplusplus" -DCLI11_DIR="$made/prefix/lib/cmake/CLI11" \
  -DBoost_INCLUDE_DIR="$made/prefix/include" -DFAST_FLOAT_INCLUDE_DIR="$made/prefix/include" \
  -DMUPARSER_LIBRARY="$made/prefix/lib/libmuparser.a" -DMUPARSER_INCLUDE_DIR="$made/prefix/include" \
  -DZIP_LIBRARY="$made/prefix/lib/libzip.a" -DZIP_INCLUDE_DIR="$made/prefix/include" \
  -DCMAKE_CXX_FLAGS="$flags -include $PWD/apps/page/engine/from_chars.hpp" \
  >"$made/engine.log" 2>&1 || { cat "$made/engine.log"; exit 1; }
cmake --build "$made/engine" --target ballbar -j "$jobs"

step 'The page around it'
mkdir -p "$made/page"
cp apps/page/package.json apps/page/package-lock.json apps/page/.npmrc apps/page/build.mjs apps/page/catalogues.mjs apps/page/tool.mjs \
  apps/page/tsconfig.json "$made/page/"
rm -rf "$made/page/src" "$made/page/engine" "$made/page/messages"
cp -R apps/page/src apps/page/engine formats/messages "$made/page/"
if ! cmp -s "$made/page/package-lock.json" "$made/page/installed"; then
  (cd "$made/page" && npm ci --omit=dev)
  cp "$made/page/package-lock.json" "$made/page/installed"
fi
(cd "$made/page" && node build.mjs .)
# The notices of what the module is made of, as Debian has them.
while read -r package; do
  echo "=== $package"
  cat "/usr/share/doc/$package/copyright"
done <apps/page/engine/compiled_in.txt >"$made/page/notices.txt"
# The module is unpacked by a package that names its licence, MIT, and leaves out the text, which is the same for all.
{
  printf '=== xz-decompress (c) Tim Perry, Steve Sanderson\n'
  sed -n '/^\/\*!/,/\*\//p' "$made/page/node_modules/xz-decompress/dist/package/xz-decompress.js"
  sed '1,/^Copyright/d' "$made/page/node_modules/@preact/signals-core/LICENSE"
} >>"$made/page/notices.txt"
version=$(sed -n 's/^project(ballbar VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
node "$made/page/tool.mjs" "$made/page" "$made/engine/apps" sample-runs "$version" "$made/ballbar.html"
