// Contact forces as arrows that end where they push.

const kSides = 7, kShaft = 0.02, kHead = 0.15;  // of the longest arrow

class Arrows {
  constructor(arrows, shared) {
    this.arrows = arrows;
    const most = Math.max(1, ...arrows.counts), points = 3 * kSides + 1;
    this.points = points;
    this.geometry = new THREE.BufferGeometry();
    this.x = new Float32Array(3 * points * most);
    this.n = new Float32Array(3 * points * most);
    const corners = [];
    for (let a = 0; a < most; ++a)
      for (let k = 0; k < kSides; ++k) {
        const at = a * points, next = (k + 1) % kSides, ring = r => at + r * kSides + k, beside = r => at + r * kSides + next;
        corners.push(ring(0), beside(0), ring(1), beside(0), beside(1), ring(1));
        corners.push(ring(2), beside(2), at + 3 * kSides);
      }
    this.geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(corners), 1));
    this.geometry.setAttribute('position', new THREE.BufferAttribute(this.x, 3).setUsage(THREE.DynamicDrawUsage));
    this.geometry.setAttribute('normal', new THREE.BufferAttribute(this.n, 3).setUsage(THREE.DynamicDrawUsage));
    this.object = new THREE.Mesh(this.geometry, surfaceMaterial([0.80, 0.08, 0.10], 0, shared));
    this.object.frustumCulled = false;
  }

  /// `m_per_N`: common to all runs of the page.
  show(frame, m_per_N) {
    const { data, begin, longest_m } = this.arrows, P = this.points, shaft_m = kShaft * longest_m;
    const count = begin[frame + 1] - begin[frame];
    const d = new THREE.Vector3(), u = new THREE.Vector3(), w = new THREE.Vector3();
    for (let a = 0; a < count; ++a) {
      const i = 6 * (begin[frame] + a);
      d.set(data[i + 3], data[i + 4], data[i + 5]);
      const length = d.length() * m_per_N, head = Math.min(kHead * longest_m, 0.6 * length);
      d.normalize();
      u.set(Math.abs(d.x) < 0.6 ? 1 : 0, Math.abs(d.x) < 0.6 ? 0 : 1, 0).cross(d).normalize();
      w.crossVectors(d, u);
      const put = (at, back, radius, cos, sin) => {
        for (let c = 0; c < 3; ++c) {
          const side = cos * u.getComponent(c) + sin * w.getComponent(c), tip = data[i + c];
          this.x[3 * at + c] = tip - back * d.getComponent(c) + radius * side;
          this.n[3 * at + c] = side;
        }
      };
      for (let k = 0; k < kSides; ++k) {
        const cos = Math.cos(2 * Math.PI * k / kSides), sin = Math.sin(2 * Math.PI * k / kSides);
        put(a * P + k, length, shaft_m, cos, sin);
        put(a * P + kSides + k, head, shaft_m, cos, sin);
        put(a * P + 2 * kSides + k, head, 0.36 * head, cos, sin);
      }
      put(a * P + 3 * kSides, 0, 0, 0, 0);
      for (let c = 0; c < 3; ++c) this.n[3 * (a * P + 3 * kSides) + c] = d.getComponent(c);
    }
    this.geometry.setDrawRange(0, 9 * kSides * count);
    this.geometry.attributes.position.needsUpdate = this.geometry.attributes.normal.needsUpdate = true;
  }
}

