// Draws the forces between grains: a line from centre to centre each, thick and dark where it is
// strong. forceNetwork(bed, colour) makes what three.js shows of a bed as read by bed.js.
const forceNetwork = (() => {
  "use strict";

  // A ribbon that faces the eye, lit as a tube, its width the root of the force.
  const ribbonMaterial = (bed) => new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    vertexShader: `
      attribute vec3 begin; attribute vec3 end; attribute float share; attribute vec3 tint;
      uniform vec4 cut; uniform float thick; uniform float least; varying vec3 colour; varying float across;
      void main() {
        colour = tint; across = position.y;
        vec4 from = modelViewMatrix * vec4(begin, 1.0);
        vec4 to = modelViewMatrix * vec4(end, 1.0);
        vec2 along = to.xy - from.xy;
        vec2 side = length(along) > 1e-6 ? normalize(vec2(-along.y, along.x)) : vec2(1.0, 0.0);
        vec4 seen = mix(from, to, position.x);
        seen.xy += position.y * side * max(least, thick * sqrt(share));
        bool is_cut = max(dot(begin, cut.xyz), dot(end, cut.xyz)) > cut.w;
        gl_Position = is_cut ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * seen;
      }`,
    fragmentShader: `
      varying vec3 colour; varying float across;
      void main() { gl_FragColor = vec4(colour * (0.6 + 0.4 * sqrt(1.0 - across * across)), 1.0); }`,
    uniforms: { cut: { value: new THREE.Vector4() }, thick: { value: 0.35 * bed.largest_radius },
                least: { value: 0 } }, // about half a pixel, told by bed.js
  });

  // Through a periodic boundary go two halves, one from each grain.
  const linesOf = (bed) => {
    const lines = { begin: [], end: [], share: [] };
    for (let k = 0; k < bed.pairs; k += 1) {
      const from = [bed.x, bed.y, bed.z].map((column) => column[bed.a[k]]);
      const to = [bed.x, bed.y, bed.z].map((column) => column[bed.b[k]]);
      const way = from.map((place, axis) => {
        const period = axis < 2 && !bed.walls[axis] ? bed.box[axis] : Infinity;
        const apart = to[axis] - place;
        return Math.abs(apart) > period / 2 ? apart - Math.sign(apart) * period : apart;
      });
      const part = way.some((step, axis) => Math.abs(step - to[axis] + from[axis]) > 1e-9) ? 0.5 : 1;
      lines.begin.push(...from);
      lines.end.push(...from.map((place, axis) => place + part * way[axis]));
      lines.share.push(bed.share[k]);
      if (part === 1) continue;
      lines.begin.push(...to);
      lines.end.push(...to.map((place, axis) => place - part * way[axis]));
      lines.share.push(bed.share[k]);
    }
    return lines;
  };

  // Strong forces are dark: thin bright lines would vanish on white.
  return (bed, colour) => {
    const lines = linesOf(bed);
    const tint = lines.share.flatMap((share) => colour(1 - share).map((value) => value / 255));
    const ribbon = { position: [[0, -1, 0, 1, -1, 0, 1, 1, 0, 0, -1, 0, 1, 1, 0, 0, 1, 0], 3] };
    const { geometry } = repeated(ribbon, { begin: [lines.begin, 3], end: [lines.end, 3],
                                            share: [lines.share, 1], tint: [tint, 3] },
                                  lines.share.length);
    const network = new THREE.Mesh(geometry, ribbonMaterial(bed));
    network.frustumCulled = false;
    return network;
  };
})();
