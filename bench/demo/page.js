// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// The page: a crowd that walks, is checked in every frame and drawn.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { BodyCloud } from "./body_cloud.js";
import { Check, People, kinds, spheresOfPoses } from "./people.js";

const element = (id) => document.getElementById(id);
const asked = new URLSearchParams(location.search);
const spheres = spheresOfPoses();

THREE.Object3D.DEFAULT_UP.set(0, 0, 1);
const renderer = new THREE.WebGLRenderer({ canvas: element("scene"), antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(45, 1, 0.1, 500);
const controls = new OrbitControls(camera, renderer.domElement);
controls.maxPolarAngle = 1.5;
const dark = matchMedia("(prefers-color-scheme: dark)");
function paintGround() {
  scene.background = new THREE.Color(dark.matches ? 0x15191e : 0xeef1f4);
  ground.material.color.set(dark.matches ? 0x20262d : 0xdde2e7);
}
const ground = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), new THREE.MeshBasicMaterial());
scene.add(ground);
dark.addEventListener("change", paintGround);
paintGround();

let people, check, cloud;

function populate(count) {
  if (cloud) scene.remove(cloud), cloud.dispose();
  people = new People(count, Number(asked.get("seed") ?? 1));
  cloud = new BodyCloud(spheres, people);
  scene.add(cloud);
  ground.scale.set(people.side, people.side, 1);
  // Some 90 people are in sight at first, however many there are.
  const distance = Math.min(people.side, 9);
  camera.position.set(-distance, -0.7 * distance, 0.75 * distance);
  controls.target.set(0, 0, 0.7);
  controls.maxDistance = 2 * people.side;
  choose();
}

function choose() {
  check?.free();
  check = new Check(people, element("bodies").value);
}

/** Takes a share of each new value, so that numbers can be read. */
class Smooth {
  value = undefined;
  add(value) {
    this.value = this.value === undefined ? value : 0.9 * this.value + 0.1 * value;
    return this.value;
  }
}
const times = { posing: new Smooth(), finding: new Smooth(), frame: new Smooth() };
const milliseconds = (value) => `${value.toFixed(value < 10 ? 1 : 0)} ms`;

let frames = 0;
function tell({ pairs, posing, finding }, frame) {
  const colliding = check.collides.reduce((sum, hit) => sum + hit, 0);
  const texts = {
    pairs: (pairs.length / 2).toLocaleString("en"),
    colliding: `${colliding.toLocaleString("en")} (${((100 * colliding) / people.count).toFixed(0)} %)`,
    posing: milliseconds(times.posing.add(posing)),
    finding: milliseconds(times.finding.add(finding)),
    frame: `${(1000 / times.frame.add(frame)).toFixed(0)} a second`,
  };
  if (frames++ % 6 === 0) for (const [id, text] of Object.entries(texts)) element(id).textContent = text;
}

let last;
function frame(now) {
  const elapsed = last === undefined ? 0 : (now - last) / 1000;
  const isStill = element("pause").checked;
  if (!isStill) people.step(asked.has("step") ? Number(asked.get("step")) : Math.min(elapsed, 0.1));
  const found = check.run();
  cloud.show(check.collides);
  controls.update();
  renderer.render(scene, camera);
  tell(found, 1000 * elapsed || 16);
  last = now;
  window.demo = { people, check, found, frames };
  requestAnimationFrame(frame);
}

function resize() {
  renderer.setSize(innerWidth, innerHeight, false);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener("resize", resize);
resize();

// Drag a person: on the ground, from where the pointer is.
const caster = new THREE.Raycaster();
function onGround(event, height) {
  const at = new THREE.Vector2((2 * event.clientX) / innerWidth - 1, 1 - (2 * event.clientY) / innerHeight);
  caster.setFromCamera(at, camera);
  return caster.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), -height), new THREE.Vector3());
}
const heldAt = 0.9; // metres: at the height of the hips
function personAt(event) {
  const point = onGround(event, heldAt);
  const { x, y } = people.agents, half = people.side / 2;
  let nearest = -1, least = 0.4 ** 2;
  for (let i = 0; point && i < people.count; ++i) {
    const square = (x[i] - half - point.x) ** 2 + (y[i] - half - point.y) ** 2;
    if (square < least) (least = square), (nearest = i);
  }
  return nearest;
}
renderer.domElement.addEventListener(
  "pointerdown",
  (event) => {
    people.held = personAt(event);
    controls.enabled = people.held < 0;
    if (!controls.enabled) renderer.domElement.setPointerCapture(event.pointerId);
  },
  { capture: true },
);
renderer.domElement.addEventListener("pointermove", (event) => {
  const point = people.held < 0 ? null : onGround(event, heldAt);
  if (!point) return;
  const { x, y } = people.agents, half = people.side / 2;
  x[people.held] = Math.min(Math.max(point.x + half, 0), people.side - 1e-6);
  y[people.held] = Math.min(Math.max(point.y + half, 0), people.side - 1e-6);
});
for (const end of ["pointerup", "pointercancel"])
  renderer.domElement.addEventListener(end, () => {
    people.held = -1;
    controls.enabled = true;
  });

// The number of people goes from 100 to 10 000 in equal ratios.
const slider = element("count");
const countOf = (at) => Math.round(100 * 10 ** (at / 50));
function showCount() {
  element("people").textContent = countOf(Number(slider.value)).toLocaleString("en");
}
for (const [name, { title }] of Object.entries(kinds)) element("bodies").add(new Option(title, name));
element("bodies").value = asked.get("bodies") ?? "spheres64";
if (asked.has("people")) slider.value = 50 * Math.log10(Number(asked.get("people")) / 100);
element("bodies").addEventListener("change", choose);
slider.addEventListener("input", showCount);
slider.addEventListener("change", () => populate(countOf(Number(slider.value))));
showCount();
populate(countOf(Number(slider.value)));
element("panel").hidden = false;
element("loading").hidden = true;
requestAnimationFrame(frame);
