#!/bin/sh
# The Debian packages of a build, tested: packed twice with the same bytes, checked by lintian, installed in a bare
# Debian 12, run there and removed without a trace; and there a program built against the libraries in them.
#
#   sh tests/packages/clean_root.sh BUILD
#
# BUILD is configured with BALLBAR_PACKAGES, its target ballbar built. The bare Debian comes from where this machine's
# own apt takes its packages; without the rights to make one, that part is left out with a sentence.
set -eu
build=$(realpath "$1")
source=$(cd "$(dirname "$0")/../.." && pwd)
here=$source/tests/packages
scratch=$build/packages-tested
rm -rf "$scratch"
mkdir -p "$scratch"
fail() {
  echo "clean_root.sh: $1" >&2
  exit 1
}

echo 'Packed twice'
sh "$source/apps/packages/pack.sh" "$build" "$scratch/debian"
(umask 077 && TZ=Asia/Tokyo LC_ALL=C.UTF-8 sh "$source/apps/packages/pack.sh" "$build" "$scratch/again")
for package in "$scratch"/debian/*.deb; do
  cmp "$package" "$scratch/again/$(basename "$package")" || fail "expected the same bytes when packed twice"
  printf '  %s  %s kB\n' "$(basename "$package")" "$(($(stat -c %s "$package") / 1000))"
done

echo 'lintian'
lintian --allow-root --fail-on error --tag-display-limit 0 "$scratch"/debian/*.deb

echo 'Pictures, for which OpenCV is in the program'
dpkg-deb -x "$scratch"/debian/ballbar_*.deb "$scratch/unpacked"
program=$scratch/unpacked/usr/bin/ballbar
python3 "$source/tests/cli/transcript.py" "$program" simulate.txt simulate-shaft-images
python3 "$source/tests/cli/readme.py" "$program" "$source" "$scratch/readme" apps/shaft_picture/README.md

echo 'Manual pages'
pages=$scratch/unpacked/usr/share/man/man1
for page in "$pages"/*.gz; do
  said=$(zcat "$page" | groff -man -Tascii -ww -z 2>&1)
  [ -z "$said" ] || fail "$page: expected nothing to be said by groff, found $said"
done
[ -s "$pages/ballbar-simulate-score.1.gz" ] || fail 'expected a page of ballbar simulate score'
zcat "$pages/ballbar-drift.1.gz" >"$scratch/drift.1"
"$program" drift --help --details | grep -o '^  --[a-z0-9-]*' | sed 's/^  //; s/-/\\-/g' >"$scratch/options"
while read -r option; do
  grep -qF -e "$option" "$scratch/drift.1" || fail "expected $option on the page of ballbar drift"
done <"$scratch/options"

echo 'Desktop'
sh "$here/desktop.sh" "$scratch/unpacked/usr" "$source/sample-runs/qc20-style-b5r/00.b5r"

sh "$here/may_make_root.sh" || exit 0
echo 'Installed in a bare Debian, run, removed'
sh "$here/servers.sh" >"$scratch/servers.list"
# Their folder has a plain name: mmdebstrap takes its hooks apart at blanks and quotes.
carried=$(mktemp -d)
trap 'rm -rf "$carried"' EXIT
mkdir "$carried/ballbar"
cp -R "$scratch/debian" "$source/tests/consumer" "$source/sample-runs/qc20-style-b5r/00.b5r" "$here/inside.sh" "$carried/ballbar/"
chmod -R a+rX "$carried"
mmdebstrap --quiet --variant=minbase --format=null --customize-hook="copy-in $carried/ballbar /tmp" \
  --customize-hook='chroot "$1" sh /tmp/ballbar/inside.sh' bookworm /dev/null "$scratch/servers.list"
