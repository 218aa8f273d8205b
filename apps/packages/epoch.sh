#!/bin/sh
# Prints the time of the changelog's last entry, in seconds since 1970: that of all that is packed.
set -eu
date -d "$(sed -n 's/^ -- .*>  //p' "$(dirname "$0")/changelog" | head -n 1)" +%s
