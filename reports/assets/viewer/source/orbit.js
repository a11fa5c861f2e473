// Turns, shifts and zooms a camera by mouse, touch and keyboard, and says when there is something new to draw.

import { Spherical, Vector3 } from "three";

const TURN = 0.01; // rad to a pixel
const STEP = Math.PI / 24; // rad to a key
const CLICK = 6; // pixels that a finger may slip

export class Orbit {
  // pick : called with a click's place. changed : called after every move.
  constructor(camera, canvas, { pick, changed }) {
    Object.assign(this, { camera, canvas, pick, changed });
    this.target = new Vector3();
    this.place = new Spherical(1, 1.2, 0.6);
    this.pointers = new Map();
    this.reach = [0.01, 100];
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => this.up(event));
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  // Look from a direction so that these corners fill the picture but for a margin.
  look(theta, phi, corners) {
    this.place.set(1, phi, theta);
    this.corners = corners;
    this.fit();
  }

  // Perspective makes the middle of the corners not the middle of their picture: a few rounds settle both.
  fit() {
    const eye = new Vector3().setFromSpherical(this.place).normalize();
    this.camera.position.copy(eye);
    this.camera.lookAt(0, 0, 0);
    this.camera.updateMatrix();
    const right = new Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const up = new Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    const tall = Math.tan((this.camera.fov * Math.PI) / 360);
    const wide = tall * this.camera.aspect;
    const target = this.corners.reduce((sum, corner) => sum.add(corner), new Vector3()).divideScalar(this.corners.length);
    let distance = 4 * Math.max(...this.corners.map((corner) => corner.distanceTo(target)));
    for (let round = 0; round < 8; round++) {
      const seen = this.corners.map((corner) => {
        const offset = corner.clone().sub(target);
        const depth = distance - offset.dot(eye);
        return [offset.dot(right) / depth, offset.dot(up) / depth];
      });
      const [x, y] = [0, 1].map((axis) => seen.map((place) => place[axis]));
      const [middleX, middleY] = [x, y].map((all) => (Math.max(...all) + Math.min(...all)) / 2);
      const fill = Math.max((Math.max(...x) - Math.min(...x)) / wide, (Math.max(...y) - Math.min(...y)) / tall) / 2;
      target.addScaledVector(right, middleX * distance).addScaledVector(up, middleY * distance);
      distance *= fill / 0.95;
    }
    this.target.copy(target);
    this.place.radius = distance;
    this.reach = [distance / 20, distance * 4];
    this.update();
  }

  update() {
    this.place.phi = Math.min(Math.max(this.place.phi, 0.02), Math.PI - 0.02);
    this.place.radius = Math.min(Math.max(this.place.radius, this.reach[0]), this.reach[1]);
    this.camera.position.setFromSpherical(this.place).add(this.target);
    this.camera.lookAt(this.target);
    this.camera.near = this.place.radius / 50;
    this.camera.far = this.place.radius * 3 + this.reach[1];
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.changed();
  }

  turn(across, down) {
    this.place.theta -= across;
    this.place.phi -= down;
    this.update();
  }

  zoom(factor) {
    this.place.radius *= factor;
    this.update();
  }

  shift(x, y) {
    const scale = (2 * this.place.radius * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
    const right = new Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const up = new Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    this.target.addScaledVector(right, -x * scale).addScaledVector(up, y * scale);
    this.update();
  }

  down(event) {
    if (event.button === 1) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.start = this.pointers.size === 1 ? [event.clientX, event.clientY] : null;
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const [x, y] = [now[0] - before[0], now[1] - before[1]];
    if (this.start && Math.hypot(now[0] - this.start[0], now[1] - this.start[1]) > CLICK) this.start = null;
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.pointers.set(event.pointerId, now);
    if (other) {
      this.place.radius *= apart(before, other) / Math.max(apart(now, other), 1);
      this.shift(x / 2, y / 2);
    } else if (event.shiftKey || event.buttons & 2) this.shift(x, y);
    else if (!this.start) this.turn(x * TURN, y * TURN);
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && this.start && event.button === 0) this.pick(event.clientX, event.clientY);
    this.start = null;
  }

  // The page scrolls as everywhere, unless the view was clicked before or the key for zooming is held.
  wheel(event) {
    if (document.activeElement !== this.canvas && !event.ctrlKey) return;
    event.preventDefault();
    this.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY / 400))));
  }

  key(event) {
    const moves = {
      ArrowLeft: () => this.turn(-STEP, 0),
      ArrowRight: () => this.turn(STEP, 0),
      ArrowUp: () => this.turn(0, -STEP),
      ArrowDown: () => this.turn(0, STEP),
      "+": () => this.zoom(0.85),
      "=": () => this.zoom(0.85),
      "-": () => this.zoom(1 / 0.85),
    };
    const move = moves[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move();
  }
}

function apart(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
