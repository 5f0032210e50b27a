#!/bin/sh
# Runs Python with the package of these sources and the library of the build: the first of $PYTHON, python3 and /usr/bin/python3 that has NumPy, SymPy, pytest and setuptools.
# usage: python.sh ARGUMENT...
here=$(cd "$(dirname "$0")/.." && pwd)
for python in "${PYTHON:-python3}" python3 /usr/bin/python3; do
    "$python" -c 'import numpy, sympy, pytest, setuptools' 2>/dev/null || continue
    : "${NHSYM_LIBRARY=$here/build/libnhsym.so.1}"
    export NHSYM_LIBRARY PYTHONPATH="$here/src/python" PYTHONDONTWRITEBYTECODE=1
    exec "$python" "$@"
done
echo "no Python with NumPy, SymPy, pytest and setuptools was found (Debian: python3-numpy python3-sympy python3-pytest python3-setuptools python3-wheel); PYTHON=.. names one" >&2
exit 77
