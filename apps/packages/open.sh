#!/bin/sh
# A double click on ballbar tests: makes their page and shows it. Without a file, the whole tool as a page.
#
#   open [FILE...]
#
# The page lies beside the first file, under its name and .html. Where nothing can be written there, or something else
# has that name, it lies below XDG_CACHE_HOME. What goes wrong is shown as a text, for there is no terminal.
set -eu
cache=${XDG_CACHE_HOME:-}
case $cache in
  /*) ;;
  *) cache=${HOME:?open: expected HOME or XDG_CACHE_HOME, found neither}/.cache ;;
esac
cache=$cache/ballbar

# $1: the text to show.
say() {
  echo "$1" >&2
  mkdir -p "$cache"
  echo "$1" >"$cache/ballbar.txt"
  exec xdg-open "$cache/ballbar.txt"
}

if [ $# = 0 ]; then
  tool=/usr/share/ballbar/ballbar.html
  [ -e "$tool" ] || say "Expected a .b5r file to open, found none; this ballbar comes without the tool as a page."
  exec xdg-open "$tool"
fi

# Nothing is there, or a page that ballbar made.
is_free() { [ ! -e "$1" ] || { [ -w "$1" ] && head -n 8 "$1" | grep -qF '<meta name="generator" content="ballbar '; }; }

for file in "$@"; do # no name is an option
  shift
  case $file in -*) file=./$file ;; esac
  set -- "$@" "$file"
done
name=$(basename "$1")
[ $# = 1 ] || name="$name and $(($# - 1)) more"
folder=$(dirname "$1")
page=$folder/$name.html
if [ ! -w "$folder" ] || [ ${#name} -gt 200 ] || ! is_free "$page"; then
  mkdir -p "$cache"
  [ ${#name} -le 200 ] || name=page
  page="$cache/$name $(printf '%s\n' "$PWD" "$@" | cksum | cut -d ' ' -f 1).html" # of the same files, the same page
fi
said=$(ballbar report "$@" --out "$page" --open 2>&1) || say "$said"
