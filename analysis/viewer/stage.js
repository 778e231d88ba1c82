// The picture: the runs beside each other, one camera for all of them.

const kBodyBack_m = 0.006, kLayerBack_m = 0.0015, kFieldOfView = 24;
const kManyCorners = 30000, kCubeInPlay_m = 0.02, kCubeIfSlow_m = 0.03, kSlow_ms = 34;
const kAbove = [0xfb, 0xfb, 0xfc], kBelow = [0xe1, 0xe5, 0xeb], kBands = 26;

const kViews = {
  front: [1, 0, 0.12], back: [-1, 0, 0.12], left: [0, 1, 0.12], right: [0, -1, 0.12], top: [0.001, 0, 1],
  front_left: [1, 1, 0.3], front_right: [1, -1, 0.3], back_left: [-1, 1, 0.3], back_right: [-1, -1, 0.3],
  above: [1, -1, 1.41],
};

/// One run in its own scene.
class Actor {
  constructor(run, shared) {
    this.run = run;
    this.scene = new THREE.Scene();
    this.root = new THREE.Group();
    this.root.quaternion.setFromUnitVectors(new THREE.Vector3(...run.head.up), new THREE.Vector3(0, 0, 1));
    this.scene.add(this.root);
    const layers = run.meshesOf('cloth').length;
    let layer = 0;
    for (const mesh of run.meshes) {
      const cloth = mesh.kind === 'cloth';
      const back_m = cloth ? kLayerBack_m * (layers - 1 - layer++) : kBodyBack_m + kLayerBack_m * layers;
      const color = cloth ? mesh.color : mesh.kind === 'body' ? [0.80, 0.755, 0.715] : [0.70, 0.72, 0.75];
      const geometry = new THREE.BufferGeometry();
      geometry.setIndex(new THREE.BufferAttribute(mesh.corners, 1));
      const attribute = (name, array, size) =>
        geometry.setAttribute(name, new THREE.BufferAttribute(array, size).setUsage(THREE.DynamicDrawUsage));
      attribute('position', mesh.x, 3);
      attribute('normal', mesh.n, 3);
      attribute('value', mesh.values, 1);
      // Of closed bodies nobody sees the inside, and browsers without a graphics card draw them in two thirds of the time.
      mesh.object = new THREE.Mesh(geometry, surfaceMaterial(color, back_m, shared, mesh.kind === 'body' ? THREE.FrontSide : THREE.DoubleSide));
      mesh.object.frustumCulled = false;
      mesh.object.matrixAutoUpdate = false;
      this.root.add(mesh.object);
      mesh.shown = true;
    }
    this.shared = shared;
    this.ground = new Ground();
    this.scene.add(this.ground.object);
    this.ground.object.visible = false;
    this.mark = new THREE.Mesh(new THREE.SphereBufferGeometry(0.006, 16, 12), plainMaterial(0.106, 0.122, 0.153, 1, true));
    this.mark.visible = false;
    this.mark.renderOrder = 9;
    this.root.add(this.mark);
    this.stand();
  }

  /// On the ground, as far as the motion is known.
  stand() {
    this.height = this.lowest();
    this.ground.object.position.z = this.height - 0.002;
  }

  /// All frames have come. The ground and the borders of the cloth come only now: what draws them would hold up the first picture.
  complete() {
    this.stand();
    this.ground.object.visible = true;
    for (const mesh of this.run.meshesOf('cloth')) {
      const border = new THREE.BufferGeometry();
      border.setIndex(new THREE.BufferAttribute(bordersOf(mesh.corners, mesh.vertices), 1));
      border.setAttribute('position', mesh.object.geometry.attributes.position);
      mesh.border = new THREE.LineSegments(border, plainMaterial(0.16, 0.18, 0.23, 0.6));
      mesh.border.frustumCulled = false;
      mesh.border.visible = mesh.shown;
      this.root.add(mesh.border);
    }
    for (const mesh of this.run.meshes) {
      if (mesh.kind === 'thing' || mesh.kind === 'body' && mesh.corners.length < kManyCorners) continue;
      const all = mesh.object.geometry.index, body = mesh.kind === 'body';
      const fewer = cube_m => new THREE.BufferAttribute(fewerCorners(mesh.x, mesh.n, mesh.corners, cube_m), 1);
      mesh.indices = { stands: all, plays: body ? fewer(kCubeInPlay_m) : all, slow: fewer(body ? kCubeIfSlow_m : kCubeInPlay_m) };
    }
    if (!this.run.arrows) return;
    this.arrows = new Arrows(this.run.arrows, this.shared);
    this.root.add(this.arrows.object);
  }

  /// Bodies of many triangles have fewer while they move: the cloth is what is looked at. Both have fewer where the browser is slow.
  move(moves, slow) {
    for (const mesh of this.run.meshes)
      if (mesh.indices) {
        const index = mesh.indices[!moves ? 'stands' : slow ? 'slow' : 'plays'];
        mesh.object.geometry.setIndex(index);
        mesh.drawn = index.array;
      }
  }

  /// In the scene's axes: z is up.
  turned(x) { return new THREE.Vector3(...x).applyQuaternion(this.root.quaternion); }

  /// The lowest point of the motion that is on or near bodies.
  lowest() {
    const { run } = this, frames = run.frames(), step = Math.max(1, Math.floor(frames.length / 8));
    let least = Infinity;
    for (const f of frames.filter((_, k) => k % step === 0))
      for (const mesh of run.meshes)
        for (let v = 0; v < mesh.vertices; v += Math.max(1, Math.floor(mesh.vertices / 300))) {
          const height = this.turned(run.position(mesh, v, f)).z;
          if (height < least) least = height;
        }
    return least;
  }

  /// The box of the cloth in a frame, about the origin.
  clothBox(frame) {
    const { run } = this, box = new THREE.Box3(), o = run.head.origin_m[frame];
    for (const mesh of run.meshesOf('cloth'))
      for (let v = 0; v < mesh.vertices; v += 3)
        box.expandByPoint(this.turned(run.position(mesh, v, frame).map((x, c) => x - o[c])));
    return box;
  }

  /// `field`: that of this run, or null; `scale_m_per_N`: of arrows; `forces`: whether they are shown.
  show(time, field, scale_m_per_N, forces) {
    const { run } = this, at = run.at(time), onBody = field && field.on === 'body';
    for (const mesh of run.meshes) {
      const coloured = field && field.on === mesh.kind;
      mesh.object.visible = mesh.shown && !(onBody && mesh.kind === 'cloth');
      if (mesh.border) mesh.border.visible = mesh.shown;
      mesh.object.material.uniforms.coloured.value = coloured ? 1 : 0;
      mesh.object.material.uniforms.bare.value = field && field.bare ? 1 : 0;
      if (!mesh.shown) continue;
      const { attributes } = mesh.object.geometry;
      if (mesh.codes) {
        run.place(mesh, at);
        attributes.position.needsUpdate = attributes.normal.needsUpdate = true;
      } else {
        const r = run.placed(mesh, at);
        mesh.object.matrix.set(...r, 0, 0, 0, 1);
        mesh.object.visible = mesh.object.visible && Math.hypot(r[0], r[4], r[8]) > 1e-6;
      }
      if (coloured) {
        run.colour(field, mesh, at);
        attributes.value.needsUpdate = true;
      }
    }
    if (this.arrows) {
      this.arrows.object.visible = forces;
      if (forces) this.arrows.show(run.nearestFrame(time), scale_m_per_N);
    }
    const origin = this.turned(run.originAt(at));
    this.ground.stand(origin.x, origin.y);
    this.shade();
    this.time = time;
    if (this.marked) this.setMark(this.marked);
  }

  shade() {
    const e = this.root.matrixWorld.elements, p = new THREE.Vector3();
    this.ground.shade(put => {
      for (const mesh of this.run.meshes) {
        if (!mesh.shown || mesh.kind === 'thing') continue;
        const step = Math.max(1, Math.floor(mesh.vertices / 2500)), m = mesh.object.matrix;
        for (let v = 0; v < mesh.vertices; v += step) {
          p.set(mesh.x[3 * v], mesh.x[3 * v + 1], mesh.x[3 * v + 2]);
          if (mesh.places) p.applyMatrix4(m);
          const x = e[0] * p.x + e[4] * p.y + e[8] * p.z, y = e[1] * p.x + e[5] * p.y + e[9] * p.z;
          put(x, y, e[2] * p.x + e[6] * p.y + e[10] * p.z - this.height);
        }
      }
    });
  }

  setMark(marked) {
    this.marked = marked;
    this.mark.visible = !!marked && marked.mesh.shown;
    if (!marked) return;
    const { mesh, vertex } = marked;
    this.mark.position.set(...mesh.x.slice(3 * vertex, 3 * vertex + 3));
    if (mesh.places) this.mark.position.applyMatrix4(mesh.object.matrix);
  }

  /// As large from everywhere.
  sizeMark(camera) {
    if (!this.mark.visible) return;
    const far = this.mark.getWorldPosition(new THREE.Vector3()).distanceTo(camera.position);
    this.mark.scale.setScalar(0.5 * far);
  }

  /// What a ray in the scene's axes meets first of what is to be seen: {mesh, vertex}, or null.
  pick(ray) {
    const inverse = new THREE.Matrix4();
    let best = null;
    for (const mesh of this.run.meshes) {
      if (!mesh.object.visible) continue;
      inverse.getInverse(mesh.object.matrixWorld);
      const local = ray.clone().applyMatrix4(inverse);
      const hit = firstHit(local.origin.toArray(), local.direction.toArray(), mesh.x, mesh.corners);
      // Cloth lies in front of what it touches, as it is drawn.
      const back = hit ? hit.distance + mesh.object.material.uniforms.back_m.value : Infinity;
      if (hit && (!best || back < best.back)) best = { mesh, vertex: hit.vertex, back };
    }
    return best;
  }
}

class Stage {
  constructor(canvas, runs, colors) {
    this.canvas = canvas;
    this.shared = { colors: { value: colorTexture(colors) }, low: { value: 0 }, high: { value: 1 }, up: { value: new THREE.Vector3(0, 1, 0) } };
    this.actors = runs.map(run => new Actor(run, this.shared));
    this.camera = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.05, 60);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.controls.enableZoom = false;
    this.controls.minDistance = 0.25;
    this.controls.maxDistance = 14;
    this.controls.rotateSpeed = 0.7;
    this.controls.addEventListener('change', () => this.draw());
  }

  /// From here on it draws; false where the browser has no WebGL.
  begin() {
    const { canvas } = this, context = canvas.getContext('webgl', { antialias: false, alpha: false });
    if (!context) return false;
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.autoClear = false;
    return true;
  }

  /// Where the runs stand in the picture: [x, y, width, height] of each, from the lower left.
  places() {
    const { clientWidth: w, clientHeight: h } = this.canvas, n = this.actors.length;
    const columns = n > 3 && w < 620 ? 2 : n, rows = Math.ceil(n / columns);
    return this.actors.map((_, k) => {
      const c = k % columns, r = Math.floor(k / columns);
      return [w * c / columns, h * (rows - 1 - r) / rows, w / columns, h / rows];
    });
  }

  resize() {
    this.sharpness = 0;
    this.draw();
  }

  /// Pixels of the picture for each of the page: what stands is drawn with four times as many, which smooths its edges; what moves
  /// with no more than the browser keeps up with.
  sharpen(ratio) {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    if (this.sharpness === ratio || !(w > 0 && h > 0)) return;
    this.sharpness = ratio;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(w, h, false);
  }

  plainRatio() { return Math.min(window.devicePixelRatio || 1, 2); }
  fineRatio() { return Math.max(2, this.plainRatio()); }

  /// How fast pictures follow each other while they move: smooth ones where there is time for them.
  pace(now) {
    const took = now - (this.before || 0);
    this.before = now;
    if (took > 250) return;
    this.mean = 0.9 * (this.mean || 17) + 0.1 * took;
    this.paced = (this.paced || 0) + 1;
    this.slow = this.slow || this.playing && this.mean > kSlow_ms;
    if (this.smooth && this.mean > 24) { this.smooth = false; this.tried = (this.tried || 0) + 1; this.paced = 0; }
    if (!this.smooth && this.paced > 30 && this.mean < 18 && (this.tried || 0) < 2) { this.smooth = true; this.paced = 0; }
  }

  /// Not before the next picture of the browser, and once for all that changed.
  draw() {
    if (this.waiting || !this.renderer) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.drawNow(); });
  }

  drawNow() {
    this.pace(performance.now());
    this.paint(this.smooth ? this.fineRatio() : this.plainRatio());
    clearTimeout(this.rest);
    // Not while it plays: a browser that is slow would make its picture anew for each frame.
    if (!this.playing) this.rest = setTimeout(() => { if (!this.waiting) this.paint(this.fineRatio()); }, 220);
  }

  /// Bands from above to below, each one step of a screen's colours: they cost nothing, while a background that shines through the
  /// picture is blended into every frame.
  clear() {
    const { renderer } = this, { clientWidth: w, clientHeight: h } = this.canvas, color = new THREE.Color();
    renderer.setScissorTest(false);
    renderer.clear(false, true, true);
    renderer.setScissorTest(true);
    for (let k = 0; k < kBands; ++k) {
      color.setRGB(...kBelow.map((c, i) => (c + (kAbove[i] - c) * k / (kBands - 1)) / 255));
      renderer.setClearColor(color, 1);
      renderer.setScissor(0, Math.floor(h * k / kBands), w, Math.ceil(h / kBands) + 1);
      renderer.clear(true, false, false);
    }
  }

  paint(ratio) {
    this.sharpen(ratio);
    const { renderer, camera } = this;
    this.clear();
    this.places().forEach(([x, y, w, h], k) => {
      renderer.setViewport(x, y, w, h);
      renderer.setScissor(x, y, w, h);
      camera.aspect = w / h;
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
      this.shared.up.value.set(0, 0, 1).transformDirection(camera.matrixWorldInverse);
      this.actors[k].sizeMark(camera);
      renderer.render(this.actors[k].scene, camera);
    });
    this.drawn = (this.drawn || 0) + 1;
  }

  /// The camera looks along a named view at the cloth of the frame that is shown; with `whole` at wearers from head to foot.
  view(name, frameOf) {
    const box = new THREE.Box3();
    for (const actor of this.actors) box.union(actor.clothBox(frameOf(actor.run)));
    const size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
    const [, , w, h] = this.places()[0], direction = new THREE.Vector3(...(kViews[name] || kViews.front_right)).normalize();
    const wide = Math.hypot(size.x, size.y), half = Math.tan(kFieldOfView * Math.PI / 360);
    const distance = Math.max(0.62 * size.z / half, 0.56 * wide / (half * w / h), 0.6) + 0.5 * Math.min(size.x, size.y);
    this.go(middle, middle.clone().addScaledVector(direction, distance));
  }

  /// Near the vertex, from where the cloth faces away from its wearer.
  closeUp(actor, mesh, vertex) {
    const at = new THREE.Vector3(...mesh.x.slice(3 * vertex, 3 * vertex + 3));
    if (mesh.places) at.applyMatrix4(mesh.object.matrix);
    at.applyMatrix4(actor.root.matrixWorld);
    const away = new THREE.Vector3(...mesh.n.slice(3 * vertex, 3 * vertex + 3));
    if (mesh.places) away.transformDirection(mesh.object.matrix);
    away.transformDirection(actor.root.matrixWorld);
    const axis = new THREE.Vector3(at.x, at.y, 0);
    if (axis.length() > 0.05 && away.dot(axis) < 0) away.negate();
    away.z = Math.max(-0.3, Math.min(0.6, away.z + 0.15));
    if (away.length() < 0.2) away.copy(axis);
    this.go(at, at.clone().addScaledVector(away.normalize(), 1.2));
  }

  /// In a quarter of a second, or at once where motion is not wanted.
  go(target, position) {
    const quick = !this.drawn || window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    const from = [this.controls.target.clone(), this.camera.position.clone()], start = performance.now();
    this.trip = (this.trip || 0) + 1;
    const trip = this.trip;
    const step = () => {
      if (trip !== this.trip) return;
      const s = quick ? 1 : Math.min(1, (performance.now() - start) / 280), ease = s * s * (3 - 2 * s);
      this.travels = s < 1;
      this.controls.target.lerpVectors(from[0], target, ease);
      // About the target, so that a turn to the other side does not pass through the wearer.
      const a = new THREE.Spherical().setFromVector3(this.turnedUp(from[1].clone().sub(from[0])));
      const b = new THREE.Spherical().setFromVector3(this.turnedUp(position.clone().sub(target)));
      const turn = Math.atan2(Math.sin(b.theta - a.theta), Math.cos(b.theta - a.theta));
      const now = new THREE.Spherical(a.radius + ease * (b.radius - a.radius), a.phi + ease * (b.phi - a.phi), a.theta + ease * turn);
      const v = new THREE.Vector3().setFromSpherical(now);
      this.camera.position.set(v.x, -v.z, v.y).add(this.controls.target);
      this.controls.update();
      this.draw();
      if (s < 1) requestAnimationFrame(step);
    };
    step();
  }

  /// Spherical coordinates of three.js are about y.
  turnedUp(v) { return new THREE.Vector3(v.x, v.z, -v.y); }

  /// Turns by angles, moves nearer: for keys.
  turn(around, over, nearer) {
    const s = new THREE.Spherical().setFromVector3(this.turnedUp(this.camera.position.clone().sub(this.controls.target)));
    s.theta += around;
    s.phi = Math.max(0.05, Math.min(Math.PI - 0.05, s.phi + over));
    s.radius = Math.max(this.controls.minDistance, Math.min(this.controls.maxDistance, s.radius * nearer));
    const v = new THREE.Vector3().setFromSpherical(s);
    this.camera.position.set(v.x, -v.z, v.y).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  /// What is seen at a place of the canvas [CSS pixels from its upper left]: {actor, mesh, vertex}, or null.
  pick(x, y) {
    const height = this.canvas.clientHeight, places = this.places();
    const k = places.findIndex(([px, py, w, h]) => x >= px && x < px + w && height - y >= py && height - y < py + h);
    if (k < 0) return null;
    const [px, py, w, h] = places[k];
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(2 * (x - px) / w - 1, 2 * (height - y - py) / h - 1), this.camera);
    this.actors[k].scene.updateMatrixWorld();
    const hit = this.actors[k].pick(caster.ray);
    return hit && { actor: this.actors[k], mesh: hit.mesh, vertex: hit.vertex };
  }

  /// Where a vertex stands in the canvas, for tests and for what is shown beside it.
  onCanvas(actor, mesh, vertex) {
    const at = new THREE.Vector3(...mesh.x.slice(3 * vertex, 3 * vertex + 3));
    if (mesh.places) at.applyMatrix4(mesh.object.matrix);
    actor.scene.updateMatrixWorld();
    at.applyMatrix4(actor.root.matrixWorld);
    const [px, py, w, h] = this.places()[this.actors.indexOf(actor)];
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    at.project(this.camera);
    return [px + (at.x + 1) / 2 * w, this.canvas.clientHeight - py - (at.y + 1) / 2 * h];
  }
}

