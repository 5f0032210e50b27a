#!/bin/sh
# Takes the steps of docs/extending.md in a copy of the sources, builds it and runs it: tests/extend/NAME.txt says what is inserted where.
# usage: extend.sh NAME [quick]      quick: the changed files are compiled, not linked.  Prints what is wrong; silent and 0 when nothing is.
#
# In NAME.txt:  @after FILE START and @before FILE START   the lines that follow are inserted after or before the only line that begins with START
#               @file FILE                                 the lines that follow are a new file
#               @run WORDS, @expect TEXT                   a command, and what it prints
name=$1
how=$2
cd "$(dirname "$0")/.." || exit 2
steps=$PWD/tests/extend/$name.txt
[ -f "$steps" ] || { echo "there is no $steps"; exit 2; }
copy=$(mktemp -d) || exit 2
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/build"
cp -a src systems analyses Makefile "$copy" || exit 2
cp -a tests "$copy" || exit 2 # the Makefile names its parts
[ "$how" = quick ] || cp -a build/src build/flags build/libnhsym.a build/fingerprint.o "$copy/build" || exit 2
cd "$copy" || exit 2

awk -v changed="$copy/changed" '
    function insert(    line, found) {
        if (!target) return
        while ((getline line < target) > 0) {
            here = index(line, start) == 1
            if (here && where == "@before") printf "%s", lines > (target ".new")
            print line > (target ".new")
            if (here && where == "@after") printf "%s", lines > (target ".new")
            found += here
        }
        close(target); close(target ".new")
        if (found != 1) print target ": " found + 0 " lines begin with " start
        else system("mv " target ".new " target)
        print target > changed
        target = ""
    }
    /^@/ { insert(); file = "" }
    /^@(after|before) / { where = $1; target = $2; start = substr($0, length($1) + length($2) + 3); lines = ""; next }
    /^@file / { file = $2; print file > changed; next }
    /^@/ { next }
    file { print > file; next }
    target { lines = lines $0 "\n" }
    END { insert() }' "$steps"

if [ "$how" = quick ]; then
    for file in $(sort -u changed); do
        case $file in
        *.c) echo "$file" ;;
        *.h) grep -lF "#include \"${file#src/}\"" src/*/*.c | head -2 ;; # two that include it
        esac
    done | sort -u | while read -r file; do
        ${CC:-gcc} -std=c17 -D_GNU_SOURCE -Isrc -Wall -Wextra -fsyntax-only "$file" 2>&1 || echo "$file does not compile"
    done
    exit 0
fi
make -s -j2 build/nhsym >build.log 2>&1 || { tail -20 build.log; exit 1; }
awk '/^@run / { run = substr($0, 6) } /^@expect / { print run "\t" substr($0, 9) }' "$steps" | while IFS='	' read -r words text; do
    build/nhsym $words 2>&1 | grep -qF -- "$text" || echo "nhsym $words does not print: $text"
done
