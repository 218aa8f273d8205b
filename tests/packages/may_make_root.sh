#!/bin/sh
# Ends with 0 where a Debian can be made in a folder here, else with 1 and a sentence.
[ "$(id -u)" = 0 ] || { command -v newuidmap && unshare --user --map-root-user true; } >/dev/null 2>&1 || {
  echo 'A bare Debian left out: this needs root, or user namespaces and newuidmap.'
  exit 1
}
