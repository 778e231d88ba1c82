// What surrounds the picture: playing, colours, views, layers, and what a click found.

const kShownViews = [['front', 'Front'], ['back', 'Back'], ['left', 'Left'], ['right', 'Right'], ['close', 'Close-up']];
const kToldEvery_ms = 200;
const capital = text => text.charAt(0).toUpperCase() + text.slice(1);

class Viewer {
  /// `run`s and the colours of all fields.
  constructor(root, runs, colors) {
    this.canvas = element('canvas');
    this.root = root;
    this.runs = runs;
    this.state = { playing: false, speed: 1, field: null, forces: true, hidden: new Set() };
    const longest = runs.reduce((a, b) => b.times.length > a.times.length ? b : a);
    this.clock = longest.times;
    this.time = this.clock[0];
    this.build(colors);
    this.stage = new Stage(this.canvas, runs, colors);
    this.listen();
    this.setReady(false);
  }

  /// Not before all frames have come it plays, and has other moments and fields.
  setReady(ready) {
    this.ready = ready;
    for (const e of [this.play, this.slider, this.speed, this.peak, this.choice]) e.disabled = !ready;
  }

  /// All frames have come, and all of the page is read.
  complete() {
    this.plots = new Plots((time, svg) => this.pickMoment(time, svg));
    for (const actor of this.stage.actors) actor.complete();
    if (this.runs.some(run => run.arrows)) this.toggle('forces', 'Contact forces', [0.80, 0.08, 0.10], true);
    this.setReady(true);
    this.label();
  }

  build(colors) {
    const button = (text, act, more = {}) => element('button', { type: 'button', onclick: act, ...more }, text);
    const told = { tabindex: '0', role: 'application', 'aria-roledescription': 'view in three dimensions',
      'aria-label': 'The wearer and the garments. Arrow keys turn, plus and minus zoom, space plays, comma and full stop step from frame to frame.' };
    for (const [name, value] of Object.entries(told)) this.canvas.setAttribute(name, value);
    this.reading = element('div', { class: 'reading', role: 'status', 'aria-live': 'polite' });
    this.labels = element('div', { class: 'labels', 'aria-hidden': 'true' });
    this.scale = element('div', { class: 'scale', 'aria-hidden': 'true' });
    this.picture = element('div', { class: 'stage' }, this.canvas, this.labels, this.scale, this.reading);

    this.play = button('', () => this.setPlaying(!this.state.playing), { class: 'play', 'aria-label': 'Play' });
    this.slider = element('input', { type: 'range', min: '0', max: String(this.clock.length - 1), step: '1', value: '0', class: 'time',
      'aria-label': 'Time', oninput: event => { this.setPlaying(false); this.setTime(this.clock[Number(event.target.value)]); } });
    this.now = element('output', { class: 'now' });
    this.speed = element('select', { 'aria-label': 'Speed', onchange: event => { this.state.speed = Number(event.target.value); } },
      ...[[0.1, '1/10 speed'], [0.25, '1/4 speed'], [0.5, '1/2 speed'], [1, 'Real speed']].map(([v, text]) => element('option', { value: String(v) }, text)));
    this.speed.value = '1';
    const start = this.runs[0].head.start;
    this.peak = button('Peak', () => { this.setPlaying(false); this.setTime(start.time_s); }, { class: 'quiet', title: 'To the moment of the peak' });
    const transport = element('div', { class: 'transport' }, this.play, this.slider, this.now, this.peak, this.speed);

    this.choice = element('select', { 'aria-label': 'Colours show', onchange: event => this.setField(event.target.value) });
    this.choice.append(element('option', { value: '' }, 'Plain'));
    for (const [kind, words] of [['cloth', 'On the cloth'], ['body', 'On the body']]) {
      const fields = this.runs[0].head.fields.filter(f => f.on === kind);
      if (fields.length) this.choice.append(element('optgroup', { label: words }, ...fields.map(f => element('option', { value: f.name }, `${f.title} [${f.unit}]`))));
    }
    this.bar = new Bar(colors, () => this.recolour());
    this.views = element('div', { class: 'buttons', role: 'group', 'aria-label': 'View' },
      ...kShownViews.map(([name, text]) => button(text, () => this.setView(name), { 'data-view': name })));
    this.layers = element('div', { class: 'buttons layers', role: 'group', 'aria-label': 'What is shown' });
    const toggle = this.toggle = (key, text, color, on) => {
      const dot = color ? element('span', { class: 'dot' }) : '';
      if (color) dot.style.background = `rgb(${color.map(c => Math.round(255 * c)).join(' ')})`;
      this.layers.append(button('', event => this.setLayer(key, event.currentTarget.getAttribute('aria-pressed') !== 'true'),
        { 'aria-pressed': String(on), 'data-layer': key }));
      this.layers.lastChild.append(dot, text);
    };
    const meshes = this.runs.flatMap(run => run.meshes), seen = new Set();
    if (meshes.some(m => m.kind === 'body')) toggle('body', 'Body', [0.80, 0.755, 0.715], true);
    for (const m of meshes)
      if (m.kind === 'cloth' && !seen.has(m.name)) { seen.add(m.name); toggle(m.name, capital(m.name), m.color, true); }
    if (meshes.some(m => m.kind === 'thing')) toggle('thing', 'Around', [0.70, 0.72, 0.75], true);
    const tools = element('div', { class: 'tools' },
      element('div', { class: 'colours' }, this.choice, this.bar.root), element('div', { class: 'choices' }, this.views, this.layers));
    this.way = element('a', { class: 'viewer-way', href: '#look', hidden: true, onclick: () => { this.way.hidden = true; } });
    this.root.append(this.picture, transport, tools);
    document.body.append(this.way);
  }

  listen() {
    let down = null;
    this.canvas.addEventListener('pointerdown', event => {
      down = [event.clientX, event.clientY];
      if (event.pointerType === 'touch') this.stage.controls.enableZoom = true;
      this.stage.trip = (this.stage.trip || 0) + 1;
      this.stage.travels = false;
    });
    this.canvas.addEventListener('pointerup', event => {
      if (!down || event.button !== 0 || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
      const box = this.canvas.getBoundingClientRect();
      this.choose(event.clientX - box.left, event.clientY - box.top);
    });
    this.canvas.addEventListener('focus', () => { this.stage.controls.enableZoom = true; });
    this.canvas.addEventListener('blur', () => { this.stage.controls.enableZoom = false; });
    const keys = {
      ArrowLeft: () => this.stage.turn(-0.12, 0, 1), ArrowRight: () => this.stage.turn(0.12, 0, 1),
      ArrowUp: () => this.stage.turn(0, -0.1, 1), ArrowDown: () => this.stage.turn(0, 0.1, 1),
      '+': () => this.stage.turn(0, 0, 0.88), '=': () => this.stage.turn(0, 0, 0.88), '-': () => this.stage.turn(0, 0, 1.14),
      ' ': () => this.setPlaying(!this.state.playing), ',': () => this.step(-1), '.': () => this.step(1),
      Escape: () => this.mark(null),
    };
    this.canvas.addEventListener('keydown', event => {
      const act = keys[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    });
    new ResizeObserver(() => { this.stand(); this.stage.resize(); this.label(); }).observe(this.canvas);
  }

  /// Whole pixels of the picture upon those of the page: between them each frame would be filtered.
  stand() {
    const { style } = this.canvas;
    style.marginTop = '0';
    const top = this.canvas.getBoundingClientRect().top + window.scrollY;
    style.marginTop = `${Math.ceil(top) - top}px`;
  }

  step(by) {
    this.setPlaying(false);
    this.setTime(this.clock[Math.max(0, Math.min(this.clock.length - 1, this.clockFrame() + by))]);
  }

  clockFrame() {
    let best = 0;
    this.clock.forEach((t, k) => { if (Math.abs(t - this.time) < Math.abs(this.clock[best] - this.time)) best = k; });
    return best;
  }

  /// A moment of a plot: the nearest recorded frame.
  pickMoment(time) {
    this.setPlaying(false);
    this.setTime(time);
    // Where the picture is out of sight, the way to it.
    const box = this.picture.getBoundingClientRect(), seen = Math.min(box.bottom, window.innerHeight) - Math.max(box.top, 0);
    clearTimeout(this.offered);
    this.way.textContent = `${this.time.toFixed(2)} s in the view`;
    this.way.hidden = seen > 0.4 * box.height;
    this.offered = setTimeout(() => { this.way.hidden = true; }, 8000);
  }

  /// Where it is not playing the picture is that of a recorded frame.
  setTime(time) {
    this.time = time;
    if (!this.state.playing) this.time = this.clock[this.clockFrame()];
    this.refresh();
  }

  setPlaying(on) {
    if (this.state.playing === on || !this.ready) return;
    this.state.playing = this.stage.playing = on;
    this.reading.setAttribute('aria-live', on ? 'off' : 'polite');
    this.play.classList.toggle('on', on);
    this.play.setAttribute('aria-label', on ? 'Pause' : 'Play');
    if (!on) return this.setTime(this.time);
    if (this.time >= this.clock[this.clock.length - 1] - 1e-9) this.time = this.clock[0];
    let before = performance.now();
    const tick = now => {
      if (!this.state.playing) return;
      const end = this.clock[this.clock.length - 1], begin = this.clock[0];
      this.time += Math.min(0.25, (now - before) / 1000) * this.state.speed;
      before = now;
      if (this.time > end) this.time = begin;
      this.refresh(true);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  /// `at_once`: draws without waiting.
  refresh(at_once = false) {
    const most_N = Math.max(...this.runs.map(run => run.arrows ? run.arrows.most_N : 0));
    const longest_m = Math.max(...this.runs.map(run => run.arrows ? run.arrows.longest_m : 0));
    const m_per_N = most_N > 0 ? longest_m / most_N : 0;
    for (const actor of this.stage.actors) {
      actor.move(this.stage.playing, this.stage.slow);
      actor.show(this.time, this.fieldOf(actor.run), m_per_N, this.state.forces);
    }
    this.tell();
    if (at_once) this.stage.drawNow(); else this.stage.draw();
  }

  /// The moment, around the picture. Where the browser is slow not with every picture: it would compose far more of the page.
  tell() {
    const now = performance.now();
    if (this.stage.playing && this.stage.slow && now - this.told < kToldEvery_ms) return;
    this.told = now;
    const words = `${this.time.toFixed(2)} s`;
    this.slider.value = this.clockFrame();
    this.slider.setAttribute('aria-valuetext', words);
    this.now.textContent = words;
    if (this.plots) this.plots.show(this.time);
    this.read();
  }

  fieldOf(run) { return run.fields.get(this.state.field) || null; }

  async setField(name) {
    this.choice.value = name;
    await Promise.all(this.runs.map(run => run.field(name)));
    if (this.choice.value !== name) return;
    this.state.field = name;
    this.offerRange();
    this.refresh();
  }

  /// The bar for the field and what is shown of it.
  offerRange() {
    const fields = this.runs.map(run => this.fieldOf(run)).filter(f => f);
    this.bar.root.hidden = !fields.length;
    if (!fields.length) return;
    const all = { ...fields[0], high: Math.max(...fields.map(f => f.high)), least: Math.min(...fields.map(f => f.least)), most: Math.max(...fields.map(f => f.most)) };
    const limits = [];
    for (const run of this.runs) {
      const meshes = run.meshesOf(all.on);
      for (const l of (this.fieldOf(run) || { limits: [] }).limits)
        if ((l.mesh < 0 || meshes[l.mesh].shown) && !limits.some(o => o.text === l.text && o.value === l.value)) limits.push(l);
    }
    this.bar.take(all, 0, all.high, limits);
    this.recolour();
  }

  setRange(low, high) {
    const { bar } = this;
    bar.from = Math.min(bar.from, low);
    bar.to = Math.max(bar.to, high);
    bar.low = low;
    bar.high = high;
    bar.follow();
    this.recolour();
  }

  recolour() {
    this.stage.shared.low.value = this.bar.low;
    this.stage.shared.high.value = this.bar.high;
    this.stage.draw();
  }

  setView(name) {
    if (name === 'close') return this.closeUp();
    this.stage.view(name, run => run.nearestFrame(this.time));
  }

  /// At the largest value of the field that is shown, in this frame.
  closeUp() {
    let best = null;
    for (const actor of this.stage.actors) {
      const { run } = actor, field = this.fieldOf(run);
      const worst = field && run.worst(field, run.nearestFrame(this.time), run.meshes.filter(m => m.shown));
      if (worst && (!best || worst.value > best.value)) best = { ...worst, actor };
    }
    if (!best) return;
    this.setPlaying(false);
    this.mark(best);
    this.stage.closeUp(best.actor, best.mesh, best.vertex);
  }

  setLayer(key, on) {
    for (const b of this.layers.children) if (b.dataset.layer === key) b.setAttribute('aria-pressed', String(on));
    if (key === 'forces') this.state.forces = on;
    for (const run of this.runs)
      for (const mesh of run.meshes)
        if (mesh.kind === 'cloth' ? mesh.name === key : mesh.kind === key) mesh.shown = on;
    if (key !== 'forces' && this.state.field) {
      const { low, high } = this.bar;
      this.offerRange();
      this.setRange(low, high);
    }
    this.refresh();
  }

  choose(x, y) { this.mark(this.stage.pick(x, y)); }

  mark(found) {
    this.marked = found;
    for (const actor of this.stage.actors) actor.setMark(found && found.actor === actor ? found : null);
    this.read();
    this.stage.draw();
  }

  /// What stands at the marked vertex, in the nearest recorded frame.
  found() {
    if (!this.marked) return null;
    const { actor, mesh, vertex } = this.marked, { run } = actor, frame = run.nearestFrame(this.time), field = this.fieldOf(run);
    return {
      run: this.runs.indexOf(run), mesh: mesh.name, kind: mesh.kind, vertex, frame, time_s: run.times[frame],
      part: mesh.parts_of ? mesh.parts[mesh.parts_of[vertex]] : '', position_m: run.position(mesh, vertex, frame),
      value: field && field.on === mesh.kind ? run.value(field, mesh, vertex, frame) : null,
      field: field ? field.name : '', unit: field ? field.unit : '', title: field ? field.title : '',
    };
  }

  read() {
    const f = this.found();
    this.reading.hidden = !f;
    if (!f) return;
    const cm = f.position_m.map(x => (100 * x).toFixed(1));
    const own = f.kind === 'cloth' && this.runs[f.run].meshesOf('cloth').length < 2 ? 'garment' : f.mesh;
    const where = f.part && !f.part.startsWith(own) ? `${own}, ${f.part}` : f.part || own;
    this.reading.replaceChildren(
      element('strong', {}, f.value === null ? capital(where) : `${rounded(f.value)} ${f.unit}`),
      element('span', {}, f.value === null ? '' : `${f.title} · ${where}`),
      element('small', {}, `x ${cm[0]}, y ${cm[1]}, z ${cm[2]} cm at ${f.time_s.toFixed(2)} s`));
  }

  /// Names of the runs, and what an arrow says.
  label() {
    if (this.runs.length > 1) {
      const height = this.canvas.clientHeight;
      this.labels.replaceChildren(...this.stage.places().map(([x, y, w, h], k) => {
        const e = element('span', {}, element('b', {}, this.runs[k].head.label));
        Object.assign(e.style, { left: `${x}px`, top: `${height - y - h}px`, width: `${w}px` });
        return e;
      }));
    }
    const arrows = this.runs.map(run => run.arrows).find(a => a);
    this.scale.textContent = arrows ? `Arrows: contact force of ${arrows.legend} on what it touches, the longest ${rounded(Math.max(...this.runs.map(r => r.arrows ? r.arrows.most_N : 0)))} N` : '';
  }
}

