// The section plane, and what the cut of a closed part looks like.
//
// Where a ray from the eye crosses the plane within a part, the first face that it meets behind the plane is the part's
// own, seen from inside; where it crosses in the air, it is a face seen from outside. So inner faces painted flat are
// exactly the cut, at no cost: no stencil, no second scene.

import { MeshBasicMaterial, BackSide, Plane, Vector3 } from "three";

const HATCH = `
  float stripe = abs(fract((gl_FragCoord.x + SLANT * gl_FragCoord.y) / PITCH) - 0.5);
  gl_FragColor.rgb *= mix(0.72, 1.0, smoothstep(0.04, 0.11, stripe));
`;

// Along the axis the plane faces the viewer and moves through the depth; across, it faces the rod's end.
export const DIRECTIONS = { along: new Vector3(0, 0, -1), across: new Vector3(-1, 0, 0) };

// A plane that keeps what lies on its far side: share 0 cuts nothing off, 1 everything.
export function place(plane, direction, share, box) {
  const normal = DIRECTIONS[direction];
  const axis = direction === "along" ? "z" : "x";
  const low = box.min[axis];
  const high = box.max[axis];
  plane.normal.copy(normal);
  plane.constant = high + 1e-6 - share * (high - low);
}

export function cutMaterial(planes, slant, pitch) {
  const material = new MeshBasicMaterial({ side: BackSide, clippingPlanes: planes });
  // Where two parts touch, the near one's inner face is in front; by no more, for it must not show beyond an outline.
  material.polygonOffset = true;
  material.polygonOffsetUnits = -4;
  material.onBeforeCompile = (shader) => {
    const hatch = HATCH.replace("SLANT", slant.toFixed(1)).replace("PITCH", pitch.toFixed(1));
    shader.fragmentShader = shader.fragmentShader.replace("#include <dithering_fragment>", `${hatch}\n#include <dithering_fragment>`);
  };
  material.customProgramCacheKey = () => `hatch ${slant} ${pitch}`;
  return material;
}

export function newPlane() {
  return new Plane(new Vector3(0, 0, -1), 0);
}
