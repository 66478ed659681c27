// The pictures of the page: hierarchies, the view in space, trees, charts.
const svg = (tag, attributes) => {
  const e = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  return e;
};
const numbers = text => text ? text.split(' ').map(Number) : [];
const points = text => {
  const n = numbers(text);
  return Array.from({length: n.length / 3}, (_, i) => n.slice(3 * i, 3 * i + 3));
};
const short = x => x === 0 ? '0' : Math.abs(x) >= 1e-3 && Math.abs(x) < 1e4 ? String(+x.toPrecision(3)) : x.toExponential(2);
const plus = (a, b) => a.map((x, i) => x + b[i]), minus = (a, b) => a.map((x, i) => x - b[i]), times = (a, s) => a.map(x => x * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const centre = polygon => times(polygon.reduce(plus), 1 / polygon.length);

// A hierarchy for the pictures: contours, children, depths, and the leaves at every step.
function hierarchy(nodes, born) {
  const tree = nodes.map(n => ({...n, points: points(n.contour), children: [], depth: 0}));
  tree.forEach((n, i) => {
    n.centre = centre(n.points);
    n.born = born ? born[i] : 0;
    if (n.parent >= 0) {
      tree[n.parent].children.push(i);
      n.depth = tree[n.parent].depth + 1;
    }
  });
  tree.leaves = known => tree.map((_, i) => i).filter(i => known(i) && !tree[i].children.some(known));
  return tree;
}
const main = hierarchy(data.nodes, numbers(data.born)), byLight = hierarchy(data.bfNodes);
for (const name of ['emission', 'reflectance', 'radiosity', 'levels']) data[name] = numbers(data[name]);
for (const step of data.iterations) for (const name of ['sent', 'gathered', 'arrived', 'mean']) step[name] = numbers(step[name]);
for (const b of data.bf) b.radiosity = numbers(b.radiosity);
for (const l of data.links) { l.rays = points(l.rays); l.arrives = numbers(l.arrives); }
for (const l of data.leaves) { l.corners = points(l.corners); l.levels = numbers(l.levels); l.t = numbers(l.t); }
for (const m of data.mesh) { m.corners = points(m.corners); m.simple = numbers(m.simple); m.weighted = numbers(m.weighted); }
for (const s of data.solvers) {
  s.solution = numbers(s.solution);
  for (const m of s.methods) { m.residual = numbers(m.residual); m.radiosity = m.radiosity.map(numbers); }
}
data.pairs.forEach(p => { p.children = []; });
data.pairs.forEach(p => { if (p.parent >= 0) data.pairs[p.parent].children.push(p); });

// Radiosity as a grey with a warm tint; lamps exceed the scale and are white. The square root approximates the response of the eye.
const reflected = data.radiosity.filter((_, i) => data.emission[i] === 0);
const most = Math.max(1e-30, ...(reflected.some(x => x > 0) ? reflected : data.radiosity));
const shade = b => {
  const t = Math.sqrt(Math.min(1, Math.max(0, b / most)));
  return b < 0 ? '#7a3fb0' : `rgb(${Math.round(28 + 227 * t)},${Math.round(28 + 217 * t)},${Math.round(34 + 186 * t)})`;
};

// --- the picture: polygons from back to front, lines above them
const eye = {turn: -0.6, lift: 0.45, zoom: 1, low: [-0.3, -0.3], high: [0.3, 0.3]};
const bounds = main.filter(n => n.parent < 0).flatMap(n => n.points);
const low = [0, 1, 2].map(c => Math.min(...bounds.map(p => p[c]))), high = [0, 1, 2].map(c => Math.max(...bounds.map(p => p[c])));
const middle = times(plus(low, high), 0.5), reach = Math.hypot(...minus(high, low)) / 2 || 1;
function camera(width, height) {
  const {turn, lift} = eye;
  const back = [Math.cos(lift) * Math.sin(turn), -Math.cos(lift) * Math.cos(turn), Math.sin(lift)];
  const right = [Math.cos(turn), Math.sin(turn), 0], up = cross(back, right), distance = 3.2 * reach, from = plus(middle, times(back, distance));
  const {low, high} = eye, scale = 0.9 * eye.zoom * Math.min(width / (high[0] - low[0]), height / (high[1] - low[1]));
  const across = p => {
    const d = minus(p, from), depth = Math.max(1e-9, -dot(d, back));
    return [dot(d, right) / depth, -dot(d, up) / depth, depth];
  };
  return {from, across, to: p => {
    const [x, y, depth] = across(p);
    return [width / 2 + scale * (x - (low[0] + high[0]) / 2), height / 2 + scale * (y - (low[1] + high[1]) / 2), depth];
  }};
}
// The initial view: the direction that shows most lit surface (backs are not visible), with the scene filling the picture.
function bestView() {
  let best = -1;
  for (const lift of [0.45, -0.45]) for (let turn = -0.6; turn < 5.6; turn += Math.PI / 4) {
    const back = [Math.cos(lift) * Math.sin(turn), -Math.cos(lift) * Math.cos(turn), Math.sin(lift)];
    let shown = turn < 0 && lift > 0 ? 0.05 * reach * reach : 0;
    main.forEach((n, i) => {
      if (n.parent >= 0) return;
      const normal = n.points.reduce((sum, p, k) => plus(sum, cross(minus(p, n.centre), minus(n.points[(k + 1) % n.points.length], n.centre))), [0, 0, 0]);
      shown += Math.max(0, dot(normal, back)) / 2 * (data.emission[i] > 0 ? 0.3 : data.radiosity[i] / most);
    });
    if (shown > best) { best = shown; Object.assign(eye, {turn, lift}); }
  }
  const seen = bounds.map(camera(1, 1).across);
  for (const [end, pick] of [['low', Math.min], ['high', Math.max]]) eye[end] = [0, 1].map(c => pick(...seen.map(p => p[c])));
}
bestView();
// faces: {points, fill, node, edge, wide}; lines: {from, to, colour, width}; marks: {at, text, colour}
function paint(canvas, {faces, lines = [], marks = []}) {
  const ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight, context = canvas.getContext('2d');
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  context.scale(ratio, ratio);
  context.lineJoin = 'round';
  const look = camera(width, height), drawn = [];
  for (const f of faces) {
    const at = f.points.map(look.to), c = centre(f.points);
    const normal = f.points.reduce((n, p, i) => plus(n, cross(minus(p, c), minus(f.points[(i + 1) % f.points.length], c))), [0, 0, 0]);
    const above = dot(normal, minus(look.from, c));  // height of the eye above the plane of the face
    drawn.push({...f, at, normal, above, depth: Math.hypot(...minus(c, look.from)), front: above > 0});
  }
  drawn.sort((a, b) => b.depth - a.depth || (a.wide ? 1 : 0) - (b.wide ? 1 : 0));
  const path = at => {
    context.beginPath();
    at.forEach((p, i) => i ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1]));
    context.closePath();
  };
  for (const f of drawn) {
    path(f.at);
    if (f.front) {
      context.fillStyle = f.fill;
      context.fill();
    }
    context.strokeStyle = (f.front || f.wide) && f.edge || (f.front ? 'rgba(60,90,140,.55)' : 'rgba(120,120,120,.25)');
    context.lineWidth = f.wide ? 2.5 : 0.8;
    if (f.edge !== 'none' && (f.front || f.wide || !f.edge)) context.stroke();
  }
  for (const l of lines) {
    const a = look.to(l.from), b = look.to(l.to);
    context.beginPath();
    context.moveTo(a[0], a[1]);
    context.lineTo(b[0], b[1]);
    context.strokeStyle = l.colour;
    context.lineWidth = l.width || 1;
    context.stroke();
  }
  context.font = '12px sans-serif';
  for (const m of marks) {
    const p = look.to(m.at);
    if (behind(drawn, look.from, m.at, p)) continue;
    context.fillStyle = m.colour;
    if (m.text) {  // with a light outline, for contrast with dark faces
      context.strokeStyle = 'rgba(255,255,255,.8)';
      context.lineWidth = 3;
      context.strokeText(m.text, p[0] - 3, p[1] + 4);
      context.fillText(m.text, p[0] - 3, p[1] + 4);
    } else {
      context.beginPath();
      context.arc(p[0], p[1], 4, 0, 7);
      context.fill();
    }
  }
  canvas.drawn = drawn;
}
function inside(at, x, y) {
  let within = false;
  for (let i = 0, j = at.length - 1; i < at.length; j = i++) {
    const [xi, yi] = at[i], [xj, yj] = at[j];
    if ((yi > y) !== (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi) within = !within;
  }
  return within;
}
// Does a face seen from its front hide the point? The tolerance of 1 % is for faces around the point itself, which need not be planar.
function behind(drawn, from, point, [x, y]) {
  const away = minus(from, point);
  return drawn.some(f => f.front && !f.wide && f.above < 0.99 * dot(f.normal, away) && inside(f.at, x, y));
}
function hit(canvas, x, y) {
  const face = [...canvas.drawn].reverse().find(f => f.front && f.node !== undefined && inside(f.at, x, y));
  return face ? face.node : -1;
}

// --- the trees: one box per node, children below their parent, as wide as their leaves
function drawTree(tree, known, fill, ring) {
  const width = new Array(tree.length).fill(0), left = new Array(tree.length).fill(0);
  for (let i = tree.length; i-- > 0;) {
    if (!known(i)) continue;
    width[i] = width[i] || 1;
    if (tree[i].parent >= 0) width[tree[i].parent] += width[i];
  }
  const row = 20, all = tree.map((n, i) => n.parent < 0 ? width[i] : 0).reduce((a, b) => a + b), unit = 1000 / all;
  let at = 0, depth = 0;
  const next = [];
  const picture = svg('svg', {});
  tree.forEach((n, i) => {
    if (!known(i)) return;
    if (n.parent < 0) { left[i] = at; at += width[i]; } else { left[i] = next[n.parent]; next[n.parent] += width[i]; }
    next[i] = left[i];
    depth = Math.max(depth, n.depth);
    const box = svg('rect', {x: (left[i] * unit + 0.5).toFixed(2), y: n.depth * row + 1, width: Math.max(0.6, width[i] * unit - 1).toFixed(2),
      height: row - 3, fill: fill(i), stroke: ring(i) || '#b9b9b0', 'stroke-width': ring(i) ? 2.5 : 0.5});
    box.append(svg('title', {}));
    box.firstChild.textContent = n.name;
    box.onclick = () => pick(i);
    picture.append(box);
    if (n.parent < 0 && width[i] * unit > 7 * n.name.length) {
      const label = svg('text', {x: left[i] * unit + 5, y: n.depth * row + 15, 'font-size': 12, 'pointer-events': 'none', fill: '#0b5bd3', stroke: 'white', 'stroke-width': 3, 'paint-order': 'stroke'});
      label.textContent = n.name;
      picture.append(label);
    }
  });
  picture.setAttribute('viewBox', `0 0 1000 ${(depth + 1) * row + 2}`);
  $('tree').replaceChildren(picture);
}

// A chart with logarithmic y; series: {name, colour, values}, one value per step.
const colours = ['#0b5bd3', '#c8310f', '#14702d', '#8a5a00', '#7a3fb0', '#0a8a8a'];
function chart(series, upTo, title) {
  const picture = svg('svg', {viewBox: '0 0 400 200', role: 'img'}), values = series.flatMap(s => s.values).filter(v => v > 0);
  const floor = Math.max(Math.min(...values), Math.max(...values) * 1e-10), top = Math.log10(Math.max(...values)), bottom = Math.log10(floor) - 0.05;
  const steps = Math.max(1, ...series.map(s => s.values.length - 1));
  const x = i => 46 + 340 * i / steps, y = v => 22 + 150 * (top - Math.log10(Math.max(v, floor))) / Math.max(1e-9, top - bottom);
  const say = (text, px, py, fill, anchor) => {
    const t = svg('text', {x: px, y: py, 'font-size': 11, fill, 'text-anchor': anchor || 'start'});
    t.textContent = text;
    picture.append(t);
  };
  say(title, 6, 12, '#555');
  const ticks = Math.max(1, Math.ceil((top - bottom) / 6));
  for (let e = Math.ceil(bottom); e <= top; e += ticks) {
    picture.append(svg('line', {x1: 46, x2: 386, y1: y(10 ** e), y2: y(10 ** e), stroke: '#e4e4de'}));
    say(e >= 0 && e < 5 ? String(10 ** e) : '1e' + e, 42, y(10 ** e) + 4, '#777', 'end');
  }
  if (Math.ceil(bottom) > top) say(short(10 ** top), 42, y(10 ** top) + 4, '#777', 'end');
  say('0', 46, 190, '#777', 'middle');
  say(String(steps), 386, 190, '#777', 'middle');
  series.forEach((s, k) => {
    const shown = s.values.slice(0, upTo + 1);
    picture.append(svg('polyline', {points: shown.map((v, i) => x(i).toFixed(1) + ',' + y(v).toFixed(1)).join(' '), fill: 'none',
      stroke: s.colour || colours[k], 'stroke-width': 2}));
    if (shown.length) picture.append(svg('circle', {cx: x(shown.length - 1), cy: y(shown.at(-1)), r: 3, fill: s.colour || colours[k]}));
  });
  const legend = element('div');
  series.forEach((s, k) => {
    const item = element('span', '\u25a0 ' + s.name + '  ');
    item.style.cssText = 'font-size:12px;margin-right:10px;color:' + (s.colour || colours[k]);
    legend.append(item);
  });
  const box = element('div');
  box.append(picture, legend);
  return box;
}
