// Elliptic integrals by Carlson's forms [DLMF 19.25, 19.36], and Riemann's equation by its Taylor series.
var nhsymSpecial = (function () {
  function means(x, y, z) {
    const a = Math.sqrt(x), b = Math.sqrt(y), c = Math.sqrt(z);
    return a * b + b * c + c * a;
  }
  // R_C(1, 1 + e)
  function arc(e) {
    if (Math.abs(e) < 1e-4) return 1 - e / 3 + e * e / 5 - e * e * e / 7;
    return e > 0 ? Math.atan(Math.sqrt(e)) / Math.sqrt(e) : Math.atanh(Math.sqrt(-e)) / Math.sqrt(-e);
  }
  // R_F, R_D and R_J at once: each step brings the arguments nearer to their mean by a factor of 4
  function carlson(x, y, z, p) {
    let sumD = 0, sumJ = 0, power = 1;
    for (let i = 0; i < 60; i++) {
      const mean = (x + y + z) / 3, far = Math.max(Math.abs(x - mean), Math.abs(y - mean), Math.abs(z - mean), Math.abs(p - mean));
      if (far < 1e-8 * mean) break;
      const l = means(x, y, z), d = (Math.sqrt(p) + Math.sqrt(x)) * (Math.sqrt(p) + Math.sqrt(y)) * (Math.sqrt(p) + Math.sqrt(z));
      sumD += power / (Math.sqrt(z) * (z + l));
      sumJ += power / d * arc((p - x) * (p - y) * (p - z) / (d * d));
      power /= 4;
      x = (x + l) / 4; y = (y + l) / 4; z = (z + l) / 4; p = (p + l) / 4;
    }
    const m = (x + y + z) / 3;
    return {F: 1 / Math.sqrt(m), D: 3 * sumD + power / (m * Math.sqrt(m)), J: 6 * sumJ + power / (m * Math.sqrt(m))};
  }
  // u is brought between -pi/2 and pi/2; half a turn adds twice the complete integral
  function whole(u, f) {
    const k = Math.round(u / Math.PI), rest = f(u - k * Math.PI);
    return k ? 2 * k * f(Math.PI / 2) + rest : rest;
  }
  function ellipticF(u, m) {
    return whole(u, a => { const s = Math.sin(a), c = Math.cos(a); return s * carlson(c * c, 1 - m * s * s, 1, 1).F; });
  }
  function ellipticE(u, m) {
    return whole(u, a => {
      const s = Math.sin(a), c = Math.cos(a), r = carlson(c * c, 1 - m * s * s, 1, 1);
      return s * r.F - m * s * s * s / 3 * r.D;
    });
  }
  function ellipticPi(n, u, m) {
    return whole(u, a => {
      const s = Math.sin(a), c = Math.cos(a), r = carlson(c * c, 1 - m * s * s, 1, 1 - n * s * s);
      return s * carlson(c * c, 1 - m * s * s, 1, 1).F + n * s * s * s / 3 * r.J;
    });
  }
  // y'' = (a + b z + c z^2)/(1 + z^2)^2 y from 0 to x
  function series(a, b, c, x, y, v, slope) {
    let z = 0;
    if (!isFinite(x)) return NaN;
    while (z !== x) {
      const e = 1 + z * z, last = Math.abs(x - z) <= 0.3 * Math.sqrt(e), h = last ? x - z : Math.sign(x - z) * 0.3 * Math.sqrt(e), u = [y, v];
      for (let k = 0; k < 38; k++) {
        let s = (a + (b + c * z) * z - (4 * z * z + 2 * e) * k * (k - 1)) * u[k] - 4 * e * z * (k + 1) * k * u[k + 1];
        if (k > 0) s += (b + 2 * c * z - 4 * z * (k - 1) * (k - 2)) * u[k - 1];
        if (k > 1) s += (c - (k - 2) * (k - 3)) * u[k - 2];
        u.push(s / (e * e * (k + 2) * (k + 1)));
      }
      y = v = 0;
      for (let k = 39; k >= 0; k--) { v = v * h + y; y = y * h + u[k]; }
      z = last ? x : z + h;
    }
    return slope ? v : y;
  }
  return {ellipticF, ellipticE, ellipticPi, series};
})();
