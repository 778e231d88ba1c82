// Blocks of a page as numbers: base64, deflated, coded by how they change (packed.hpp).

const bytesOfBase64 = text => {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
};

const inflated = async text => {
  const stream = new Blob([bytesOfBase64(text.trim())]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
};

/// p(t, v, c) of packed.hpp; parents: of the vertices.
const unpacked = (buffer, frames, vertices, components, parents) => {
  const bytes = new Uint8Array(buffer), count = frames * vertices * components, out = new Int16Array(count);
  const change = new Int16Array(vertices), row = vertices * components;
  let at = 0;
  for (let c = 0; c < components; ++c)
    for (let t = 0; t < frames; ++t) {
      let i = t * row + c;
      for (let v = 0; v < vertices; ++v, ++at, i += components) {
        const z = bytes[at] | bytes[count + at] << 8, parent = parents[v];
        change[v] = (z >>> 1 ^ -(z & 1)) + (parent >= 0 ? change[parent] : 0);
        out[i] = change[v] + (t > 0 ? out[i - row] : 0);
      }
    }
  return out;
};

/// Corners of triangles, of which each was stored as the change from the one before.
const cornersOf = buffer => {
  const change = new Int32Array(buffer), out = new Uint32Array(change.length);
  let now = 0;
  for (let i = 0; i < change.length; ++i) out[i] = now += change[i];
  return out;
};

