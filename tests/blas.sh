#!/bin/sh
# The BLAS libraries that Debian installs side by side, a line each: name, and a folder for LD_LIBRARY_PATH.
#
#   sh blas.sh PROGRAM SCRATCH
#
# The folders are made in SCRATCH. None where PROGRAM does not load liblapack.so.3 as it starts.
set -eu
ldd "$1" | grep -q 'liblapack\.so\.3' || exit 0
made() {
  mkdir -p "$2"
  for name in libblas liblapack; do
    ln -sf "$(find "${3%/*}/lapack" "$3" -name "$name.so.3" | tail -n 1)" "$2/$name.so.3"
  done
  # Ceres is linked with ATLAS by its own name; ATLAS is what its own name finds.
  [ "$1" = ATLAS ] || ln -sf "$2/libblas.so.3" "$2/libf77blas.so.3"
  echo "$1 $2"
}
scratch=$(realpath -m "$2")
for folder in /usr/lib/*/blas /usr/lib/*/atlas /usr/lib/*/openblas-pthread; do
  [ -e "$folder/libblas.so.3" ] || continue
  case $folder in
    */blas) made reference "$scratch/reference" "$folder" ;;
    */atlas) made ATLAS "$scratch/ATLAS" "$folder" ;;
    *) made OpenBLAS "$scratch/OpenBLAS" "$folder" ;;
  esac
done
