#!/bin/sh
# Prints the seconds since 1970 of the last commit, or of the changelog's last entry where the history is not there.
set -eu
cd "$(dirname "$0")"
git log -1 --format=%ct 2>/dev/null || date -d "$(sed -n 's/^ -- .*>  //p' changelog | head -n 1)" +%s
