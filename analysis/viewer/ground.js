// The ground: a grid of half metres that fades out, and the soft shadow of what stands on it.

const kCells = 64, kHalf_m = 1.6, kGround_m = 4;

const kGroundVertex = `
  varying vec2 v_at;
  void main() { v_at = position.xy; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

const kGroundFragment = `
  uniform sampler2D shadow;
  uniform vec2 offset;
  varying vec2 v_at;
  float line(float x) { float d = abs(fract(x - 0.5) - 0.5) / fwidth(x); return 1.0 - min(d, 1.0); }
  void main() {
    float fade = 1.0 - smoothstep(0.35, 1.0, length(v_at) / 4.0);
    vec2 p = (v_at + offset) / 0.5;
    float grid = max(line(p.x), line(p.y)) * 0.16;
    vec2 uv = v_at / 3.2 + 0.5;
    float dark = uv.x > 0.0 && uv.x < 1.0 && uv.y > 0.0 && uv.y < 1.0 ? texture2D(shadow, uv).r : 0.0;
    gl_FragColor = vec4(0.16, 0.18, 0.25, max(grid, 0.50 * dark) * fade);
  }`;

class Ground {
  constructor() {
    this.cells = new Float32Array(kCells * kCells);
    this.spare = new Float32Array(kCells * kCells);
    this.bytes = new Uint8Array(kCells * kCells);
    this.texture = new THREE.DataTexture(this.bytes, kCells, kCells, THREE.LuminanceFormat);
    this.texture.minFilter = this.texture.magFilter = THREE.LinearFilter;
    this.material = new THREE.ShaderMaterial({
      vertexShader: kGroundVertex, fragmentShader: kGroundFragment, transparent: true, depthWrite: false,
      extensions: { derivatives: true },
      uniforms: { shadow: { value: this.texture }, offset: { value: new THREE.Vector2() } },
    });
    this.object = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * kGround_m, 2 * kGround_m), this.material);
  }

  /// What is low throws a dark and sharp shadow, what is high a faint one. `add(x, y, height)` is called back.
  shade(each) {
    this.cells.fill(0);
    const size = kCells / (2 * kHalf_m), cells = this.cells;
    each((x, y, height) => {
      const i = Math.floor((x + kHalf_m) * size), j = Math.floor((y + kHalf_m) * size);
      if (i < 0 || j < 0 || i >= kCells || j >= kCells) return;
      const dark = 0.16 + 0.84 / (1 + 40 * height * height);
      if (dark > cells[j * kCells + i]) cells[j * kCells + i] = dark;
    });
    for (let pass = 0; pass < 4; ++pass) { this.blur(cells, this.spare, 1, kCells); this.blur(this.spare, cells, kCells, 1); }
    for (let i = 0; i < cells.length; ++i) this.bytes[i] = 255 * Math.min(1, 1.35 * cells[i]);
    this.texture.needsUpdate = true;
  }

  blur(from, to, step, row) {
    for (let j = 0; j < kCells; ++j)
      for (let i = 0; i < kCells; ++i) {
        const at = j * row + i * step;
        to[at] = 0.25 * ((i > 0 ? from[at - step] : 0) + 2 * from[at] + (i + 1 < kCells ? from[at + step] : 0));
      }
  }
}

