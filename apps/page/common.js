addEventListener('error', e => { document.documentElement.dataset.error = e.message; });
const $ = id => document.getElementById(id);
const element = (tag, text, kind) => {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (kind) e.className = kind;
  return e;
};

// The controls of a page with steps: buttons, slider, keys. `count` and `at` return the number of steps and the present one, `show` shows
// one; `time` is the interval between steps while playing, `page` the number of steps that a page key moves.
function stepper({count, at, show, time, page}) {
  let timer = null;
  const play = on => {
    clearInterval(timer);
    timer = null;
    if (on && at() >= count() - 1) show(0);
    if (on) timer = setInterval(() => at() < count() - 1 ? show(at() + 1) : play(false), time);
    $('play').textContent = on ? 'pause' : 'play';
  };
  const go = k => {
    play(false);
    show(Math.max(0, Math.min(count() - 1, k)));
  };
  $('back').onclick = () => go(at() - 1);
  $('forth').onclick = () => go(at() + 1);
  $('play').onclick = () => play(!timer);
  $('slide').oninput = () => go(+$('slide').value);
  document.addEventListener('keydown', e => {
    if (e.ctrlKey || e.altKey || e.metaKey || e.target.type === 'range' && e.target.id !== 'slide') return;
    const k = {ArrowRight: at() + 1, ArrowLeft: at() - 1, PageDown: at() + page, PageUp: at() - page, Home: 0, End: count() - 1}[e.key];
    if (k !== undefined) go(k); else if (e.key === ' ') play(!timer); else return;
    e.preventDefault();
  });
  return {go, play};
}
