// node tests/live.js MODEL.js NHSYM SYSTEM: the motion of an exported model against the program's own, from the model's initial state and from two others, with
// other parameters.  Prints a line of JSON: the largest difference of a state relative to its size along the motion, the largest drift of a quantity that holds,
// the evaluations; of the functions of special.js, where the model needs them, nothing is told apart.
'use strict';
const path = require('path'), {execFileSync} = require('child_process');
const [file, nhsym, system] = process.argv.slice(2), {model, solve} = require(path.resolve(file));
const close = (a, b) => Math.abs(a - b) <= 1e-12 * Math.max(Math.abs(a), Math.abs(b));
let states = 0, drift = 0, evaluations = 0, motions = 0, velocities = 0;
// the same kind of change for every system: a parameter by some percent, velocities by a tenth of their size
const variations = [[0, 0], [0.04, 0.1], [-0.03, -0.07]];
const free = !model.conditions;
for (const [dp, dv] of free ? variations : variations.slice(0, 1)) {
  const p = {...model.parameters}, start = model.initial.slice(), begin = model.time[0], end = Math.min(model.time[1], begin + 3);
  Object.keys(p).forEach((k, i) => { if (i % 2 === 0) p[k] *= 1 + dp; });
  start.forEach((v, i) => { start[i] = v + dv * (Math.abs(v) || 0.1) * (i % 2 ? 1 : 0.5); });
  const motion = solve(model, p, start, begin, end, {tol: 1e-13, most: 400000});
  const line = ['simulate', system, '--initial', (begin ? `t=${begin}, ` : '') + model.state.map((k, i) => `${k}=${start[i]}`).join(', '), '--until', end, '--step', (end - begin) / 6, '--accuracy', '1e-12', '--quiet'];
  for (const k in p) line.push('--set', `${k}=${p[k]}`);
  let text;
  try { text = execFileSync(nhsym, line.map(String), {encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe']}); } catch (e) { if (e.status !== 5 && e.status !== 4) throw e; continue; }
  const rows = text.trim().split('\n').map(r => r.split(',')), column = k => { const c = rows[0].indexOf(k) >= 0 ? rows[0].indexOf(k) : rows[0].indexOf(k.replace("'", '_dot')); if (c < 0) throw new Error(`no column ${k}`); return c; };
  const follows = model.tracks.map((k, j) => k.kind === 'state' || k.kind === 'energy' ? [j, column(k.name)] : null).filter(Boolean), far = follows.map(([, c]) => Math.max(1, ...rows.slice(1).map(r => Math.abs(+r[c]))));
  const at = model.state.map(column), size = at.map(c => Math.max(1e-3, ...rows.slice(1).map(r => Math.abs(+r[c])))), s = new Float64Array(model.state.length), tracks = [];
  for (const r of rows.slice(1)) {
    if (+r[0] > motion.t[motion.t.length - 1] + 1e-12) throw new Error(`ends at ${motion.t[motion.t.length - 1]}`);
    motion.at(+r[0], s);
    at.forEach((c, j) => { states = Math.max(states, Math.abs(s[j] - r[c]) / size[j]); });
    model.observe(+r[0], s, p, tracks); // what is followed: the velocities of all coordinates, the energy
    follows.forEach(([j, c], i) => { velocities = Math.max(velocities, Math.abs(tracks[j] - r[c]) / far[i]); });
  }
  if (model.currents.length) {
    const q0 = [], q = [], scale = [], most = model.currents.map(() => 0), largest = most.slice();
    model.quantities(motion.t[0], motion.y[0], p, q0, scale);
    motion.t.forEach((t, i) => { model.quantities(t, motion.y[i], p, q, scale); q.forEach((v, j) => { most[j] = Math.max(most[j], Math.abs(v - q0[j])); largest[j] = Math.max(largest[j], scale[j]); }); });
    model.currents.forEach((c, j) => { if (!c.without && c.proved && Object.keys(c.needs || {}).every(k => close(p[k], c.needs[k](p))) && isFinite(most[j])) drift = Math.max(drift, most[j] / (largest[j] || 1)); });
  }
  evaluations += motion.evaluations;
  motions++;
}
console.log(JSON.stringify({states, velocities, drift, evaluations, motions}));
