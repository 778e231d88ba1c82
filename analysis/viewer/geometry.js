// What triangles need: neighbours, normals, edges, where a ray meets them.

/// As parentsOf of packed.cpp.
const parentsOf = (vertices, corners) => {
  const parents = new Int32Array(vertices).fill(-1);
  const see = (v, w) => { if (w < v && w > parents[v]) parents[v] = w; };
  for (let i = 0; i < corners.length; i += 3) {
    const a = corners[i], b = corners[i + 1], c = corners[i + 2];
    see(a, b); see(a, c); see(b, a); see(b, c); see(c, a); see(c, b);
  }
  return parents;
};

/// Sums of the normals of the triangles around each vertex, by area, of length 1.
const setNormals = (x, corners, n) => {
  n.fill(0);
  for (let i = 0; i < corners.length; i += 3) {
    const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
    const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
    const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    n[a] += nx; n[a + 1] += ny; n[a + 2] += nz;
    n[b] += nx; n[b + 1] += ny; n[b + 2] += nz;
    n[c] += nx; n[c + 1] += ny; n[c + 2] += nz;
  }
  for (let i = 0; i < n.length; i += 3) {
    const size = Math.sqrt(n[i] * n[i] + n[i + 1] * n[i + 1] + n[i + 2] * n[i + 2]) || 1;
    n[i] /= size; n[i + 1] /= size; n[i + 2] /= size;
  }
};

/// Fewer triangles over the same vertices: those that edges connect within a cube of this side are taken as one of them, so that nothing
/// grows together that only lies side by side. Borders stay, and what is bent sharply: hands and hems. `normals`: of the vertices.
const fewerCorners = (x, normals, corners, cube_m) => {
  const n = x.length / 3, of = new Int32Array(n), cube = new Array(n), alike = 0.8;
  for (let v = 0; v < n; ++v) {
    of[v] = v;
    cube[v] = [0, 1, 2].map(c => Math.floor(x[3 * v + c] / cube_m)).join();
  }
  for (const v of bordersOf(corners, n)) cube[v] = v;
  const bent = (a, b) => normals[3 * a] * normals[3 * b] + normals[3 * a + 1] * normals[3 * b + 1] + normals[3 * a + 2] * normals[3 * b + 2] < alike;
  const find = v => { while (of[v] !== v) v = of[v] = of[of[v]]; return v; };
  for (let i = 0; i < corners.length; ++i) {
    const a = corners[i], b = corners[i % 3 === 2 ? i - 2 : i + 1];
    if (cube[a] !== cube[b]) continue;
    const p = find(a), q = find(b);
    if (bent(p, q)) continue;
    of[Math.max(p, q)] = Math.min(p, q);
  }
  const out = [];
  for (let i = 0; i < corners.length; i += 3) {
    const a = find(corners[i]), b = find(corners[i + 1]), c = find(corners[i + 2]);
    if (a !== b && b !== c && c !== a) out.push(a, b, c);
  }
  return new Uint32Array(out);
};

/// Pairs of vertices: edges of one triangle only.
const bordersOf = (corners, vertices) => {
  const count = new Map();
  for (let i = 0; i < corners.length; i += 3)
    for (let k = 0; k < 3; ++k) {
      const a = corners[i + k], b = corners[i + (k + 1) % 3], key = Math.min(a, b) * vertices + Math.max(a, b);
      count.set(key, (count.get(key) || 0) + 1);
    }
  const out = [];
  for (const [key, times] of count) if (times === 1) out.push(Math.floor(key / vertices), key % vertices);
  return new Uint32Array(out);
};

/// The first meeting of a ray with triangles: {distance, vertex: the corner that is nearest to it}, or null
/// (Moeller and Trumbore 1997).
const firstHit = (from, along, x, corners) => {
  let best = Infinity, hit = null;
  const [ox, oy, oz] = from, [dx, dy, dz] = along;
  for (let i = 0; i < corners.length; i += 3) {
    const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
    const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
    const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const det = ux * px + uy * py + uz * pz;
    if (Math.abs(det) < 1e-14) continue;
    const sx = ox - x[a], sy = oy - x[a + 1], sz = oz - x[a + 2];
    const r = (sx * px + sy * py + sz * pz) / det;
    if (r < 0 || r > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const s = (dx * qx + dy * qy + dz * qz) / det;
    if (s < 0 || r + s > 1) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / det;
    if (!(distance > 1e-6) || distance >= best) continue;
    best = distance;
    const weights = [1 - r - s, r, s], most = weights.indexOf(Math.max(...weights));
    hit = { distance, vertex: corners[i + most] };
  }
  return hit;
};

