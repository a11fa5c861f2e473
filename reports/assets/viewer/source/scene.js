// The scene: an instanced mesh for each shape and colour, drawn only when something has changed.

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  EdgesGeometry,
  HemisphereLight,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  MeshStandardMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";

import { cutMaterial, newPlane, place } from "./cut.js";

const DENSEST = 2; // device pixels to one of the page; more costs a slow machine much and shows nothing
const LIT = new Color(1, 0.45, 0.02);
const EDGE = 32; // degrees; sharper edges are drawn

export class View {
  constructor(canvas, { meshes, pieces }) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: "low-power" });
    this.renderer.localClippingEnabled = true;
    this.canvas = canvas;
    this.camera = new PerspectiveCamera(24, 2, 0.01, 100);
    this.scene = new Scene();
    this.plane = newPlane();
    this.pieces = pieces;
    this.groups = [];
    this.lit = new Set();
    this.section = { direction: "along", share: 0.5, only: "" };
    this.light();
    this.density = Math.min(window.devicePixelRatio || 1, DENSEST);
    this.build(meshes);
    canvas.addEventListener("webglcontextrestored", () => this.draw());
  }

  light() {
    this.scene.add(new HemisphereLight(0xffffff, 0x8c949c, 1.7));
    for (const [x, y, z, strength] of [[-1, 2, 2, 2.2], [2, 0.5, 1, 0.9]]) {
      const light = new DirectionalLight(0xffffff, strength);
      light.position.set(x, y, z);
      this.camera.add(light);
    }
    this.scene.add(this.camera);
  }

  build(meshes) {
    const geometries = new Map();
    const lines = new LineBasicMaterial({ color: 0x10181f, transparent: true, opacity: 0.55, clippingPlanes: [this.plane] });
    const whole = lines.clone();
    whole.clippingPlanes = [];
    this.lines = [lines, whole];
    this.box = new Box3();
    meshes.forEach((mesh, index) => {
      const own = this.pieces.filter((piece) => piece.mesh === index);
      if (!geometries.has(mesh.shape)) geometries.set(mesh.shape, geometryOf(mesh));
      const { surface, edges } = geometries.get(mesh.shape);
      const face = new MeshStandardMaterial({ metalness: 0.5 * mesh.metallic, roughness: mesh.roughness, clippingPlanes: [this.plane] });
      const cut = cutMaterial([this.plane], own[0].item % 2 ? 1 : -1, 7 * this.density);
      const outer = new InstancedMesh(surface, face, own.length);
      const inner = new InstancedMesh(surface, cut, own.length);
      const group = { outer, inner, face, lines: [], pieces: own, colour: new Color(...mesh.colour.slice(0, 3)), member: own[0].group };
      own.forEach((piece, i) => {
        outer.setMatrixAt(i, piece.matrix);
        inner.setMatrixAt(i, piece.matrix);
        const line = new LineSegments(edges, lines);
        line.matrixAutoUpdate = false;
        line.matrix.copy(piece.matrix);
        line.matrixWorldNeedsUpdate = true;
        group.lines.push(line);
        this.box.union(surface.boundingBox.clone().applyMatrix4(piece.matrix));
      });
      this.scene.add(outer, inner, ...group.lines);
      this.groups.push(group);
      this.paint(group);
    });
  }

  paint(group) {
    group.pieces.forEach((piece, i) => {
      const colour = this.lit.has(piece) ? LIT : group.colour;
      group.outer.setColorAt(i, colour);
      group.inner.setColorAt(i, colour);
    });
    group.outer.instanceColor.needsUpdate = group.inner.instanceColor.needsUpdate = true;
  }

  // Light these pieces up and no others.
  highlight(pieces) {
    this.lit = new Set(pieces);
    this.groups.forEach((group) => this.paint(group));
    this.draw();
  }

  show(item, visible) {
    for (const group of this.groups.filter((found) => found.pieces[0].item === item)) {
      group.hidden = !visible;
    }
    this.cut(this.section);
  }

  // direction : "along", "across" or "none". share : 0 to 1. only : the group that is cut, "" for all.
  cut(section) {
    this.section = section;
    const cutting = section.direction !== "none";
    if (cutting) place(this.plane, section.direction, section.share, this.box);
    for (const group of this.groups) {
      const own = cutting && section.share > 0 && (!section.only || section.only === group.member);
      group.face.clippingPlanes = own ? [this.plane] : [];
      group.outer.visible = !group.hidden;
      group.inner.visible = own && !group.hidden;
      for (const line of group.lines) {
        line.visible = !group.hidden;
        line.material = this.lines[own ? 0 : 1];
      }
      group.cut = own;
    }
    this.draw();
  }

  // The piece at a place of the window, as it is seen: what is cut off or hidden is not there.
  pick(x, y) {
    const frame = this.canvas.getBoundingClientRect();
    const at = new Vector2(((x - frame.left) / frame.width) * 2 - 1, 1 - ((y - frame.top) / frame.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const shown = this.groups.filter((group) => !group.hidden);
    const meshes = shown.flatMap((group) => (group.cut ? [group.outer, group.inner] : [group.outer]));
    const owner = new Map(shown.flatMap((group) => [[group.outer, group], [group.inner, group]]));
    const hit = ray
      .intersectObjects(meshes, false)
      .find(({ object, point }) => !owner.get(object).cut || this.plane.distanceToPoint(point) >= 0);
    return hit ? owner.get(hit.object).pieces[hit.instanceId] : null;
  }

  corners() {
    const { min, max } = this.box;
    return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z));
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.density = Math.min(window.devicePixelRatio || 1, DENSEST);
    this.renderer.setPixelRatio(this.density);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  // At the next frame, once, however often it is asked for; nothing runs while nothing changes.
  draw() {
    this.wanted ??= requestAnimationFrame(() => {
      this.wanted = undefined;
      this.renderer.render(this.scene, this.camera);
      this.canvas.dataset.frames = String(Number(this.canvas.dataset.frames ?? 0) + 1);
    });
  }
}

function geometryOf(mesh) {
  const surface = new BufferGeometry();
  surface.setAttribute("position", new BufferAttribute(mesh.positions, 3));
  surface.setAttribute("normal", new BufferAttribute(mesh.normals, 3));
  surface.setIndex(new BufferAttribute(mesh.indices, 1));
  surface.computeBoundingBox();
  return { surface, edges: new EdgesGeometry(surface, EDGE) };
}
