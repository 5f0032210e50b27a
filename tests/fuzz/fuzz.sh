#!/bin/sh
# Builds the fuzz targets with clang's libFuzzer, address and undefined-behaviour sanitizers, and runs each for some seconds.
# usage: fuzz.sh SECONDS          what is found is kept in build-fuzz/; the exit code is 1 when something was
seconds=${1:-60}
cd "$(dirname "$0")/../.." || exit 2
build=build-fuzz
if ! command -v clang >/dev/null; then
    echo "fuzzing needs clang (Debian: apt-get install clang); everything else works without it" >&2
    exit 2
fi
runtime="libclang-rt-$(clang -dumpversion | cut -d. -f1)-dev"
mkdir -p "$build/empty"
echo 'int LLVMFuzzerTestOneInput(const unsigned char *d, unsigned long n) { return d && n ? 0 : 0; }' >"$build/probe.c"
if ! clang -fsanitize=fuzzer,address,undefined "$build/probe.c" -o "$build/probe" 2>/dev/null; then
    sh tests/packages.sh "$runtime" || exit 2
fi

printf '#define NH_VERSION "fuzz"\n#define NH_DATADIR "/usr"\n' >"$build/names.h.new"
cmp -s "$build/names.h.new" "$build/names.h" || mv "$build/names.h.new" "$build/names.h"
flags="-std=c17 -O1 -g $(make -s --no-print-directory print-includes) -D_GNU_SOURCE -include $build/names.h -Wno-unknown-attributes -fno-omit-frame-pointer -fsanitize=address,undefined,float-cast-overflow,fuzzer-no-link -fno-sanitize-recover=all"
libraries=$(make -s --no-print-directory print-libraries)
echo "building in $build"
for source in $(ls src/*/*.c | grep -v '^src/cli/'); do
    object="$build/$(echo "$source" | tr / _).o"
    if [ ! "$object" -nt "$source" ] || find src -name '*.h' -newer "$object" | grep -q .; then echo "$source $object"; fi
done | xargs -r -P "$(nproc)" -n 2 sh -c "clang $flags -c \"\$0\" -o \"\$1\" || exit 255" || exit 2

failed=0
for target in fuzz_expression fuzz_system; do
    corpus="$build/$target.corpus"
    mkdir -p "$corpus"
    clang $flags -fsanitize=fuzzer "tests/fuzz/$target.c" "$build"/src_*.o $libraries -o "$build/$target" || exit 2
    if [ "$target" = fuzz_system ]; then
        seeds="systems $build/bad" # every wrong file of the tables is a seed
        mkdir -p "$build/bad"
        awk -v out="$build/bad/" '/^=== message$/ {file = ""; next} /^=== / {close(file); file = out $2 ".yaml"; printf "" >file; next} file {print >file}' tests/bad/*.txt
    else # every expression of the systems is a seed
        seeds="$build/expressions"
        mkdir -p "$seeds"
        sed -n 's/^lagrangian: *//p; s/.*expr: "\(.*\)".*/\1/p; s/^  - \(.*=.*\)$/\1/p' systems/*.yaml | split -l 1 - "$seeds/e"
    fi
    echo "$target for $seconds seconds"
    ASAN_OPTIONS=detect_leaks=1 "$build/$target" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=3000 -dict=tests/fuzz/words.dict -artifact_prefix="$build/$target-" \
        -print_final_stats=1 -close_fd_mask=1 "$corpus" $seeds >"$build/$target.log" 2>&1 || failed=1
    grep -a -q 'stat::number_of_executed_units' "$build/$target.log" || failed=1
    grep -a -e 'stat::number_of_executed_units' -e 'SUMMARY' -e 'Test unit written' "$build/$target.log"
done
[ "$failed" = 0 ] && echo "nothing found" || echo "something was found: see $build/*.log"
exit "$failed"
