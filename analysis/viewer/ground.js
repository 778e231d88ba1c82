// The ground: a grid of half metres that fades out, and the soft shadow of what stands on it.

const kCells = 48, kHalf_m = 1.2, kGrid_m = 0.5, kReach = 6;

const kShadowVertex = `
  precision highp float;
  attribute vec3 position;
  uniform mat4 modelViewMatrix, projectionMatrix;
  varying vec2 v_at;
  void main() { v_at = position.xy / 2.4 + 0.5; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;
const kShadowFragment = `
  precision mediump float;
  uniform sampler2D shadow;
  varying vec2 v_at;
  void main() { gl_FragColor = vec4(0.13, 0.15, 0.22, 0.5 * texture2D(shadow, v_at).r); }`;

const kGridVertex = `
  precision highp float;
  attribute vec3 position;
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform vec2 offset;
  varying float v_fade;
  void main() {
    vec3 at = vec3(position.xy - offset, position.z);
    v_fade = 1.0 - smoothstep(0.9, 2.9, length(at.xy));
    gl_Position = projectionMatrix * modelViewMatrix * vec4(at, 1.0);
  }`;
const kGridFragment = `
  precision mediump float;
  varying float v_fade;
  void main() { gl_FragColor = vec4(0.42, 0.46, 0.55, 0.34 * v_fade); }`;

class Ground {
  constructor() {
    this.cells = new Float32Array(kCells * kCells);
    this.spare = new Float32Array(kCells * kCells);
    this.bytes = new Uint8Array(kCells * kCells);
    this.texture = new THREE.DataTexture(this.bytes, kCells, kCells, THREE.LuminanceFormat);
    this.texture.minFilter = this.texture.magFilter = THREE.LinearFilter;
    const raw = (vertexShader, fragmentShader, uniforms) =>
      new THREE.RawShaderMaterial({ vertexShader, fragmentShader, uniforms, transparent: true, depthWrite: false });
    const shadow = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * kHalf_m, 2 * kHalf_m), raw(kShadowVertex, kShadowFragment, { shadow: { value: this.texture } }));
    this.offset = new THREE.Vector2();
    const lines = [];
    // In pieces, so that they can fade out along their length.
    for (let i = -kReach; i <= kReach; ++i)
      for (let j = -kReach; j < kReach; ++j) {
        const a = kGrid_m * i, b = kGrid_m * j, c = kGrid_m * (j + 1);
        lines.push(a, b, 0, a, c, 0, b, a, 0, c, a, 0);
      }
    const grid = new THREE.BufferGeometry();
    grid.setAttribute('position', new THREE.BufferAttribute(new Float32Array(lines), 3));
    this.grid = new THREE.LineSegments(grid, raw(kGridVertex, kGridFragment, { offset: { value: this.offset } }));
    this.object = new THREE.Group();
    shadow.renderOrder = 1;
    this.grid.frustumCulled = shadow.frustumCulled = false;
    this.object.add(this.grid, shadow);
  }

  /// The lines stay where they are in the world, under a wearer who moves on.
  stand(x, y) { this.offset.set(x - kGrid_m * Math.floor(x / kGrid_m), y - kGrid_m * Math.floor(y / kGrid_m)); }

  /// What is low throws a dark and sharp shadow, what is high a faint one. `each` calls back with x, y and height.
  shade(each) {
    this.cells.fill(0);
    const size = kCells / (2 * kHalf_m), cells = this.cells;
    each((x, y, height) => {
      const i = Math.floor((x + kHalf_m) * size), j = Math.floor((y + kHalf_m) * size);
      if (i < 2 || j < 2 || i >= kCells - 2 || j >= kCells - 2) return;
      const dark = 0.16 + 0.84 / (1 + 40 * height * height);
      if (dark > cells[j * kCells + i]) cells[j * kCells + i] = dark;
    });
    for (let pass = 0; pass < 3; ++pass) { this.blur(cells, this.spare, 1, kCells); this.blur(this.spare, cells, kCells, 1); }
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

