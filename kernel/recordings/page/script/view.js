// The part of the ground that is shown: its middle in metres, pixels a metre, and how the pointer changes it.

const stage = element("stage");
const reducedMotion = matchMedia("(prefers-reduced-motion: reduce)");
const view = {x: 0, y: 0, scale: 40, width: 1, height: 1, changed: true, moving: 0};
const leastScale = 0.2, mostScale = 1500;

const screenX = (x) => view.width / 2 + (x - view.x) * view.scale;
const screenY = (y) => view.height / 2 - (y - view.y) * view.scale;
const groundX = (px) => view.x + (px - view.width / 2) / view.scale;
const groundY = (py) => view.y - (py - view.height / 2) / view.scale;

function setView(x, y, scale) {
  view.x = x;
  view.y = y;
  view.scale = Math.min(Math.max(scale, leastScale), mostScale);
  view.changed = true;
  requestDraw();
}

/** Goes there within a fifth of a second, or at once for those who want no motion. */
function moveView(x, y, scale) {
  const from = {...view}, began = performance.now(), lasts = 200, turn = ++view.moving;
  if (reducedMotion.matches) return setView(x, y, scale);
  const step = (now) => {
    if (turn !== view.moving) return;
    const part = Math.min(Math.max((now - began) / lasts, 0), 1), eased = 1 - (1 - part) ** 3;
    setView(from.x + (x - from.x) * eased, from.y + (y - from.y) * eased,
      from.scale * (scale / from.scale) ** eased);
    if (part < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

/** Zooms by a factor about a point of the stage, which stays where it is. */
function zoomAbout(px, py, factor) {
  ++view.moving;
  const scale = Math.min(Math.max(view.scale * factor, leastScale), mostScale);
  const x = groundX(px), y = groundY(py);
  setView(x - (px - view.width / 2) / scale, y + (py - view.height / 2) / scale, scale);
}

const zoomBy = (factor) => moveView(view.x, view.y, Math.min(Math.max(view.scale * factor, leastScale), mostScale));

/** Pixels beside the fitted picture, for the ruler and the buttons. */
const border = {left: 46, right: 60, bottom: 20};

function fittedScale() {
  const margin = 1.2;
  return Math.min((view.width - border.left - border.right) / (bounds.right - bounds.left + margin),
    (view.height - border.bottom) / (bounds.top - bounds.bottom + margin));
}

function fit(atOnce) {
  follow(false);
  view.fitted = true;
  const scale = Math.max(fittedScale(), leastScale);
  (atOnce ? setView : moveView)((bounds.left + bounds.right + (border.right - border.left) / scale) / 2,
    (bounds.bottom + bounds.top - border.bottom / scale) / 2, scale);
}

function resizeStage() {
  const first = view.width === 1, box = stage.getBoundingClientRect();
  view.width = stage.clientWidth || box.width;
  view.height = stage.clientHeight || box.height;
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  for (const canvas of [element("ground"), element("crowd"), element("ruler")]) {
    canvas.width = Math.round(view.width * ratio);
    canvas.height = Math.round(view.height * ratio);
  }
  view.ratio = ratio;
  if (first || view.fitted) fit(true);
  view.changed = true;
  draw();
}

/** Pointers that are down on the stage, by their number. */
const pointers = new Map();
let dragged = 0;  // pixels since the pointer went down

const offsetIn = (event) => {
  const box = stage.getBoundingClientRect();
  return {x: event.clientX - box.left - stage.clientLeft, y: event.clientY - box.top - stage.clientTop};
};

function middleOf(points) {
  const [a, b = a] = points;
  return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y)};
}

function pointerDown(event) {
  if (event.target.closest("button, .card")) return;
  if (event.button !== 0 && event.pointerType === "mouse") return;
  stage.setPointerCapture(event.pointerId);
  if (pointers.size === 0) dragged = 0;
  pointers.set(event.pointerId, offsetIn(event));
  hideTip();
}

function pointerMove(event) {
  if (!pointers.has(event.pointerId)) {
    if (event.pointerType === "mouse") hover(event.target.closest("button, .card") ? null : offsetIn(event));
    return;
  }
  const before = middleOf(pointers.values());
  pointers.set(event.pointerId, offsetIn(event));
  const after = middleOf(pointers.values());
  dragged += Math.hypot(after.x - before.x, after.y - before.y) + Math.abs(after.apart - before.apart);
  if (dragged < 4) return;
  stage.classList.add("dragging");
  follow(false);
  view.fitted = false;
  ++view.moving;
  setView(view.x - (after.x - before.x) / view.scale, view.y + (after.y - before.y) / view.scale, view.scale);
  if (before.apart > 0 && after.apart > 0) zoomAbout(after.x, after.y, after.apart / before.apart);
}

function pointerUp(event) {
  if (!pointers.delete(event.pointerId)) return;
  if (pointers.size > 0) return;
  stage.classList.remove("dragging");
  if (event.type === "pointerup" && dragged < 4) selectAt(offsetIn(event));
}

function listenToStage() {
  stage.addEventListener("pointerdown", pointerDown);
  stage.addEventListener("pointermove", pointerMove);
  stage.addEventListener("pointerup", pointerUp);
  stage.addEventListener("pointercancel", pointerUp);
  stage.addEventListener("pointerleave", () => hover(null));
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.fitted = false;
    const pixels = event.deltaY * (event.deltaMode === 1 ? 20 : 1), at = offsetIn(event);
    zoomAbout(at.x, at.y, Math.exp(-Math.max(-200, Math.min(200, pixels)) * (event.ctrlKey ? 0.008 : 0.002)));
  }, {passive: false});
  element("zoom-in").addEventListener("click", zoomIn);
  element("zoom-out").addEventListener("click", zoomOut);
  element("fit").addEventListener("click", () => fit(false));
  new ResizeObserver(resizeStage).observe(stage);
}

function zoomIn() {
  view.fitted = false;
  zoomBy(1.5);
}

function zoomOut() {
  view.fitted = false;
  zoomBy(1 / 1.5);
}
