"""Null space by NumPy, as a user would compute it: singular values of one matrix.  usage: bench_nullspace.py COLUMNS ROWS

The same shape as build/tests/bench_nullspace: A = B diag(d) Z, three of d zero.  Prints the seconds of the singular values of A, those of its QR decomposition and the singular values of R,
and the dimension.
"""
import sys
import time

import numpy as np

n, m = int(sys.argv[1]), int(sys.argv[2])
random = np.random.default_rng(2385)
b = random.uniform(-1, 1, (m, n))
w = random.uniform(-1, 1, (n, 1))
z = np.eye(n) - 2 * w @ w.T / (w.T @ w)
z[:3] = 0
a = b @ z
begin = time.perf_counter()
_, values, right = np.linalg.svd(a, full_matrices=False)
dimension = int((values < 1e-10 * values[0]).sum())
null = right[n - dimension:]
first = time.perf_counter() - begin
begin = time.perf_counter()
_, values, right = np.linalg.svd(np.linalg.qr(a, mode="r"))
null = right[n - int((values < 1e-10 * values[0]).sum()):]
print(f"{first:.3f} {time.perf_counter() - begin:.3f} {dimension}")
