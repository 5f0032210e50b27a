# The sources in numbers, as two Markdown tables: per folder, and over all functions.  Run from the top folder; `make house` writes them into docs/modules.md.
#
#     sh tests/house.sh BUILD     with the object files of that folder, for exported functions
#     sh tests/house.sh --form    only the headings and the first column
#     sh tests/house.sh --counts  only the last row of the second table, which may not grow (tests/check_layers.sh)
set -e
build=${1:-build}

# Of all values on standard input, one per line: median, 90 % and largest, with " / " between.
quantiles() { sort -n | awk '{ v[NR] = $1 } END { printf "%d / %d / %d", v[int((NR + 1) / 2)], v[int((9 * NR + 9) / 10)], v[NR] }'; }

# A function: a line at the left margin that ends in `)`, and a `{`, up to a `}`, both at the margin too.  Prints its lines and its parameters.
functions() {
    awk '/^[A-Za-z_].*\)$/ { head = $0; next }
         /^ .*\)$/ && head !~ /\)$/ { next }
         /^{$/ && head != "" { begin = FNR; n = head ~ /\(void\)$/ ? 0 : gsub(/,/, ",", head) + 1; next }
         /^}$/ && begin { print FNR - begin + 2, n; begin = 0; head = "" }
         /^[^ {}]/ && !/\)$/ { head = "" }' "$@"
}

# Groups of modules that include one another in a circle, found by removing headers that include no other, again and again.
circles() {
    for header in $(find src -name '*.h'); do
        name=${header#src/}
        sed -n 's/^#include "\(.*\)"$/\1/p' "$header" | while read -r other; do echo "$name $other"; done
    done | awk '{ from[NR] = $1; to[NR] = $2; out[$1]++ }
                END { do { changed = 0; for (i = 1; i <= NR; i++) if (from[i] != "" && !out[to[i]]) { out[from[i]]--; from[i] = ""; changed = 1 } } while (changed)
                      left = 0; for (f in out) left += out[f] > 0; print left }'
}

exported() { for file in "$@"; do nm --defined-only "$build/${file%.c}.o" 2>/dev/null || true; done | awk '$2 == "T"' | wc -l; }

heading="| folder | files | lines | exported functions | includes | lines of functions: median / 90 % / largest | parameters | comments | lines of headers: median / 90 % / largest |"
whole="| headers in circles | functions over 60 lines | lines over 120 characters | lines with small numbers outside named constants |"

row() {
    c=$(find "$1" $3 -name '*.c'); h=$(find "$1" $3 -name '*.h'); all="$c $h"
    lines=$(cat $all | wc -l)
    comments=$(cat $all | awk '/\/\*/ { inside = 1 } inside { n++ } /\*\// { inside = 0 } END { print n }')
    echo "| $2 | $(echo $all | wc -w) | $lines | $(exported $c) | $(cat $all | grep -c '^#include') | $(functions $c | cut -d' ' -f1 | quantiles) | $(functions $c | cut -d' ' -f2 | quantiles) | $((100 * comments / lines)) % | $(wc -l $h | awk '$2 != "total" { print $1 }' | quantiles) |"
}

# Folders of C sources.
folders() { for folder in src/*/; do ls "$folder"*.c >/dev/null 2>&1 && echo "${folder%/}"; done; }

tables() {
    echo "$heading"
    echo "|---|---|---|---|---|---|---|---|---|"
    for folder in $(folders); do row "$folder" "\`$folder\`" "-maxdepth 1"; done
    row src all
    echo
    echo "$whole"
    echo "|---|---|---|---|"
    counts
}

counts() {
    literals=$(find src -name '*.c' | xargs cat | grep -v 'static const' | grep -cE '[^A-Za-z0-9_.][0-9.]*[0-9]e-[0-9]')
    long=$(find src -name '*.[ch]' | LC_ALL=C xargs awk 'length > 120 { n++ } END { print n + 0 }')
    echo "| $(circles) | $(functions $(find src -name '*.c') | awk '$1 > 60' | wc -l) | $long | $literals |"
}

if [ "$1" = --form ]; then
    echo "$heading"
    for folder in $(folders) all; do echo "$folder"; done
    echo "$whole"
elif [ "$1" = --counts ]; then
    counts
else
    tables
fi
