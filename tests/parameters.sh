#!/bin/sh
# docs/parameters.md from the rows that bench_parameters printed, one file per system.
# usage: parameters.sh FOLDER       (`make parameters` does it)
cd "$1" || exit 2
cat <<'PAGE'
# Other parameter values

Written by `make parameters`. Parameters stay symbols, so that a formula does not depend on their values. For every system of `systems/` with
parameters three other sets of values are drawn: distinct whole numbers, decimals of five digits, and the values of its file with one parameter at 1,
at 0 or at another parameter's value. With each set the system is analysed and reduced again, without an analysis file, and every current, generator, bracket, conserved
momentum, density and joint field is compared with that of the file's values. Reduced equations are not: their charts are chosen by conditioning at the values.
A special value is put into the file's formulas before the comparison. Sets for which the system is of another kind (no metric, other constraints) are drawn again.

* letters: all formulas are the same, letter for letter.
* functions: all formulas of the file follow from those that are found there. At a special value there are more of them, and simpler ones.
  For currents the rank of gradients in ball arithmetic decides, for fields, momenta and densities linear algebra over the constants.
* limited: a formula of the file holds for some values only, as the file's run says, and is not compared: a series, or a closed form that there is for such values. The others are as above.
* no meaning: some formulas of the file mean nothing there, for instance with 1/k for k = 0 or sqrt(B^2 - w^2) for B < w; or they become constants; or the
  file's equations of motion are not finite at that value. The others are as above.
* differs: a formula is not there.
* -: no admissible values were found.

"For some values only" counts formulas that are proved or fitted for some values of parameters only, of the file and of the first two sets.

| system | formulas | whole numbers | decimals | one special value | for some values only | remarks |
|---|---|---|---|---|---|---|
PAGE
cat -- *.row
awk -F' *[|] *' '
    { systems++; formulas += $3; limited += $7; for (i = 4; i <= 6; i++) { seen[i, $i]++; drawn[i] += $i != "-" } }
    function set(i, name) { return sprintf("%s: %d of %d letter for letter, %d by functions, %d limited, %d without a meaning, %d differ", name, seen[i, "letters"], drawn[i], seen[i, "functions"], seen[i, "limited"], seen[i, "no meaning"], seen[i, "differs"]) }
    END { printf "\n%d systems with parameters, %d formulas. %s. %s. %s. For some values only: %d.\n", systems, formulas, set(4, "Whole numbers"), set(5, "Decimals"), set(6, "One special value"), limited }' ./*.row
