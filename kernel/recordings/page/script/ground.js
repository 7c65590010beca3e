// What only the view changes: a grid and walls below the crowd, the grid's metres above it.

const colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ground", "grid", "line", "ink", "quiet", "accent", "hit", "hit-fill", "body", "body-small",
    "body-line", "wall"])
    colours[name] = style.getPropertyValue("--" + name).trim();
  colours.font = "11px " + getComputedStyle(document.body).fontFamily;
}

/** The step of 1, 2 or 5 times a power of ten that is not narrower than so many pixels. */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= least);
}

/** Calls visit(pixel, metres of the recording) for each line of the grid that the view shows. */
function forGrid(step, from, to, corner, toScreen, visit) {
  const first = Math.ceil((from + corner) / step), last = Math.floor((to + corner) / step);
  for (let i = first; i <= last; ++i) visit(Math.round(toScreen(i * step - corner)) + 0.5, i * step);
}

const gridStep = () => roundStep(64 / view.scale);

function drawGrid(context) {
  const step = gridStep();
  const left = groundX(0), right = groundX(view.width), bottom = groundY(view.height), top = groundY(0);
  context.strokeStyle = colours.grid;
  context.lineWidth = 1;
  context.beginPath();
  forGrid(step, left, right, meta.corner[0], screenX, (x) => { context.moveTo(x, 0); context.lineTo(x, view.height); });
  forGrid(step, bottom, top, meta.corner[1], screenY, (y) => { context.moveTo(0, y); context.lineTo(view.width, y); });
  context.stroke();
}

/** Writes text that stands out from whatever is behind it. */
function writeOver(context, text, x, y) {
  context.strokeText(text, x, y);
  context.fillText(text, x, y);
}

function drawRuler() {
  const context = element("ruler").getContext("2d"), step = gridStep();
  const digits = step < 1 ? Math.ceil(-Math.log10(step) - 1e-9) : 0;
  context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  context.clearRect(0, 0, view.width, view.height);
  const left = groundX(0), right = groundX(view.width), bottom = groundY(view.height), top = groundY(0);
  context.font = colours.font;
  context.fillStyle = colours.quiet;
  context.strokeStyle = colours.ground;
  context.lineWidth = 3;
  context.lineJoin = "round";
  context.textBaseline = "alphabetic";
  context.textAlign = "center";
  forGrid(step, left, right, meta.corner[0], screenX, (x, metres) => {
    if (x > 44 && x < view.width - 24) writeOver(context, metres.toFixed(digits) + " m", x, view.height - 8);
  });
  context.textAlign = "left";
  forGrid(step, bottom, top, meta.corner[1], screenY, (y, metres) => {
    if (y > 40 && y < view.height - 24) writeOver(context, metres.toFixed(digits) + " m", 8, y - 4);
  });
}

function drawWalls(context) {
  context.strokeStyle = colours.wall;
  context.lineWidth = Math.min(Math.max(view.scale * 0.04, 1.5), 4);
  context.lineJoin = context.lineCap = "round";
  context.beginPath();
  for (let wall = 0; wall + 1 < walls.begin.length; ++wall)
    for (let i = walls.begin[wall]; i < walls.begin[wall + 1]; ++i) {
      const x = screenX(walls.points[2 * i] / 1000), y = screenY(walls.points[2 * i + 1] / 1000);
      if (i === walls.begin[wall]) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
  context.stroke();
}

function drawGround() {
  const context = element("ground").getContext("2d", {alpha: false});
  context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  context.fillStyle = colours.ground;
  context.fillRect(0, 0, view.width, view.height);
  drawGrid(context);
  drawWalls(context);
  drawRuler();
}
