#!/bin/sh
# desktop.sh USR B5R: the desktop entry is valid, a .b5r file has its type, an icon has that name, and a double click on
# a file makes its page: beside it where that can be written, else below XDG_CACHE_HOME, never over another's file.
set -eu
usr=$1 b5r=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() {
  echo "desktop.sh: $1" >&2
  exit 1
}

desktop-file-validate "$usr/share/applications/ballbar.desktop"
mkdir -p "$scratch/data/mime/packages"
cp "$usr/share/mime/packages/ballbar.xml" "$scratch/data/mime/packages/"
XDG_DATA_HOME=$scratch/data update-mime-database "$scratch/data/mime"
type_of() { XDG_DATA_HOME=$scratch/data gio info -a standard::content-type "$1" | sed -n 's/.*content-type: //p'; }
cp "$b5r" "$scratch/named.b5r"
cp "$b5r" "$scratch/named-otherwise"
for file in named.b5r named-otherwise; do
  type=$(type_of "$scratch/$file")
  [ "$type" = application/x-ballbar-b5r ] || fail "$file: expected application/x-ballbar-b5r, found '$type'"
done
[ -f "$usr/share/icons/hicolor/scalable/mimetypes/application-x-ballbar-b5r.svg" ] || fail 'expected an icon of .b5r'

# xdg-open that says what it would open.
mkdir "$scratch/bin" "$scratch/home" "$scratch/folder"
printf '#!/bin/sh\necho "$1" >"%s/opened"\n' "$scratch" >"$scratch/bin/xdg-open"
chmod 755 "$scratch/bin/xdg-open"
# opened EXPECTED FILE...: what the double click shows; EXPECTED is a pattern.
opened() {
  expected=$1
  shift
  rm -f "$scratch/opened"
  env -u XDG_CACHE_HOME HOME="$scratch/home" PATH="$scratch/bin:$usr/bin:$PATH" sh "$usr/libexec/ballbar/open" "$@" \
    2>/dev/null
  for wait in 1 2 3 4 5; do [ -e "$scratch/opened" ] || sleep "$wait"; done # it is started, not waited for
  shown=$(cat "$scratch/opened")
  # shellcheck disable=SC2254  # a pattern
  case $shown in
    $expected) ;;
    *) fail "expected $expected to be shown, found $shown" ;;
  esac
  [ -s "$shown" ] || fail "$shown: expected a page, found nothing"
}
cp "$b5r" "$scratch/folder/a test.b5r"
opened "$scratch/folder/a test.b5r.html" "$scratch/folder/a test.b5r"
opened "$scratch/folder/a test.b5r.html" "$scratch/folder/a test.b5r" # over its own page
echo 'of somebody else' >"$scratch/folder/a test.b5r.html"
opened "$scratch/home/.cache/ballbar/a test.b5r *.html" "$scratch/folder/a test.b5r"
[ "$(cat "$scratch/folder/a test.b5r.html")" = 'of somebody else' ] || fail "expected another's file to stay as it was"
(cd "$scratch/folder" && cp "$b5r" ./-x.b5r && opened '*/./-x.b5r.html' -x.b5r)
long=$(printf '%0240d.b5r' 0)
cp "$b5r" "$scratch/folder/$long"
opened "$scratch/home/.cache/ballbar/page *.html" "$scratch/folder/$long"
opened "$scratch/home/.cache/ballbar/ballbar.txt" "$scratch/folder/none.b5r" # says why there is no page
grep -q 'none.b5r: expected a file' "$shown" || fail "$shown: expected the fault of the file"
