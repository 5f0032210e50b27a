// The page: numbers -> motion -> table, picture, plots.  The model comes from the program; nothing here is of one system.
function nhsymPage(model) {
  const $ = (s, e) => (e || document).querySelector(s), $$ = (s, e) => [...(e || document).querySelectorAll(s)];
  const NS = 'http://www.w3.org/2000/svg', make = (n, a, up) => { const e = document.createElementNS(NS, n); for (const k in a) e.setAttribute(k, a[k]); if (up) up.append(e); return e; };
  const root = document.documentElement, live = !!model.rhs, names = Object.keys(model.parameters), nq = model.currents.length, [begin, end] = model.time;
  const given = {...model.parameters}, first = {}, now = {...model.parameters};
  if (live) model.state.forEach((k, i) => { first[k] = model.initial[i]; now[k] = model.initial[i]; });
  const start = {...given, ...first};
  let tol = 1e-9, zoom = [begin, end], t = begin, playing = false, hover = null, speed = 1, motion = null;
  const minus = text => text.replace('-', '\u2212');
  const number = (x, digits) => !isFinite(x) ? '\u2013' : minus(Math.abs(x) >= 1e6 || (x && Math.abs(x) < 1e-4) ? x.toExponential(Math.min(2, digits - 1)) : String(+x.toPrecision(digits)));
  const values = () => { const p = {}; for (const k of names) p[k] = now[k]; return p; };
  root.classList.add('js');

  // ---- the motion ----
  function recomputed() {
    const p = values(), s = model.state.map(k => now[k]), solved = nhsymSolve(model, p, s, begin, end, {tol}), state = new Float64Array(s.length), out = new Float64Array(model.tracks.length);
    const q0 = new Float64Array(nq), q = new Float64Array(nq), size = new Float64Array(nq), most = new Float64Array(nq), scale = new Float64Array(nq), drift = [];
    if (nq) {
      model.quantities(begin, solved.y[0], p, q0, size);
      solved.t.forEach((time, i) => {
        model.quantities(time, solved.y[i], p, q, size);
        const row = [time];
        for (let j = 0; j < nq; j++) { scale[j] = Math.max(scale[j], size[j]); const d = Math.abs(q[j] - q0[j]); row.push(d); if (!(d <= most[j])) most[j] = d; }
        drift.push(row);
      });
    }
    const at = time => { solved.at(time, state); model.observe(time, state, p, out); return out; };
    const quantities = time => { solved.at(time, state); model.quantities(time, state, p, q, size); return q; };
    return {p, at, quantities, state: time => solved.at(time, state), most, scale, drift, begin, end: solved.t[solved.t.length - 1], evaluations: solved.evaluations, complete: solved.complete};
  }
  // the motion that the program computed: a cubic through four of its times
  function table() {
    const T = model.motion.t, V = model.motion.value, out = new Float64Array(V.length), last = T.length - 1;
    const at = time => {
      let i = Math.min(last - 1, Math.max(0, Math.floor((time - T[0]) / (T[last] - T[0]) * last)));
      while (i > 0 && T[i] > time) i--;
      while (i < last - 1 && T[i + 1] < time) i++;
      const u = (time - T[i]) / (T[i + 1] - T[i]);
      V.forEach((v, j) => {
        const a = v[i], b = v[i + 1], before = v[Math.max(0, i - 1)], after = v[Math.min(last, i + 2)];
        const m = (b - (before === null ? a : before)) / 2, n = ((after === null ? b : after) - a) / 2;
        out[j] = a === null || b === null ? NaN : a + u * (m + u * (3 * (b - a) - 2 * m - n + u * (2 * (a - b) + m + n)));
      });
      return out;
    };
    const q = new Float64Array(nq), column = model.currents.map(c => model.tracks.findIndex(k => k.name === c.name && k.kind !== 'shape'));
    return {p: given, at, quantities(time) { const v = at(time); column.forEach((c, j) => { q[j] = c < 0 ? NaN : v[c]; }); return q; }, drift: [], begin, end, complete: true};
  }
  // the nearest state that the constraints allow; the number that was changed stays
  function settle(changed) {
    if (!model.conditions) return true;
    const p = values(), s = model.state.map(k => now[k]), held = model.state.indexOf(changed), n = s.length, f = [], g = [], h = [];
    for (let i = 0; i < 40; i++) {
      f.length = 0;
      model.conditions(begin, s, p, f);
      const m = f.length;
      if (!f.every(isFinite)) return false;
      if (Math.max(...f.map(Math.abs)) < 1e-13 * (1 + Math.max(...s.map(Math.abs)))) break;
      if (i === 39 && Math.max(...f.map(Math.abs)) > 1e-9) return false;
      const J = [];
      for (let j = 0; j < n; j++) {
        const x = s[j], d = 1e-6 * Math.max(1, Math.abs(x));
        s[j] = x + d; model.conditions(begin, s, p, g); s[j] = x - d; model.conditions(begin, s, p, h); s[j] = x;
        for (let a = 0; a < m; a++) J[a * n + j] = j === held ? 0 : (g[a] - h[a]) / (2 * d);
      }
      const A = [];
      let trace = 0;
      for (let a = 0; a < m; a++) for (let b = 0; b < m; b++) { let x = 0; for (let j = 0; j < n; j++) x += J[a * n + j] * J[b * n + j]; A[a * m + b] = x; if (a === b) trace += x; }
      for (let a = 0; a < m; a++) A[a * m + a] += 1e-13 * trace;
      nhsymLinear(m, A, f);
      for (let j = 0; j < n; j++) for (let a = 0; a < m; a++) s[j] -= J[a * n + j] * f[a];
    }
    if (!s.every(isFinite)) return false;
    model.state.forEach((k, j) => { now[k] = s[j]; });
    return true;
  }

  // ---- the table of quantities ----
  const close = (a, b) => Math.abs(a - b) <= 1e-12 * Math.max(Math.abs(a), Math.abs(b));
  const needs = (c, p) => Object.keys(c.needs || {}).filter(k => !close(p[k], c.needs[k](p)));
  const unchanged = () => names.every(k => now[k] === given[k]);
  function showTable() {
    const q = motion.quantities ? motion.quantities(t) : [];
    model.currents.forEach((c, j) => {
      const row = $(`[data-quantity="${j}"]`);
      if (!row) return;
      const lacks = c.proved ? needs(c, motion.p) : unchanged() ? [] : [''], gone = lacks.length > 0, value = $('.val', row), drift = $('.dr', row), sure = $('.sure', row), bar = $('.meter i', row);
      if (sure && sure.dataset.is === undefined) sure.dataset.is = sure.textContent;
      row.classList.toggle('off', gone);
      if (sure) sure.textContent = !gone ? sure.dataset.is : c.proved ? 'not for these values' : 'not tried for these values';
      const needed = $('.needs', row);
      if (needed) needed.textContent = gone && c.proved ? 'needs ' + lacks.map(k => `${k} = ${number(c.needs[k](motion.p), 5)}`).join(', ') : '';
      if (c.without && live) return;
      const scale = motion.scale ? motion.scale[j] : Math.abs(q[j]);
      value.textContent = Math.abs(q[j]) < 1e-7 * scale ? '0' : number(q[j], 7);
      if (!motion.most) return;
      const relative = motion.most[j] / (scale || 1), fine = isFinite(relative);
      drift.textContent = !fine ? 'not defined here' : relative < 3e-16 ? 'drift 0' : 'drift ' + relative.toExponential(1).replace('-', '\u2212');
      if (bar) bar.style.width = fine ? Math.max(0, Math.min(100, 100 * (Math.log10(relative + 1e-17) + 16) / 16)) + '%' : 0;
    });
  }

  // ---- plots ----
  const step = (range, count) => { const r = range / count, e = Math.pow(10, Math.floor(Math.log10(r))), f = r / e; return e * (f < 1.5 ? 1 : f < 3.5 ? 2 : f < 7.5 ? 5 : 10); };
  let grid = [], rows = [];
  function sample() {
    const N = 360, a = Math.max(zoom[0], Math.min(begin, motion.end)), b = Math.min(zoom[1], Math.max(begin, motion.end));
    grid = []; rows = [];
    for (let i = 0; i <= N; i++) { const time = a + (b - a) * i / N; grid.push(time); rows.push(Float64Array.from(motion.at(time))); }
  }
  const valuesAt = time => motion.at(Math.min(motion.end, Math.max(begin, time)));
  const plots = $$('figure.plot').map((figure, number_) => {
    const isDrift = figure.hasAttribute('data-drift');
    if (isDrift && !live) { if (!$('svg', figure)) figure.remove(); return null; }
    $$('svg', figure).forEach(e => e.remove());
    const svg = make('svg', {role: 'img', 'aria-label': figure.dataset.title, class: 'live'});
    figure.prepend(svg);
    const cap = $('figcaption', figure), curves = $$('.lg', cap).map((e, j) => ({track: +e.dataset.track, colour: `var(--c${1 + j % 6})`, dash: j > 5 ? '5 3' : 'none', on: true, from: e}));
    figure.prepend(cap);
    for (const c of curves) {
      const b = document.createElement('button');
      b.type = 'button'; b.className = 'lg'; b.title = 'show or hide this curve';
      b.style.setProperty('--k', c.colour); b.setAttribute('aria-pressed', true);
      b.append(document.createElement('i'), ...c.from.childNodes, c.out = document.createElement('output'));
      c.from.replaceWith(b);
      b.onclick = () => { c.on = !c.on; b.setAttribute('aria-pressed', c.on); draw(); cursor(); };
    }
    const ticks = make('g', {}, svg), clip = make('clipPath', {id: 'clip' + number_}, svg), box = make('rect', {}, clip), lines = make('g', {'clip-path': `url(#clip${number_})`, fill: 'none', 'stroke-width': 1.8, 'stroke-linejoin': 'round'}, svg);
    const band = make('rect', {class: 'band', visibility: 'hidden'}, svg), line = make('line', {class: 'now'}, svg), other = make('line', {class: 'hover', visibility: 'hidden'}, svg), dots = make('g', {}, svg);
    let W = 360, H = 190, low = 0, high = 1;
    const L = 48, R = 8, T = 6, B = 20, X = time => L + (W - L - R) * (time - zoom[0]) / (zoom[1] - zoom[0]), Y = v => T + (H - T - B) * (1 - (v - low) / (high - low));
    const logOf = (row, c) => Math.max(-17, Math.log10(row[c.track + 1] / (motion.scale[c.track] || 1) + 1e-17));
    function draw() {
      const size = svg.getBoundingClientRect();
      W = size.width || 360; H = size.height || 190;
      svg.setAttribute('viewBox', `0 0 ${W} ${H}`);
      const data = curves.map(c => !c.on ? null : isDrift ? motion.drift.map(r => [r[0], logOf(r, c)]) : rows.map((r, l) => [grid[l], r[c.track]]));
      low = Infinity; high = -Infinity;
      for (const d of data) if (d) for (const e of d) if (isFinite(e[1])) { if (e[1] < low) low = e[1]; if (e[1] > high) high = e[1]; }
      if (!(low <= high)) { low = 0; high = 1; }
      if (isDrift) { low = -17; high = Math.max(-8, high) + .5; }
      const mid = (low + high) / 2, flat = high - low < 1e-6 * Math.abs(mid), half = isDrift ? (high - low) / 2 : flat ? Math.abs(mid) * 0.02 : Math.max((high - low) / 2 * 1.07, 1e-9);
      low = mid - half; high = mid + half;
      ticks.textContent = lines.textContent = '';
      const up = isDrift ? Math.max(2, Math.ceil((high - low) / 5)) : step(high - low, 4), along = step(zoom[1] - zoom[0], Math.max(3, W / 80));
      for (let v = Math.ceil(low / up) * up; v <= high + 1e-12; v += up) {
        make('path', {class: 'tick', d: `M${L} ${Y(v)}H${W - R}`}, ticks);
        const e = make('text', {x: L - 6, y: Y(v) + 3.5, 'text-anchor': 'end'}, ticks);
        e.textContent = isDrift ? '10' : minus(String(+v.toPrecision(5)));
        if (isDrift) make('tspan', {dy: -4, 'font-size': 8}, e).textContent = minus(String(Math.round(v)));
      }
      for (let v = Math.ceil(zoom[0] / along) * along; v <= zoom[1] + 1e-9; v += along) {
        make('path', {class: 'tick', d: `M${X(v)} ${T}V${H - B}`}, ticks);
        make('text', {x: X(v), y: H - 5, 'text-anchor': 'middle'}, ticks).textContent = minus(String(+v.toPrecision(6)));
      }
      make('text', {x: W - R, y: H - B - 5, 'text-anchor': 'end', class: 'axis'}, ticks).textContent = 't';
      box.setAttribute('x', L); box.setAttribute('y', T - 2); box.setAttribute('width', Math.max(1, W - L - R)); box.setAttribute('height', H - T - B + 4);
      data.forEach((d, j) => {
        if (!d) return;
        let s = '', pen = false;
        for (const a of d) { if (!isFinite(a[1])) { pen = false; continue; } s += (pen ? 'L' : 'M') + X(a[0]).toFixed(1) + ' ' + Y(a[1]).toFixed(1); pen = true; }
        make('path', {d: s, stroke: curves[j].colour, 'stroke-dasharray': curves[j].dash}, lines);
      });
    }
    function cursor() {
      const at = hover === null ? t : hover, v = valuesAt(at);
      for (const [l, time, shown] of [[line, t, true], [other, hover, hover !== null]]) {
        const inside = shown && time >= zoom[0] && time <= zoom[1];
        l.setAttribute('visibility', inside ? 'visible' : 'hidden');
        if (inside) { l.setAttribute('x1', X(time)); l.setAttribute('x2', X(time)); l.setAttribute('y1', T); l.setAttribute('y2', H - B); }
      }
      dots.textContent = '';
      for (const c of curves) {
        let y = v[c.track];
        if (isDrift) { let row = motion.drift[0]; for (const r of motion.drift) if (r[0] <= at) row = r; const x = row ? row[c.track + 1] / (motion.scale[c.track] || 1) : NaN; c.out.textContent = x ? x.toExponential(1).replace('-', '\u2212') : '0'; y = row ? logOf(row, c) : NaN; }
        else c.out.textContent = number(y, 4);
        if (c.on && isFinite(y) && at >= zoom[0] && at <= zoom[1]) make('circle', {cx: X(at), cy: Y(y), r: 3.2, fill: c.colour, class: 'dot'}, dots);
      }
    }
    // hover shows values, a click goes there, a drag zooms
    let down = null;
    const where = e => { const b = svg.getBoundingClientRect(), x = (e.clientX - b.left) * W / b.width; return zoom[0] + (zoom[1] - zoom[0]) * (Math.min(W - R, Math.max(L, x)) - L) / (W - L - R); };
    svg.addEventListener('pointerdown', e => { if (e.button) return; down = {time: where(e), x: e.clientX, touch: e.pointerType === 'touch'}; svg.setPointerCapture(e.pointerId); if (down.touch) seek(down.time); });
    svg.addEventListener('pointermove', e => {
      const time = where(e);
      if (down && down.touch) { seek(time); return; }
      hover = time;
      if (down && Math.abs(e.clientX - down.x) > 5) { const a = X(Math.min(down.time, time)), b = X(Math.max(down.time, time)); band.setAttribute('x', a); band.setAttribute('width', b - a); band.setAttribute('y', T); band.setAttribute('height', H - T - B); band.setAttribute('visibility', 'visible'); }
      cursors();
    });
    svg.addEventListener('pointerup', e => {
      if (!down) return;
      const time = where(e), moved = Math.abs(e.clientX - down.x) > 5;
      band.setAttribute('visibility', 'hidden');
      if (!down.touch) { if (moved) zoomTo([Math.min(down.time, time), Math.max(down.time, time)]); else { play(false); seek(time); } }
      down = null;
    });
    svg.addEventListener('pointerleave', () => { hover = null; cursors(); });
    svg.addEventListener('dblclick', () => zoomTo([begin, end]));
    return {draw, cursor};
  }).filter(Boolean);
  function zoomTo(z) { if (z[1] - z[0] < 1e-6 * (end - begin)) return; zoom = z; $('#unzoom').hidden = zoom[0] === begin && zoom[1] === end; sample(); draw(); cursors(); }
  const draw = () => plots.forEach(p => p.draw());
  function cursors() {
    plots.forEach(p => p.cursor());
    if (scene) scene.frame(t, Float64Array.from(valuesAt(t)), hover === null ? null : Float64Array.from(valuesAt(hover)));
  }
  $('#unzoom').onclick = () => zoomTo([begin, end]);

  // ---- time ----
  const bar = $('#time'), clock = $('#clock'), player = $('#play');
  bar.min = 0; bar.max = 1000; bar.step = 1;
  function show() { bar.value = 1000 * (t - begin) / (end - begin); clock.textContent = 't = ' + minus(t.toFixed(2)); bar.setAttribute('aria-valuetext', clock.textContent); cursors(); showTable(); }
  function seek(time) { t = time; show(); }
  bar.oninput = () => { play(false); seek(begin + (end - begin) * bar.value / 1000); };
  let before = 0;
  const pace = (end - begin) / Math.min(20, Math.max(8, Math.abs(end - begin))); // seconds of a whole motion: 8 to 20
  function play(on) {
    playing = on; player.classList.toggle('on', on); player.setAttribute('aria-label', on ? 'pause' : 'play');
    if (on) { before = 0; requestAnimationFrame(tick); }
  }
  function tick(ms) {
    if (!playing) return;
    if (before) { t += (ms - before) / 1000 * speed * pace; if ((t - motion.end) * pace > 0) t = begin; show(); }
    before = ms;
    requestAnimationFrame(tick);
  }
  player.onclick = () => play(!playing);
  $('#speed').onchange = e => { speed = +e.target.value; };

  // ---- parameters and initial state ----
  const sliders = $$('.sl').map(row => ({row, name: row.dataset.name, range: $('input[type=range]', row), field: $('input[type=number]', row)}));
  let wait = 0;
  for (const s of sliders) {
    const snaps = [start[s.name], ...(s.row.dataset.snap || '').split(' ').filter(Boolean).map(Number)], wide = s.range.max - s.range.min;
    s.range.oninput = () => { let v = +s.range.value; for (const n of snaps) if (Math.abs(v - n) < wide * .015) v = n; set(s.name, v); };
    s.field.onchange = () => { const v = +s.field.value; if (isFinite(v) && s.field.value !== '') set(s.name, v); else controls(); };
    s.row.querySelector('label').ondblclick = () => set(s.name, start[s.name]);
  }
  function set(name, value) {
    const old = {...now};
    now[name] = value;
    if (!settle(name)) { Object.assign(now, old); tell(`No state satisfies the constraints with ${name} = ${number(value, 4)}.`); controls(); return; }
    if (!wait) wait = requestAnimationFrame(() => { wait = 0; change(); });
  }
  const tell = text => { $('#told').textContent = text; };
  function command() {
    const differs = names.filter(k => now[k] !== given[k]).map(k => ` --set ${k}=${+(+now[k]).toPrecision(8)}`).join('');
    const state = live ? ` --initial "${(begin ? `t=${begin}, ` : '') + model.state.map(k => k + '=' + +(+now[k]).toPrecision(8)).join(', ')}"` : '';
    return `${model.command}${differs}${state} --until ${end} --tolerance ${tol}`;
  }
  function controls() {
    for (const s of sliders) { s.range.value = now[s.name]; s.field.value = +(+now[s.name]).toPrecision(5); s.row.classList.toggle('changed', now[s.name] !== start[s.name]); }
    const changed = Object.keys(start).filter(k => now[k] !== start[k]);
    if ($('#reset')) $('#reset').hidden = !changed.length;
    if ($('#command')) $('#command').textContent = command();
    try { history.replaceState(null, '', changed.length ? '#' + changed.map(k => `${k}=${now[k]}`).join('&') : location.pathname + location.search); } catch (e) { /* a page in a sandbox */ }
  }
  function change() {
    const before_ = performance.now();
    motion = live ? recomputed() : table();
    if ((t - motion.end) * pace > 0) t = begin;
    sample(); controls();
    if (scene) scene.motion(motion);
    draw(); show();
    if (live) tell(motion.complete ? `${motion.evaluations} evaluations` : `This motion is computed until t = ${number(motion.end, 4)}: there the equations become singular, or the steps too short.`);
    root.dataset.milliseconds = (performance.now() - before_).toFixed(1);
  }
  if ($('#reset')) $('#reset').onclick = () => { Object.assign(now, start); change(); };
  for (const x of $('#tol') ? ['1e-4', '1e-6', '1e-9', '1e-11'] : []) $('#tol').add(new Option(x, x, false, +x === tol));
  if ($('#tol')) $('#tol').onchange = e => { tol = +e.target.value; change(); };

  // ---- to take away ----
  function download(text, type, name) {
    const a = document.createElement('a');
    a.href = URL.createObjectURL(new Blob([text], {type})); a.download = name; a.click();
    URL.revokeObjectURL(a.href);
  }
  // the picture as it is turned and zoomed, in frames that show one after another; colours are those of the page
  function movie() {
    const colours = getComputedStyle(root), names_ = ['bg', 'fg', 'soft', 'faint', 'stage', 'grid', 'c1', 'c2', 'c3', 'c4', 'c5', 'c6'], frames = 80, seconds = Math.min(20, Math.max(4, Math.abs(motion.end - begin)));
    const svg = $('svg.scene'), seen = [];
    for (let i = 0; i < frames; i++) { const time = begin + (motion.end - begin) * i / (frames - 1); scene.frame(time, Float64Array.from(motion.at(time)), null); seen.push(scene.parts()); }
    cursors();
    const turn = (inner, i) => `<g visibility="hidden"><animate attributeName="visibility" values="visible;hidden" keyTimes="0;${1 / frames}" calcMode="discrete" begin="${(i * seconds / frames).toFixed(3)}s" dur="${seconds}s" repeatCount="indefinite"/>${inner}</g>`;
    return `<${'svg'} xmlns="http://www.w3.org/2000/svg" viewBox="${svg.getAttribute('viewBox')}"><title>${model.title.replace(/[<&]/g, ' ')}</title><style>svg{${names_.map(k => `--${k}:${colours.getPropertyValue('--' + k).trim()}`).join(';')}}.tick{fill:none;stroke:var(--grid)}text{font:11px sans-serif;fill:var(--faint)}</style>` +
      `<rect width="100%" height="100%" fill="var(--stage)"/>${seen[0].still}${seen.map((s, i) => turn(s.moving, i)).join('')}</${'svg'}>`; // not as a figure of the page's text
  }
  if ($('#movie')) $('#movie').onclick = () => { play(false); download(movie(), 'image/svg+xml', model.name + '.svg'); };
  $('#csv').onclick = () => {
    const columns = model.tracks.map((k, i) => [k, i]).filter(([k]) => k.kind !== 'shape'), lines = [['t', ...columns.map(([k]) => k.name), ...(live ? model.currents.map(c => c.name) : [])].join(',')];
    for (let i = 0; i <= 500; i++) { const time = begin + (motion.end - begin) * i / 500, v = motion.at(time); lines.push([time, ...columns.map(([, j]) => v[j]), ...(live && nq ? motion.quantities(time) : [])].join(',')); }
    download(lines.join('\n') + '\n', 'text/csv', model.name + '.csv');
  };
  const said = (b, text) => { const old = b.textContent; b.textContent = text; setTimeout(() => { b.textContent = old; }, 1200); };
  for (const b of $$('[data-copy]')) b.onclick = () => { const text = b.dataset.copy[0] === '#' ? $(b.dataset.copy).textContent : b.dataset.copy; (navigator.clipboard ? navigator.clipboard.writeText(text) : Promise.reject()).then(() => said(b, 'copied'), () => prompt('copy:', text)); };
  if (matchMedia('(max-width: 700px)').matches && $('.ctl')) $('.ctl').open = false;
  const stage = $('#stage');
  $$('.still', document).forEach(e => e.remove());
  const scene = stage && model.shapes.length ? nhsymScene(stage, model, {make, $, $$}) : null;
  let paused = false;
  for (const [k, v] of new URLSearchParams(location.hash.slice(1))) { if (k in now && isFinite(+v)) now[k] = +v; if (k === 't' && isFinite(+v)) { t = +v; paused = true; } }
  change();
  new ResizeObserver(() => { draw(); if (scene) scene.motion(motion); cursors(); }).observe(document.body);
  addEventListener('beforeprint', () => { play(false); draw(); cursors(); });
  play(!paused && !matchMedia('(prefers-reduced-motion: reduce)').matches);
  return {set, seek, zoomTo, play, movie, now, get motion() { return motion; }, get time() { return t; }};
}

// What every page has: colours, contents, parts that scroll, folds that are open on paper.
function nhsymFrame() {
  const $$ = s => [...document.querySelectorAll(s)], root = document.documentElement;
  root.classList.add('js');
  const theme = document.querySelector('#theme');
  if (theme) theme.onclick = () => { const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches; root.dataset.theme = dark ? 'light' : 'dark'; };
  const printer = document.querySelector('#print');
  if (printer) printer.onclick = () => print();
  const links = $$('.toc a'), heads = links.map(a => document.querySelector(a.getAttribute('href')));
  const mark = () => { let at = 0; heads.forEach((h, i) => { if (h && h.getBoundingClientRect().top < 140) at = i; }); links.forEach((a, i) => { if (i === at) a.setAttribute('aria-current', 'true'); else a.removeAttribute('aria-current'); }); };
  addEventListener('scroll', mark, {passive: true});
  mark();
  const reach = () => $$('.formula,pre,.f').forEach(e => { if (e.scrollWidth > e.clientWidth) e.tabIndex = 0; });
  addEventListener('resize', reach);
  document.addEventListener('toggle', reach, true);
  reach();
  addEventListener('beforeprint', () => $$('article details:not(.screen)').forEach(d => { d.dataset.was = d.open ? 1 : ''; d.open = true; }));
  addEventListener('afterprint', () => $$('article details').forEach(d => { if (d.dataset.was !== undefined) d.open = !!d.dataset.was; }));
}
nhsymFrame();
var nhsymLive = typeof nhsymModel === 'object' && document.querySelector('#stage') ? nhsymPage(nhsymModel) : null;
