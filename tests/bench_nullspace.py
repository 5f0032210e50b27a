"""Null space by NumPy, as a user would compute it: singular values of one matrix.  usage: bench_nullspace.py COLUMNS ROWS

The same shape as build/tests/bench_nullspace: A = B diag(d) Z, three of d zero.  Prints the seconds of the singular values of A, those of its QR decomposition and the singular values of R,
the dimension, and for the pair (A, B) those by singular values and by QR decompositions.
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
begin2 = time.perf_counter()
# the pair of matrices that nhsym solves: how small is A c where B c varies?
second = begin2 - begin
begin = time.perf_counter()
_, size, right = np.linalg.svd(b - b.mean(axis=0), full_matrices=False)
_, values, right = np.linalg.svd(a @ (right.T / size), full_matrices=False)
pair = time.perf_counter() - begin
begin = time.perf_counter()
triangle = np.linalg.qr(b - b.mean(axis=0), mode="r")
_, values, right = np.linalg.svd(np.linalg.solve(triangle.T, np.linalg.qr(a, mode="r").T).T)
print(f"{first:.3f} {second:.3f} {dimension} {pair:.3f} {time.perf_counter() - begin:.3f}")
