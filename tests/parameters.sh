#!/bin/sh
# docs/parameters.md from the rows that bench_parameters printed, one file per system.
# usage: parameters.sh FOLDER       (`make parameters` does it)
cat "$(dirname "$0")/pages/parameters.md"
cd "$1" || exit 2
cat <<'PAGE'
| system | formulas | whole numbers | decimals | one special value | for some values only | remarks |
|---|---|---|---|---|---|---|
PAGE
cat -- *.row
awk -F' *[|] *' '
    { systems++; formulas += $3; limited += $7; for (i = 4; i <= 6; i++) { seen[i, $i]++; drawn[i] += $i != "-" } }
    function set(i, name) { return sprintf("%s: %d of %d letter for letter, %d by functions, %d limited, %d without a meaning, %d differ", name, seen[i, "letters"], drawn[i], seen[i, "functions"], seen[i, "limited"], seen[i, "no meaning"], seen[i, "differs"]) }
    END { printf "\n%d systems with parameters, %d formulas. %s. %s. %s. For some values only: %d.\n", systems, formulas, set(4, "Whole numbers"), set(5, "Decimals"), set(6, "One special value"), limited }' ./*.row
