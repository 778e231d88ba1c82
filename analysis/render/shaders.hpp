#pragma once
/// GLSL of the renderer. Camera coordinates throughout: right, up, towards the viewer; metres.

namespace gambeson::shader {

/// Orthographic: clip = P * position.
inline constexpr const char* kSurfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
layout(location = 3) in vec3 extra;  // map, mapped, lit
uniform mat4 P;
out vec3 x, n, plain;
out vec3 e;
void main() {
  x = position; n = normal; plain = color; e = extra;
  gl_Position = P * vec4(position, 1.0);
}
)";

inline constexpr const char* kNothingFragment = R"(#version 330 core
void main() {}
)";

/// Normal towards the viewer and depth, for the ambient occlusion.
inline constexpr const char* kNormalFragment = R"(#version 330 core
in vec3 x, n, plain;
in vec3 e;
out vec4 result;
void main() {
  vec3 m = normalize(gl_FrontFacing ? n : -n);
  result = vec4(m, x.z);
}
)";

/// Light that the sun of the picture, high on the left before the scene, sends to x: 0 in shadow, 1 in full light; the
/// mean over a disc of samples in the order of sunflower seeds makes its edge soft.
inline constexpr const char* kSunlight = R"(
uniform sampler2DShadow sunDepth;
uniform mat4 S;         // camera coordinates to the sun's clip space
uniform float softness; // of the edge, in texture coordinates
float sunlight(vec3 x) {
  vec3 s = 0.5 * (S * vec4(x, 1.0)).xyz + 0.5;
  s.z = min(s.z, 1.0);  // beyond the last surface: in shadow only where one stands before it
  float sum = 0.0;
  for (int i = 0; i < 24; ++i) {
    float r = sqrt((float(i) + 0.5) / 24.0), a = 2.39996323 * float(i);
    sum += texture(sunDepth, vec3(s.xy + softness * r * vec2(cos(a), sin(a)), s.z));
  }
  return sum / 24.0;
}
)";

/// Soft light: sky and floor (hemisphere), key from the upper left, fill from the right, a faint rim. Fields are lit
/// more evenly than plain surfaces, so that their colours stay readable against the bar.
inline constexpr const char* kSurfaceFragment = R"(
in vec3 x, n, plain;
in vec3 e;
uniform sampler2D map;
uniform vec3 up, sun;
uniform float bias;
out vec4 result;
vec3 linearOf(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
vec3 encoded(vec3 c) { return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
void main() {
  bool mapped = e.y > 0.999;
  vec3 base = mapped ? linearOf(texture(map, vec2((e.x * 255.0 + 0.5) / 256.0, 0.5)).rgb) : plain;
  if (e.z < 0.5) { result = vec4(encoded(base), 1.0); return; }
  vec3 m = normalize(gl_FrontFacing ? n : -n);
  vec3 view = vec3(0.0, 0.0, 1.0);
  float wrapped = clamp((dot(m, sun) + 0.25) / 1.25, 0.0, 1.0);
  float key = wrapped * mix(0.45, 1.0, sunlight(x + bias * m));
  float sky = 0.5 + 0.5 * dot(m, up);
  float fill = clamp((dot(m, normalize(vec3(0.85, 0.05, 0.5))) + 0.4) / 1.4, 0.0, 1.0);
  float edge = pow(1.0 - clamp(m.z, 0.0, 1.0), 3.0);
  vec3 light = vec3(1.0, 0.985, 0.96) * 0.76 * key + vec3(0.94, 0.97, 1.0) * (0.28 * sky + 0.20 * fill) + 0.14;
  if (mapped) light = mix(vec3(0.93), light, 0.62);
  if (!gl_FrontFacing) light *= mapped ? 0.90 : 0.80;  // the inside of cloth
  vec3 h = normalize(sun + view);
  float gloss = (mapped ? 0.015 : 0.035) * pow(clamp(dot(m, h), 0.0, 1.0), 22.0);
  vec3 c = base * light * (1.0 - 0.16 * edge) + gloss;
  result = vec4(encoded(clamp(c, 0.0, 1.0)), 1.0);
}
)";

/// The ground: dark only where the sun does not reach, with a faint grid, both fading with the distance from the
/// middle.
inline constexpr const char* kGroundFragment = R"(
in vec3 x, n, plain;
in vec3 e;
uniform vec3 middle;
uniform float radius, edgeOn;
out vec4 result;
void main() {
  float d = length(x - middle) / radius;
  float fade = 1.0 - smoothstep(0.45, 1.0, d);
  float shadow = edgeOn > 0.5 ? 0.0 : 1.0 - sunlight(x);
  vec2 g = e.xy / 0.5, w = fwidth(g) * 0.75;
  vec2 line = 1.0 - smoothstep(vec2(0.0), w + 1e-6, abs(fract(g + 0.5) - 0.5));
  float grid = edgeOn > 0.5 ? 0.35 : 0.15 * max(line.x, line.y);
  float a = fade * max(0.26 * shadow, grid);
  result = vec4(vec3(0.16, 0.18, 0.22) * a, a);
}
)";

/// Arrows: lit, faint where a surface hides them. `normals` is the normal and depth image of the surfaces.
inline constexpr const char* kArrowFragment = R"(#version 330 core
in vec3 x, n, plain;
in vec3 e;
uniform sampler2D normals;
uniform vec2 normalsPerPixel;
uniform vec3 sun;
uniform float soft, legend;
out vec4 result;
vec3 encoded(vec3 c) { return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
void main() {
  vec3 m = normalize(gl_FrontFacing ? n : -n);
  float front = texelFetch(normals, ivec2(gl_FragCoord.xy * normalsPerPixel), 0).w;
  float hidden = legend > 0.5 ? 0.0 : smoothstep(0.0, soft, front - x.z);
  float light = 0.62 + 0.42 * clamp(dot(m, sun), 0.0, 1.0) + 0.12 * m.z;
  float a = mix(1.0, 0.42, hidden);
  result = vec4(encoded(clamp(plain * light, 0.0, 1.0)) * a, a);
}
)";

/// Draws one triangle over the whole image.
inline constexpr const char* kScreenVertex = R"(#version 330 core
void main() {
  vec2 c = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(c, 0.0, 1.0);
}
)";

/// Ambient occlusion from normals and depth: the mean over a disc of max(0, v.n) / |v|^2, as in the obscurance of
/// McGuire et al. 2011, with a fall-off at the radius. The samples turn in tiles of 4 x 4 pixels that the blur
/// removes.
inline constexpr const char* kOcclusionFragment = R"(#version 330 core
uniform sampler2D normals;
uniform float metresPerPixel, radius;
out vec4 result;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy), size = textureSize(normals, 0);
  vec4 c = texelFetch(normals, p, 0);
  if (c.w < -1e8) { result = vec4(1.0); return; }
  float sum = 0.0, turn = float((p.x % 4) * 4 + (p.y % 4)) * 0.3926991;
  for (int i = 0; i < 20; ++i) {
    float r = (float(i) + 0.5) / 20.0, a = 2.39996323 * float(i) + turn;
    vec2 o = r * radius / metresPerPixel * vec2(cos(a), sin(a));
    ivec2 q = clamp(p + ivec2(round(o)), ivec2(0), size - 1);
    vec4 s = texelFetch(normals, q, 0);
    vec3 v = vec3(vec2(q - p) * metresPerPixel, s.w - c.w);
    float v2 = dot(v, v), f = max(0.0, 1.0 - v2 / (radius * radius));
    sum += f * f * max(0.0, dot(v, c.xyz) - 0.012 * radius) / (sqrt(v2) + 0.02 * radius);
  }
  result = vec4(clamp(1.0 - 2.2 * sum / 20.0, 0.0, 1.0));
}
)";

/// The mean over 4 x 4 pixels of the same surface.
inline constexpr const char* kBlurFragment = R"(#version 330 core
uniform sampler2D normals, occlusion;
uniform float radius;
out vec4 result;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy), size = textureSize(normals, 0);
  float depth = texelFetch(normals, p, 0).w, sum = 0.0, weight = 0.0;
  for (int j = -2; j < 2; ++j)
    for (int i = -2; i < 2; ++i) {
      ivec2 q = clamp(p + ivec2(i, j), ivec2(0), size - 1);
      float w = max(1e-4, 1.0 - abs(texelFetch(normals, q, 0).w - depth) / (0.5 * radius));
      sum += w * texelFetch(occlusion, q, 0).r;
      weight += w;
    }
  result = vec4(sum / weight);
}
)";

}  // namespace gambeson::shader
