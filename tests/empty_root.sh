#!/bin/sh
# Tests in an empty Debian 12, with its own Node.js and BLAS and nothing in the environment but HOME, PATH and LANG.
#
#   sh tests/empty_root.sh BUILD     the packages of tests/run.sh, then of the tests of that build what another machine
#                                    can change: transcripts, READMEs and the page
#   sh tests/empty_root.sh --whole   both commands of README.md, word for word, on the files that git knows
#
# BALLBAR_HTML  with --whole, a ballbar.html that was made before, for the tests that need one
#
# Debian comes from where this machine's own apt takes its packages, with the certificates of this machine. Without the
# rights to make a root, that is said, and nothing is tested.
set -eu
build=$1
cd "$(dirname "$0")/.."
source=$PWD
sh tests/packages/may_make_root.sh || exit 0
carried=$(mktemp -d)
trap 'rm -rf "$carried"' EXIT
sh tests/packages/servers.sh >"$carried/servers.list"

# What is tested, at the same place as here, for a build knows where it is. Objects and caches of the compiler are left.
if [ "$build" = --whole ]; then
  git ls-files -z | tar -c --null -T - -f "$carried/files.tar" --transform "s|^|${source#/}/|"
  if [ -n "${BALLBAR_HTML:-}" ]; then
    tar -rf "$carried/files.tar" -C "$(dirname "$BALLBAR_HTML")" ballbar.html --transform "s|^|${source#/}/build-tool/|"
  fi
  cat >"$carried/inside.sh" <<END_OF_FILE
set -eux
cd "$source"
sh apps/quickstart.sh
sh tests/run.sh
sh tests/run.sh -L 'long|tool'
END_OF_FILE
else
  build=$(realpath "$build")
  tar -c -f "$carried/files.tar" -C / --exclude='*.o' --exclude='*.a' --exclude='*.gch' --exclude=.git \
    --exclude='build-[!t]*' --exclude="${source#/}/build" --exclude=build-tidy --exclude=packages-tested \
    --exclude=build-tool/engine --exclude=build-tool/prefix --exclude=build-tool/page --exclude=build-tool/sources \
    "${source#/}"
  cat >"$carried/inside.sh" <<END_OF_FILE
set -eux
cd "$source"
sh apps/install-packages.sh build page images mat pdf python fleet hal test
node --version
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -R '^cli|^readme|^terms|^page_' -LE 'slow|long'
END_OF_FILE
fi
mkdir "$carried/certificates"
find /usr/local/share/ca-certificates -name '*.crt' -exec cp {} "$carried/certificates" \; 2>/dev/null || true
chmod -R a+rX "$carried"

# Files are given by the hooks; a plain name, for mmdebstrap takes its hooks apart at blanks and quotes.
mmdebstrap --quiet --variant=minbase --include=ca-certificates --format=null \
  --customize-hook="tar -C \"\$1\" --no-same-owner -xf $carried/files.tar" \
  --customize-hook="cp -R $carried/certificates/. \"\$1/usr/local/share/ca-certificates/\"" \
  --customize-hook="cp $carried/inside.sh \"\$1/root/\"" \
  --customize-hook='chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin update-ca-certificates' \
  --customize-hook='chroot "$1" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 sh /root/inside.sh' \
  bookworm /dev/null "$carried/servers.list"
