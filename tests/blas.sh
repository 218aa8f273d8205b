#!/bin/sh
# The BLAS libraries that Debian installs side by side, a line each: name, and folders for LD_LIBRARY_PATH.
#
#   sh blas.sh PROGRAM
#
# None where PROGRAM does not load libblas.so.3 as it starts.
set -eu
ldd "$1" | grep -q 'libblas\.so\.3' || exit 0
for folder in /usr/lib/*/blas /usr/lib/*/atlas /usr/lib/*/openblas-pthread; do
  [ -e "$folder/libblas.so.3" ] || continue
  case $folder in
    */blas) echo "reference $folder:${folder%/blas}/lapack" ;;
    */atlas) echo "ATLAS $folder" ;;
    *) echo "OpenBLAS $folder" ;;
  esac
done
