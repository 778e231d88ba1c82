// How things look: cloth from both sides, bodies, arrows, the ground.

const kVertex = `
  attribute float value;
  uniform float back_m;
  varying float v_value;
  varying vec3 v_normal, v_at;
  void main() {
    vec4 at = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * at;
    // Farther away by back_m as far as depth goes: cloth that touches is in front of what it touches.
    vec4 behind = projectionMatrix * vec4(at.xyz * (1.0 + back_m / length(at.xyz)), 1.0);
    gl_Position.z = behind.z / behind.w * gl_Position.w;
    v_value = value;
    v_normal = normalMatrix * normal;
    v_at = at.xyz;
  }`;

const kFragment = `
  uniform vec3 plain;
  uniform sampler2D colors;
  uniform float low, high, coloured, sheen;
  uniform vec3 up;
  varying float v_value;
  varying vec3 v_normal, v_at;
  vec3 linear(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }
  void main() {
    vec3 n = normalize(v_normal), eye = normalize(-v_at);
    float inside = 1.0;
    if (dot(n, eye) < 0.0) { n = -n; }
    if (!gl_FrontFacing) inside = 0.82;
    vec3 base = plain;
    if (coloured > 0.5 && v_value > -1e20)
      base = texture2D(colors, vec2(clamp((v_value - low) / (high - low), 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb;
    base = linear(base) * inside;
    float key = max(dot(n, normalize(vec3(-0.45, 0.65, 0.62))), 0.0);
    float fill = max(dot(n, normalize(vec3(0.8, 0.1, 0.45))), 0.0);
    float sky = 0.5 + 0.5 * dot(n, up);
    float rim = pow(1.0 - max(dot(n, eye), 0.0), 3.0);
    float shine = pow(max(dot(n, normalize(normalize(vec3(-0.45, 0.65, 0.62)) + eye)), 0.0), 28.0);
    vec3 c = base * (0.30 + 0.34 * sky + 0.52 * key + 0.16 * fill) + vec3(0.10 * rim * (0.3 + 0.7 * sky) + sheen * shine);
    gl_FragColor = vec4(pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
  }`;

/// `shared`: uniforms that all materials of the page have in common.
const surfaceMaterial = (color, back_m, sheen, shared) => new THREE.ShaderMaterial({
  vertexShader: kVertex, fragmentShader: kFragment, side: THREE.DoubleSide,
  uniforms: { ...shared, plain: { value: new THREE.Vector3(...color) }, back_m: { value: back_m }, coloured: { value: 0 },
              sheen: { value: sheen } },
});

const colorTexture = colors => {
  const data = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) data.set([colors[3 * i], colors[3 * i + 1], colors[3 * i + 2], 255], 4 * i);
  const texture = new THREE.DataTexture(data, 256, 1, THREE.RGBAFormat);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
};

