// One small mesh many times: repeated(mesh, items, count) makes a geometry of it. `mesh` has what each
// corner of it has, `items` what each copy has, all as { name: [numbers, how many of a corner or a
// copy] }. Copies are written out, for which drawing by software takes a hundredth of the time; only
// where they would fill the memory are they instances. `copies` says how often numbers of an item
// stand in the geometry.
const repeated = (mesh, items, count) => {
  "use strict";
  const mostCorners = 2e6;
  const corners = mesh.position[0].length / 3;
  if (corners * count > mostCorners) {
    const geometry = new THREE.InstancedBufferGeometry();
    for (const [name, [numbers, size]] of Object.entries(mesh)) {
      geometry.setAttribute(name, new THREE.Float32BufferAttribute(numbers, size));
    }
    for (const [name, [numbers, size]] of Object.entries(items)) {
      geometry.setAttribute(name, new THREE.InstancedBufferAttribute(new Float32Array(numbers), size));
    }
    return { geometry, copies: 1 };
  }
  const geometry = new THREE.BufferGeometry();
  for (const [name, [numbers, size]] of Object.entries(mesh)) {
    const all = new Float32Array(numbers.length * count);
    for (let k = 0; k < count; k += 1) all.set(numbers, k * numbers.length);
    geometry.setAttribute(name, new THREE.BufferAttribute(all, size));
  }
  for (const [name, [numbers, size]] of Object.entries(items)) {
    const all = new Float32Array(size * corners * count);
    for (let at = 0; at < all.length; at += 1) {
      all[at] = numbers[Math.floor(at / (size * corners)) * size + at % size];
    }
    geometry.setAttribute(name, new THREE.BufferAttribute(all, size));
  }
  return { geometry, copies: corners };
};
