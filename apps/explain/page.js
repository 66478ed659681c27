// The chapters of the page, and the content of each of their steps.
let picked = -1, threshold = data.epsilon, showLinks = false, at99 = 1, solver = '', now = 0, chapter = 0;
const blue = '#0b5bd3', orange = '#d9730d';
const facesOf = (tree, leaves, fill) => leaves.map(i => ({points: tree[i].points, node: i, fill: fill(i)}));
const outline = (tree, i, edge) => ({points: tree[i].points, fill: 'rgba(255,255,255,.15)', edge, wide: true});
const link = (tree, l, colour, width) => ({from: tree[l.p].centre, to: tree[l.q].centre, colour, width});
const everything = () => true;
const list = (items, chosen, open) => {
  const all = element('ol');
  items.forEach(([text, value]) => {
    const e = element('li', text, value === chosen ? 'now' : '');
    e.onclick = () => open(value);
    all.append(e);
  });
  return all;
};

// The result of refinement by form factor alone at another threshold, as far as the recorded pairs tell.
function atThreshold(t) {
  const links = [];
  let open = 0;
  const go = p => {
    if (p.is === 'drop' || p.is === 'convex' || p.is === 'hide') return;
    const byLamp = p.f === 'link' && p.is !== 'link';
    if (p.estimate <= t && !byLamp) links.push(p);
    else if (p.children.length) p.children.forEach(go);
    else if (p.is === 'link' && p.estimate <= data.epsilon) ++open;
    else if (p.is === 'link') links.push(p);
  };
  data.pairs.filter(p => p.parent < 0).forEach(go);
  return {links, open};
}
// From which pass on has over-shooting a smaller residual than shooting? It pays only if much light is reflected repeatedly.
function overshooting(methods) {
  const after = (m, k) => m.residual[Math.min(k, m.residual.length - 1)], shooting = methods.find(m => m.name.startsWith('Southwell'));
  const over = methods.filter(m => m.name.startsWith('over'));
  for (let k = 1; over.some(m => k < m.residual.length); ++k) {
    const best = over.find(m => after(m, k) < after(shooting, k));
    if (best) return `Here ${best.name} is ahead of shooting from pass ${k} on.`;
  }
  return 'Here over-shooting never pays: too little of the light is reflected again. A closed scene shows the contrary.';
}
const generations = Math.max(0, ...data.pairs.map(p => p.generation)) + 2;
const leavesAt = Array.from({length: generations}, (_, g) => main.leaves(i => main[i].born <= g).length);
const linksBy = [], matrixBy = [];
data.pairs.reduce((sum, p) => { linksBy.push(sum += p.is === 'link' ? 1 : 0); matrixBy.push(leavesAt[p.generation] ** 2); return sum; }, 0);

const chapters = [{
  name: 'Refine', steps: data.pairs.length, known: k => i => main[i].born <= data.pairs[k].generation, tree: main,
  fill: i => shade(data.emission[i] > 0 ? most : most / 4),
  ring: k => i => i === data.pairs[k].p ? blue : i === data.pairs[k].q ? orange : '',
  show(k) {
    const p = data.pairs[k], mine = atThreshold(threshold), small = Math.max(main[p.p].area, main[p.q].area);
    $('heading').textContent = `Question ${k + 1} of ${data.pairs.length}, generation ${p.generation}: may these two be linked?`;
    $('caption').textContent = `${main[p.p].name} (blue) and ${main[p.q].name} (orange): ${p.why}.`;
    const slider = element('input');
    Object.assign(slider, {type: 'range', min: -3, max: 0, step: 0.01, value: Math.log10(threshold)});
    slider.oninput = () => { threshold = 10 ** slider.value; redraw(); };
    const label = element('label', `your threshold: ${short(threshold)} (this run: ${short(data.epsilon)})`), box = element('input');
    box.type = 'checkbox';
    box.checked = showLinks;
    box.onchange = () => { showLinks = box.checked; redraw(); };
    const other = element('label', ' show all links at your threshold');
    other.prepend(box);
    keep('threshold', slider, label, other);
    label.append(slider);
    const verdict = ['drop', 'convex', 'hide'].includes(p.is) ? 'no light passes, whatever the threshold'
      : p.estimate <= threshold ? `F = ${short(p.estimate)}: you would link them here`
      : p.is === 'link' && p.estimate > data.epsilon ? `F = ${short(p.estimate)}: you would split, but ${short(small)} m2 is the least area`
      : `F = ${short(p.estimate)}: you would split the larger`;
    const note = element('div', `${verdict}. In all: ${mine.links.length} links` +
      (mine.open ? `, and ${mine.open} pairs that this run linked and you would split further.` : '.'), 'note');
    $('details').append(note, chart([{name: 'links so far', values: linksBy}, {name: 'n\u00b2, n leaves', values: matrixBy}], k, 'links against n\u00b2, by question'),
      element('div', 'The line between them is green where they are linked, else red; thin lines are the rays of the link.', 'small'));
    const l = data.links.find(x => (x.p === p.p && x.q === p.q) || (x.p === p.q && x.q === p.p));
    const lines = showLinks ? mine.links.map(x => link(main, x, 'rgba(11,91,211,.25)', 1)) : [];
    lines.push({...link(main, p, p.is === 'link' ? '#14702d' : '#c8310f', 2)});
    if (l && p.is === 'link') {
      l.arrives.forEach((ok, i) => lines.push({from: l.rays[2 * i], to: l.rays[2 * i + 1], colour: ok ? 'rgba(20,112,45,.5)' : 'rgba(200,49,15,.6)'}));
      $('details').append(element('div', 'The link: ' + l.why + '.', 'note'));
    }
    const known = this.known(k);
    return {faces: [...facesOf(main, main.leaves(known), this.fill), outline(main, p.p, blue), outline(main, p.q, orange)], lines};
  }
}, {
  name: 'Links', steps: data.links.length, known: () => everything, tree: main, fill: i => shade(data.radiosity[i]),
  ring: k => i => i === data.links[k].p ? blue : i === data.links[k].q ? orange : '',
  show(k) {
    const l = data.links[k], above = new Set();
    $('heading').textContent = `Link ${k + 1} of ${data.links.length}`;
    $('caption').textContent = `${main[l.p].name} (blue) and ${main[l.q].name} (orange): ${l.why}. Exchange ${short(l.exchange)} m2, ` +
      `${short(l.unoccluded)} m2 if nothing stood between. Green rays arrive, red ones are stopped; where none was needed they are drawn as they would run.`;
    for (let i = picked; i >= 0; i = main[i].parent) above.add(i);
    const own = data.links.map((x, i) => [x, i]).filter(([x]) => above.has(x.p) || above.has(x.q));
    if (picked >= 0) $('details').append(element('div', `${own.length} links bring light to ${main[picked].name}: its own, and those of the nodes above it.`, 'note'));
    $('details').append(list((picked >= 0 ? own : data.links.map((x, i) => [x, i])).slice(0, 400).map(([x, i]) => [`${main[x.p].name} \u2013 ${main[x.q].name}: ${x.why}`, i]), k, go));
    if (data.faint) $('details').append(element('div', `${data.faint} pairs were to be linked, but none of their rays arrived: they carry nothing and are left out.`, 'note'));
    const lines = own.map(([x]) => link(main, x, 'rgba(11,91,211,.35)', 1));
    l.arrives.forEach((ok, i) => lines.push({from: l.rays[2 * i], to: l.rays[2 * i + 1], colour: ok ? '#14702d' : '#c8310f'}));
    return {faces: [...facesOf(main, main.leaves(everything), this.fill), outline(main, l.p, blue), outline(main, l.q, orange)], lines};
  }
}, {
  name: 'Light', steps: 3 * data.iterations.length, known: () => everything, tree: main,
  value(k) {
    const step = data.iterations[Math.floor(k / 3)];
    return k % 3 === 0 ? i => step.gathered[i] : k % 3 === 1 ? i => step.arrived[i] : i => data.emission[i] + data.reflectance[i] * step.mean[i];
  },
  fillAt(k) { const v = this.value(k); return i => shade(v(i)); },
  ring: () => i => i === picked ? blue : '',
  show(k) {
    const n = Math.floor(k / 3), value = this.value(k), step = data.iterations[n];
    $('heading').textContent = `Iteration ${n + 1}: ${['gather', 'push', 'pull'][k % 3]}`;
    $('caption').textContent = [
      'Every node gathers over its own links: irradiance = sum of F B of the other ends. Faces show what their own node has gathered; boxes of the tree, what each level has.',
      'What inner nodes gathered is pushed down and added: each leaf now has the irradiance of all links above it.' +
        (data.closure === null ? '' : ` What leaves send and take is scaled so that form factors sum to 1 where no light is lost; they were off by ${short(100 * data.closure)} %.`),
      'Each leaf radiates B = E + rho times its irradiance, and the area averages are pulled up, so that every node can send.'][k % 3];
    const rows = element('table'), head = element('tr');
    for (const t of ['patch', 'B sent', 'gathered', 'arrived', 'B new']) head.append(element('th', t));
    const radiosity = step.mean.map((irradiance, i) => data.emission[i] + data.reflectance[i] * irradiance);
    rows.append(head);
    main.forEach((m, i) => {
      if (m.parent >= 0 && i !== picked) return;
      const row = element('tr');
      for (const t of [m.name, ...[step.sent, step.gathered, step.mean, radiosity].map(of => short(of[i]))]) row.append(element('td', t));
      rows.append(row);
    });
    $('details').append(chart([{name: 'relative change of B', values: data.iterations.map(s => s.residual)}], n, 'relative change of B, by iteration'),
      element('div', 'W/m2. B sent: the radiosity of the patch before; gathered: irradiance over its own links; arrived: mean irradiance of its leaves after push; B new: their mean radiosity.', 'small'), rows);
    return {faces: facesOf(main, main.leaves(everything), i => shade(value(i)))};
  }
}, {
  name: 'T-vertices', steps: 5, known: () => everything, tree: main, fill: i => shade(data.radiosity[i]), ring: () => i => i === picked ? blue : '',
  show(k) {
    const count = data.leaves.reduce((n, l) => n + l.t.filter(Boolean).length, 0);
    $('heading').textContent = ['Level tags', 'T-vertices', 'Connected', 'Simple reconstruction', 'Weighted reconstruction'][k];
    $('caption').textContent = [
      'Every vertex carries the level at which it was made. A leaf of level l has corners of level l or less.',
      'A vertex with a level above that of the leaf is a T-vertex. ' + (count ? `There are ${count}, red. Drawn as they are, the colours of both sides would part there.`
        : 'There is none here: leaves that meet in an edge are equally fine. A smaller --epsilon may split one of two neighbours; three_plates.scene has some as it is.'),
      (count ? 'Each T-vertex is connected to the nearest corner' : 'With no T-vertex there is nothing to connect') +
        `: ${data.leaves.length} leaves, ${data.mesh.length} faces. No coordinates are compared, tags decide.`,
      'The colour of a corner is the average of all faces around the vertex: light bleeds over the edges of a solid (paper, fig. 7).',
      'Weighted by the cosine between the normals: smooth on one surface, sharp at its edges (paper, figs. 5 and 8).'][k];
    if (k < 2) {
      const marks = data.leaves.flatMap(l => l.corners.map((c, i) => k ? {at: c, colour: '#c8310f', t: l.t[i]} : {at: c, text: String(l.levels[i]), colour: '#14702d', t: 1}))
        .filter(m => m.t);
      const marked = new Map(marks.map(m => [m.at + (m.text || ''), m]));  // each mark once, although leaves share corners
      return {faces: data.leaves.map(l => ({points: l.corners, node: l.node, fill: shade(data.radiosity[l.node])})), marks: [...marked.values()]};
    }
    if (k === 2) return {faces: data.mesh.map(m => ({points: m.corners, node: m.node, fill: shade(data.radiosity[m.node])}))};
    const faces = [];  // bilinear interpolation, drawn as 4 x 4 cells per face
    for (const m of data.mesh) {
      const b = k === 3 ? m.simple : m.weighted, q = i => Math.min(i, m.corners.length - 1), cut = 4;
      const mix = (v, u, w, add) => add(add(times(v[0], (1 - u) * (1 - w)), times(v[1], u * (1 - w))), add(times(v[q(2)], u * w), times(v[q(3)], (1 - u) * w)));
      const at = (u, w) => mix(m.corners, u, w, plus), light = (u, w) => mix(b.map(x => [x]), u, w, plus)[0];
      for (let i = 0; i < cut; ++i) for (let j = 0; j < cut; ++j) {
        faces.push({points: [at(i / cut, j / cut), at((i + 1) / cut, j / cut), at((i + 1) / cut, (j + 1) / cut), at(i / cut, (j + 1) / cut)], node: m.node,
          fill: shade(light((i + 0.5) / cut, (j + 0.5) / cut)), edge: shade(light((i + 0.5) / cut, (j + 0.5) / cut))});
      }
    }
    return {faces};
  }
}, {
  name: 'By light (BF)', steps: data.bf.length, tree: byLight, known: k => i => i < data.bf[k].nodes, fillAt: k => i => shade(data.bf[k].radiosity[i]),
  ring: k => i => { const c = data.bf[k].choices[0]; return c && i === c.p ? blue : c && i === c.q ? orange : ''; },
  show(k) {
    const g = data.bf[k];
    $('heading').textContent = `BF-refinement, generation ${k}: ${g.leaves} leaves, ${g.links} links`;
    $('caption').textContent = `Estimated error ${short(100 * g.estimate)} %, wanted ${short(100 * data.target)} %. The mesh so far is solved, and the links whose light errs most are refined next` +
      (g.choices.length ? ':' : '; here it ends.' + (k ? '' : ' A smaller --target goes on.'));
    $('details').append(chart([{name: 'links', values: data.bf.map(b => b.links)}, {name: 'n\u00b2', values: data.bf.map(b => b.leaves ** 2)}], k, 'links against n\u00b2, by generation'),
      list(g.choices.map((c, i) => [c.why, i]), 0, i => { g.choices.unshift(g.choices.splice(i, 1)[0]); redraw(); }));
    const c = g.choices[0], known = this.known(k), faces = facesOf(byLight, byLight.leaves(known), this.fillAt(k));
    if (c) faces.push(outline(byLight, c.p, blue), outline(byLight, c.q, orange));
    return {faces, lines: g.choices.filter(x => x.p !== x.q).map(x => link(byLight, x, x === c ? '#c8310f' : 'rgba(200,49,15,.25)', x === c ? 2 : 1))};
  }
}, {
  name: 'Solvers', steps: Math.max(...data.solvers[1].methods.map(m => m.residual.length)), known: () => everything, tree: main,
  fill: i => shade(data.radiosity[i]), ring: () => i => i === picked ? blue : '',
  show(k) {
    const s = data.solvers[at99], box = element('input'), label = element('label', ` all that reflects at .99 (else as in the scene, at most ${short(data.solvers[0].reflectance)})`);
    box.type = 'checkbox';
    box.checked = at99 === 1;
    box.onchange = () => { at99 = box.checked ? 1 : 0; redraw(); };
    label.prepend(box);
    keep('solvers', box, label);
    $('heading').textContent = `Solvers after ${k} ${k === 1 ? 'pass' : 'passes'} over all links`;
    $('caption').textContent = 'Residual against work. Jacobi gathers everywhere at once; Gauss-Seidel leaf by leaf with what is new; Southwell shoots from the leaf with the most unshot light; ' +
      'over-shooting sends more than there is and takes back the rest as negative light (violet): worse at first, ahead later where light is reflected many times; ' +
      'conjugate gradients search all directions at once. ' + overshooting(s.methods);
    $('details').append(chart(s.methods.map(m => ({name: m.name, values: m.residual})), k, 'relative residual, by passes'));
    if (!at99) return {faces: facesOf(main, main.leaves(everything), this.fill)};
    const thumbs = element('div', undefined, 'thumbs'), top = Math.max(1e-30, ...s.solution.filter((_, i) => data.emission[i] === 0));
    const after = m => { const b = m.radiosity[Math.min(k, m.radiosity.length - 1)]; return facesOf(main, main.leaves(everything), i => shade(b[i] / top * most)); };
    s.methods.forEach(m => {
      const figure = element('figure', undefined, m.name === solver ? 'now' : ''), small = element('canvas');
      figure.append(small, element('figcaption', m.name));
      figure.onclick = () => { solver = solver === m.name ? '' : m.name; redraw(); };
      thumbs.append(figure);
      requestAnimationFrame(() => paint(small, {faces: after(m).map(f => ({...f, edge: 'none'}))}));
    });
    $('details').append(element('div', `Large: ${solver || 'the solution of the scene'}. Click one of the small pictures to see it large.`, 'small'), thumbs);
    const large = s.methods.find(m => m.name === solver);
    return {faces: large ? after(large) : facesOf(main, main.leaves(everything), this.fill)};
  }
}];

// Keeps the controls, because one that is being dragged must survive the redraw that it causes.
function keep(name, ...controls) {
  if ($('controls').dataset.of !== name) {
    $('controls').replaceChildren(...controls.slice(name === 'threshold' ? 1 : 0).filter(c => c.tagName === 'LABEL'));
    $('controls').dataset.of = name;
  } else if (name === 'threshold') {
    $('controls').firstChild.firstChild.textContent = controls[1].textContent;
  }
}
function pick(i) {
  picked = i === picked ? -1 : i;
  if (chapters[chapter].name === 'Links' && picked >= 0) {
    const own = data.links.findIndex(l => l.p === picked || l.q === picked);
    if (own >= 0) now = own;
  }
  redraw();
}
function redraw() {
  const c = chapters[chapter], k = now;
  $('details').replaceChildren();
  if (!['Refine', 'Solvers'].includes(c.name)) { $('controls').replaceChildren(); $('controls').dataset.of = ''; }
  $('picked').textContent = '';
  if (!c.steps) {
    $('heading').textContent = c.name;
    $('caption').textContent = 'There is nothing of this kind here.';
  } else {
    const picture = c.show(k), fill = c.fillAt ? c.fillAt(k) : c.fill, known = c.known(k), marked = c.ring(k);
    if (picked >= 0 && picked < c.tree.length && known(picked)) {
      picture.faces.push(outline(c.tree, picked, '#d400d4'));
      const n = c.tree[picked], first = c.tree === main ? `, level ${n.depth}, ${data.links.filter(l => l.p === picked || l.q === picked).length} links of its own` : '';
      const leaf = c.tree === main && data.leaves.find(l => l.node === picked);
      $('picked').textContent = `${n.name}: ${short(n.area)} m2${first}` + (leaf ? `; tags of its vertices ${leaf.levels.join(' ')}` : `; ${n.children.length} children`) +
        (c.tree === main ? `; radiosity ${short(data.radiosity[picked])} W/m2` : '');
    }
    drawTree(c.tree, known, fill, i => i === picked ? '#d400d4' : marked(i));
    last = picture;
    paint($('view'), picture);
  }
  $('slide').max = Math.max(0, c.steps - 1);
  $('slide').value = k;
  $('where').textContent = `${c.steps ? k + 1 : 0} of ${c.steps}`;
  [...$('chapters').children].forEach((b, i) => b.classList.toggle('now', i === chapter));
  history.replaceState(null, '', `#${c.name.split(' ')[0].toLowerCase()}=${k}`);
}
let last = {faces: []};
const {go} = stepper({count: () => chapters[chapter].steps, at: () => now, show: k => { now = k; redraw(); }, time: 700, page: 10});
function open(i, k = 0) { chapter = i; if (chapters[i].tree !== main) picked = -1; go(k); }
document.title = 'explain ' + data.scene;
$('title').textContent = data.scene;
chapters.forEach((c, i) => {
  const b = element('button', c.name);
  b.onclick = () => open(i);
  $('chapters').append(b);
});
const view = $('view');
let drag = null, moved = 0;
view.onpointerdown = e => { drag = [e.clientX, e.clientY]; moved = 0; view.setPointerCapture(e.pointerId); };
view.onpointermove = e => {
  if (!drag) return;
  moved += Math.abs(e.clientX - drag[0]) + Math.abs(e.clientY - drag[1]);
  eye.turn -= (e.clientX - drag[0]) / 150;
  eye.lift = Math.max(-1.5, Math.min(1.5, eye.lift + (e.clientY - drag[1]) / 150));
  drag = [e.clientX, e.clientY];
  paint(view, last);
};
view.onpointerup = e => {
  drag = null;
  if (moved < 4) {
    const box = view.getBoundingClientRect(), i = hit(view, e.clientX - box.left, e.clientY - box.top);
    if (i >= 0) pick(i);
  }
};
view.onwheel = e => { e.preventDefault(); eye.zoom *= Math.exp(-e.deltaY / 800); paint(view, last); };
addEventListener('resize', () => paint(view, last));
const asked = /#([a-z-]+)=(\d+)/.exec(location.hash);
open(asked ? Math.max(0, chapters.findIndex(c => c.name.toLowerCase().startsWith(asked[1]))) : 0, asked ? +asked[2] : 0);
document.documentElement.dataset.ready = '1';
