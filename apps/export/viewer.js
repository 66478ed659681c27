// Draws the scene with WebGL: arrays in the page's data become buffers; controls, pointer and keys move the eye.
const $ = id => document.getElementById(id);
const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer;
const positions = new Float32Array(bytes(data.positions)), cornerVertex = new Uint32Array(bytes(data.cornerVertex));
const cornerLight = new Uint16Array(bytes(data.cornerLight)), faceSize = new Uint8Array(bytes(data.faceSize));
const faceSeen = new Uint8Array(bytes(data.faceSeen));
const faceNode = new Uint32Array(bytes(data.faceNode)), parent = new Uint32Array(bytes(data.parent));
const faces = faceSize.length;
$('title').textContent = data.title; $('sentence').textContent = data.sentence;

// The depths of nodes, for ancestor(): at level 0 this is the input face, at the depth of a leaf and beyond the leaf itself.
const depth = new Uint8Array(parent.length);
let deepest = 0;
for (let i = 0; i < parent.length; ++i) {  // parents come first
  if (parent[i] !== i) { depth[i] = depth[parent[i]] + 1; }
}
for (let f = 0; f < faces; ++f) { deepest = Math.max(deepest, depth[faceNode[f]]); }
function ancestor(node, level) { while (depth[node] > level) { node = parent[node]; } return node; }

const canvas = $('canvas'), gl = canvas.getContext('webgl2', {antialias: true, preserveDrawingBuffer: true});
function fault(sentence) { $('fault').textContent = sentence; $('fault').style.display = 'block'; throw new Error(sentence); }
if (!gl) { fault('This browser has no WebGL 2, which the picture needs.'); }

function program(vertex, fragment) {
  const p = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const s = gl.createShader(type);
    gl.shaderSource(s, '#version 300 es\nprecision highp float;\n' + text);
    gl.compileShader(s);
    if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) { fault(gl.getShaderInfoLog(s)); }
    gl.attachShader(p, s);
  }
  gl.linkProgram(p);
  if (!gl.getProgramParameter(p, gl.LINK_STATUS)) { fault(gl.getProgramInfoLog(p)); }
  return p;
}
// Light is linear; the displayed colour is clamped and encoded as sRGB. A face that another object covers (alpha 0) is moved behind it.
const surface = program(
  'in vec3 position; in vec3 light; in vec3 flatLight; in vec4 patchColor; uniform mat4 view; uniform int mode; out vec3 color;' +
  'void main() { gl_Position = view * vec4(position, 1.0); if (patchColor.a == 0.0) { gl_Position.z += 2e-4 * gl_Position.w; }' +
  'color = mode == 0 ? light : mode == 1 ? flatLight : patchColor.rgb; }',
  'in vec3 color; uniform float exposure; out vec4 result; vec3 encode(vec3 c) { c = clamp(c, 0.0, 1.0);' +
  'return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308)))); }' +
  'void main() { result = gl_FrontFacing ? vec4(encode(color * exposure), 1.0) : vec4(0.07, 0.07, 0.08, 1.0); }');
const border = program(
  'in vec3 position; uniform mat4 view; void main() { gl_Position = view * vec4(position, 1.0); gl_Position.z -= 1e-4 * gl_Position.w; }',
  'out vec4 result; void main() { result = vec4(1.0, 0.85, 0.2, 0.6); }');

const half = (() => {  // table of all 65536 half floats
  const table = new Float32Array(65536);
  for (let h = 0; h < 65536; ++h) {
    const e = h >> 10 & 31, m = h & 1023;
    table[h] = (h & 32768 ? -1 : 1) * (e === 0 ? m * 2 ** -24 : (1 + m / 1024) * 2 ** (e - 15));
  }
  return table;
})();

let count = 0;
for (let f = 0; f < faces; ++f) { count += 3 * (faceSize[f] - 2); }
const at = new Float32Array(3 * count), light = new Float32Array(3 * count), flatLight = new Float32Array(3 * count);
const patchColor = new Uint8Array(4 * count);
const firstCorner = new Uint32Array(faces + 1);
for (let f = 0, out = 0; f < faces; ++f) {
  const first = firstCorner[f], n = faceSize[f];
  firstCorner[f + 1] = first + n;
  const mean = [0, 0, 0];
  for (let k = 0; k < n; ++k) { for (let c = 0; c < 3; ++c) { mean[c] += half[cornerLight[3 * (first + k) + c]] / n; } }
  for (let k = 2; k < n; ++k) {
    for (const corner of [first, first + k - 1, first + k]) {
      for (let c = 0; c < 3; ++c) {
        at[out] = positions[3 * cornerVertex[corner] + c];
        light[out] = half[cornerLight[3 * corner + c]];
        flatLight[out++] = mean[c];
      }
    }
  }
}
function attribute(p, name, values, size, type, normalized) {
  const place = gl.getAttribLocation(p, name), buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
  if (place >= 0) {
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
  }
  return buffer;
}
const surfaces = gl.createVertexArray();
gl.bindVertexArray(surfaces);
attribute(surface, 'position', at, 3, gl.FLOAT, false);
attribute(surface, 'light', light, 3, gl.FLOAT, false);
attribute(surface, 'flatLight', flatLight, 3, gl.FLOAT, false);
const patchBuffer = attribute(surface, 'patchColor', patchColor, 4, gl.UNSIGNED_BYTE, true);
const lines = gl.createVertexArray();
gl.bindVertexArray(lines);
const lineBuffer = attribute(border, 'position', new Float32Array(3), 3, gl.FLOAT, false);
let lineCount = 0;

// The outlines and colours of the patches of one level: an edge between two faces of the same patch is not drawn.
function chooseLevel(level) {
  const patch = new Uint32Array(faces), open = new Map(), found = [];
  for (let f = 0, out = 0; f < faces; ++f) {
    const node = patch[f] = ancestor(faceNode[f], level);
    let h = Math.imul(node + 1, 2654435761) >>> 0;
    h = Math.imul(h ^ h >>> 15, 2246822519) >>> 0;
    for (let k = 0; k < 3 * (faceSize[f] - 2); ++k, out += 4) {
      patchColor[out] = 40 + (h & 127); patchColor[out + 1] = 40 + (h >> 8 & 127); patchColor[out + 2] = 40 + (h >> 16 & 127);
      patchColor[out + 3] = 255 * faceSeen[f];
    }
  }
  gl.bindBuffer(gl.ARRAY_BUFFER, patchBuffer);
  gl.bufferData(gl.ARRAY_BUFFER, patchColor, gl.DYNAMIC_DRAW);
  const vertices = positions.length / 3;
  for (let f = 0; f < faces; ++f) {
    for (let k = 0, first = firstCorner[f], n = faceSize[f]; k < n; ++k) {
      const a = cornerVertex[first + k], b = cornerVertex[first + (k + 1) % n], key = Math.min(a, b) * vertices + Math.max(a, b);
      const other = open.get(key);
      if (other === undefined) { open.set(key, f); continue; }
      if (patch[other] !== patch[f]) { found.push(a, b); }
      open.delete(key);
    }
  }
  for (const key of open.keys()) { found.push(Math.floor(key / vertices), key % vertices); }
  const points = new Float32Array(3 * found.length);
  found.forEach((v, i) => points.set(positions.subarray(3 * v, 3 * v + 3), 3 * i));
  gl.bindBuffer(gl.ARRAY_BUFFER, lineBuffer);
  gl.bufferData(gl.ARRAY_BUFFER, points, gl.DYNAMIC_DRAW);
  lineCount = found.length;
}

const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const l = Math.hypot(...a); return l > 0 ? a.map(x => x / l) : a; };
let eye, forward, up, fov, picture, walking = false;
function turn(v, axis, angle) {  // Rodrigues
  const c = Math.cos(angle), s = Math.sin(angle), along = (1 - c) * dot(axis, v), w = cross(axis, v);
  return [0, 1, 2].map(k => c * v[k] + s * w[k] + along * axis[k]);
}
function take(i) {
  const c = data.cameras[i];
  if (!c) { return; }
  eye = [...c.eye]; forward = unit(c.forward); up = unit(c.up); fov = c.fov * Math.PI / 180; picture = c.aspect; walking = false;
  $('camera').value = i;
}
function matrix() {
  const right = unit(cross(forward, up)), above = cross(right, forward), aspect = canvas.width / canvas.height;
  const near = walking ? 1e-3 : Math.max(1e-3, 0.3 * (Math.hypot(...eye) - 0.6)), far = Math.hypot(...eye) + 2;
  // The whole picture of the camera is visible.
  const x = 1 / Math.tan(fov / 2) * Math.min(1, picture / aspect), y = x * aspect;
  const a = (far + near) / (near - far), b = 2 * far * near / (near - far);
  const m = [right.map(v => v * x), above.map(v => v * y), forward];
  const row = k => [...m[k], -dot(m[k], eye)];
  const r = row(0), u = row(1), d = row(2);
  const columns = [];
  for (let k = 0; k < 4; ++k) { columns.push(r[k], u[k], -a * d[k] + (k === 3 ? b : 0), d[k]); }
  return new Float32Array(columns);
}
let wanted = false;
function draw() {
  wanted = false;
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio); canvas.height = Math.round(canvas.clientHeight * ratio);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(0.067, 0.067, 0.067, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST); gl.depthFunc(gl.LEQUAL);
  $('backs').value === 'hide' ? gl.enable(gl.CULL_FACE) : gl.disable(gl.CULL_FACE);
  const view = matrix(), mode = $('show').selectedIndex;
  gl.useProgram(surface);
  gl.uniformMatrix4fv(gl.getUniformLocation(surface, 'view'), false, view);
  gl.uniform1i(gl.getUniformLocation(surface, 'mode'), mode);
  gl.uniform1f(gl.getUniformLocation(surface, 'exposure'), mode === 2 ? 1 : 2 ** $('exposure').value);
  gl.bindVertexArray(surfaces);
  gl.drawArrays(gl.TRIANGLES, 0, count);
  if ($('borders').value !== 'none') {
    gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(border);
    gl.uniformMatrix4fv(gl.getUniformLocation(border, 'view'), false, view);
    gl.bindVertexArray(lines);
    gl.drawArrays(gl.LINES, 0, lineCount);
    gl.disable(gl.BLEND);
  }
  const pixel = new Uint8Array(4 * canvas.width * canvas.height);
  if (window.halflightTest) {  // for tests: the mean of the picture
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    let sum = 0;
    for (let i = 0; i < pixel.length; i += 4) { sum += pixel[i] + pixel[i + 1] + pixel[i + 2]; }
    document.body.dataset.mean = (sum / pixel.length * 4 / 3).toFixed(3);
  }
  document.body.dataset.drawn = count / 3;
  document.body.dataset.borders = lineCount / 2;
}
function redraw() { if (!wanted) { wanted = true; requestAnimationFrame(draw); } }

data.cameras.forEach((c, i) => $('camera').append(new Option(c.name || 'camera ' + (i + 1), i)));
$('level').max = deepest; $('level').value = deepest;
function texts() {
  const e = +$('exposure').value;
  $('exposureText').textContent = (e > 0 ? '+' : '') + e.toFixed(1) + ' EV';
  $('levelText').textContent = +$('level').value === deepest ? 'leaves' : $('level').value;
}
$('camera').onchange = () => { take(+$('camera').value); redraw(); };
$('exposure').oninput = () => { texts(); redraw(); };
$('level').oninput = () => { texts(); chooseLevel(+$('level').value); redraw(); };
for (const id of ['show', 'borders', 'backs']) { $(id).onchange = redraw; }

const pressed = new Map();
canvas.onpointerdown = e => { canvas.setPointerCapture(e.pointerId); canvas.focus(); pressed.set(e.pointerId, e); };
canvas.onpointerup = canvas.onpointercancel = e => pressed.delete(e.pointerId);
canvas.oncontextmenu = e => e.preventDefault();
canvas.onpointermove = e => {
  const before = pressed.get(e.pointerId);
  if (!before) { return; }
  pressed.set(e.pointerId, e);
  const dx = (e.clientX - before.clientX) / canvas.clientHeight, dy = (e.clientY - before.clientY) / canvas.clientHeight;
  const right = unit(cross(forward, up)), above = cross(right, forward);
  if (e.buttons & 2 || e.shiftKey || pressed.size > 1) {
    const s = Math.max(Math.hypot(...eye), 0.1) * Math.tan(fov / 2) * 2;
    eye = add(add(eye, right, -dx * s), above, dy * s);
  } else {
    const pitch = Math.asin(Math.max(-1, Math.min(1, dot(forward, up)))), sign = walking ? -1 : 1;
    const down = Math.max(-1.55 - pitch, Math.min(1.55 - pitch, sign * -dy * (walking ? fov : 3))), side = sign * -dx * (walking ? fov : 3);
    const move = v => turn(turn(v, right, down), up, side);
    forward = unit(move(forward));
    if (!walking) { eye = move(eye); }
  }
  redraw();
};
canvas.addEventListener('wheel', e => {
  e.preventDefault();
  eye = add(eye, forward, -0.0008 * e.deltaY * Math.max(0.2, Math.hypot(...eye)));
  redraw();
}, {passive: false});
const keys = new Set();
let last = 0;
function walk(now) {
  const step = Math.min(now - last, 50) * 1.5e-4;
  last = now;
  const right = unit(cross(forward, up)), ahead = unit(add(forward, up, -dot(forward, up)));
  for (const [key, way, sign] of [['w', ahead, 1], ['s', ahead, -1], ['d', right, 1], ['a', right, -1], ['e', up, 1], ['q', up, -1]]) {
    if (keys.has(key)) { eye = add(eye, way, sign * step); }
  }
  if (keys.size > 0) { draw(); requestAnimationFrame(walk); }
}
addEventListener('keydown', e => {
  const key = e.key.toLowerCase();
  if (e.target.tagName === 'SELECT' || e.target.tagName === 'INPUT' || e.ctrlKey || e.metaKey) { return; }
  if (key === 'h') { $('panel').hidden = !$('panel').hidden; }
  if (key >= '1' && key <= '9') { take(+key - 1); redraw(); }
  if ('wasdqe'.includes(key) && key.length === 1) {
    walking = true;
    if (keys.size === 0) { last = performance.now(); requestAnimationFrame(walk); }
    keys.add(key);
  }
});
addEventListener('keyup', e => keys.delete(e.key.toLowerCase()));
addEventListener('blur', () => keys.clear());
addEventListener('resize', redraw);

// Settings in the address after #: "borders=level&level=2&show=patches&exposure=1&camera=0&test".
for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
  if (key === 'test') { window.halflightTest = true; } else if ($(key) && 'value' in $(key)) { $(key).value = value; }
}
texts(); chooseLevel(+$('level').value); take(+$('camera').value || 0); draw();
