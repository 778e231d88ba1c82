// One run of the page: where its meshes are and what its fields say, at any time.

const kNoValue = -32768, kNone = -1e30;

class Run {
  /// `head`: its JSON object; `number`: which run of the page it is. Its blocks are looked up when they are needed.
  constructor(head, number) {
    this.head = head;
    this.number = number;
    this.times = head.times_s;
    this.fields = new Map();
    this.whole = false;
  }

  bytesOf(selector) { return inflated(document.querySelector(`script.${selector}[data-run="${this.number}"]`).textContent); }
  block(n) { return this.bytesOf(`viewer-block[data-block="${n}"]`); }

  /// What the first picture takes: of all that changes the start's frame alone.
  async loadFirst() {
    const first = { cloth: 0, body: 0, thing: 0 };
    // In one piece: whoever waits for many lets the browser read the rest of the page in between.
    const bytes = await this.bytesOf('viewer-first');
    this.first = ([begin, length]) => bytes.slice(begin, begin + length);
    this.meshes = [];
    for (const m of this.head.meshes) {
      const corners = cornersOf(this.first(m.triangles));
      const mesh = { ...m, corners, parents: parentsOf(m.vertices, corners), first: first[m.kind], places: null, base: 0,
                     x: new Float32Array(3 * m.vertices), n: new Float32Array(3 * m.vertices),
                     values: new Float32Array(m.vertices).fill(kNone), parts_of: null };
      first[m.kind] += m.vertices;
      if (m.moving !== undefined) {
        mesh.codes = unpacked(this.first(m.start), 1, m.vertices, 3, mesh.parents);
        mesh.base = this.head.start.frame;
      } else {
        mesh.x.set(new Float32Array(this.first(m.fixed)));
        mesh.places = new Float32Array(this.first(m.placed));
        setNormals(mesh.x, corners, mesh.n);
      }
      this.meshes.push(mesh);
    }
    return this;
  }

  /// All frames.
  async loadRest() {
    for (const mesh of this.meshes) {
      if (mesh.codes) {
        const codes = unpacked(await this.block(mesh.moving), this.times.length, mesh.vertices, 3, mesh.parents);
        Object.assign(mesh, { codes, base: 0 });
      }
      if (mesh.part !== undefined) mesh.parts_of = new Uint16Array(await this.block(mesh.part));
    }
    const arrows = this.head.arrows;
    if (arrows) {
      this.arrows = { ...arrows, data: new Float32Array(await this.block(arrows.block)), begin: [0] };
      for (const n of arrows.counts) this.arrows.begin.push(this.arrows.begin[this.arrows.begin.length - 1] + n);
    }
    this.fields.clear();
    this.whole = true;
  }

  /// Frames whose places are known.
  frames() { return this.whole ? this.times.map((_, k) => k) : [this.head.start.frame]; }

  meshesOf(kind) { return this.meshes.filter(m => m.kind === kind); }
  fieldHead(name) { return this.head.fields.find(f => f.name === name); }

  /// The codes of a field are read when it is first asked for.
  async field(name) {
    const head = this.fieldHead(name);
    if (!head) return null;
    if (!this.fields.has(name)) {
      const parents = [];
      for (const m of this.meshesOf(head.on)) for (const p of m.parents) parents.push(p < 0 ? -1 : m.first + p);
      const whole = this.whole, frames = whole ? head.frames : 1;
      if (!whole && head.start === undefined) return null;
      const codes = unpacked(whole ? await this.block(head.block) : this.first(head.start), frames, parents.length, 1, parents);
      this.fields.set(name, { ...head, frames, codes, vertices: parents.length });
    }
    return this.fields.get(name);
  }

  /// The frame at or before a time, and how far it is to the next (0 .. 1).
  at(time) {
    if (!this.whole) return { frame: this.head.start.frame, part: 0 };
    const t = this.times;
    if (!(time > t[0])) return { frame: 0, part: 0 };
    let low = 0, high = t.length - 1;
    if (time >= t[high]) return { frame: high, part: 0 };
    while (high - low > 1) {
      const middle = low + high >> 1;
      if (t[middle] <= time) low = middle; else high = middle;
    }
    return { frame: low, part: (time - t[low]) / (t[high] - t[low]) };
  }

  nearestFrame(time) {
    const { frame, part } = this.at(time);
    return part > 0.5 ? frame + 1 : frame;
  }

  originAt({ frame, part }) {
    const a = this.head.origin_m[frame], b = this.head.origin_m[Math.min(frame + 1, this.times.length - 1)];
    return a.map((x, c) => x + part * (b[c] - x));
  }

  /// Vertices that move one by one, about the origin.
  place(mesh, { frame, part }) {
    const n = 3 * mesh.vertices, q = mesh.quantum_m, a = (frame - mesh.base) * n, b = part > 0 ? a + n : a, codes = mesh.codes, x = mesh.x;
    for (let i = 0; i < n; ++i) x[i] = q * (codes[a + i] + part * (codes[b + i] - codes[a + i]));
    setNormals(x, mesh.drawn || mesh.corners, mesh.n);
  }

  /// The rows of a mesh that moves as a whole: 12 numbers.
  placed(mesh, { frame, part }) {
    const a = 12 * frame, b = part > 0 ? a + 12 : a, p = mesh.places;
    return Array.from({ length: 12 }, (_, i) => p[a + i] + part * (p[b + i] - p[a + i]));
  }

  valueOf(field, code) {
    const value = code === kNoValue ? NaN : field.scale * Math.sinh(field.step * code);
    return value;
  }

  /// At a vertex of a mesh, in a frame; NaN where there is none.
  value(field, mesh, vertex, frame) {
    return this.valueOf(field, field.codes[(field.frames > 1 ? frame : 0) * field.vertices + mesh.first + vertex]);
  }

  /// Into mesh.values; kNone where there is none.
  colour(field, mesh, { frame, part }) {
    const begin = (field.frames > 1 ? frame : 0) * field.vertices + mesh.first;
    const next = part > 0 && field.frames > 1 ? begin + field.vertices : begin;
    const table = this.tableOf(field), codes = field.codes, out = mesh.values;
    for (let v = 0; v < mesh.vertices; ++v) {
      const a = codes[begin + v], b = codes[next + v];
      out[v] = a === kNoValue || b === kNoValue ? kNone
        : table[a + 32768] + part * (table[b + 32768] - table[a + 32768]);
    }
  }

  /// The value of each code that occurs.
  tableOf(field) {
    if (!field.table) {
      field.table = new Float32Array(65536);
      const most = Math.ceil(Math.asinh(1000) / field.step) + 1;
      for (let c = -most; c <= most; ++c) field.table[c + 32768] = this.valueOf(field, c);
    }
    return field.table;
  }

  /// The largest in a frame among the meshes `shown`: {mesh, vertex, value}, or null.
  worst(field, frame, shown) {
    let best = null;
    for (const mesh of shown) {
      if (mesh.kind !== field.on) continue;
      for (let v = 0; v < mesh.vertices; ++v) {
        const value = this.value(field, mesh, v, frame);
        if (value > (best ? best.value : -Infinity)) best = { mesh, vertex: v, value };
      }
    }
    return best;
  }

  /// Where a vertex is in a frame, in the world of the recording [m].
  position(mesh, vertex, frame) {
    const o = this.head.origin_m[frame];
    if (mesh.codes) {
      const i = 3 * ((frame - mesh.base) * mesh.vertices + vertex);
      return [0, 1, 2].map(c => o[c] + mesh.quantum_m * mesh.codes[i + c]);
    }
    const r = this.placed(mesh, { frame, part: 0 }), x = mesh.x, v = 3 * vertex;
    return [0, 1, 2].map(c => o[c] + r[4 * c] * x[v] + r[4 * c + 1] * x[v + 1] + r[4 * c + 2] * x[v + 2] + r[4 * c + 3]);
  }
}

