// The 3D view: robot, cell and dresspacks at one moment, turned with mouse, fingers or keys. Lengths in metres, z up.
const tubeCorners = 12, ringsPerSegment = 4;

function capsuleGeometries(from, to, radius) {
  const a = new THREE.Vector3(...from), b = new THREE.Vector3(...to), length = a.distanceTo(b), parts = [];
  for (const end of [a, b]) {
    const ball = new THREE.SphereBufferGeometry(radius, 20, 14);
    ball.translate(end.x, end.y, end.z);
    parts.push(ball);
  }
  if (length > 1e-6) {
    const middle = new THREE.CylinderBufferGeometry(radius, radius, length, 20, 1, true);
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), b.clone().sub(a).normalize());
    middle.applyMatrix(new THREE.Matrix4().compose(a.clone().add(b).multiplyScalar(.5), turn, new THREE.Vector3(1, 1, 1)));
    parts.push(middle);
  }
  return parts;
}

function meshGeometry(shape) {
  const numbers = wholeNumbers(shape.triangles), corners = new Float32Array(numbers.length);
  for (let i = 0; i < numbers.length; ++i) corners[i] = shape.low + shape.step * numbers[i];
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
  geometry.computeVertexNormals();
  return geometry;
}

function addShapes(group, shapes, material) {
  for (const shape of shapes) {
    if (shape.kind === 'capsule') {
      for (const part of capsuleGeometries(shape.from, shape.to, shape.radius))
        group.add(Object.assign(new THREE.Mesh(part, material), {userData: {shape}}));
      continue;
    }
    const mesh =
        new THREE.Mesh(shape.kind === 'box' ? new THREE.BoxBufferGeometry(...shape.sides) : meshGeometry(shape), material);
    mesh.position.set(...shape.position);
    mesh.quaternion.set(...shape.quaternion);
    mesh.userData.shape = shape;
    group.add(mesh);
  }
}

// A dresspack's line as a round tube, coloured by segment. places: positions of its points, in segments.
class Tube {
  constructor(places, segments, radius, material) {
    this.places = places;
    this.segments = segments;
    this.radius = radius;
    this.rings = segments * ringsPerSegment + 1;
    const vertices = this.rings * tubeCorners, corners = [];
    for (let r = 0; r + 1 < this.rings; ++r)
      for (let c = 0; c < tubeCorners; ++c) {
        const a = r * tubeCorners + c, b = r * tubeCorners + (c + 1) % tubeCorners;
        corners.push(a, a + tubeCorners, b, b, a + tubeCorners, b + tubeCorners);
      }
    this.geometry = new THREE.BufferGeometry();
    for (const name of ['position', 'normal', 'color'])
      this.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * vertices), 3));
    this.geometry.setIndex(corners);
    this.mesh = new THREE.Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.centres = Array.from({length: this.rings}, () => new THREE.Vector3());
    this.tangents = Array.from({length: this.rings}, () => new THREE.Vector3());
  }
  segmentOfRing(ring) { return Math.min(Math.max(Math.floor(ring / ringsPerSegment), 0), this.segments - 1); }
  segmentOfFace(face) { return this.segmentOfRing(Math.floor(face / (2 * tubeCorners))); }
  ringOfSegment(segment) { return Math.round((segment + .5) * ringsPerSegment); }

  // Cubic interpolation between neighbouring points; the slope at each point is that of the line through both neighbours. The
  // points are stored as x y z from index `at`.
  move(numbers, at) {
    const last = this.places.length - 1;
    const slope = (i, x) => {
      const before = Math.max(i - 1, 0), after = Math.min(i + 1, last);
      return (numbers[at + 3 * after + x] - numbers[at + 3 * before + x]) / (this.places[after] - this.places[before]);
    };
    for (let r = 0, i = 0; r < this.rings; ++r) {
      const place = r / ringsPerSegment;
      while (i + 1 < last && this.places[i + 1] <= place) ++i;
      const long = this.places[i + 1] - this.places[i], u = (place - this.places[i]) / long, centre = [], along = [];
      for (let x = 0; x < 3; ++x) {
        const p = numbers[at + 3 * i + x], rise = numbers[at + 3 * i + 3 + x] - p, a = long * slope(i, x),
              b = long * slope(i + 1, x);
        const c = 3 * rise - 2 * a - b, d = a + b - 2 * rise;
        centre.push(p + u * (a + u * (c + u * d)));
        along.push(a + u * (2 * c + 3 * u * d));
      }
      this.centres[r].set(...centre);
      this.tangents[r].set(...along).normalize();
    }
    this.skin();
  }
  // Rings perpendicular to the tangents, transported without rotation about them.
  skin() {
    const position = this.geometry.attributes.position, normal = this.geometry.attributes.normal;
    const side = new THREE.Vector3(), other = new THREE.Vector3(), out = new THREE.Vector3();
    const first = this.tangents[0];
    side.set(Math.abs(first.x) < .7 ? 1 : 0, Math.abs(first.x) < .7 ? 0 : 1, 0);
    for (let r = 0; r < this.rings; ++r) {
      const along = this.tangents[r], centre = this.centres[r];
      side.addScaledVector(along, -side.dot(along)).normalize();
      other.crossVectors(along, side);
      for (let c = 0; c < tubeCorners; ++c) {
        const angle = 2 * Math.PI * c / tubeCorners, k = r * tubeCorners + c;
        out.copy(side).multiplyScalar(Math.cos(angle)).addScaledVector(other, Math.sin(angle));
        normal.setXYZ(k, out.x, out.y, out.z);
        position.setXYZ(k, centre.x + this.radius * out.x, centre.y + this.radius * out.y, centre.z + this.radius * out.z);
      }
    }
    position.needsUpdate = normal.needsUpdate = true;
    this.geometry.computeBoundingSphere();
  }
  paint(colourOfSegment) {
    const colour = this.geometry.attributes.color;
    for (let r = 0; r < this.rings; ++r) {
      const [red, green, blue] = colourOfSegment(this.segmentOfRing(r));
      for (let c = 0; c < tubeCorners; ++c) colour.setXYZ(r * tubeCorners + c, red / 255, green / 255, blue / 255);
    }
    colour.needsUpdate = true;
  }
}

function ringMesh(radius, thickness, colour) {
  return new THREE.Mesh(new THREE.TorusBufferGeometry(radius, thickness, 10, 40), new THREE.MeshLambertMaterial({color: colour}));
}

function directed(object, position, direction) {
  object.position.set(...position);
  object.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...direction));
  return object;
}

class Viewer {
  constructor(place, scene, motion) {
    this.scene = new THREE.Scene();
    this.data = scene;
    this.motion = motion;
    this.renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'Robot and dresspack; arrows turn the view while it has the focus');
    place.append(this.canvas);
    this.place = place;
    this.camera = new THREE.PerspectiveCamera(35, 1, .02, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.enableKeys = false;
    this.controls.addEventListener('change', () => this.dirty = true);
    this.marks = [];
    this.labels = [];
    this.frames = new THREE.Group();
    this.addLights();
    this.addRobot();
    this.addHoses();
    this.dirty = true;
    this.marked = this.addMark(0xd32f00, data.preview ? 'here' : data.life?.marked.words || '');
    this.chosen = this.addMark(0x111111, '');
    this.findBox();
    this.resize();
    this.look('overview');
    new ResizeObserver(() => this.resize()).observe(place);
  }
  addLights() {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a92, .75));
    const sun = new THREE.DirectionalLight(0xffffff, .45);
    this.camera.add(sun);
    sun.position.set(-.5, .8, 1);
    this.scene.add(this.camera);
  }
  addRobot() {
    const greys = [0xb3bdc9, 0xd0d8e0].map(color => new THREE.MeshLambertMaterial({color}));
    this.links = this.data.links.map((link, k) => {
      const group = new THREE.Group();
      addShapes(group, link.shapes, greys[k % 2]);
      const axes = new THREE.AxesHelper(.25);
      axes.visible = false;
      axes.material.depthTest = false;  // the axes begin inside their links
      axes.renderOrder = 1;
      group.add(axes);
      this.scene.add(group);
      this.addLabel(link.name, group, 'link');
      return Object.assign(group, {axes});
    });
    const cell = new THREE.Group();
    addShapes(cell, this.data.cell, new THREE.MeshLambertMaterial({color: 0xa9b79a}));
    this.scene.add(cell);
    if (this.data.floor) {
      const grid = new THREE.GridHelper(6, 12, 0x8b95a1, 0xb9c1ca);
      grid.rotateX(Math.PI / 2);
      Object.assign(grid.material, {transparent: true, opacity: .45});
      this.scene.add(grid);
    }
    for (const clamp of this.data.clamps) this.addClamp(clamp);
    for (const ring of this.data.rings) {
      const wall = .006, mesh = directed(ringMesh(ring.radius + wall, wall, 0x4d7c57), ring.position, ring.direction);
      this.linkOf(ring).add(mesh);
      this.addLabel(ring.name, mesh, 'clamp');
    }
    for (const point of this.data.mounting_points) {
      const mesh = directed(
          new THREE.Mesh(
              new THREE.ConeBufferGeometry(.02, .06, 12).rotateX(Math.PI / 2), new THREE.MeshLambertMaterial({color: 0x7b5ea7})),
          point.position, point.direction);
      this.linkOf(point).add(mesh);
      this.addLabel(point.name, mesh, 'clamp');
    }
  }
  linkOf(item) { return this.links[item.link] || this.scene; }
  addClamp(clamp) {
    const group = directed(new THREE.Group(), clamp.position, clamp.direction);
    group.add(ringMesh(clamp.radius * 1.12, clamp.radius * .22, 0x3f4a55));
    const arrow = new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), .22, 0x0072b2, .07, .05);
    arrow.visible = false;
    group.add(arrow);
    this.linkOf(clamp).add(group);
    this.addLabel(clamp.name, group, 'clamp');
    (this.clampGroups = this.clampGroups || []).push(group);
    (this.arrows = this.arrows || []).push(arrow);
  }
  addHoses() {
    const material = new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors});
    let at = this.motion.group('points').begin;
    this.tubes = this.motion.data.lines.map((line, d) => {
      const tube = new Tube(line.places, line.segments, this.data.hoses[d].radius, material);
      this.scene.add(tube.mesh);
      tube.at = at;
      tube.first = line.first_segment;
      at += 3 * line.places.length;
      return tube;
    });
  }
  // A ring around a segment, with a label; hidden until it has a position.
  addMark(colour, word) {
    const mark = new THREE.Mesh(new THREE.TorusBufferGeometry(1.4, .24, 12, 40), new THREE.MeshBasicMaterial({color: colour}));
    mark.visible = false;
    this.scene.add(mark);
    if (word) this.addLabel(word, mark, 'mark');
    return mark;
  }
  addLabel(words, object, kind) {
    const element = document.createElement('span');
    element.className = 'label ' + kind;
    element.textContent = words;
    this.place.append(element);
    this.labels.push({element, object, kind});
  }
  tubeOf(segment) { return this.tubes.find(tube => segment >= tube.first && segment < tube.first + tube.segments); }

  mark(mark, segment) {
    const tube = segment >= 0 ? this.tubeOf(segment) : null;
    mark.visible = !!tube;
    mark.segment = segment;
    this.dirty = true;
    if (!tube) return;
    const ring = tube.ringOfSegment(segment - tube.first);
    mark.position.copy(tube.centres[ring]);
    mark.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), tube.tangents[ring]);
    mark.scale.setScalar(tube.radius);
  }
  // Moves all objects to a row of the motion; colour: colour of each segment of the file.
  pose(row, colourOfSegment) {
    const positions = this.motion.group('link_positions'), turns = this.motion.group('link_quaternions');
    if (positions)
      this.links.forEach((link, k) => {
        if (3 * k >= positions.size) return;
        const p = positions.begin + 3 * k, q = turns.begin + 4 * k;
        link.position.set(row[p], row[p + 1], row[p + 2]);
        link.quaternion.set(row[q + 1], row[q + 2], row[q + 3], row[q]).normalize();
      });
    for (const tube of this.tubes) {
      tube.move(row, tube.at);
      tube.paint(k => colourOfSegment(tube.first + k));
    }
    for (const mark of [this.marked, this.chosen])
      if (mark.visible) this.mark(mark, mark.segment);
    this.dirty = true;
  }
  // Positions of the dresspacks over the motion, corners around the links in their first pose, and the box around all of these.
  findBox() {
    this.box = new THREE.Box3();
    this.found = [];
    const find = point => this.box.expandByPoint(this.found[this.found.push(point) - 1]);
    const times = this.motion.time, step = Math.max(1, Math.floor(times.length / 50)), points = this.motion.group('points');
    for (let k = 0; k < times.length; k += step) {
      const row = this.motion.goTo(times[k]);
      for (let i = points.begin; i < points.begin + points.size; i += 3)
        find(new THREE.Vector3(row[i], row[i + 1], row[i + 2]));
      this.pose(row, () => noAmount);
      this.scene.updateMatrixWorld(true);
      if (k === 0)
        for (const link of this.links)
          for (const part of link.children) {
            if (!part.isMesh) continue;
            const around = new THREE.Box3().setFromObject(part);
            for (let corner = 0; corner < 8; ++corner)
              find(new THREE.Vector3(...['x', 'y', 'z'].map((axis, k) => (corner >> k & 1 ? around.max : around.min)[axis])));
          }
    }
  }
  // Moves the camera to one side of all objects, or near the marked or the chosen place.
  look(where) {
    const directions = {overview: [.45, -.85, .28], front: [1, 0, .02], side: [0, -1, .02], top: [0, -.02, 1]};
    const mark = [this.chosen, this.marked].find(one => one.visible);
    const near = where === 'place' ? mark || {position: this.tubes[0].centres[this.tubes[0].rings >> 1]} : null;
    const direction = near ? this.camera.position.clone().sub(this.controls.target) : new THREE.Vector3(...directions[where]);
    const narrow = Math.min(1, this.camera.aspect), center = near ? near.position : this.box.getCenter(new THREE.Vector3());
    const distance = near ? (mark && !data.preview ? .9 : mark ? 1.8 : 3) / narrow : this.distanceOfAll(direction, center);
    this.controls.target.copy(center);
    this.camera.position.copy(this.controls.target).addScaledVector(direction.normalize(), distance);
    this.controls.update();
    this.dirty = true;
  }
  // Extent in the picture of all these points, seen along `direction` at the centre.
  distanceOfAll(direction, center) {
    const out = direction.clone().normalize(), right = new THREE.Vector3().crossVectors(this.camera.up, out);
    if (right.lengthSq() < 1e-6) right.set(1, 0, 0);
    right.normalize();
    const up = new THREE.Vector3().crossVectors(out, right), high = Math.tan(Math.PI / 360 * this.camera.fov) / 1.08;
    let distance = .5;
    for (const point of this.found) {
      const at = point.clone().sub(center);
      const wide = Math.max(Math.abs(at.dot(up)) / high, Math.abs(at.dot(right)) / (high * this.camera.aspect));
      distance = Math.max(distance, at.dot(out) + wide);
    }
    return distance;
  }
  turn(azimuth, elevation, closer) {
    const from = this.camera.position.clone().sub(this.controls.target), ball = new THREE.Spherical();
    ball.setFromVector3(new THREE.Vector3(from.x, from.z, -from.y));
    ball.theta += azimuth;
    ball.phi = Math.min(Math.max(ball.phi - elevation, .02), Math.PI - .02);
    ball.radius *= closer;
    const to = new THREE.Vector3().setFromSpherical(ball);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(to.x, -to.z, to.y));
    this.controls.update();
  }
  // Returns the ray into the scene through a point of the canvas [px].
  ray(x, y) {
    const ray = new THREE.Raycaster(), size = this.canvas.getBoundingClientRect();
    ray.setFromCamera(new THREE.Vector2(2 * x / size.width - 1, 1 - 2 * y / size.height), this.camera);
    return ray;
  }
  // Returns the segment of the file at a point of the canvas [px]; -1: none.
  segmentAt(x, y) {
    const ray = this.ray(x, y);
    let nearest = null;
    for (const tube of this.tubes)
      for (const hit of ray.intersectObject(tube.mesh))
        if (!nearest || hit.distance < nearest.distance)
          nearest = {distance: hit.distance, segment: tube.first + tube.segmentOfFace(hit.faceIndex)};
    return nearest ? nearest.segment : -1;
  }
  // Returns the position of a segment on the canvas [px].
  placeOf(segment) {
    const tube = this.tubeOf(segment), at = tube.centres[tube.ringOfSegment(segment - tube.first)].clone().project(this.camera);
    const size = this.canvas.getBoundingClientRect();
    return {x: (at.x + 1) / 2 * size.width, y: (1 - at.y) / 2 * size.height};
  }
  resize() {
    const width = this.place.clientWidth, height = this.place.clientHeight;
    if (!width || !height || matchMedia('print').matches) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }
  warnOf(links) {
    // The inside of these objects is visible.
    const material = new THREE.MeshLambertMaterial({color: 0xd97a3a, transparent: true, opacity: .4, depthWrite: false});
    this.links.forEach((link, k) => {
      if (links[k])
        for (const part of link.children)
          if (part.userData.shape) part.material = material;
    });
    this.dirty = true;
  }
  show(what, visible) {
    if (what === 'frames')
      for (const link of this.links) link.axes.visible = visible;
    if (what === 'names') this.names = visible;
    if (what === 'names')
      for (const arrow of this.arrows || []) arrow.visible = visible;
    this.dirty = true;
  }
  draw() {
    this.dirty = false;
    this.scene.background = new THREE.Color(getComputedStyle(document.documentElement).getPropertyValue('--view').trim());
    this.renderer.render(this.scene, this.camera);
    const place = new THREE.Vector3(), taken = [];
    for (const label of this.labels) {
      const wanted = label.object.visible && (label.kind === 'mark' || this.names);
      label.object.getWorldPosition(place).project(this.camera);
      const seen = wanted && place.z < 1 && Math.abs(place.x) < 1 && Math.abs(place.y) < 1;
      label.element.hidden = !seen;
      if (!seen) continue;
      // Moved below the labels that overlap it.
      const widest = this.place.clientWidth - label.element.offsetWidth - 20;
      const left = Math.min((place.x + 1) / 2 * this.place.clientWidth, widest), right = left + label.element.offsetWidth;
      let top = (1 - place.y) / 2 * this.place.clientHeight;
      for (let tries = 0;
           tries < 8 && taken.some(other => left < other.right && right > other.left && Math.abs(top - other.top) < 17); ++tries)
        top += 17;
      taken.push({left, right, top});
      // In shares of the picture, because paper makes the picture narrower.
      label.element.style.left = `${100 * left / this.place.clientWidth}%`;
      label.element.style.top = `${100 * top / this.place.clientHeight}%`;
    }
  }
}
