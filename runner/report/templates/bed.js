// Turns a bed: spheres are drawn as discs whose depth and light are those of a sphere, polyhedra as
// copies of their meshes. Draws only when something has changed. Until the first frame, and where
// there is no WebGL, the picture stays.
(() => {
  "use strict";
  const section = document.getElementById("bed");
  if (!section || typeof THREE === "undefined") return;
  const sources = [...section.querySelectorAll("script.bed-data")];
  const picture = document.getElementById("bed-picture");
  const stage = document.getElementById("bed-stage");
  const controls = document.getElementById("bed-controls");

  const canvas = document.createElement("canvas");
  // What was drawn stays, so that people can save it as a picture.
  const wanted = { antialias: true, preserveDrawingBuffer: true };
  const context = canvas.getContext("webgl2", wanted) || canvas.getContext("webgl", wanted);
  if (!context) return;
  canvas.id = "bed-canvas";
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "The bed in three dimensions; arrow keys turn it, with shift they move it, plus and minus zoom");

  // Viridis, by eleven of its colours; as in picture.cpp.
  const scale = [[68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142],
                 [33, 145, 140], [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38],
                 [253, 231, 37]];
  // Large and small grains, or the components of a mixture; as in picture.cpp.
  const kinds = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167],
                 [86, 180, 233], [213, 94, 0], [240, 228, 66], [110, 110, 110]];

  const colour = (share) => {
    const at = Math.min(Math.max(share, 0), 1) * (scale.length - 1);
    const low = Math.min(Math.floor(at), scale.length - 2);
    return scale[low].map((value, k) => value + (at - low) * (scale[low + 1][k] - value));
  };

  const bytesOf = (text) => {
    const raw = atob(text);
    const bytes = new Uint8Array(raw.length);
    for (let k = 0; k < raw.length; k += 1) bytes[k] = raw.charCodeAt(k);
    return bytes.buffer;
  };

  const isMixture = (bed) => Boolean(bed.meshes) && bed.meshes.length > 1;

  // The columns stand one behind the other: x, y, z, radius, force, touching,
  // orientation, and of a mixture component.
  const read = (source) => {
    const bed = JSON.parse(source.textContent);
    const buffer = bytesOf(bed.grains);
    const n = bed.count;
    const column = (index, unit) =>
      Float32Array.from(new Uint16Array(buffer, 2 * n * index, n), (value) => value * unit / 65535);
    bed.x = column(0, bed.extent);
    bed.y = column(1, bed.extent);
    bed.z = column(2, bed.extent);
    bed.radius = column(3, bed.largest_radius);
    bed.force = column(4, bed.largest_force);
    bed.touching = Float32Array.from(new Uint16Array(buffer, 10 * n, n));
    if (bed.meshes) {
      bed.turn = Float32Array.from(new Int16Array(buffer, 12 * n, 4 * n), (value) => value / 32767);
      bed.component = isMixture(bed)
        ? Float32Array.from(new Uint16Array(buffer, 20 * n, n)) : new Float32Array(n);
    }
    const forces = bytesOf(bed.forces);
    bed.a = new Uint32Array(forces, 0, bed.pairs);
    bed.b = new Uint32Array(forces, 4 * bed.pairs, bed.pairs);
    bed.share = Float32Array.from(new Uint16Array(forces, 8 * bed.pairs, bed.pairs),
      (value) => value / 65535);
    return bed;
  };

  const valuesOf = (bed, by) => {
    if (by === "size") return bed.radius.map((radius) => 2 * radius);
    if (by === "touching") return bed.touching;
    if (by === "force") return bed.force;
    if (by === "component") return bed.component;
    if (by === "wall" && bed.tube) {
      const radius = bed.box[0] / 2;
      return bed.x.map((x, k) => radius - Math.hypot(x - radius, bed.y[k] - radius));
    }
    if (by === "wall") {
      const across = [bed.x, bed.y];
      return bed.x.map((_, k) => Math.min(...[0, 1].filter((axis) => bed.walls[axis])
        .map((axis) => Math.min(across[axis][k], bed.box[axis] - across[axis][k]))));
    }
    return bed.radius.map((radius) => (radius < bed.small_limit ? 1 : 0));
  };

  const common = `
    attribute vec3 centre; attribute float radius; attribute vec3 tint;
    uniform vec4 cut; varying vec3 colour;
    bool is_cut() { return dot(centre, cut.xyz) > cut.w; }`;
  const light = `
    vec3 lit(vec3 colour, vec3 normal) {
      float lamp = max(0.0, dot(normal, normalize(vec3(-0.4, 0.5, 1.0))));
      return colour * (0.35 + 0.65 * lamp);
    }`;

  const sphereMaterial = () => new THREE.ShaderMaterial({
    extensions: { fragDepth: true },
    vertexShader: `${common}
      varying vec2 at; varying float middle; varying float reach;
      void main() {
        colour = tint; at = position.xy; reach = radius;
        vec4 seen = modelViewMatrix * vec4(centre, 1.0);
        middle = seen.z;
        seen.xy += position.xy * radius;
        seen.z += radius;
        gl_Position = is_cut() ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * seen;
      }`,
    fragmentShader: `${light}
      varying vec3 colour; varying vec2 at; varying float middle; varying float reach;
      uniform vec2 depth; // near and far
      void main() {
        float rest = 1.0 - dot(at, at);
        if (rest <= 0.0) discard;
        vec3 normal = vec3(at, sqrt(rest));
        gl_FragColor = vec4(lit(colour, normal), 1.0);
        gl_FragDepthEXT = (-(middle + reach * normal.z) - depth.x) / (depth.y - depth.x);
      }`,
    uniforms: { cut: { value: new THREE.Vector4() }, depth: { value: new THREE.Vector2() } },
  });

  const meshMaterial = () => new THREE.ShaderMaterial({
    vertexShader: `${common}
      attribute vec4 turn; attribute float part, component; varying vec3 facing;
      vec3 turned(vec3 v) { return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v); }
      void main() {
        colour = tint; facing = normalize(normalMatrix * turned(normal));
        vec4 seen = modelViewMatrix * vec4(centre + 2.0 * radius * turned(position), 1.0);
        gl_Position = is_cut() || part != component
          ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * seen;
      }`,
    fragmentShader: `${light}
      varying vec3 colour; varying vec3 facing;
      void main() { gl_FragColor = vec4(lit(colour, normalize(facing)), 1.0); }`,
    uniforms: { cut: { value: new THREE.Vector4() }, depth: { value: new THREE.Vector2() } },
  });

  // Triangles of all meshes, each with the normal of its face, or of the sphere that it belongs to,
  // and the number of its mesh: a grain shows those of its own alone.
  const trianglesOf = (meshes) => {
    const corners = [];
    const normals = [];
    const parts = [];
    for (const [face, mesh] of meshes.flatMap((mesh) => mesh.faces.map((face) => [face, mesh]))) {
      const [a, b, c] = face.map((index) => new THREE.Vector3(...mesh.vertices[index]));
      const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
      for (let k = 2; k < face.length; k += 1) {
        for (const index of [face[0], face[k - 1], face[k]]) {
          corners.push(...mesh.vertices[index]);
          normals.push(...(mesh.is_ball ? mesh.vertices[index] : [normal.x, normal.y, normal.z]));
          parts.push(meshes.indexOf(mesh));
        }
      }
    }
    return { position: [corners, 3], normal: [normals, 3], part: [parts, 1] };
  };

  const square = { position: [[-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0], 3] };

  const grainsOf = (bed) => {
    const centres = new Float32Array(3 * bed.count);
    for (let k = 0; k < bed.count; k += 1) {
      centres.set([bed.x[k], bed.y[k], bed.z[k]], 3 * k);
    }
    const items = { centre: [centres, 3], radius: [bed.radius, 1],
                    tint: [new Float32Array(3 * bed.count), 3] };
    if (bed.meshes) Object.assign(items, { turn: [bed.turn, 4], component: [bed.component, 1] });
    const { geometry, copies } =
      repeated(bed.meshes ? trianglesOf(bed.meshes) : square, items, bed.count);
    const grains = new THREE.Mesh(geometry, bed.meshes ? meshMaterial() : sphereMaterial());
    grains.frustumCulled = false;
    grains.userData.copies = copies;
    return grains;
  };

  // Both rims of a tube, or the edges of a box.
  const frameOf = (bed) => {
    const [length, width, height] = bed.box;
    const frame = bed.tube ? new THREE.CylinderGeometry(length / 2, length / 2, height, 48, 1, true)
      : new THREE.BoxGeometry(length, width, height);
    if (bed.tube) frame.rotateX(Math.PI / 2);
    frame.translate(length / 2, width / 2, height / 2);
    return new THREE.LineSegments(new THREE.EdgesGeometry(frame, 30),
      new THREE.LineBasicMaterial({ color: 0x888888 }));
  };

  const renderer = new THREE.WebGLRenderer({ canvas, context });
  renderer.setClearColor(0xffffff, 1);
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
  let scene, bed, grains, network;
  const firstView = { turn: 0.6, tilt: 0.5, zoom: 1, right: 0, up: 0 }; // as in picture.cpp
  const view = { ...firstView }; // rad, and how far what is in the middle lies from the bed's, d
  let isWaiting = false;

  const towardsEye = () => new THREE.Vector3(Math.sin(view.turn) * Math.cos(view.tilt),
    -Math.cos(view.turn) * Math.cos(view.tilt), Math.sin(view.tilt));

  // Half of what is seen from below to above, d.
  const halfHeight = () => {
    const aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight);
    return 1.05 * Math.hypot(...bed.box) / 2 * Math.max(1, 1 / aspect) / view.zoom;
  };

  const place = () => {
    const middle = new THREE.Vector3(...bed.box).multiplyScalar(0.5);
    const far = 2 * middle.length() + 2;
    const towards = towardsEye();
    const right = new THREE.Vector3(Math.cos(view.turn), Math.sin(view.turn), 0);
    middle.addScaledVector(right, view.right).addScaledVector(towards.clone().cross(right), view.up);
    camera.up.set(0, 0, 1);
    camera.position.copy(middle).addScaledVector(towards, far);
    camera.lookAt(middle);
    const aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight);
    const half = halfHeight();
    Object.assign(camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half,
                            near: 0.1, far: 2 * far });
    camera.updateProjectionMatrix();
    grains.material.uniforms.depth.value.set(camera.near, camera.far);
    network.material.uniforms.least.value = 1.2 * half / Math.max(1, canvas.clientHeight);
  };

  const draw = () => {
    isWaiting = false;
    const width = stage.clientWidth;
    const height = Math.round(Math.min(0.66 * width, 620));
    if (canvas.clientWidth !== width || canvas.clientHeight !== height) {
      renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
      renderer.setSize(width, height);
    }
    place();
    renderer.render(scene, camera);
    section.classList.add("turning");
  };

  const redraw = () => {
    if (isWaiting) return;
    isWaiting = true;
    window.requestAnimationFrame(draw);
  };

  const pick = (id) => document.getElementById(id);

  // What colours stand for, from the lowest value to the highest.
  const tell = (low, high, scaleShown) => {
    const bar = document.createElement("span");
    bar.className = "scale";
    const stops = scaleShown.map((rgb) => `rgb(${rgb})`).join(",");
    bar.style.background = `linear-gradient(to right, ${stops})`;
    pick("bed-key").replaceChildren(low, bar, high);
  };

  const colourOfKind = (number) => kinds[number % kinds.length];

  // What has which colour.
  const tellEach = (names, colourOf) => {
    pick("bed-key").replaceChildren(...names.flatMap((name, k) => {
      const square = document.createElement("span");
      square.className = "scale square";
      square.style.background = `rgb(${colourOf(k)})`;
      return [square, name, " "];
    }));
  };

  const digits = (value) => (Number.isInteger(value) ? String(value) : value.toPrecision(3));

  const paintGrains = (by) => {
    const values = valuesOf(bed, by);
    const areKinds = by === "kind" || by === "component";
    let low = Infinity;
    let high = -Infinity;
    for (const value of values) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    const tint = grains.geometry.attributes.tint;
    const copies = grains.userData.copies;
    for (let k = 0; k < bed.count; k += 1) {
      const rgb = areKinds ? colourOfKind(values[k])
                           : colour(high > low ? (values[k] - low) / (high - low) : 0.5);
      for (let at = k * copies; at < (k + 1) * copies; at += 1) {
        tint.setXYZ(at, rgb[0] / 255, rgb[1] / 255, rgb[2] / 255);
      }
    }
    tint.needsUpdate = true;
    const length = (value) => `${digits(value * bed.d)} ${bed.unit}`;
    const told = { size: length, touching: digits, force: (value) => `${digits(value)} m g`,
                   wall: length }[by];
    if (by === "kind") tellEach(["large", "small"], colourOfKind);
    else if (by === "component") tellEach(bed.components, colourOfKind);
    else if (high > low) tell(told(low), told(high), scale);
    else tellEach([`all ${told(low)}`], () => colour(0.5));
  };

  const paint = () => {
    const showsForces = pick("bed-show").value === "forces";
    grains.visible = !showsForces;
    network.visible = showsForces;
    pick("bed-colour").disabled = showsForces;
    paintGrains(pick("bed-colour").value);
    if (showsForces) tell("0", `${digits(bed.largest_pair_force)} m g`, [...scale].reverse());
    redraw();
  };

  // Takes away what lies on the side that faces the eye.
  const cut = () => {
    const axis = Number(pick("bed-axis").value);
    const kept = Number(pick("bed-slice").value) / 100;
    const faces = towardsEye().getComponent(axis) < 0 ? -1 : 1;
    const plane = new THREE.Vector4(0, 0, 0, 1e9); // lines through a periodic side reach beyond
    if (kept < 1) {
      plane.setComponent(axis, faces);
      plane.w = bed.box[axis] * (faces > 0 ? kept : kept - 1);
    }
    for (const shown of [grains, network]) shown.material.uniforms.cut.value.copy(plane);
    pick("bed-kept").textContent = `${pick("bed-slice").value} %`;
    redraw();
  };

  const show = (index) => {
    bed = read(sources[index]);
    scene = new THREE.Scene();
    grains = grainsOf(bed);
    network = forceNetwork(bed, colour);
    scene.add(grains, network, frameOf(bed));
    const has = { kind: bed.small_limit > 0, component: isMixture(bed),
                  wall: bed.walls.includes(true), forces: bed.pairs > 0 };
    for (const id of ["bed-colour", "bed-show"]) {
      for (const option of pick(id).options) {
        option.disabled = has[option.value] === false;
        if (option.disabled && option.selected) pick(id).selectedIndex = 0;
      }
    }
    paint();
    cut();
  };

  const turn = (right, up) => {
    view.turn -= right;
    view.tilt = Math.min(Math.max(view.tilt + up, -1.55), 1.55);
    redraw();
  };
  const zoom = (factor) => {
    view.zoom = Math.min(Math.max(view.zoom * factor, 0.5), 100);
    redraw();
  };

  // By so many pixels to the right and upwards.
  const move = (right, up) => {
    const pixel = 2 * halfHeight() / Math.max(1, canvas.clientHeight);
    const most = Math.hypot(...bed.box) / 2; // so that the bed cannot be lost
    const within = (value) => Math.min(Math.max(value, -most), most);
    view.right = within(view.right - right * pixel);
    view.up = within(view.up - up * pixel);
    redraw();
  };

  // One pointer turns, with shift it moves; two zoom and move.
  const pointers = new Map();
  const apart = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? apart() : 0;
    const now = { x: event.clientX, y: event.clientY };
    pointers.set(event.pointerId, now);
    const [right, down] = [now.x - last.x, now.y - last.y];
    if (pointers.size === 2) {
      if (before > 0) zoom(apart() / before);
      move(right / 2, -down / 2); // each finger half of it
    } else if (event.shiftKey) move(right, -down);
    else turn(right / 200, down / 200);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas) return; // the page scrolls until the bed is picked
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 600));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const keys = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
    if (keys[event.key] && event.shiftKey) move(...keys[event.key].map((step) => 300 * step));
    else if (keys[event.key]) turn(...keys[event.key]);
    else if (event.key === "0") {
      Object.assign(view, firstView);
      redraw();
    } else if (event.key === "+") zoom(1.15);
    else if (event.key === "-") zoom(1 / 1.15);
    else return;
    event.preventDefault();
  });

  const chooser = pick("bed-choice");
  sources.forEach((source, index) => {
    const option = document.createElement("option");
    option.value = index;
    option.textContent = source.dataset.title;
    chooser.append(option);
  });
  chooser.addEventListener("change", () => show(Number(chooser.value)));
  pick("bed-show").addEventListener("change", paint);
  pick("bed-colour").addEventListener("change", paint);
  pick("bed-slice").addEventListener("input", cut);
  pick("bed-axis").addEventListener("change", cut);
  window.addEventListener("resize", redraw);

  try {
    show(0);
    if (isMixture(bed)) {
      pick("bed-colour").value = "component";
      paint();
    }
  } catch (error) {
    return; // the picture stays
  }
  controls.hidden = false;
  stage.append(canvas);
})();
