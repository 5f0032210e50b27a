#!/bin/sh
# Data races, by ThreadSanitizer: two contexts of the library at once, and what shares its work between threads.
# usage: threads.sh BUILD          a build with SANITIZE=thread; the last line is "N passed, N failed"
build=$1
passed=0
failed=0
export TSAN_OPTIONS="halt_on_error=0 exitcode=66 ${TSAN_OPTIONS:-}"
look() {
    name=$1
    shift
    said=$("$@" 2>&1)
    code=$?
    if [ "$code" = 0 ] && ! printf '%s' "$said" | grep -q 'WARNING: ThreadSanitizer'; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf '%s\n' "$name: exit code $code" "$said" | head -n 60
    fi
}
NHSYM=$build/nhsym
export NHSYM
look 'contexts at once' "$build/tests/bench_contexts"
look 'an ensemble' "$NHSYM" simulate sleigh --ensemble 40 --threads 4 --until 2
look 'members alone' "$NHSYM" simulate sleigh --velocities coordinates --ensemble 40 --spread 0.9 --initial 'phi=0.3, omega=0.5' --threads 4 --until 5
look 'sectors of a search' "$NHSYM" analyze kepler --no-analysis --threads 4 --quiet --json /dev/null
look 'a search with series' "$NHSYM" analyze rolling_ball --threads 4 --quiet --json /dev/null
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
