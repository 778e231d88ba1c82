// How things look: cloth from both sides, bodies, arrows, lines. Light is worked out at the vertices, which are dense, and not at the
// pixels, which are many: browsers without a graphics card draw as well.

const kVertex = `
  precision highp float;
  attribute vec3 position, normal;
  attribute float value;
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform mat3 normalMatrix;
  uniform float back_m, coloured, bare, low, high;
  uniform vec3 up;
  varying vec4 v_light;  // of the outside and of the inside, shine of both
  varying vec3 v_value;  // along the colours; whether there is one; how much of it is shown
  const vec3 key = vec3(-0.448, 0.647, 0.617), fill = vec3(0.869, 0.109, 0.482);
  vec2 lit(vec3 n, vec3 eye) {
    float facing = max(dot(n, eye), 0.0), rim = 1.0 - facing;
    float sky = 0.5 + 0.5 * dot(n, up), half_way = max(dot(n, normalize(key + eye)), 0.0);
    float shine = half_way * half_way; shine *= shine; shine *= shine; shine *= shine;
    return vec2(0.56 + 0.20 * sky + 0.28 * max(dot(n, key), 0.0) + 0.09 * max(dot(n, fill), 0.0), 0.10 * rim * rim * rim * sky + 0.06 * shine);
  }
  void main() {
    vec4 at = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * at;
    // Farther away by back_m as far as depth goes: cloth that touches is in front of what it touches.
    gl_Position.z += projectionMatrix[3][2] * back_m / at.z;
    vec3 n = normalize(normalMatrix * normal), eye = normalize(-at.xyz);
    vec2 front = lit(n, eye), behind = lit(-n, eye);
    v_light = vec4(front.x, 0.86 * behind.x, front.y, 0.6 * behind.y);
    float t = (value - low) / (high - low);
    v_value = vec3(t, coloured > 0.5 && value > -1e20 ? 1.0 : 0.0, bare > 0.5 ? 20.0 * value / high : 1.0);
  }`;

const kFragment = `
  precision mediump float;
  uniform vec3 plain;
  uniform sampler2D colors;
  varying vec4 v_light;
  varying vec3 v_value;
  void main() {
    vec2 light = gl_FrontFacing ? v_light.xz : v_light.yw;
    vec3 base = plain;
    if (v_value.y > 0.999) {
      vec3 color = texture2D(colors, vec2(clamp(v_value.x, 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb;
      base = mix(plain, color, clamp(v_value.z, 0.0, 1.0));
    }
    gl_FragColor = vec4(base * light.x + light.y, 1.0);
  }`;

const kPlainVertex = `
  precision highp float;
  attribute vec3 position;
  uniform mat4 modelViewMatrix, projectionMatrix;
  void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;
const kPlainFragment = `
  precision mediump float;
  uniform vec4 color;
  void main() { gl_FragColor = color; }`;

/// `shared`: uniforms that all materials of the page have in common.
const surfaceMaterial = (color, back_m, shared, side = THREE.DoubleSide) => new THREE.RawShaderMaterial({
  vertexShader: kVertex, fragmentShader: kFragment, side,
  uniforms: { ...shared, plain: { value: new THREE.Vector3(...color) }, back_m: { value: back_m }, coloured: { value: 0 }, bare: { value: 0 } },
});

/// One colour with its opacity; `over_all`: in front of everything.
const plainMaterial = (r, g, b, a = 1, over_all = false) => new THREE.RawShaderMaterial({
  vertexShader: kPlainVertex, fragmentShader: kPlainFragment, transparent: a < 1 || over_all, depthTest: !over_all, uniforms: { color: { value: new THREE.Vector4(r, g, b, a) } },
});

const colorTexture = colors => {
  const data = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) data.set([colors[3 * i], colors[3 * i + 1], colors[3 * i + 2], 255], 4 * i);
  const texture = new THREE.DataTexture(data, 256, 1, THREE.RGBAFormat);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
};

