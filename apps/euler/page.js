const story = data, frames = story.frames;
let now = -1, moving = 0;

// Parses "0 2 1 0 0;1 ..." to a Map from names to fields.
const table = (text, letters) => new Map(text.split(';').filter(Boolean).map(row => {
  const n = row.split(' ');
  return [letters[0] + n[0], n.slice(1).map((x, i) => letters[i + 1] + x)];
}));
for (const f of frames) {
  f.h = table(f.halfedges, 'hhhvf');
  f.v = table(f.vertices, 'vh');
  f.f = table(f.faces, 'fh');
}

function records(title, columns, here, before, lit) {
  const t = element('table'), head = element('tr');
  t.dataset.of = title;
  for (const c of [title, ...columns]) head.append(element('th', c));
  t.append(head);
  for (const [name, fields] of here) {
    const old = before && before.get(name), row = element('tr');
    if (before && !old) row.className = 'fresh';
    if (lit.includes(name)) row.classList.add('lit');
    row.dataset.of = name;
    row.append(element('td', name));
    fields.forEach((x, i) => row.append(element('td', x, old && old[i] !== x ? 'moved' : '')));
    t.append(row);
  }
  return t;
}

// Animates elements that both pictures have from their old positions; new ones fade in.
function move(from, to) {
  const token = ++moving, old = new Map(), jobs = [];
  for (const e of from.querySelectorAll('[data-k]')) old.set(e.dataset.k, e);
  const numbers = s => s.match(/-?[\d.]+/g).map(Number);
  for (const e of to.querySelectorAll('[data-k]')) {
    const attribute = e.hasAttribute('d') ? 'd' : 'transform', target = e.getAttribute(attribute);
    const was = old.get(e.dataset.k), start = was && was.getAttribute(attribute);
    if (start && start.replace(/-?[\d.]+/g, '') === target.replace(/-?[\d.]+/g, '')) {
      jobs.push({e, attribute, target, parts: target.split(/-?[\d.]+/), a: numbers(start), b: numbers(target)});
    } else {
      jobs.push({e, fade: true});
    }
  }
  const begin = performance.now(), time = 420;
  const draw = clock => {
    if (token !== moving) return;
    const s = Math.min(1, (clock - begin) / time), t = s * s * (3 - 2 * s);
    for (const j of jobs) {
      if (j.fade) j.e.style.opacity = t;
      else if (s === 1) j.e.setAttribute(j.attribute, j.target);
      else j.e.setAttribute(j.attribute, j.parts.map((p, i) => p + (i < j.b.length ? (j.a[i] + t * (j.b[i] - j.a[i])).toFixed(1) : '')).join(''));
    }
    if (s < 1) requestAnimationFrame(draw);
  };
  draw(begin);
  requestAnimationFrame(draw);
}

// The walk of the element under the pointer: around a face, around a vertex, or, for a half-edge, around its face.
let held = null;
function walkOf(name) {
  const f = frames[now], edge = /^e(\d+)$/.exec(name);
  if (edge) name = 'h' + 2 * edge[1];
  const around = face => {
    const all = [], first = f.f.get(face)[0];
    for (let h = first; all.length <= f.h.size && f.h.has(h); h = f.h.get(h)[0]) { all.push(h); if (f.h.get(h)[0] === first) break; }
    return all;
  };
  if (f.f.has(name)) return {names: [name, ...around(name)], text: name + ': ' + around(name).map(h => h + ' from ' + f.h.get(h)[2]).join(', ')};
  if (f.v.has(name)) {
    const out = [...f.h].filter(([, fields]) => fields[2] === name).map(([h]) => h);
    return {names: [name, ...out], text: name + ': ' + out.map(h => h + ' in ' + f.h.get(h)[3]).join(', ')};
  }
  if (!f.h.has(name)) return null;
  const [next, prev, vertex, face] = f.h.get(name), twin = 'h' + (+name.slice(1) ^ 1);
  return {names: [name, ...around(face)], text: `${name}: from ${vertex}, in ${face}, next ${next}, prev ${prev}, twin ${twin}; ${face}: ${around(face).join(' ')}`};
}
function mark(name) {
  const walk = name && !frames[now].damaged ? walkOf(name) : null, names = new Set(walk ? walk.names : []);
  for (const e of document.querySelectorAll('#picture [data-k]')) {
    const plain = e.dataset.k.replace(/^n(?=h)/, '').replace(/^(h\d+)s\d+$/, '$1').replace(/^l(\d+)(c\d+)?$/, 'f$1');
    e.classList.toggle('walked', names.has(plain));
  }
  for (const e of document.querySelectorAll('#solid [data-of], #tables tr[data-of]')) e.classList.toggle('walked', e.dataset.of.split(' ').some(n => names.has(n)));
  $('walk').textContent = walk ? walk.text : '';
}
const pointed = e => {
  const of = e.target.closest && e.target.closest('[data-k],[data-of]');
  if (!of) return null;
  const name = of.dataset.k || of.dataset.of.split(' ')[0];
  return name.replace(/^n(?=h)/, '').replace(/^(h\d+)s\d+$/, '$1').replace(/^l(\d+)(c\d+)?$/, 'f$1').replace(/^s(\d+)$/, 'h$1').replace(/^tip(\d+)$/, 'h$1');
};

function show(i) {
  i = Math.max(0, Math.min(frames.length - 1, i));
  if (i === now) return;
  const f = frames[i], before = i > 0 ? frames[i - 1] : null, near = now >= 0 && Math.abs(i - now) === 1;
  const holder = element('div');
  holder.innerHTML = '<svg viewBox="-400 -400 800 800">' + f.picture + '</svg>';
  const svg = holder.firstChild, old = $('picture').firstChild;
  $('picture').replaceChildren(svg);
  moving++;
  if (near && old && f.panels === frames[now].panels) move(old, svg);
  now = i;

  held = null;
  $('solid').innerHTML = f.solid ? '<svg viewBox="-120 -110 240 220">' + f.solid + '</svg>' : '';
  $('operator').textContent = f.headline || 'the start: nothing';
  $('numbers').replaceChildren();
  const counts = element('span');
  f.counts.forEach((n, k) => {
    const part = element('span', n, before && before.counts[k] !== n ? 'moved' : '');
    counts.append(element('b', 'vefsh'[k] + ' '), part, '  ');
  });
  counts.style.whiteSpace = 'pre';
  $('numbers').append(counts, element('span', f.equation));
  $('notes').replaceChildren();
  if (f.sentence) $('notes').append(element('div', (f.refused ? 'Refused: ' : '') + f.sentence + (f.refused ? '. Nothing was changed.' : ''), 'note' + (f.expected ? ' fine' : '')));
  for (const text of f.faults) $('notes').append(element('div', text, 'note'));
  for (const c of f.checks) $('notes').append(element('div', (c.met ? '\u2713 ' : '\u2717 ') + c.text + (c.met ? '' : ': ' + c.sentence), 'note' + (c.met ? ' good' : '')));
  if (f.damaged) $('notes').append(element('div', 'The picture shows the records before the damage; the table shows them as they are.', 'note fine'));
  $('caption').replaceChildren();
  for (const p of (i === 0 ? story.introduction + '\n\n' + f.caption : f.caption).split(/\n\n+/)) if (p.trim()) $('caption').append(element('p', p));
  if (f.told) $('caption').append(element('p', f.told, 'told'));
  const anchors = element('div');
  anchors.id = 'anchors';
  anchors.append(records('vertex', ['anchor'], f.v, before && before.v, f.lit), records('face', ['anchor'], f.f, before && before.f, f.lit));
  $('tables').replaceChildren();
  if (f.h.size) $('tables').append(records('half-edge', ['next', 'prev', 'vertex', 'face'], f.h, before && before.h, f.lit), anchors);
  mark(null);
  const changed = $('tables').querySelector('.fresh, .moved');
  if (changed) {  // scrolls the changed row to the middle of the table
    const box = $('tables'), at = changed.getBoundingClientRect().top - box.getBoundingClientRect().top + box.scrollTop;
    box.scrollTop = at > box.clientHeight - 40 ? at - box.clientHeight / 2 : 0;
  }
  [...$('script').children].forEach((e, k) => e.classList.toggle('now', k === i));
  $('script').children[i].scrollIntoView({block: 'nearest'});
  $('slide').value = i;
  $('where').textContent = 'step ' + i + ' of ' + (frames.length - 1);
  $('back').disabled = $('first').disabled = i === 0;
  $('forth').disabled = $('last').disabled = i === frames.length - 1;
  if (!(i === 0 && !location.hash)) history.replaceState(null, '', '#step=' + i);
}
const {go} = stepper({count: () => frames.length, at: () => now, show, time: 1600, page: 1});

document.title = story.title;
$('title').textContent = story.title;
$('slide').max = frames.length - 1;
frames.forEach((f, i) => {
  const e = element('li', f.statement || 'the start', f.sentence && !f.expected ? 'bad' : '');
  e.dataset.n = i;
  e.onclick = () => go(i);
  $('script').append(e);
});
$('first').onclick = () => go(0);
$('last').onclick = () => go(frames.length - 1);
for (const id of ['picture', 'solid', 'tables']) {
  $(id).addEventListener('pointerover', e => { if (!held) mark(pointed(e)); });
  $(id).addEventListener('pointerleave', () => { if (!held) mark(null); });
  $(id).addEventListener('click', e => { const name = pointed(e); held = name && name !== held ? name : null; mark(held); });
}
const asked = () => { const m = /step=(\d+)/.exec(location.hash); return m ? +m[1] : 0; };
addEventListener('hashchange', () => go(asked()));
show(asked());
