#!/bin/sh
# What Debian wants of files that are about to be packed, and what makes two packings the same:
#
#   sh stage.sh STAGED BUILD VERSION
#
# In each component below STAGED: copyright with the notices of what is compiled in, changelog, manual pages of the
# program, permissions that the umask does not set, times of the changelog.
set -eu
staged=$1 build=$2 version=$3
here=$(cd "$(dirname "$0")" && pwd)
source=$here/../..
export LC_ALL=C
epoch=${SOURCE_DATE_EPOCH:-$(sh "$here/epoch.sh")}
modules=$build/apps/page/node_modules

# Packages whose code is in the program, or in the libraries, by what their headers and archives say.
in_libraries='libeigen3-dev libboost-dev libfast-float-dev libtomlplusplus-dev nlohmann-json3-dev'
in_program="$in_libraries libceres-dev libcli11-dev"
if grep -q '^OPENCV_CORE_INSIDE:' "$build/CMakeCache.txt"; then in_program="$in_program libopencv-core-dev"; fi

# notices FOLDER PACKAGE...: the copyright of each, as Debian has it; prints a line each.
notices() (
  folder=$1
  shift
  mkdir -p "$folder"
  for package in "$@"; do
    cp "/usr/share/doc/$package/copyright" "$folder/$package.txt"
    echo "  $(dpkg-query -W -f '${source:Package} ${source:Version}' "$package"): notices/$package.txt"
  done
)

# What ballbar.html holds beside them, where it is packed.
in_tool() { if [ -e "$folder/usr/share/ballbar/ballbar.html" ]; then cat "$source/apps/page/engine/compiled_in.txt"; fi; }

# What the page inside the program holds: the licence of each, and the notice that Apache's licence asks for.
page_notices() (
  folder=$1
  for file in echarts/NOTICE echarts/LICENSE echarts/licenses/LICENSE-d3 zrender/LICENSE @preact/signals-core/LICENSE tslib/LICENSE.txt; do
    text=$modules/$file
    [ -f "$text" ] || { [ "${file%%/*}" = tslib ] && continue; }
    cp "$text" "$folder/$(echo "${file#@}" | tr '/' '-' | tr '[:upper:]' '[:lower:]' | sed 's/\.txt$//').txt"
  done
  echo
  echo "The page of \`ballbar report\`, inside the program, holds Apache ECharts, under the Apache License, Version 2.0"
  echo "(/usr/share/common-licenses/Apache-2.0, with what it adds in notices/echarts-license.txt), with parts of D3 and"
  echo "with ZRender, signals-core and tslib, under the licences in notices/. The notice of Apache ECharts:"
  echo
  sed 's/^/  /; s/ *$//' "$modules/echarts/NOTICE"
  echo
)

copyright_of() (
  package=$1 doc=$2 folder=$3
  echo "ballbar $version, built from its own sources. All of it, but what is named below, is under this licence:"
  echo
  sed 's/^/  /; s/ *$//' "$source/LICENSE"
  echo
  echo "The program is linked with parts of SuiteSparse (libspqr, libcholmod) under the GNU General Public License, version"
  echo "2 or later, and, by libzip, OpenSSL under the Apache License 2.0: as a whole it may be passed on under version 3 of the"
  echo "former, /usr/share/common-licenses/GPL-3."
  echo
  echo "Code of these Debian source packages is compiled in; the copyright of each stands in the file named. Their"
  echo "sources, those of Eigen under the Mozilla Public License 2.0 among them, are in Debian under these names:"
  echo
  case $package in
    ballbar | python3-ballbar)
      if [ "$package" = ballbar ]; then more=$(in_tool); else more=pybind11-dev; fi
      # shellcheck disable=SC2086,SC2046  # the lists are meant to be split
      notices "$doc/notices" $(printf '%s\n' $in_program $more | sort -u)
      if [ -d "$modules/echarts" ]; then page_notices "$doc/notices"; fi
      if [ "$package" = ballbar ] && [ -n "$more" ]; then
        echo "ballbar.html is unpacked by xz-decompress, under the MIT licence, which is among the notices in it."
        echo
      fi
      ;;
    *)
      # shellcheck disable=SC2086
      notices "$doc/notices" $in_libraries
      ;;
  esac
)

# manual_pages PROGRAM [WORD...]: here, of a command by its help, then of its own commands; without a word, of the
# program. Examples get a prompt, by which help2man sets each on a line of its own.
manual_pages() (
  program=$1
  shift
  name=$(echo ballbar "$@" | tr ' ' '-')
  version=$("$program" --version)
  "$program" "$@" --help ${1:+--details} >"$name"
  sed -i -e ':a; / \\$/ { N; s/ \\\n */ /; ba }' -e 's/^  ballbar /  $ ballbar /' "$name"
  SOURCE_DATE_EPOCH=$epoch help2man --no-info --locale=C.UTF-8 --include="$here/ballbar.h2m" \
    --name="$(sed -n '1 s/\.\{0,1\}$//p' "$name")" --version-string="$name (ballbar) ${version#ballbar }" \
    --help-option="$name" --output="$name.1" cat
  sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p' "$name" | while read -r command; do
    manual_pages "$program" "$@" "$command"
  done
  rm "$name"
)

for component in program:ballbar development:libballbar-dev python:python3-ballbar; do
  folder=$staged/${component%%:*} package=${component##*:}
  [ -d "$folder" ] || continue
  doc=$folder/usr/share/doc/$package
  mkdir -p "$doc"
  copyright_of "$package" "$doc" "$folder" >"$doc/copyright"
  gzip -9nc "$here/changelog" >"$doc/changelog.gz"
  if [ "$package" = ballbar ]; then
    mkdir -p "$folder/usr/share/man/man1"
    (
      cd "$folder/usr/share/man/man1"
      manual_pages "$folder/usr/bin/ballbar"
      gzip -9n ./*
    )
  fi
  find "$folder" -type d -empty -delete # of what is optional and not there
  find "$folder" -type d -exec chmod 755 {} +
  find "$folder" -type f -perm -u+x -exec chmod 755 {} +
  find "$folder" -type f ! -perm -u+x -exec chmod 644 {} +
  find "$folder" -exec touch -h -d "@$epoch" {} +
done
