#!/bin/sh
# pack.sh BUILD OUT: what is built in BUILD, configured with BALLBAR_PACKAGES, as Debian packages in OUT, in the place of
# those that are there.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$1
mkdir -p "$2"
out=$(realpath "$2")
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(sh "$here/epoch.sh")}
export SOURCE_DATE_EPOCH
umask 022
rm -rf "$out"/*.deb "$out/_CPack_Packages" "$out/members" "$out/cpack.log"
if ! cpack --config "$build/CPackConfig.cmake" -G DEB -B "$out" >"$out/cpack.log" 2>&1; then
  cat "$out/cpack.log" >&2
  exit 1
fi
rm -rf "$out/_CPack_Packages" "$out/cpack.log"
# cpack writes who packed into the outer archive, and when.
for package in "$out"/*.deb; do
  (
    mkdir "$out/members"
    cd "$out/members"
    ar x "$package"
    rm "$package"
    ar rcD "$package" debian-binary control.tar.* data.tar.*
    cd ..
    rm -r members
  )
done
