// A x = b by elimination with pivots, rows scaled: A (n x n, row by row) is overwritten, x stands in b; NaN where A is singular.
function nhsymLinear(n, A, b) {
  for (let i = 0; i < n; i++) {
    let size = 0;
    for (let k = 0; k < n; k++) size = Math.max(size, Math.abs(A[i * n + k]));
    for (let k = 0; k < n; k++) A[i * n + k] /= size;
    b[i] /= size;
  }
  for (let j = 0; j < n; j++) {
    let pivot = j;
    for (let i = j + 1; i < n; i++) if (Math.abs(A[i * n + j]) > Math.abs(A[pivot * n + j])) pivot = i;
    if (pivot !== j) {
      for (let k = j; k < n; k++) { const other = A[pivot * n + k]; A[pivot * n + k] = A[j * n + k]; A[j * n + k] = other; }
      const other = b[pivot]; b[pivot] = b[j]; b[j] = other;
    }
    for (let i = j + 1; i < n; i++) {
      const factor = A[i * n + j] / A[j * n + j];
      if (factor === 0) continue;
      for (let k = j + 1; k < n; k++) A[i * n + k] -= factor * A[j * n + k];
      b[i] -= factor * b[j];
    }
  }
  for (let i = n - 1; i >= 0; i--) {
    for (let k = i + 1; k < n; k++) b[i] -= A[i * n + k] * b[k];
    b[i] /= A[i * n + i];
  }
}

// Dormand and Prince's pair of order 5(4) with dense output (Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, II.5 and II.6).
// nhsymSolve(model, parameters, state, from, to, {tol, most}) -> {t, y, at(time, out), evaluations, complete}: t, y: the steps; most: their number.
function nhsymSolve(model, parameters, start, from, to, options) {
  const tol = (options && options.tol) || 1e-10, most = (options && options.most) || 20000, n = start.length;
  const floor = model.floor || start.map(() => 1), sign = to < from ? -1 : 1, row = () => new Float64Array(n);
  const A = [[1 / 5], [3 / 40, 9 / 40], [44 / 45, -56 / 15, 32 / 9], [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729],
    [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656], [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84]];
  const C = [1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1], E = [71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40];
  const D = [-12715105075 / 11282082432, 0, 87487479700 / 32700410799, -10690763975 / 1880347072, 701980252875 / 199316789632,
    -1453857185 / 822651844, 69997945 / 29380423];
  const k = [row(), row(), row(), row(), row(), row(), row()], z = row(), times = [from], states = [Float64Array.from(start)], dense = [];
  let t = from, y = states[0], evaluations = 1, complete = true, refused = 0;
  model.rhs(t, y, parameters, k[0]);
  let rate = 0;
  for (let j = 0; j < n; j++) rate = Math.max(rate, Math.abs(k[0][j]) / Math.max(Math.abs(y[j]), floor[j], 1e-3));
  let h = sign * Math.min(Math.abs(to - from), 0.01, 0.01 / (rate || 1));
  while (sign * (to - t) > 1e-14 * Math.max(1, Math.abs(to))) {
    if (sign * (t + h - to) > 0) h = to - t;
    for (let i = 0; i < 6; i++) {
      const a = A[i];
      for (let j = 0; j < n; j++) { let s = 0; for (let l = 0; l <= i; l++) s += a[l] * k[l][j]; z[j] = y[j] + h * s; }
      model.rhs(t + C[i] * h, z, parameters, k[i + 1]);
    }
    evaluations += 6;
    let error = 0;
    for (let j = 0; j < n; j++) {
      let s = 0;
      for (let l = 0; l < 7; l++) s += E[l] * k[l][j];
      const r = s ? h * s / (tol * Math.max(Math.abs(y[j]), Math.abs(z[j]), floor[j])) : s;
      error += r * r;
    }
    error = Math.sqrt(error / n);
    if (error <= 1) {
      const d = [row(), row(), row(), row()];
      for (let j = 0; j < n; j++) {
        let s = 0;
        for (let l = 0; l < 7; l++) s += D[l] * k[l][j];
        const dy = z[j] - y[j], b = h * k[0][j] - dy;
        d[0][j] = dy; d[1][j] = b; d[2][j] = dy - h * k[6][j] - b; d[3][j] = h * s;
      }
      dense.push(d); t += h; times.push(t); y = Float64Array.from(z); states.push(y);
      k[0].set(k[6]);
      refused = 0;
    } else if (++refused > 40 || times.length + refused > most) { complete = false; break; }
    if (times.length > most) { complete = false; break; }
    h *= isFinite(error) ? Math.min(5, Math.max(0.2, 0.9 * Math.pow(error + 1e-30, -0.2))) : 0.1;
    if (t + h === t) { complete = false; break; }
  }
  function at(time, out) {
    let a = 0, b = times.length - 1;
    while (b - a > 1) { const c = (a + b) >> 1; if (sign * (time - times[c]) >= 0) a = c; else b = c; }
    if (!dense[a]) { out.set(states[a]); return out; }
    const u = (time - times[a]) / (times[a + 1] - times[a]), w = 1 - u, d = dense[a], y0 = states[a];
    for (let j = 0; j < n; j++) out[j] = y0[j] + u * (d[0][j] + w * (d[1][j] + u * (d[2][j] + w * d[3][j])));
    return out;
  }
  return {t: times, y: states, at, evaluations, complete};
}
