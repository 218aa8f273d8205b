#!/bin/sh
# In a bare Debian with the packages and a ballbar test in /tmp/ballbar: installed, run, removed.
set -eu
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
fail() {
  echo "inside.sh: $1" >&2
  exit 1
}
# All files but what any installation changes, and the installed size of all packages.
files() { find / -xdev \( -path /tmp -o -path /proc -o -path /sys -o -path /dev -o -path /var/lib/dpkg \
  -o -path /var/lib/apt -o -path /var/cache -o -path /var/log \) -prune -o -print | sort; }
installed() { apt-get -qq install --no-install-recommends "$@" >/tmp/apt.log 2>&1 || fail "$(cat /tmp/apt.log)"; }
size_kB() { dpkg-query -W -f '${Installed-Size} ${Package}\n' | awk '{ kB += $1 } END { print kB }'; }

# With what Debian recommends beside the libraries, as plain apt-get install would bring it.
recommended_kB=$(apt-get -s --install-recommends install /tmp/ballbar/debian/ballbar_*.deb |
  awk '/^Inst/ && $2 != "ballbar" { print $2 }' | xargs apt-cache show --no-all-versions |
  awk '/^Installed-Size:/ { kB += $2 } END { print kB }')

files >/tmp/before
dpkg-query -W -f '${Package}\n' | sort >/tmp/packages-before
before_kB=$(size_kB)
installed /tmp/ballbar/debian/ballbar_*.deb
needs_kB=$(($(size_kB) - before_kB))
own_kB=$(dpkg-query -W -f '${Installed-Size}' ballbar)
dpkg-query -W -f '${Package} ${Installed-Size}\n' | sort | join -v 2 /tmp/packages-before - | sort -k 2nr >/tmp/new
echo "  installed with all that it needs: $(((needs_kB + 512) / 1024)) MB in $(wc -l </tmp/new) packages; with what" \
  "these recommend: $(((recommended_kB + own_kB + 512) / 1024)) MB. The largest, in kB:"
head -n 6 /tmp/new | sed 's/^/    /'
[ $((recommended_kB + own_kB)) -le $((60 * 1024)) ] || fail 'expected at most 60 MB on a bare Debian'

ballbar --version
cp /tmp/ballbar/00.b5r /root/
ballbar errors /root/00.b5r | grep -q 'lowers the circularity from 5.6' || fail 'expected the circularity of the test'
ballbar report /root/00.b5r --out /root/page.html >/dev/null
[ -s /root/page.html ] || fail 'expected a page'

# A double click in a folder that its user cannot write to.
printf '#!/bin/sh\necho "$1" >/tmp/home/opened\n' >/tmp/xdg-open
chmod 755 /tmp/xdg-open
mkdir /tmp/home
chown nobody /tmp/home
cp /tmp/ballbar/00.b5r /srv/
setpriv --reuid nobody --regid nogroup --clear-groups env HOME=/tmp/home PATH="/tmp:$PATH" \
  /usr/libexec/ballbar/open /srv/00.b5r 2>/dev/null
for wait in 1 2 3 4 5; do [ -s /tmp/home/opened ] || sleep "$wait"; done # it is started, not waited for
case $(cat /tmp/home/opened) in
  /tmp/home/.cache/ballbar/00.b5r*.html) ;;
  *) fail "expected a page below /tmp/home/.cache/ballbar, found $(cat /tmp/home/opened)" ;;
esac
rm /srv/00.b5r

gzip -t /usr/share/man/man1/ballbar.1.gz /usr/share/man/man1/ballbar-drift.1.gz
for file in bash-completion/completions/ballbar doc/ballbar/copyright; do
  [ -s "/usr/share/$file" ] || fail "expected /usr/share/$file"
done
gzip -t /usr/share/doc/ballbar/changelog.gz
rm -r /root/00.b5r /root/page.html

# The whole tool as a page, where it was made before: copied from where it is installed, and in the menu.
if [ -e /usr/share/ballbar/ballbar.html ]; then
  ballbar report --tool --out /tmp/ballbar/tool.html
  cmp /tmp/ballbar/tool.html /usr/share/ballbar/ballbar.html || fail 'expected ballbar.html as it is installed'
  ! grep -q NoDisplay=true /usr/share/applications/ballbar.desktop || fail 'expected an entry in the menu'
fi

installed /tmp/ballbar/debian/python3-ballbar_*.deb
python3 -c "import ballbar; print('  import ballbar', ballbar.__version__)
assert ballbar.machine_errors('/tmp/ballbar/00.b5r').errors[0].sigma > 0.0"
apt-get -qq purge --autoremove python3-ballbar >/tmp/apt.log 2>&1

apt-get -qq purge --autoremove ballbar >/tmp/apt.log 2>&1
files >/tmp/after
diff /tmp/before /tmp/after >/tmp/left || {
  cat /tmp/left >&2
  fail 'expected nothing to be left after purge'
}
echo '  removed, and nothing is left'

# With no more than it asks for, but for a compiler and CMake.
installed /tmp/ballbar/debian/libballbar-dev_*.deb g++ cmake make
cmake -S /tmp/ballbar/consumer -B /tmp/ballbar/built -DCMAKE_BUILD_TYPE=Release >/tmp/ballbar/consumer.log
cmake --build /tmp/ballbar/built --target consumer >>/tmp/ballbar/consumer.log
/tmp/ballbar/built/consumer
