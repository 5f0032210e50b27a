// Opens pages one after another in a frame and measures each from without; needs --allow-file-access-from-files.  The next frame is made while the last one's
// load is told of, so that this page itself is not loaded before all are.
(function () {
  'use strict';
  var seen = [];
  function measure(name, frame, began) {
    var d = frame.contentDocument, w = frame.contentWindow, now = { name: name, ready: 0, formulas: 0, empty: [], fetched: 0, width: 0, room: 0, nodes: 0 };
    now.width = d.documentElement.scrollWidth; // lays the page out
    now.room = d.documentElement.clientWidth;
    now.ready = performance.now() - began;
    now.fetched = w.performance.getEntriesByType('resource').length;
    now.nodes = d.getElementsByTagName('*').length;
    Array.prototype.forEach.call(d.querySelectorAll('details'), function (e) { e.open = true; });
    Array.prototype.forEach.call(d.querySelectorAll('math'), function (m) {
      var box = m.getBoundingClientRect();
      now.formulas++;
      if (!(box.width > 0) || !(box.height > 0)) now.empty.push(m.textContent.slice(0, 60));
    });
    now.wide = d.documentElement.scrollWidth;
    seen.push(now);
  }
  function next(i) {
    if (i === PAGES.length) {
      var out = document.createElement('pre');
      out.id = 'seen';
      out.textContent = JSON.stringify(seen);
      document.body.appendChild(out);
      return;
    }
    var frame = document.createElement('iframe'), began = performance.now();
    frame.style.cssText = 'width:390px;height:800px;border:0';
    frame.onload = function () { measure(PAGES[i], frame, began); next(i + 1); frame.remove(); };
    frame.src = PAGES[i];
    document.body.appendChild(frame);
  }
  next(0);
})();
