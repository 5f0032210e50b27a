/* The search: an index of all sections, which index.js gives to nhsymIndex when it is first needed (a script also comes
 * from file://, where nothing else can be fetched).  A section is [page, anchor, heading, beginning, its words]. */
(function () {
  'use strict';
  const $ = id => document.getElementById(id), query = $('query'), results = $('results'), root = document.documentElement;
  let pages = [], sections = null, asked = false;
  root.classList.add('js');

  window.nhsymIndex = function (index) { [pages, sections] = index; show(); };
  function load() {
    if (asked) return;
    asked = true;
    const script = document.createElement('script');
    script.src = 'index.js';
    document.head.append(script);
  }

  /* Every word of the query begins a word of the section; words of its heading and of the page's title count more. */
  function score(section, words) {
    const title = pages[section[0]][1].toLowerCase(), heading = section[2].toLowerCase();
    let sum = 0;
    for (const word of words) {
      const at = (' ' + section[4]).indexOf(' ' + word);
      const best = heading.includes(word) ? 8 : title.includes(word) ? 4 : at < 0 ? 0 : (section[4] + ' ').startsWith(word + ' ', at) ? 2 : 1;
      if (!best) return 0;
      sum += best;
    }
    return sum + (section[1] ? 0 : 0.5);
  }

  function row(section) {
    const item = document.createElement('li'), link = document.createElement('a'), where = document.createElement('b'), text = document.createElement('span');
    const [page, title] = pages[section[0]];
    link.href = page + (section[1] ? '#' + section[1] : '');
    where.textContent = section[1] && section[2] !== title ? title + ' › ' + section[2] : section[2];
    text.textContent = section[3];
    link.append(where, text);
    item.append(link);
    return item;
  }

  function show() {
    const words = query.value.toLowerCase().match(/[^\s_(),;"]+/g) || [];
    results.hidden = !words.length;
    if (!words.length || !sections) return;
    const found = sections.map(s => [score(s, words), s]).filter(f => f[0] > 0).sort((a, b) => b[0] - a[0]).slice(0, 20);
    results.replaceChildren(...found.map(f => row(f[1])));
    if (!found.length) results.append(Object.assign(document.createElement('li'), {textContent: 'No section has all of these words.'}));
  }

  query.addEventListener('focus', load);
  query.addEventListener('input', () => { load(); show(); });
  query.form.addEventListener('submit', event => { event.preventDefault(); const first = results.querySelector('a'); if (first) location.href = first.href; });
  document.addEventListener('click', event => { if (!query.form.contains(event.target)) results.hidden = true; });
  document.addEventListener('keydown', event => {
    const links = [...results.querySelectorAll('a')], at = links.indexOf(document.activeElement), step = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (event.key === '/' && !/INPUT|TEXTAREA/.test(document.activeElement.tagName)) { event.preventDefault(); query.focus(); }
    if (event.key === 'Escape') results.hidden = true;
    if (step && !results.hidden && links.length) { event.preventDefault(); (links[at + step] || query).focus(); }
  });

  if (matchMedia('(max-width:1100px)').matches) document.querySelectorAll('aside details').forEach(d => { d.open = false; });

  /* Colours stay as chosen, where the browser lets a page remember. */
  const chosen = (() => { try { return localStorage.getItem('nhsym-theme'); } catch (_) { return null; } })();
  if (chosen) root.dataset.theme = chosen;
  $('theme').onclick = () => {
    const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.theme = dark ? 'light' : 'dark';
    try { localStorage.setItem('nhsym-theme', root.dataset.theme); } catch (_) { /* not remembered */ }
  };
  const given = new URLSearchParams(location.search).get('q'), theme = new URLSearchParams(location.search).get('theme');
  if (theme) root.dataset.theme = theme;
  if (given) { query.value = given; load(); }
})();
