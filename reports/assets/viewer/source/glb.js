// Reads the GLB that the page carries: meshes as arrays, pieces with their places. Only what fluxbore's own writer uses.

import { Matrix4, Quaternion, Vector3 } from "three";

const KINDS = { 5126: Float32Array, 5123: Uint16Array, 5125: Uint32Array };
const WIDTHS = { SCALAR: 1, VEC3: 3 };

// Base64 of gzip -> ArrayBuffer.
export async function unpack(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

// {meshes: [{positions, normals, indices, colour, metallic, roughness}], pieces: [{mesh, name, label, matrix, ...extras}]}
export function parse(buffer) {
  const size = new DataView(buffer).getUint32(12, true);
  const document = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, size)));
  const start = 28 + size;
  const array = (index) => {
    const accessor = document.accessors[index];
    const view = document.bufferViews[accessor.bufferView];
    return new KINDS[accessor.componentType](buffer, start + view.byteOffset, accessor.count * WIDTHS[accessor.type]);
  };
  const meshes = document.meshes.map(({ primitives: [primitive] }) => {
    const look = document.materials[primitive.material].pbrMetallicRoughness;
    return {
      positions: array(primitive.attributes.POSITION),
      normals: array(primitive.attributes.NORMAL),
      indices: array(primitive.indices),
      shape: primitive.attributes.POSITION,
      colour: look.baseColorFactor,
      metallic: look.metallicFactor,
      roughness: look.roughnessFactor,
    };
  });
  const pieces = [];
  const visit = (index, above) => {
    const node = document.nodes[index];
    const here = new Matrix4().compose(
      new Vector3(...(node.translation ?? [0, 0, 0])),
      new Quaternion(...(node.rotation ?? [0, 0, 0, 1])),
      new Vector3(1, 1, 1),
    );
    here.premultiply(above);
    if ("mesh" in node) {
      pieces.push({ mesh: node.mesh, name: node.name, label: document.meshes[node.mesh].name, matrix: here, ...node.extras });
    }
    for (const child of node.children ?? []) visit(child, here);
  };
  // The root lays the axis upwards, as glTF wants it; here it runs to the right, as in every figure of the page.
  const lying = new Matrix4().set(0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1);
  for (const root of document.scenes[document.scene].nodes) {
    for (const child of document.nodes[root].children ?? []) visit(child, lying);
  }
  return { meshes, pieces };
}
