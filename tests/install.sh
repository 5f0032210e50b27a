#!/bin/sh
# The program as a distribution would have it: installs into a folder of its own, compiles docs/example.c through pkg-config against the shared and the static
# library, runs both from elsewhere, reads the manual pages, and uninstalls without a trace.
# usage: install.sh          the first failure ends it; 0: all is well
set -eu
stage=$(mktemp -d)
work=$(mktemp -d)
trap 'rm -rf "$stage" "$work"' EXIT
source=$PWD
prefix=/opt/nhsym
libraries=$prefix/lib/somewhere
here() { MAKEFLAGS= make -s --no-print-directory -C "$source" SANITIZE= DESTDIR="$stage" PREFIX=$prefix LIBDIR=$libraries "$@"; }
failed() { echo "install: $*" >&2; exit 1; }

# What is built has other paths in it; it finds its data from where it stands.
here install >/dev/null
lib=$stage$libraries

# ---- names ----
readelf -d "$lib/libnhsym.so" | grep -q 'soname: \[libnhsym.so.1\]' || failed "the shared library has no soname"
grep -o '^NH_API [^(]*(' src/nhsym.h | sed 's/($//; s/.*[ *]//' | sort >"$work/promised"
nm -D --defined-only "$lib/libnhsym.so" | awk '$2 != "A" { sub(/@.*/, "", $3); print $3 }' | sort >"$work/exported"
[ -s "$work/promised" ] || failed "no names in nhsym.h"
diff "$work/promised" "$work/exported" || failed "the shared library does not export what nhsym.h promises"

# ---- an example, by pkg-config ----
export PKG_CONFIG_PATH="$lib/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$stage" PKG_CONFIG_ALLOW_SYSTEM_LIBS=1
cd "$work"
cp "$stage$prefix/share/doc/nhsym/example.c" .
${CC:-cc} -std=c17 -Wall -Wextra -Werror example.c $(pkg-config --cflags --libs nhsym) -o with_shared
${CC:-cc} -std=c17 -Wall -Wextra -Werror example.c $(pkg-config --cflags nhsym) "$lib/libnhsym.a" $(pkg-config --libs --static nhsym | sed 's/ -lnhsym / /') -o with_static
readelf -d with_static | grep -q 'libnhsym' && failed "the example with the archive wants the shared library"
LD_LIBRARY_PATH=$lib ./with_shared >shared.txt
NHSYM_PATH=$stage$prefix/share/nhsym ./with_static >static.txt
diff shared.txt static.txt || failed "the two libraries do not answer alike"
grep -q 'sin(phi/k).*proved' shared.txt || failed "the example does not print the momentum: $(cat shared.txt)"

# ---- the program and its pages, from there ----
"$stage$prefix/bin/nhsym" verify sleigh --current "m*v^2 + m*a^2*k^2*omega^2" --quiet || failed "the program does not find its systems"
for page in man1/nhsym.1 man3/nhsym.3; do
    [ -s "$stage$prefix/share/man/$page" ] || failed "$page is empty"
    command -v groff >/dev/null || continue
    groff -man -ww -Tutf8 "$stage$prefix/share/man/$page" >page.txt 2>complaints.txt
    [ ! -s complaints.txt ] || failed "$page: $(cat complaints.txt)"
done
while read -r name; do # every function has its place on the page
    grep -q "$name(" "$stage$prefix/share/man/man3/nhsym.3" || failed "nhsym.3 does not have $name"
done <promised

# ---- every page and picture that a page links to is there ----
cd "$stage$prefix/share/doc/nhsym"
for page in *.md; do
    grep -oE '\]\([^):]+\)' "$page" | sed 's/^](\([^#]*\).*)$/\1/' | while read -r link; do
        [ -z "$link" ] || [ -e "$link" ] || echo "$page links to $link"
    done
done >"$work/dead"
[ ! -s "$work/dead" ] || failed "installed pages have links to nowhere: $(cat "$work/dead")"
cd "$work"

# ---- without a trace ----
echo mine >"$stage$prefix/share/nhsym/systems/mine.txt"
here uninstall
[ "$(find "$stage" ! -type d)" = "$stage$prefix/share/nhsym/systems/mine.txt" ] || failed "left after uninstall, or a user's file removed: $(find "$stage" ! -type d)"
rm "$stage$prefix/share/nhsym/systems/mine.txt"
here uninstall
[ -z "$(ls -A "$stage")" ] || failed "left after uninstall: $(find "$stage")"
