#!/bin/sh
# Where this machine's own apt takes the packages of Debian 12 from, as lines of a sources.list.
set -eu
servers=$(apt-get indextargets --format '$(ORIGIN)|deb [signed-by="$(SIGNED_BY)"] $(REPO_URI) $(CODENAME) $(COMPONENT)' \
  'Identifier: Packages' | sed -n 's/^Debian|//p' | sed 's/ \[signed-by="[^"]*"\]//' | sort -u)
case $servers in
  *' bookworm '*) printf '%s\n' "$servers" ;;
  *)
    echo 'servers.sh: expected the packages of Debian bookworm in apt, found none' >&2
    exit 1
    ;;
esac
