// The moving picture: shapes in a plane, or bodies in space that turn under the mouse.
// nhsymScene(stage, model, tools) -> {motion(motion), frame(time, values, ghost)}: values are those of the model's tracks at one time.
function nhsymScene(stage, model, tools) {
  const svg = tools.$('svg.scene', stage), make = tools.make, samples = 320;
  const space = model.shapes.some(s => ['ball', 'cylinder', 'box', 'rod'].includes(s.kind));
  const shapes = model.shapes.filter(s => !(space && s.flat));
  const colour = shapes.map(() => 'var(--soft)');
  let painted = 0;
  shapes.forEach((s, i) => { if (s.kind !== 'segment' && s.kind !== 'rod') colour[i] = `var(--c${1 + painted++ % 6})`; });
  const moves = i => shapes[i].kind !== 'segment' && shapes[i].kind !== 'rod';
  let W = 500, H = 380, motion = null, times = [], rows = [], last = null, user = false, follow = false, scale = 40, centre = [0, 0, 0];
  const finite = list => list.every(Number.isFinite);
  const number = (s, v, j) => v[s.at + j];
  const extentOf = (s, v, j) => { const x = Math.abs(number(s, v, j)); return Number.isFinite(x) ? x : 0; }; // of a body: an inertia may have no box
  const round = x => x.toFixed(1);
  // ---- what every picture has: size, buttons, mouse ----
  function size() {
    const box = svg.getBoundingClientRect();
    W = box.width || 500; H = box.height || 380;
    svg.setAttribute('viewBox', `0 0 ${W} ${H}`);
  }
  function sample(m) {
    motion = m; times = []; rows = [];
    for (let i = 0; i <= samples; i++) { const t = m.begin + (m.end - m.begin) * i / samples; times.push(t); rows.push(Float64Array.from(m.at(t))); }
  }
  const again = () => last && frame(...last);
  const buttons = tools.$$('.view button', stage);
  const acts = {out: () => { user = true; scale /= 1.3; }, in: () => { user = true; scale *= 1.3; }, fit: () => { user = false; follow = false; fit(); }, follow: () => { follow = !follow; user = false; fit(); }};
  for (const b of buttons) b.onclick = () => { acts[b.dataset.do](); for (const c of buttons) if (c.dataset.do === 'follow') c.setAttribute('aria-pressed', follow); again(); };
  let grab = null;
  svg.addEventListener('pointerdown', e => { if (e.pointerType === 'touch' && !space) return; grab = [e.clientX, e.clientY]; svg.setPointerCapture(e.pointerId); stage.classList.add('grabbed'); });
  svg.addEventListener('pointermove', e => { if (!grab) return; drag(e.clientX - grab[0], e.clientY - grab[1]); grab = [e.clientX, e.clientY]; again(); });
  svg.addEventListener('pointerup', () => { grab = null; stage.classList.remove('grabbed'); });
  svg.addEventListener('dblclick', () => { acts.fit(); again(); });
  svg.addEventListener('wheel', e => { if (!e.ctrlKey) return; e.preventDefault(); user = true; scale *= Math.exp(-e.deltaY / 300); again(); }, {passive: false});
  svg.addEventListener('keydown', e => { const way = {ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, -12], ArrowDown: [0, 12]}[e.key]; if (!way) return; e.preventDefault(); drag(...way); again(); });
  function drag(dx, dy) {
    if (space) { turn -= dx / 120; tilt = Math.max(-1.5, Math.min(1.5, tilt + dy / 120)); return; }
    user = true; follow = false; centre[0] -= dx / scale; centre[1] += dy / scale;
  }
  const pitch = () => { const raw = 70 / scale, e = Math.pow(10, Math.floor(Math.log10(raw))), f = raw / e; return e * (f > 5 ? 10 : f > 2 ? 5 : f > 1 ? 2 : 1); };
  const label = text => { caption.textContent = text; caption.setAttribute('y', H - 10); };

  // ---- in a plane ----
  const ends = {point: [[0, 1]], arrow: [[0, 1]], disc: [[0, 1]], wheel: [[0, 1]], segment: [[0, 1], [2, 3]]};
  const radius = (s, v) => s.kind === 'disc' ? extentOf(s, v, 2) : s.kind === 'wheel' ? extentOf(s, v, 3) : 0;
  function fitPlane() {
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const v of follow && last ? [last[1]] : rows) for (const s of shapes) for (const e of ends[s.kind]) for (const c of [0, 1]) {
      const x = number(s, v, e[c]), r = radius(s, v);
      if (Number.isFinite(x)) { low[c] = Math.min(low[c], x - r); high[c] = Math.max(high[c], x + r); }
    }
    if (!finite(low)) return;
    const wide = Math.max(high[0] - low[0], 1e-9), tall = Math.max(high[1] - low[1], 1e-9);
    if (follow) scale = Math.min(scale * 2, 0.3 * Math.min(W, H) / Math.max(wide, tall, 1e-3));
    else { centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0]; const unit = Math.max(wide, tall); scale = Math.min((W - 70) / Math.max(wide, unit / 40), (H - 70) / Math.max(tall, unit / 40)); }
  }
  const X = x => W / 2 + (x - centre[0]) * scale, Y = y => H / 2 - (y - centre[1]) * scale;
  function grid() {
    const step = pitch();
    let d = '';
    for (let x = Math.ceil((centre[0] - W / 2 / scale) / step) * step; X(x) < W; x += step) d += `M${round(X(x))} 0V${H}`;
    for (let y = Math.ceil((centre[1] - H / 2 / scale) / step) * step; Y(y) > 0; y += step) d += `M0 ${round(Y(y))}H${W}`;
    ground.setAttribute('d', d);
    label(`grid: ${+step.toPrecision(3)}`);
  }
  function trace(s, until) {
    let d = '', pen = false;
    for (let i = 0; i < rows.length; i++) {
      if (until !== null && times[i] > until) break;
      const x = number(s, rows[i], 0), y = number(s, rows[i], 1);
      if (!finite([x, y])) { pen = false; continue; }
      d += (pen ? 'L' : 'M') + round(X(x)) + ' ' + round(Y(y)); pen = true;
    }
    return d;
  }
  function put(s, v, c, to) {
    const x = X(number(s, v, 0)), y = Y(number(s, v, 1));
    if (!finite([x, y])) return;
    if (s.kind === 'segment') make('path', {d: `M${round(x)} ${round(y)}L${round(X(number(s, v, 2)))} ${round(Y(number(s, v, 3)))}`, stroke: c, 'stroke-width': 3, 'stroke-linecap': 'round'}, to);
    else if (s.kind === 'wheel') { const a = number(s, v, 2), r = scale * number(s, v, 3), p = r * Math.cos(a), q = r * Math.sin(a); make('path', {d: `M${round(x - p)} ${round(y + q)}L${round(x + p)} ${round(y - q)}`, stroke: c, 'stroke-width': 6, 'stroke-linecap': 'round'}, to); }
    else if (s.kind === 'disc') make('circle', {cx: round(x), cy: round(y), r: round(Math.max(2, scale * radius(s, v))), fill: c, 'fill-opacity': .16, stroke: c, 'stroke-width': 1.7}, to);
    else {
      make('circle', {cx: round(x), cy: round(y), r: 6, fill: c}, to);
      if (s.kind === 'arrow') { const a = number(s, v, 2); make('path', {d: `M${round(x)} ${round(y)}L${round(x + 32 * Math.cos(a))} ${round(y - 32 * Math.sin(a))}`, stroke: c, 'stroke-width': 3.4, 'stroke-linecap': 'round'}, to); }
    }
  }
  function framePlane(time, v, ghostly) {
    if (follow) { const s = shapes.find((q, i) => moves(i)) || shapes[0], x = number(s, v, 0), y = number(s, v, 1); if (finite([x, y])) centre = [x, y, 0]; }
    grid();
    whole.textContent = past.textContent = body.textContent = ghost.textContent = '';
    shapes.forEach((s, i) => { if (!moves(i)) return;
      make('path', {d: trace(s, null), stroke: colour[i], opacity: .3, 'stroke-width': 1.3}, whole);
      make('path', {d: trace(s, time), stroke: colour[i], 'stroke-width': 1.9, opacity: .85}, past); });
    for (const front of [false, true]) shapes.forEach((s, i) => { if (moves(i) === front) put(s, v, colour[i], body); });
    if (ghostly) shapes.forEach((s, i) => put(s, ghostly, colour[i], ghost));
  }

  // ---- in space: far things first, hidden sides faint ----
  const given = {ball: 4, cylinder: 5, box: 6}, sides = 28, arcs = 40;
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], plus = (a, k, b) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = a => { const n = Math.sqrt(dot(a, a)) || 1; return [a[0] / n, a[1] / n, a[2] / n]; };
  const place = (s, v, j) => [number(s, v, j), number(s, v, j + 1), number(s, v, j + 2)];
  const corner = s => s.kind === 'rod' || given[s.kind] ? (v => place(s, v, 0)) : (v => [number(s, v, 0), number(s, v, 1), 0]);
  let turn = 0.55, tilt = 0.38, extent = 1, lowest = 0, away, right, top, light, list = [];
  const upward = model.up === undefined ? 2 : model.up;
  function frameOf() { // the directions of the picture
    const e = [(upward + 1) % 3, (upward + 2) % 3], d = [0, 0, 0], r = [0, 0, 0], u = [0, 0, 0];
    d[e[0]] = Math.cos(turn) * Math.cos(tilt); d[e[1]] = Math.sin(turn) * Math.cos(tilt); d[upward] = Math.sin(tilt);
    r[e[0]] = -Math.sin(turn); r[e[1]] = Math.cos(turn);
    u[upward] = 1;
    away = d; right = r; top = cross(d, r);
    light = unit(plus(plus(d, 0.5, r), 0.9, u));
  }
  function fitSpace() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const v of follow && last ? [last[1]] : rows) for (const s of shapes) {
      const points = s.kind === 'rod' ? [place(s, v, 0), place(s, v, 3)] : [corner(s)(v)];
      const r = s.kind === 'ball' ? extentOf(s, v, 3) : s.kind === 'cylinder' ? Math.hypot(extentOf(s, v, 3), extentOf(s, v, 4) / 2) : s.kind === 'box' ? Math.hypot(extentOf(s, v, 3), extentOf(s, v, 4), extentOf(s, v, 5)) / 2 : 0;
      for (const p of points) if (finite(p)) for (const c of [0, 1, 2]) { low[c] = Math.min(low[c], p[c] - r); high[c] = Math.max(high[c], p[c] + r); }
    }
    if (!finite(low)) return;
    lowest = low[upward];
    centre = low.map((a, c) => (a + high[c]) / 2);
    extent = Math.max(Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]), 1e-9);
    scale = 1.15 * Math.min(W, H) / extent;
  }
  const see = p => { const q = plus(p, -1, centre), z = dot(q, away), far = 3 * extent, f = scale * far / Math.max(far - z, far / 8); return [W / 2 + f * dot(q, right), H / 2 - f * dot(q, top), z, f]; };
  const path = (ps, close) => ps.map((p, i) => { const q = see(p); return (i ? 'L' : 'M') + round(q[0]) + ' ' + round(q[1]); }).join('') + (close ? 'Z' : '');
  const mean = ps => ps.reduce((m, p) => plus(m, 1 / ps.length, p), [0, 0, 0]);
  const depth = p => dot(plus(p, -1, centre), away);
  const add = (z, at) => list.push([z, at]);
  const shade = (c, n) => `color-mix(in srgb, ${c} ${Math.round(28 + 34 * Math.max(0, dot(n, light)))}%, var(--stage))`;
  const eye = p => plus(plus(centre, 3 * extent, away), -1, p);
  function face(ps, n, c, edge) {
    const m = mean(ps), front = dot(n, eye(m)) > 0;
    add(depth(m), front ? {d: path(ps, true), fill: shade(c, n), 'fill-opacity': .9, stroke: edge ? c : shade(c, n), 'stroke-width': edge ? 1.3 : .6}
      : {d: path(ps, true), fill: 'none', stroke: c, 'stroke-opacity': edge ? .25 : 0, 'stroke-width': 1});
    return front;
  }
  const around = (p, a, b, r, t) => plus(plus(p, r * Math.cos(t), a), r * Math.sin(t), b);
  const ring = (p, a, b, r) => Array.from({length: sides}, (_, j) => around(p, a, b, r, 2 * j * Math.PI / sides));
  function circle(p, a, b, r, c) { // a great circle: behind the ball it is faint
    let run = [], was = null;
    const d = depth(p), end = () => { if (run.length) add(d + (was ? r : -r), {d: path(run), fill: 'none', stroke: c, 'stroke-opacity': was ? .9 : .2, 'stroke-width': 1.3}); };
    for (let j = 0; j <= arcs; j++) {
      const q = around(p, a, b, r, 2 * j * Math.PI / arcs), front = dot(plus(q, -1, p), eye(p)) > r * r;
      if (front !== was) { if (run.length) run.push(q); end(); run = []; was = front; }
      run.push(q);
    }
    end();
  }
  function solid(s, v, c) {
    const p = place(s, v, 0), g = given[s.kind], a = place(s, v, g), b = place(s, v, g + 3), n = cross(a, b), x = extentOf(s, v, 3);
    if (!finite([...p, ...a, ...b])) return;
    if (s.kind === 'ball') {
      const q = see(p), r = Math.max(4, q[3] * x);
      add(q[2], {d: `M${round(q[0] - r)} ${round(q[1])}a${round(r)} ${round(r)} 0 1 0 ${round(2 * r)} 0a${round(r)} ${round(r)} 0 1 0 ${round(-2 * r)} 0`, fill: shade(c, light), 'fill-opacity': .9, stroke: c, 'stroke-width': 1.3});
      if (r > 6) { circle(p, a, b, x, c); circle(p, b, n, x, c); circle(p, n, a, x, c); }
    } else if (s.kind === 'cylinder') {
      const h = extentOf(s, v, 4) / 2;
      for (const e of [1, -1]) {
        const o = plus(p, e * h, n), front = face(ring(o, a, b, x), n.map(k => e * k), c, true);
        if (front) for (const j of [0, 1]) add(depth(o) + 0.01 * x, {d: path([o, plus(o, x * (j ? -1 : 1), a)]), fill: 'none', stroke: c, 'stroke-opacity': j ? .5 : 1, 'stroke-width': j ? 1 : 2.6});
      }
      if (h > 0) for (let j = 0; j < sides; j++) {
        const q = [j, j + 1].map(u => around([0, 0, 0], a, b, x, 2 * u * Math.PI / sides));
        face([plus(plus(p, 1, q[0]), h, n), plus(plus(p, 1, q[1]), h, n), plus(plus(p, 1, q[1]), -h, n), plus(plus(p, 1, q[0]), -h, n)], unit(plus(q[0], 1, q[1])), c, false);
      }
    } else {
      const h = [x / 2, extentOf(s, v, 4) / 2, extentOf(s, v, 5) / 2], A = [a, b, n];
      for (let j = 0; j < 6; j++) {
        const e = j > 2 ? -1 : 1, u = A[j % 3], w = A[(j + 1) % 3], t = A[(j + 2) % 3], o = plus(p, e * h[j % 3], u), l = h[(j + 1) % 3], m = h[(j + 2) % 3];
        face([[1, 1], [-1, 1], [-1, -1], [1, -1]].map(k => plus(plus(o, k[0] * l, w), k[1] * m, t)), u.map(k => e * k), c, true);
      }
    }
  }
  function bodies(v, to) {
    list = [];
    shapes.forEach((s, i) => {
      if (s.kind === 'rod') { const a = place(s, v, 0), b = place(s, v, 3); if (finite([...a, ...b])) add(depth(mean([a, b])), {d: path([a, b]), fill: 'none', stroke: 'var(--soft)', 'stroke-width': 3}); }
      else if (given[s.kind]) solid(s, v, colour[i]);
      else if (s.kind === 'segment') { const a = [number(s, v, 0), number(s, v, 1), 0], b = [number(s, v, 2), number(s, v, 3), 0]; if (finite([...a, ...b])) add(depth(mean([a, b])), {d: path([a, b]), fill: 'none', stroke: 'var(--soft)', 'stroke-width': 3}); }
      else { const q = see(corner(s)(v)); if (finite(q)) add(q[2], {d: `M${round(q[0] - 5)} ${round(q[1])}a5 5 0 1 0 10 0a5 5 0 1 0 -10 0`, fill: colour[i]}); }
    });
    list.sort((a, b) => a[0] - b[0]);
    to.textContent = '';
    for (const e of list) make('path', e[1], to);
  }
  function frameSpace(time, v, ghostly) {
    if (follow) { const p = corner(shapes.find((q, i) => moves(i)) || shapes[0])(v); if (finite(p)) centre = p; }
    frameOf();
    const step = pitch() * 1.5, e = [(upward + 1) % 3, (upward + 2) % 3], half = 5;
    let d = '';
    for (const m of [0, 1]) for (let j = -half; j <= half; j++) {
      const p = [0, 0, 0], q = [0, 0, 0];
      p[upward] = q[upward] = lowest;
      p[e[m]] = q[e[m]] = step * (Math.round(centre[e[m]] / step) + j);
      p[e[1 - m]] = step * (Math.round(centre[e[1 - m]] / step) - half); q[e[1 - m]] = p[e[1 - m]] + 2 * half * step;
      d += path([p, q]);
    }
    ground.setAttribute('d', d);
    label(`squares of ${+step.toPrecision(2)}`);
    whole.textContent = past.textContent = '';
    shapes.forEach((s, i) => {
      if (!moves(i)) return;
      const points = rows.map(corner(s)), draw = n => { let t = '', pen = false; for (let k = 0; k < n; k++) { if (!finite(points[k])) { pen = false; continue; } const q = see(points[k]); t += (pen ? 'L' : 'M') + round(q[0]) + ' ' + round(q[1]); pen = true; } return t; };
      make('path', {d: draw(points.length), stroke: colour[i], opacity: .28, 'stroke-width': 1.2}, whole);
    });
    bodies(v, body);
    ghost.textContent = '';
    if (ghostly) bodies(ghostly, ghost);
  }

  const ground = make('path', {class: 'tick'}, svg), whole = make('g', {fill: 'none', 'stroke-linejoin': 'round'}, svg), past = make('g', {fill: 'none', 'stroke-linejoin': 'round'}, svg);
  const ghost = make('g', {opacity: .35}, svg), body = make('g', {'stroke-linejoin': 'round', 'stroke-linecap': 'round'}, svg), caption = make('text', {x: 12, class: 'note'}, svg);
  const fit = space ? fitSpace : fitPlane;
  function frame(time, v, ghostly) { last = [time, v, ghostly]; (space ? frameSpace : framePlane)(time, v, ghostly); }
  // for an animation in one file: what stays, and what moves; where the picture follows a body everything moves
  const parts = () => ({still: follow ? '' : ground.outerHTML + whole.outerHTML + caption.outerHTML, moving: (follow ? ground.outerHTML + whole.outerHTML : '') + body.outerHTML});
  return {parts, motion(m) { size(); sample(m); if (!user) fit(); }, frame, space};
}
