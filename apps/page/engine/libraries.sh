#!/bin/sh
# libraries.sh MADE JOBS FLAGS: what ballbar is linked with, compiled by emscripten from Debian's source packages into
# MADE/prefix; what is nothing but headers is taken from where Debian installs it. A library that is there stays, unless
# the flags are others.
set -eu
made=$1 jobs=$2 flags=$3
prefix=$made/prefix sources=$made/sources
if [ -e "$made/flags" ] && [ "$(cat "$made/flags")" != "$flags" ]; then
  for library in pugixml fmt muparser z zip ceres prefix; do rm -rf "${made:?}/$library"; done
fi
mkdir -p "$prefix/include" "$prefix/lib/cmake" "$sources"
echo "$flags" >"$made/flags"
export NODE_PATH=/usr/share/nodejs

# The machine's own list of package servers, for sources: with folders of its own, so that it needs no rights and changes
# nothing.
lists=$sources/apt
apt_source() {
  apt-get -q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$lists/servers" \
    -o Dir::State::Lists="$lists/lists" -o Dir::Cache="$lists/cache" -o APT::Sandbox::User=root "$@"
}
list_sources() {
  rm -rf "$lists/servers"
  mkdir -p "$lists/lists/partial" "$lists/cache/archives/partial" "$lists/servers"
  for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
    # Debian's own alone: a list that names another signer or suite is somebody else's.
    if [ -f "$list" ] && grep -q 'debian' "$list" && grep -Eq 'bookworm' "$list"; then
      sed 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' "$list" >"$lists/servers/$(basename "$list")"
    fi
  done
  if [ -z "$(ls "$lists/servers")" ]; then
    echo "libraries.sh: expected a list of packages of Debian bookworm in /etc/apt, found none." >&2
    exit 1
  fi
  apt_source update # each time: of a list that is old, or came in part, a source is not found
}

# The folder of a source package, unpacked. apt has checked what it brings; the signature of its uploader is not needed.
unpacked() {
  if [ ! -d "$sources/$1" ]; then
    list_sources >&2
    rm -rf "$sources/$1.new" "$sources/$1"_*.dsc # of a run that broke off, of another version
    (cd "$sources" && apt_source source --download-only "$1" && dpkg-source --no-check -x "$1"_*.dsc "$1.new") >&2
    mv "$sources/$1.new" "$sources/$1"
  fi
  echo "$sources/$1"
}

# built NAME PACKAGE OPTION...: by the library's own CMakeLists.txt.
built() {
  name=$1 package=$2
  shift 2
  [ ! -e "$prefix/lib/lib$name.a" ] || return 0
  echo "$package"
  folder=$(unpacked "$package")
  {
    emcmake cmake -S "$folder" -B "$made/$name" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
      -DCMAKE_FIND_ROOT_PATH="$prefix" -DBUILD_SHARED_LIBS=OFF -DCMAKE_CXX_FLAGS="$flags -DMAX_LOG_LEVEL=-3" \
      -DCMAKE_CXX_FLAGS_RELEASE='-O2 -DNDEBUG' "$@" &&
      cmake --build "$made/$name" -j "$jobs" && cmake --install "$made/$name"
  } >"$made/$name.log" 2>&1 || {
    tail -n 40 "$made/$name.log" >&2
    exit 1
  }
}

# A package of headers, as find_package looks for it.
headers() {
  name=$1 target=$2 folder=$3
  ln -sfn "/usr/include/$folder" "$prefix/include/$folder"
  mkdir -p "$prefix/lib/cmake/$name"
  cat >"$prefix/lib/cmake/$name/${name}Config.cmake" <<END
add_library($target INTERFACE IMPORTED)
set_target_properties($target PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$prefix/include")
END
}
headers nlohmann_json nlohmann_json::nlohmann_json nlohmann
headers tomlplusplus tomlplusplus::tomlplusplus toml++
headers CLI11 CLI11::CLI11 CLI
ln -sfn /usr/include/boost "$prefix/include/boost"
ln -sfn /usr/include/fast_float "$prefix/include/fast_float"

built pugixml pugixml
built fmt fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF
built muparser muparser -DENABLE_SAMPLES=OFF -DENABLE_OPENMP=OFF -DENABLE_WIDE_CHAR=OFF

# Debian's zlib has no header that its CMakeLists.txt would make.
if [ ! -e "$prefix/lib/libz.a" ]; then
  echo zlib
  folder=$(unpacked zlib)
  cp "$folder/zconf.h.in" "$folder/zconf.h"
  mkdir -p "$made/z"
  for file in adler32 compress crc32 deflate infback inffast inflate inftrees trees uncompr zutil; do
    emcc -O2 -c "$folder/$file.c" -o "$made/z/$file.o"
  done
  cp "$folder/zlib.h" "$folder/zconf.h" "$prefix/include/"
  emar rcs "$prefix/lib/libz.a" "$made"/z/*.o
fi
# The sizes of the two types it would ask a program for, which cannot be run here.
built zip libzip -DSIZEOF_OFF_T=8 -DSIZEOF_SIZE_T=4 -DHAVE_SIZEOF_OFF_T=TRUE -DHAVE_SIZEOF_SIZE_T=TRUE \
  -DENABLE_COMMONCRYPTO=OFF -DENABLE_GNUTLS=OFF -DENABLE_MBEDTLS=OFF -DENABLE_OPENSSL=OFF -DENABLE_BZIP2=OFF \
  -DENABLE_LZMA=OFF -DBUILD_TOOLS=OFF -DBUILD_REGRESS=OFF -DBUILD_EXAMPLES=OFF -DBUILD_DOC=OFF \
  -DZLIB_LIBRARY="$prefix/lib/libz.a" -DZLIB_INCLUDE_DIR="$prefix/include"

# Without what it would use for problems larger than ours, and without threads, which a page from a disk has not.
mkdir -p "$made/modules"
cat >"$made/modules/FindThreads.cmake" <<'END'
add_library(Threads::Threads INTERFACE IMPORTED GLOBAL)
set(Threads_FOUND TRUE)
END
built ceres ceres-solver -DCMAKE_MODULE_PATH="$made/modules" -DMINIGLOG=ON -DSUITESPARSE=OFF -DCXSPARSE=OFF -DLAPACK=OFF \
  -DEIGENSPARSE=ON -DBUILD_TESTING=OFF -DBUILD_EXAMPLES=OFF -DBUILD_BENCHMARKS=OFF -DSCHUR_SPECIALIZATIONS=OFF \
  -DCERES_THREADING_MODEL=NO_THREADS -DEigen3_DIR=/usr/share/eigen3/cmake
