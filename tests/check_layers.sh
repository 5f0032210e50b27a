#!/bin/sh
# Is the house in order?  What docs/modules.md promises, checked on the sources.
# usage: check_layers.sh [BUILD]          prints one line per offence; silent and 0 when there is none
build=${1:-build}
cd "$(dirname "$0")/.." || exit 2
offences=$(mktemp) || exit 2
trap 'rm -f "$offences"' EXIT

# ---- a file includes its own folder's or lower folders' headers ----
awk '
    BEGIN { n = split("base graph evaluate exact system geometry integrals count classify motion reduction problem search absence commands document library cli", name, " "); for (i = 1; i <= n; i++) level[name[i]] = i }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        split(FILENAME, path, "/")
        split($0, quoted, "\"")
        if (quoted[2] == "nhsym.h") next
        split(quoted[2], part, "/")
        if (!(part[1] in level)) print FILENAME ": \"" quoted[2] "\" names no layer"
        else if (level[part[1]] > level[path[2]]) print FILENAME ": includes " quoted[2] " of a higher layer"
    }' src/*/*.c src/*/*.h >>"$offences"

# ---- modules include each other in one direction: no circle, also inside of a folder (NAME.h, NAME.c and NAME_internal.h are one module) ----
circles=$(awk '/^[ \t]*#[ \t]*include[ \t]*".*[.]h"/ {
    split($0, quoted, "\"")
    module = FILENAME
    sub(/^src\//, "", module); sub(/(_internal)?[.][ch]$/, "", module); sub(/(_internal)?[.]h$/, "", quoted[2])
    print module, quoted[2]
}' src/*/*.c src/*/*.h | awk '$1 != $2' | tsort 2>&1 >/dev/null | sed -n 's/^tsort: \(.*\/.*\)/\1/p' | tr '\n' ' ')
[ -z "$circles" ] || echo "modules that include each other in a circle: $circles" >>"$offences"

# ---- a third-party header stands where docs/modules.md says, and nowhere else ----
standard=" assert.h complex.h ctype.h errno.h float.h inttypes.h limits.h math.h setjmp.h stdarg.h stdatomic.h stdbool.h stddef.h stdint.h stdio.h stdlib.h string.h time.h"
standard="$standard dirent.h fcntl.h getopt.h pthread.h signal.h strings.h sys/resource.h sys/stat.h sys/time.h sys/types.h sys/wait.h unistd.h "
found=$(awk -v standard="$standard" '/^[ \t]*#[ \t]*include[ \t]*</ {
    split($0, part, /[<>]/)
    if (!index(standard, " " part[2] " ")) print part[2], FILENAME
}' src/*/*.c src/*/*.h | sort -u)
promised=$(sed -n 's/^| `<\([^>]*\)>` | \(.*\) | .*/\1 \2/p' docs/modules.md | tr -d '`,' |
    awk '{ for (i = 2; i <= NF; i++) print $1, $i }' | sort -u)
printf '%s\n' "$found" | while read -r line; do
    printf '%s\n' "$promised" | grep -qxF "$line" || echo "${line#* }: includes <${line% *}>, which docs/modules.md does not say"
done >>"$offences"
printf '%s\n' "$promised" | while read -r line; do
    printf '%s\n' "$found" | grep -qxF "$line" || echo "docs/modules.md: ${line#* } does not include <${line% *}>"
done >>"$offences"

# ---- exported symbols start with nh_ (the sanitizers add their own) ----
if [ -f "$build/libnhsym.a" ]; then
    nm -g --defined-only "$build/libnhsym.a" 2>/dev/null | awk 'NF == 3 && $3 !~ /^nh_/ && $3 !~ /^__odr_asan|^__asan|^__ubsan/ { print "libnhsym.a: exports " $3 }' |
        sort -u >>"$offences"
else
    echo "$build/libnhsym.a: is not there" >>"$offences"
fi

# ---- a name begins with its module's name, or with a word that docs/glossary.md has for its folder ----
# All objects in one call: one process for each took ten seconds.
objects=$(for source in src/*/*.c; do # not those left behind by a module that is no more
    [ -f "$build/${source%.c}.o" ] && echo "$build/${source%.c}.o"
done)
[ -z "$objects" ] || nm -A -g --defined-only $objects 2>/dev/null | sed -n "s|^$build/src/\(.*\)\.o:[0-9a-f]* *[^ ] nh_\(.*\)|\1 \2|p" | awk '
    FILENAME != "-" { if (split($0, cell, "|") > 4 && cell[2] ~ /`[a-z]+`/) { gsub(/[ `]/, "", cell[2]); gsub(/[ `]/, "", cell[3]); n = split(cell[3], word, ","); for (i = 1; i <= n; i++) listed[cell[2] " " word[i]] = 1 } next }
    {
        split($1, path, "/")
        n = split(path[2], part, "_")
        split($2, word, "_")
        prefix = part[1]
        for (i = 1; i <= n; i++) {
            if ($2 == prefix || index($2, prefix "_") == 1) next
            prefix = prefix "_" part[i + 1]
        }
        if (path[1] " " word[1] in listed) used[path[1] " " word[1]] = 1
        else print "src/" $1 ".c: exports nh_" $2 ", whose prefix docs/glossary.md does not have for " path[1]
    }
    END { for (entry in listed) if (!(entry in used)) print "docs/glossary.md: no name needs the prefix " entry }' docs/glossary.md - >>"$offences"

# ---- src/cli takes headers and functions of src/base, src/library and nhsym.h only: all else stands behind these ----
grep -nE '^[ \t]*#[ \t]*include[ \t]*"' src/cli/*.[ch] | grep -vE '"(cli|base|library)/|"nhsym\.h"' | sed 's/$/: src\/cli includes headers of src\/base and src\/library only/' >>"$offences"
own=$(for source in src/cli/*.c; do [ -f "$build/${source%.c}.o" ] && echo "$build/${source%.c}.o"; done)
behind=$(for source in src/base/*.c src/library/*.c; do [ -f "$build/${source%.c}.o" ] && echo "$build/${source%.c}.o"; done)
{ nm -g --defined-only $own $behind; nm -A -u $own; } 2>/dev/null | awk '
    NF == 3 && $2 != "U" { defined[$3] = 1; next }
    $NF ~ /^nh_/ && $NF !~ /^nh_cli_/ && !($NF in defined) && !($NF in told) { told[$NF] = 1; sub(/:.*/, "", $1); print $1 ": takes " $NF ", which stands behind src/library" }' >>"$offences"

# ---- nhsym.h can be read at one sitting ----
awk 'END { if (NR > 210) print FILENAME ": has " NR " lines; at most 210" }' src/nhsym.h >>"$offences"

# ---- cited sources and sections exist ----
grep -noE '\[[A-Za-z]*:? ?[A-Z][A-Za-z]+[0-9]{4}[a-z]?' src/*/*.c src/*/*.h tests/*.c tests/*.h tests/*.sh README.md docs/*.md | grep -v '^docs/references.md' |
    sed 's/^\([^:]*:[0-9]*\):.*[^A-Za-z]\([A-Z][A-Za-z]*[0-9]\{4\}[a-z]\{0,1\}\)$/\1 \2/' | awk '!seen[$2]++' | while read -r place key; do
    grep -q "^\* \*\*\[$key\]\*\*" docs/references.md || echo "$place: [$key] is not in docs/references.md"
done >>"$offences"
grep -noE 'docs/[a-z]+\.md(, sec\. [0-9]+)?' src/*/*.c src/*/*.h README.md docs/*.md tests/*.[ch] tests/*.sh Makefile |
    awk -F : '!seen[$3]++' | while IFS=: read -r file line citation; do
    page=${citation%%,*}
    [ -f "$page" ] || [ "$page" = docs/performance.md ] || echo "$file:$line: $page is not there"
    case "$citation" in
    *sec.*) grep -q "^## ${citation##*sec. }\. " "$page" || echo "$file:$line: $page has no section ${citation##*sec. }" ;;
    esac
done >>"$offences"
for page in README.md docs/*.md; do
    folder=$(dirname "$page")
    grep -oE '\]\([^)#:]+\)' "$page" | sed 's/^](\(.*\))$/\1/' | while read -r link; do
        [ -e "$folder/$link" ] || [ "$(basename "$link")" = performance.md ] || echo "$page: links to $link, which is not there"
    done
done >>"$offences"

# ---- the pages name files that are there ----
grep -noE '`(src|tests|docs|systems|analyses)/[A-Za-z0-9_/.-]+\.[a-z0-9]+`' README.md docs/*.md | tr -d '`' | grep -v '/[A-Z]*[._]' |
    while IFS=: read -r page line file; do [ -e "$file" ] || echo "$page:$line: $file is not there"; done >>"$offences"
grep '^| `src/[a-z]*` |' docs/modules.md | tr -d ' `' | cut -d '|' -f 2 | while read -r folder; do
    grep "^| .$folder. |" docs/modules.md | cut -d '|' -f 3 | grep -o '`[a-z0-9_]*`' | tr -d '`' | while read -r module; do
        ls "$folder" | grep -q "^$module[._]\|$module[.]" || echo "docs/modules.md: $folder has no $module"
    done
done >>"$offences"

# ---- a page per function, 500 lines per file besides its includes ----
awk -v most_lines=60 -v most_file=500 '
    FNR == 1 { if (last > most_file) print previous ": " last " lines"; start = 0 }
    FNR == 1 { includes = 0 }
    /^#include/ { includes++ }
    { last = FNR - includes; previous = FILENAME }
    /^{/ { start = FNR - 1; head = before }
    /^}/ { if (start && FNR - start + 1 > most_lines) print FILENAME ":" start ": a function of " FNR - start + 1 " lines: " head; start = 0 }
    { before = $0 }
    END { if (last > most_file) print previous ": " last " lines" }' src/*/*.c src/*/*.h >>"$offences"

# ---- circles, long functions, long lines and small numbers outside named constants: no more than docs/modules.md says (`make house`) ----
{ grep -A 2 '^| headers in circles' docs/modules.md && sh tests/house.sh --counts; } | awk -F '|' '
    NR == 1 { for (i = 2; i < NF; i++) name[i] = $i }
    NR == 3 { for (i = 2; i < NF; i++) most[i] = $i }
    NR == 4 { for (i = 2; i < NF; i++) if ($i + 0 > most[i] + 0) print "src:" name[i] "are" $i "and were" most[i] "at most" }' >>"$offences"

# ---- the style is that of .clang-format (version 14; without it nothing is compared, and tests/test_docs.c says so) ----
if command -v clang-format-14 >/dev/null; then
    clang-format-14 --dry-run src/*.h src/*/*.[ch] 2>&1 | sed -n 's/^\(src[^:]*:[0-9]*\):.*warning: .*/\1: is not in the style of .clang-format: make format/p' |
        sort -u >>"$offences"
fi

# ---- words that docs/glossary.md has replaced: names of variables, comments and texts ----
grep -nwiE 'climb|ladder|shelf|workbench|yardstick|contender|hasten|bystages|survey' src/*/*.[ch] docs/*.md README.md analyses/*.yaml systems/*.yaml tests/*.[ch] |
    sed 's/^\([^:]*:[0-9]*\):.*/\1: a word that the glossary has replaced (climb, ladder, shelf, yardstick, survey, ..)/' >>"$offences"

# ---- no system is known to the code; src/cli may name one in an example ----
for file in $(grep -liE 'sleigh|disk|crane' src/*/*.[ch] | grep -v '^src/cli/'); do # in code, not in a comment
    ${CC:-gcc} -fpreprocessed -dD -E -P -x c "$file" 2>/dev/null | grep -niE 'sleigh|disk|crane' | sed "s|^|$file: code that knows a system: |"
done >>"$offences"

sort -u "$offences"
[ ! -s "$offences" ]
