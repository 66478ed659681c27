// SPDX-License-Identifier: MIT
#pragma once

// The fixed parts of the stepper's page: style, elements, and the script that steps. html.cpp puts the data between them.

namespace apps::euler {

inline constexpr const char* page_style = R"~(
*{box-sizing:border-box}
html,body{height:100%;margin:0}
body{display:grid;grid-template:auto minmax(0,1fr) auto / minmax(210px,270px) minmax(320px,1fr) minmax(330px,400px);
 font:15px/1.45 'Segoe UI','DejaVu Sans',Verdana,sans-serif;color:#222;background:#fbfbf9}
header{grid-column:1/4;padding:10px 20px 6px;border-bottom:1px solid #dcdcd6;display:flex;gap:18px;align-items:baseline}
h1{font-size:20px;margin:0}
header span{color:#777;font-size:13px}
code,.mono,td,th,#script li{font-family:'DejaVu Sans Mono',Consolas,Menlo,monospace}
#script{overflow:auto;margin:0;padding:8px 0;border-right:1px solid #dcdcd6;list-style:none;font-size:12px}
#script li{padding:3px 12px 3px 38px;position:relative;cursor:pointer;white-space:pre-wrap}
#script li::before{content:attr(data-n);position:absolute;left:0;width:30px;text-align:right;color:#aaa}
#script li:hover{background:#eeeee8}
#script li.now{background:#222;color:#fff}
#script li.bad{color:#a8200a}#script li.bad.now{color:#ffb3a5}
main{display:flex;flex-direction:column;min-width:0;min-height:0;padding:10px 16px 0}
#head{display:flex;gap:14px;align-items:baseline;flex-wrap:wrap;min-height:28px}
#operator{font-size:17px;font-weight:bold}
#picture{flex:1;min-height:0;display:flex;justify-content:center;padding:6px 0}
#picture svg{width:100%;height:100%}
#numbers{display:flex;gap:26px;justify-content:center;font-size:16px;padding:2px 0 8px;flex-wrap:wrap}
#numbers b{color:#888;font-weight:normal}
#numbers .moved{background:#ffe3a8;border-radius:3px;padding:0 2px}
aside{overflow:auto;border-left:1px solid #dcdcd6;padding:12px 16px;min-height:0}
#caption{min-height:5em}
#caption p{margin:0 0 .7em}
.note{border-left:4px solid #c8310f;background:#fdf0ec;padding:6px 10px;margin:0 0 8px;color:#8c1c06;font-size:14px}
.note.fine{border-color:#cf8a00;background:#fff7e4;color:#6d4a00}
.note.good{border-color:#14702d;background:#eef8f0;color:#14572a}
table{border-collapse:collapse;font-size:12.5px;margin:8px 0 14px}
th{font-weight:normal;color:#888;text-align:right;padding:1px 8px;position:sticky;top:-12px;background:#fbfbf9}
td{text-align:right;padding:1px 8px;border-top:1px solid #ecece6}
td:first-child{color:#555;font-weight:bold}
td.moved{background:#ffe3a8}tr.fresh td{background:#fde4de}
tr.lit td{outline:1px solid #0b5bd3;outline-offset:-1px}
#anchors{display:flex;gap:24px;align-items:flex-start}
footer{grid-column:1/4;border-top:1px solid #dcdcd6;padding:8px 20px;display:flex;gap:8px;align-items:center}
button{font:inherit;padding:4px 12px;border:1px solid #bbb;border-radius:6px;background:#fff;cursor:pointer;min-width:44px}
button:hover{background:#f0f0ea}button:disabled{opacity:.4;cursor:default}
input[type=range]{flex:1}
footer span{color:#777;font-size:13px;min-width:7em;text-align:right}
@media(max-width:1000px){body{display:block;overflow:auto}#script{max-height:9em;border:0}#picture svg{height:90vw}footer{position:sticky;bottom:0;background:#fbfbf9}}
@media print{footer,#script{display:none}}
)~";

inline constexpr const char* page_body = R"~(
<header><h1 id="title"></h1><span>next: &rarr; &nbsp; undo: &larr; &nbsp; play: space</span></header>
<ol id="script"></ol>
<main><div id="head"><span id="operator" class="mono"></span></div><div id="picture"></div><div id="numbers" class="mono"></div></main>
<aside><div id="caption"></div><div id="notes"></div><div id="tables"></div></aside>
<footer><button id="first" title="the start (Home)">|&#9664;</button><button id="back" title="undo this step (left arrow)">&#9664; undo</button>
<button id="forth" title="the next step (right arrow)">next &#9654;</button><button id="last" title="the end (End)">&#9654;|</button>
<button id="play" title="play (space)">play</button><input id="slide" type="range" min="0" value="0" aria-label="step"><span id="where"></span></footer>
)~";

inline constexpr const char* page_script = R"~(
const $ = id => document.getElementById(id);
const frames = story.frames;
let now = -1, timer = null, moving = 0;

const element = (tag, text, kind) => {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (kind) e.className = kind;
  return e;
};
// "0 2 1 0 0;1 ..." -> Map of name -> fields
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
  for (const c of [title, ...columns]) head.append(element('th', c));
  t.append(head);
  for (const [name, fields] of here) {
    const old = before && before.get(name), row = element('tr');
    if (before && !old) row.className = 'fresh';
    if (lit.includes(name)) row.classList.add('lit');
    row.append(element('td', name));
    fields.forEach((x, i) => row.append(element('td', x, old && old[i] !== x ? 'moved' : '')));
    t.append(row);
  }
  return t;
}

// Moves everything that both pictures have from where it was; what is new fades in.
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
  const anchors = element('div');
  anchors.id = 'anchors';
  anchors.append(records('vertex', ['anchor'], f.v, before && before.v, f.lit), records('face', ['anchor'], f.f, before && before.f, f.lit));
  $('tables').replaceChildren();
  if (f.h.size) $('tables').append(records('half-edge', ['next', 'prev', 'vertex', 'face'], f.h, before && before.h, f.lit), anchors);
  [...$('script').children].forEach((e, k) => e.classList.toggle('now', k === i));
  $('script').children[i].scrollIntoView({block: 'nearest'});
  $('slide').value = i;
  $('where').textContent = 'step ' + i + ' of ' + (frames.length - 1);
  $('back').disabled = $('first').disabled = i === 0;
  $('forth').disabled = $('last').disabled = i === frames.length - 1;
  if (!(i === 0 && !location.hash)) history.replaceState(null, '', '#step=' + i);
}
function play(on) {
  clearInterval(timer);
  timer = null;
  if (on && now === frames.length - 1) show(0);
  if (on) timer = setInterval(() => now < frames.length - 1 ? show(now + 1) : play(false), 1600);
  $('play').textContent = on ? 'pause' : 'play';
}
const go = i => { play(false); show(i); };

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
$('back').onclick = () => go(now - 1);
$('forth').onclick = () => go(now + 1);
$('last').onclick = () => go(frames.length - 1);
$('play').onclick = () => play(!timer);
$('slide').oninput = () => go(+$('slide').value);
document.addEventListener('keydown', e => {
  if (e.ctrlKey || e.altKey || e.metaKey) return;
  const i = {ArrowRight: now + 1, ArrowLeft: now - 1, PageDown: now + 1, PageUp: now - 1, Home: 0, End: frames.length - 1}[e.key];
  if (i !== undefined) go(i);
  else if (e.key === ' ') play(!timer);
  else return;
  e.preventDefault();
});
const asked = () => { const m = /step=(\d+)/.exec(location.hash); return m ? +m[1] : 0; };
addEventListener('hashchange', () => go(asked()));
show(asked());
)~";

}  // namespace apps::euler
