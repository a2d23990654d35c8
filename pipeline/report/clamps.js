// Clamps in the preview: the YAML of a clamp where the reader clicks on a link, and clamps that are dragged over the surfaces of
// links. Length and clearance are computed over the whole program. Lengths in metres, poses in a link's frame.
const leastSlack = .02, mostSlack = 1 / 3, clearanceMoments = 60;

// Distance of a point to a triangle: to its plane if the foot of the perpendicular lies inside, else to its sides.
function distanceToTriangle(point, a, b, c) {
  const ab = b.clone().sub(a), ac = c.clone().sub(a), normal = ab.clone().cross(ac), area = normal.length();
  if (area > 1e-12) {
    normal.divideScalar(area);
    const ap = point.clone().sub(a), height = ap.dot(normal), foot = ap.addScaledVector(normal, -height);
    const u = foot.clone().cross(ac).dot(normal) / area, v = ab.clone().cross(foot).dot(normal) / area;
    if (u >= 0 && v >= 0 && u + v <= 1) return {distance: Math.abs(height), nearest: point.clone().addScaledVector(normal, -height)};
  }
  return [[a, b], [b, c], [c, a]].map(([from, to]) => distanceToLine(point, from, to)).sort((x, y) => x.distance - y.distance)[0];
}
function distanceToLine(point, from, to) {
  const along = to.clone().sub(from), square = along.lengthSq();
  const share = square > 0 ? Math.min(Math.max(point.clone().sub(from).dot(along) / square, 0), 1) : 0;
  const nearest = from.clone().addScaledVector(along, share);
  return {distance: nearest.distanceTo(point), nearest};
}

// The shape of a link, to which points have a distance (below 0 inside a capsule or box); a mesh is a surface without an inside.
class Solid {
  constructor(shape) {
    this.shape = shape;
    if (shape.kind === 'capsule') {
      this.begin = new THREE.Vector3(...shape.from);
      this.end = new THREE.Vector3(...shape.to);
      this.centre = this.begin.clone().add(this.end).multiplyScalar(.5);
      this.reach = this.begin.distanceTo(this.end) / 2 + shape.radius;
      return;
    }
    this.frame = new THREE.Matrix4().compose(
        new THREE.Vector3(...shape.position), new THREE.Quaternion(...shape.quaternion), new THREE.Vector3(1, 1, 1));
    this.centre = new THREE.Vector3(...shape.position);
    if (shape.kind === 'box') {
      this.half = new THREE.Vector3(...shape.sides).multiplyScalar(.5);
      this.inverse = new THREE.Matrix4().getInverse(this.frame);
      this.reach = this.half.length();
      return;
    }
    const numbers = wholeNumbers(shape.triangles);
    this.corners = [];
    const box = new THREE.Box3();
    for (let i = 0; i < numbers.length; i += 3) {
      const corner = new THREE.Vector3(...[0, 1, 2].map(k => shape.low + shape.step * numbers[i + k])).applyMatrix4(this.frame);
      this.corners.push(corner);
      box.expandByPoint(corner);
    }
    const ball = box.getBoundingSphere(new THREE.Sphere());
    this.centre = ball.center;
    this.reach = ball.radius;
  }
  // Returns {distance, nearest} of a point in the link's frame.
  near(point) {
    if (this.shape.kind === 'capsule') {
      const axis = distanceToLine(point, this.begin, this.end), out = point.clone().sub(axis.nearest);
      if (out.lengthSq() === 0) out.set(1, 0, 0);
      return {distance: axis.distance - this.shape.radius, nearest: axis.nearest.addScaledVector(out.normalize(), this.shape.radius)};
    }
    if (this.shape.kind === 'box') {
      const local = point.clone().applyMatrix4(this.inverse), nearest = local.clone().clamp(this.half.clone().negate(), this.half);
      let distance = nearest.distanceTo(local);
      if (distance === 0) {  // inside: the nearest side decides
        const axis = ['x', 'y', 'z'].sort((a, b) => Math.abs(local[b]) - this.half[b] - Math.abs(local[a]) + this.half[a])[0];
        distance = Math.abs(local[axis]) - this.half[axis];
        nearest[axis] = Math.sign(local[axis] || 1) * this.half[axis];
      }
      return {distance, nearest: nearest.applyMatrix4(this.frame)};
    }
    let best = {distance: Infinity, nearest: this.centre.clone()};
    for (let i = 0; i + 2 < this.corners.length; i += 3) {
      const one = distanceToTriangle(point, this.corners[i], this.corners[i + 1], this.corners[i + 2]);
      if (one.distance < best.distance) best = one;
    }
    return best;
  }
}

// Returns the distance to the nearest shape; skips shapes that are farther than `limit`.
function nearestOf(solids, point, limit = Infinity) {
  let best = {distance: limit, nearest: null};
  for (const solid of solids) {
    if (point.distanceTo(solid.centre) - solid.reach > best.distance) continue;
    const one = solid.near(point);
    if (one.distance < best.distance) best = one;
  }
  return best;
}

class Clamps {
  constructor(viewer, scene, motion, panel) {
    Object.assign(this, {viewer, scene, motion, panel, dragged: null});
    this.solids = scene.links.map(link => link.shapes.map(shape => new Solid(shape)));
    this.clamps = scene.clamps.map((clamp, k) => ({
                                     ...clamp,
                                     group: viewer.clampGroups[k],
                                     position: new THREE.Vector3(...clamp.position),
                                     direction: new THREE.Vector3(...clamp.direction),
                                     bracketMesh: null
                                   }));
    this.rings = scene.rings.map(ring => ({...ring, position: new THREE.Vector3(...ring.position), bracketMesh: null}));
    for (const one of [...this.clamps, ...this.rings]) this.drawBracket(one);
    this.chosen = 0;
    this.listen();
    this.poses = this.findPoses();
    if (this.clamps.length) this.show();
  }
  findPoses() {
    const positions = this.motion.group('link_positions'), turns = this.motion.group('link_quaternions'), poses = [];
    if (!positions) return poses;
    for (const time of this.motion.time) {
      const row = this.motion.goTo(time);
      poses.push({
        time: this.motion.data.begin + time,
        links: this.scene.links.map((link, k) => {
          const p = positions.begin + 3 * k, q = turns.begin + 4 * k;
          return new THREE.Matrix4().compose(
              new THREE.Vector3(row[p], row[p + 1], row[p + 2]),
              new THREE.Quaternion(row[q + 1], row[q + 2], row[q + 3], row[q]).normalize(), new THREE.Vector3(1, 1, 1));
        })
      });
    }
    return poses;
  }

  // ---- position of the pointer ----
  // Returns {link, position, normal} on the shapes of the links, in the link's frame; null: none.
  surfaceAt(x, y) {
    const shapes = [];
    this.viewer.links.forEach((group, link) => group.children.forEach(part => {
      if (part.userData.shape) shapes.push(Object.assign(part, {link}));
    }));
    const [hit] = this.viewer.ray(x, y).intersectObjects(shapes);
    if (!hit) return null;
    const group = this.viewer.links[hit.object.link], inverse = new THREE.Matrix4().getInverse(group.matrixWorld);
    const normal = hit.face.normal.clone().transformDirection(hit.object.matrixWorld);
    if (normal.dot(this.viewer.camera.position.clone().sub(hit.point)) < 0) normal.negate();
    const position = hit.point.clone().applyMatrix4(inverse), shape = hit.object.userData.shape;
    normal.transformDirection(inverse);
    if (shape.kind === 'capsule') {  // The drawn faces are plane and lie up to 2 % of the radius inside the capsule.
      const solid = new Solid(shape), axis = distanceToLine(position, solid.begin, solid.end).nearest;
      normal.subVectors(position, axis).normalize();
      position.copy(axis).addScaledVector(normal, shape.radius);
    }
    return {link: hit.object.link, position, normal};
  }
  clampAt(x, y) {
    const rings = this.clamps.flatMap((clamp, k) => clamp.group.children.filter(part => part.isMesh).map(part => Object.assign(part, {clamp: k})));
    const [hit] = this.viewer.ray(x, y).intersectObjects(rings);
    return hit ? hit.object.clamp : -1;
  }

  // ---- a clamp at a place ----
  // On a surface the hose lies on it, parallel to it, toward the dresspack's next clamp.
  placed(clamp, surface) {
    const position = surface.position.clone().addScaledVector(surface.normal, clamp.radius);
    const frames = this.viewer.links, here = position.clone().applyMatrix4(frames[surface.link].matrixWorld);
    const [before, after] = this.neighbours(clamp);
    const toward = new THREE.Vector3();
    for (const [other, sign] of [[after, 1], [before, -1]])
      if (other) toward.addScaledVector(other.position.clone().applyMatrix4(frames[other.link].matrixWorld).sub(here).normalize(), sign);
    const direction = toward.transformDirection(new THREE.Matrix4().getInverse(frames[surface.link].matrixWorld));
    direction.addScaledVector(surface.normal, -direction.dot(surface.normal));
    if (direction.lengthSq() < 1e-6) direction.set(surface.normal.y, surface.normal.z, surface.normal.x).cross(surface.normal);
    return {link: surface.link, position, direction: direction.normalize()};
  }
  ofDresspack(clamp) {
    return this.clamps.filter(other => other.dresspack === clamp.dresspack).sort((a, b) => a.at - b.at);
  }
  neighbours(clamp) {
    const all = this.ofDresspack(clamp), k = all.indexOf(clamp);
    return [all[k - 1] || null, all[k + 1] || null];
  }
  move(clamp, place) {
    Object.assign(clamp, place);
    this.viewer.links[place.link].add(clamp.group);
    directed(clamp.group, place.position.toArray(), place.direction.toArray());
    this.drawBracket(clamp);
    this.viewer.dirty = true;
  }
  drawBracket(clamp) {
    if (clamp.bracketMesh) clamp.bracketMesh.parent.remove(clamp.bracketMesh);
    clamp.bracketMesh = null;
    const foot = nearestOf(this.solids[clamp.link] || [], clamp.position);
    clamp.bracket = foot.nearest ? Math.max(0, foot.distance) : NaN;
    if (!foot.nearest || !(clamp.bracket > 1e-4)) return;
    const tooLong = clamp.bracket - clamp.radius > clamp.most_bracket;
    const length = foot.nearest.distanceTo(clamp.position);
    const rod = new THREE.Mesh(
        new THREE.CylinderBufferGeometry(.012, .012, length, 10),
        new THREE.MeshLambertMaterial({color: tooLong ? 0xd32f00 : 0x6c757d}));
    rod.position.copy(foot.nearest).add(clamp.position).multiplyScalar(.5);
    rod.quaternion.setFromUnitVectors(
        new THREE.Vector3(0, 1, 0), clamp.position.clone().sub(foot.nearest).normalize());
    this.viewer.links[clamp.link].add(rod);
    clamp.bracketMesh = rod;
  }

  // ---- consequences for the program ----
  // For each piece of the dresspack: least and largest distance of its clamps over the program, and suitable lengths.
  lengths(clamp) {
    const all = this.ofDresspack(clamp), pieces = [];
    for (let k = 0; k + 1 < all.length; ++k) {
      const [from, to] = [all[k], all[k + 1]], length = to.at - from.at;
      let least = Infinity, most = 0, when = 0;
      for (const pose of this.poses) {
        const apart = from.position.clone().applyMatrix4(pose.links[from.link]).distanceTo(to.position.clone().applyMatrix4(pose.links[to.link]));
        least = Math.min(least, apart);
        if (apart > most) [most, when] = [apart, pose.time];
      }
      pieces.push({from: from.name, to: to.name, length, least, most, when, low: most / (1 - leastSlack), high: most / (1 - mostSlack)});
    }
    return pieces;
  }
  // Returns the least distance over the program between the hose at this clamp and links other than the clamp's own link.
  clearance(clamp) {
    let best = {distance: Infinity, link: '', time: 0};
    const step = Math.max(1, Math.floor(this.poses.length / clearanceMoments));
    for (let k = 0; k < this.poses.length; k += step) {
      const pose = this.poses[k], at = clamp.position.clone().applyMatrix4(pose.links[clamp.link]);
      this.solids.forEach((solids, link) => {
        if (link === clamp.link) return;
        const local = at.clone().applyMatrix4(new THREE.Matrix4().getInverse(pose.links[link]));
        const near = nearestOf(solids, local, best.distance + clamp.radius);
        if (near.nearest && near.distance - clamp.radius < best.distance)
          best = {distance: near.distance - clamp.radius, link: this.scene.links[link].name, time: pose.time};
      });
    }
    return best;
  }
  yaml(clamp) {
    const list = vector => `[${vector.toArray().map(x => String(Number(x.toFixed(3)) || 0)).join(', ')}]`;
    return `${clamp.key}: {link: ${this.scene.links[clamp.link].name}, position_m: ${list(clamp.position)}, direction: ${list(clamp.direction)}}`;
  }
  words(clamp, whole) {
    const lines = [];
    const bracket = clamp.bracket - clamp.radius;
    if (bracket > .001)
      lines.push([`bracket of ${(1000 * bracket).toFixed(0)} mm (at most ${(1000 * clamp.most_bracket).toFixed(0)})`, bracket > clamp.most_bracket]);
    for (const piece of this.lengths(clamp)) {
      const short = piece.length < piece.low, long = piece.length > piece.high;
      lines.push([
        `${piece.from} to ${piece.to}: ${piece.least.toFixed(3)} .. ${piece.most.toFixed(3)} m apart, farthest at ${piece.when.toFixed(2)} s; ` +
            `${piece.length.toFixed(3)} m is ${short ? 'too short' : long ? 'too long' : 'long enough'}: ${piece.low.toFixed(3)} .. ${piece.high.toFixed(3)} m suit`,
        short || long
      ]);
    }
    if (whole) {
      const clear = this.clearance(clamp);
      if (Number.isFinite(clear.distance))
        lines.push([
          clear.distance < 0 ? `${(-1000 * clear.distance).toFixed(0)} mm inside ${clear.link} at ${clear.time.toFixed(2)} s` :
                               `clearance ${(1000 * clear.distance).toFixed(0)} mm, to ${clear.link} at ${clear.time.toFixed(2)} s`,
          clear.distance < 0
        ]);
    }
    return lines;
  }
  // whole: whether the clearance is also computed, which takes a moment.
  show(whole = true) {
    const clamp = this.clamps[this.chosen];
    const names = this.clamps.map((one, k) => [String(k), one.name]);
    this.panel.replaceChildren(
        chooser('clamp-name', 'A click on a link places the', names, String(this.chosen), value => {
          this.chosen = Number(value);
          this.show();
        }),
        make('span', {class: 'soft'}, ' drag a clamp to move it along the surface; nothing is written: copy the line into the job'),
        make('pre', {id: 'clamp-yaml'}, this.yaml(clamp)),
        make('ul', {id: 'clamp-words'}, ...this.words(clamp, whole).map(([words, bad]) => make('li', bad ? {class: 'failed'} : {}, words))));
  }
  place(x, y) {
    const surface = this.surfaceAt(x, y);
    if (!surface || !this.clamps.length) return false;
    this.move(this.clamps[this.chosen], this.placed(this.clamps[this.chosen], surface));
    this.show();
    return true;
  }
  listen() {
    const canvas = this.viewer.canvas;
    const at = event => {
      const size = canvas.getBoundingClientRect();
      return [event.clientX - size.left, event.clientY - size.top];
    };
    canvas.addEventListener('pointerdown', event => {
      const k = event.button === 0 ? this.clampAt(...at(event)) : -1;
      if (k < 0) return;
      this.dragged = k;
      this.chosen = k;
      this.viewer.controls.enabled = false;
    }, true);
    canvas.addEventListener('pointermove', event => {
      if (this.dragged === null) return;
      const surface = this.surfaceAt(...at(event));
      if (!surface) return;
      this.move(this.clamps[this.dragged], this.placed(this.clamps[this.dragged], surface));
      this.show(false);
    });
    window.addEventListener('pointerup', () => {
      if (this.dragged === null) return;
      this.dragged = null;
      this.viewer.controls.enabled = true;
      this.show();
    });
  }
}
