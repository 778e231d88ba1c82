// The colour bar: its range is moved by two handles, and what lies beyond a limit is hatched.

const rounded = (value, digits = 3) => {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 10 ** digits) return Math.round(value).toString();
  return Number(value.toPrecision(digits)).toString();
};

const element = (name, attributes = {}, ...children) => {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith('on')) e.addEventListener(key.slice(2), value);
    else if (key in e && typeof value !== 'string') e[key] = value;
    else e.setAttribute(key, value);
  e.append(...children);
  return e;
};

class Bar {
  constructor(colors, changed) {
    this.canvas = element('canvas', { width: 512, height: 1, 'aria-hidden': 'true' });
    const context = this.canvas.getContext('2d', { willReadFrequently: true }), image = context.createImageData(512, 1);
    this.colors = colors;
    this.paint = () => {
      const { from, to, low, high } = this;
      for (let i = 0; i < 512; ++i) {
        const value = from + (to - from) * i / 511, t = Math.max(0, Math.min(1, (value - low) / (high - low || 1)));
        const c = 3 * Math.round(255 * t);
        image.data.set([colors[c], colors[c + 1], colors[c + 2], 255], 4 * i);
      }
      context.putImageData(image, 0, 0);
    };
    const handle = (name, set) => element('input', { type: 'range', min: '0', max: '1000', step: '1', 'aria-label': name,
                                                     oninput: event => { set(this.valueOf(Number(event.target.value))); this.follow(); changed(); } });
    this.lower = handle('Lowest colour', v => { this.low = Math.min(v, this.high - this.least_m()); });
    this.upper = handle('Highest colour', v => { this.high = Math.max(v, this.low + this.least_m()); });
    this.beyond = element('div', { class: 'beyond', 'aria-hidden': 'true' });
    this.track = element('div', { class: 'track' }, this.canvas, this.beyond, this.lower, this.upper);
    this.ticks = element('div', { class: 'ticks', 'aria-hidden': 'true' });
    this.words = element('p', { class: 'limit' });
    this.root = element('div', { class: 'bar' }, this.track, this.ticks, this.words);
  }

  least_m() { return 1e-3 * (this.to - this.from); }
  valueOf(step) { return this.from + (this.to - this.from) * step / 1000; }
  stepOf(value) { return Math.round(1000 * (value - this.from) / (this.to - this.from)); }

  /// `limits`: those of the meshes that are shown.
  take(field, low, high, limits) {
    this.field = field;
    this.limits = limits;
    // The bar reaches past its first colours by half as much; a single spot far above would leave it no room.
    this.from = Math.min(0, Math.max(field.least, -0.25 * field.high), low);
    this.to = Math.max(high, Math.min(field.most, 2 * field.high), 1e-12);
    const least = limits.length ? Math.min(...limits.map(l => l.value)) : Infinity;
    if (least < 2.5 * this.to) this.to = Math.max(this.to, 1.15 * least);
    this.low = low;
    this.high = high;
    this.follow();
  }

  follow() {
    const { field, from, to } = this;
    this.lower.value = this.stepOf(this.low);
    this.upper.value = this.stepOf(this.high);
    this.lower.setAttribute('aria-valuetext', `${rounded(this.low)} ${field.unit}`);
    this.upper.setAttribute('aria-valuetext', `${rounded(this.high)} ${field.unit}`);
    this.paint();
    const share = v => 100 * (v - from) / (to - from);
    const tick = (v, cls, text) => {
      const at = Math.max(0, Math.min(100, share(v)));
      const e = element('span', { class: cls }, text);
      e.style.left = `${at}%`;
      e.style.transform = `translateX(${-at}%)`;
      return e;
    };
    this.ticks.replaceChildren(tick(this.low, 'end', rounded(this.low)), tick(this.high, 'end', `${rounded(this.high)} ${field.unit}`));
    const sorted = [...this.limits].sort((a, b) => a.value - b.value), first = sorted[0];
    const within = first && first.value < to;
    this.beyond.style.display = within ? '' : 'none';
    if (within) this.beyond.style.left = `${share(first.value)}%`;
    if (!first) { this.words.textContent = ''; return; }
    const same = sorted.filter(l => l.value === first.value).length - 1, next = sorted.find(l => l.value > first.value);
    this.words.textContent = `${within ? 'Hatched: beyond the ' : 'Beyond this bar: '}${first.text}, ${rounded(first.value)} ${field.unit}` +
      (same > 0 ? ` (and ${same} alike)` : '') + (next ? `; next, ${next.text}, ${rounded(next.value)} ${field.unit}` : '');
  }
}

