#!/bin/sh
# The Debian packages of the committed sources, in fresh minimal roots: built there (make deb), judged by lintian, installed in another root without any
# compiler's leftovers, used, and purged, after which the files of that root must be those of before.
# usage: debian.sh [SUITE]...      bookworm and trixie by default; as root, with debootstrap and a network
# ROOTS names the folder for the roots (3 GB; ~/.cache/nhsym-debian), MIRROR the archive. The packages end in ROOTS/SUITE-packages.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
roots=${ROOTS:-${XDG_CACHE_HOME:-$HOME/.cache}/nhsym-debian}
mirror=${MIRROR:-http://deb.debian.org/debian}
failed() { echo "debian: $*" >&2; exit 1; }
[ "$(id -u)" = 0 ] || failed "debootstrap and chroot want root: sudo sh tests/debian.sh"
command -v debootstrap >/dev/null || failed "debootstrap is missing: apt-get install debootstrap"

# A command in a root; what it mounts is gone when it ends.
inside() {
    root=$1
    shift
    env -i HOME=/tmp/home PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM=dumb DEBIAN_FRONTEND=noninteractive $(env | grep -iE '^(https?|no)_proxy=' || :) \
        unshare --mount sh -ec 'mount -t proc proc "$0/proc"; mount --rbind /dev "$0/dev"; exec chroot "$0" sh -ec "$1"' "$root" "$*"
}
fresh() { rm -rf --one-file-system "$2"; cp -a "$roots/$1" "$2"; cp /etc/resolv.conf "$2/etc/"; mkdir -p "$2/tmp/home"; echo force-unsafe-io >"$2/etc/dpkg/dpkg.cfg.d/quick"; }
step() { echo "== $suite: $1"; shift; "$@" >"$roots/$suite.log" 2>&1 || { tail -n 30 "$roots/$suite.log"; failed "$suite: the whole log is $roots/$suite.log"; }; }
# Files that belong to packages or were made by their scripts; not logs, and not the caches of apt and of the loader.
files() { inside "$1" "find / -xdev \( -path /proc -o -path /dev -o -path /tmp -o -path /var/log -o -path /var/cache -o -path /var/lib/apt -o -path '/var/lib/dpkg/*-old' \) -prune -o -print | sort"; }

mkdir -p "$roots"
for suite in ${*:-bookworm trixie}; do
    [ -e "$roots/$suite/.ready" ] || { rm -rf "$roots/$suite"; step "a minimal root" debootstrap --variant=minbase "$suite" "$roots/$suite" "$mirror"; touch "$roots/$suite/.ready"; }
    packages=$roots/$suite-packages build=$roots/$suite-build use=$roots/$suite-use
    rm -rf "$packages"; mkdir "$packages"

    fresh "$suite" "$build"
    mkdir "$build/tmp/nhsym"
    git -C "$source" archive HEAD | tar -xf - -C "$build/tmp/nhsym"
    step "build dependencies and lintian" inside "$build" "apt-get update -q; apt-get install -yq --no-install-recommends build-essential lintian;
        cd /tmp/nhsym; make deb-source; apt-get build-dep -yq --no-install-recommends ./build/deb/nhsym-*/"
    step "make deb" inside "$build" "cd /tmp/nhsym; make deb"
    find "$build/tmp/nhsym/build/deb" -maxdepth 1 -type f -exec cp {} "$packages/" \;
    step "lintian" inside "$build" "cd /tmp/nhsym/build/deb; lintian --allow-root --fail-on error *.changes"
    cp "$roots/$suite.log" "$packages/lintian.txt"
    echo "   lintian: no errors, $(grep -c '^W:' "$packages/lintian.txt" || :) warnings; $(cd "$packages" && ls *.deb | tr '\n' ' ')"

    fresh "$suite" "$use"
    cp "$packages"/*.deb "$use/tmp/"
    step "what the packages depend on" inside "$use" "apt-get update -q; cd /tmp; apt-get install -yq --no-install-recommends gcc libc6-dev pkg-config python3-sympy ./*.deb; apt-get purge -yq '*nhsym*'"
    files "$use" >"$packages/before.txt"
    step "install" inside "$use" "cd /tmp; dpkg -i nhsym_*.deb libnhsym*.deb python3-nhsym_*.deb"
    step "nhsym" inside "$use" 'cd /tmp; nhsym version; nhsym analyze sleigh; nhsym analyze sleigh --quiet --html page.html; test -s page.html'
    grep -q 'FOUND: 3 independent currents' "$roots/$suite.log" || failed "$suite: nhsym analyze sleigh: $(cat "$roots/$suite.log")"
    step "a program in C, with both libraries" inside "$use" 'cd /tmp; cc /usr/share/doc/nhsym/example.c $(pkg-config --cflags --libs nhsym) -o shared; ./shared >shared.txt; ldd ./shared | grep libnhsym.so.1;
        cc /usr/share/doc/nhsym/example.c -Wl,-Bstatic -lnhsym -Wl,-Bdynamic $(pkg-config --libs --static nhsym | sed "s/-lnhsym //") -o static; ./static >static.txt; cmp shared.txt static.txt; grep "proved" shared.txt'
    step "Python" inside "$use" 'cd /tmp; python3 -c "import nhsym; a = nhsym.system(\"sleigh\").analyze(); print(repr(a), a[\"Phi2\"].sympy()); assert a.independent == 3"'
    step "purge" inside "$use" "dpkg --purge \$(dpkg-query -W -f '\${Package} ' '*nhsym*'); test -z \"\$(dpkg-query -W -f '\${Package}' '*nhsym*' 2>/dev/null)\""
    files "$use" >"$packages/after.txt"
    diff "$packages/before.txt" "$packages/after.txt" || failed "$suite: purging the packages left or removed files"
    rm -rf --one-file-system "$build" "$use"
    echo "== $suite: built, installed, used and purged without a trace"
done
