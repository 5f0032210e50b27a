// Runs at the end of a page, after axe-core: measures it, and leaves what it saw as JSON in an element of its own.
(function () {
  'use strict';
  function visible(e) { for (var d = e.closest('details'); d; d = d.parentElement.closest('details')) if (!d.open) return false; return true; }
  function all(selector) { return Array.prototype.slice.call(document.querySelectorAll(selector)); }
  var seen = { resources: performance.getEntriesByType('resource').length, formulas: 0, empty: [], width: document.documentElement.scrollWidth, room: document.documentElement.clientWidth };
  all('details').forEach(function (d) { d.open = true; });
  all('math').filter(visible).forEach(function (m) {
    var box = m.getBoundingClientRect();
    seen.formulas++;
    if (!(box.width > 0) || !(box.height > 0)) seen.empty.push(m.textContent.slice(0, 60));
  });
  // a product that is broken between two lines shows a dot: a hyphen would be read as a minus
  seen.hyphens = all('math').filter(function (m) { return m.nextSibling && m.nextSibling.nodeValue === '\u00ad' && getComputedStyle(m.parentElement).hyphenateCharacter.indexOf('\u00b7') < 0; }).length;
  axe.run(document, { resultTypes: ['violations'] }).then(function (r) {
    seen.faults = r.violations.map(function (v) { return { id: v.id, impact: v.impact, where: v.nodes.slice(0, 3).map(function (n) { return n.target.join(' '); }).join('; '), nodes: v.nodes.length }; });
    seen.rules = r.passes.length;
  }, function (e) { seen.faults = [{ id: String(e), impact: 'critical', where: '', nodes: 0 }]; }).then(function () {
    var out = document.createElement('pre');
    out.id = 'seen';
    out.textContent = JSON.stringify(seen);
    document.body.appendChild(out);
  });
})();
