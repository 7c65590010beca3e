// People: bodies, or dots where these would be too small to see.

const crowdContext = element("crowd").getContext("2d");
const dotBelow = 12;      // pixels: smaller people are dots
const thinLine = 1;       // pixels: strokes of 1.05 take five times as long, and so does 1 in a scaled frame
const outlinedFrom = 40;  // pixels: smaller bodies have no outline unless they overlap

/** Rows of the current frame that the view shows, by how they are drawn; filled anew for each frame. */
const drawn = {bodies: [], hits: [], wallHits: [], dots: [], hitDots: []};

function sortRows() {
  for (const list of Object.values(drawn)) list.length = 0;
  const left = groundX(0), right = groundX(view.width), bottom = groundY(view.height), top = groundY(0);
  const frame = player.frame;
  for (let row = frames.begin[frame]; row < frames.begin[frame + 1]; ++row) {
    const x = standX(row), y = standY(row), radius = shapes.radius[people.shape[row]];
    if (x + radius < left || x - radius > right || y + radius < bottom || y - radius > top) continue;
    const isDot = sizeOf(people.shape[row]) * view.scale < dotBelow;
    const mark = people.marks[row];
    if (isDot) (mark === 0 ? drawn.dots : drawn.hitDots).push(row);
    else (mark === 0 ? drawn.bodies : mark === marks.inWall ? drawn.wallHits : drawn.hits).push(row);
  }
}

function drawRing(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
}

function drawDots(context, rows, radius, colour, ring) {
  context.fillStyle = context.strokeStyle = colour;
  for (const row of rows) {
    const x = screenX(standX(row)), y = screenY(standY(row));
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
    if (ring) drawRing(context, x, y, ring);
  }
}

function drawSmallPeople(context) {
  const radius = Math.max(1.5, 0.2 * view.scale);
  context.lineWidth = thinLine;
  drawDots(context, drawn.dots, radius, colours["body-line"]);
  drawDots(context, drawn.hitDots, radius + 1, colours.hit, radius + 3);
}

function drawBodies(context) {
  const isOutlined = 2 * shapes.typicalRadius * view.scale >= outlinedFrom;
  context.fillStyle = colours[isOutlined ? "body" : "body-small"];
  context.strokeStyle = colours["body-line"];
  context.lineWidth = thinLine;
  for (const row of drawn.bodies) {
    traceBody(context, row);
    context.fill();
    if (isOutlined) context.stroke();
  }
}

const rimFrom = 32, strokedFrom = 128;  // pixels a metre
const rimWidth = () => Math.min(Math.max(0.03 * view.scale, 1.7), 3.2);

/** Bodies in one colour, a bit larger than they are. */
function drawBold(context, rows) {
  context.fillStyle = colours.hit;
  for (const row of rows) {
    traceBody(context, row, -1.2);
    context.fill();
  }
}

/** Two areas, one in the other, which take half the time of strokes. */
function drawRims(context, rows) {
  const inwards = rimWidth();
  for (const row of rows) {
    traceBody(context, row);
    context.fillStyle = colours.hit;
    context.fill();
    traceBody(context, row, inwards);
    context.fillStyle = colours["hit-fill"];
    context.fill();
  }
}

function drawStroked(context, rows, dash) {
  context.fillStyle = colours["hit-fill"];
  context.strokeStyle = colours.hit;
  context.lineWidth = rimWidth();
  context.setLineDash(dash);
  for (const row of rows) {
    traceBody(context, row);
    context.fill();
    context.stroke();
  }
  context.setLineDash([]);
}

/** People in walls alone have a dashed rim, people in each other a whole one, by areas as long as a dense crowd is in view. */
function drawHits(context) {
  if (view.scale < rimFrom) return drawBold(context, [...drawn.wallHits, ...drawn.hits]);
  drawStroked(context, drawn.wallHits, [5, 4]);
  if (view.scale < strokedFrom) drawRims(context, drawn.hits);
  else drawStroked(context, drawn.hits, []);
}

/** Small triangles that point to where bodies are heading, all in one path. */
function drawHeadings(context, rows, colour) {
  context.beginPath();
  for (const row of rows) {
    const x = screenX(standX(row)), y = screenY(standY(row)), heading = standHeading(row);
    const along = Math.cos(heading) * view.scale, across = Math.sin(heading) * view.scale;
    context.moveTo(x + 0.1 * along, y - 0.1 * across);
    context.lineTo(x - 0.05 * along - 0.06 * across, y + 0.05 * across - 0.06 * along);
    context.lineTo(x - 0.05 * along + 0.06 * across, y + 0.05 * across + 0.06 * along);
    context.closePath();
  }
  context.fillStyle = colour;
  context.fill();
}

function drawDiscs(context) {
  context.lineWidth = thinLine;
  context.globalAlpha = 0.7;
  for (const [rows, colour] of [[drawn.bodies, "body-line"], [drawn.hits, "hit"], [drawn.wallHits, "hit"]]) {
    context.strokeStyle = colours[colour];
    for (const row of rows) {
      traceDiscs(context, row);
      context.stroke();
    }
  }
  context.globalAlpha = 1;
}

const trailSeconds = 10;

/** Where the selected person came from, fainter with time. */
function drawTrail(context) {
  if (selection.who < 0) return;
  let x, y, drawing = false;
  context.strokeStyle = colours.accent;
  context.lineWidth = 2;
  context.lineCap = "butt";
  const now = frames.seconds[player.frame], first = frameAt(now - trailSeconds);
  for (let frame = first; frame <= player.frame; ++frame) {
    const row = rowOf(frame, selection.who);
    if (row >= 0 && drawing) {
      context.globalAlpha = 0.1 + 0.7 * Math.max(0, 1 - (now - frames.seconds[frame]) / trailSeconds);
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(screenX(standX(row)), screenY(standY(row)));
      context.stroke();
    }
    drawing = row >= 0;
    if (drawing) [x, y] = [screenX(standX(row)), screenY(standY(row))];
  }
  context.globalAlpha = 1;
}

/** Traces the two of an event, and where it is deepest. */
function drawEvent(context) {
  const {whos, x, y} = selection.event;
  context.strokeStyle = colours.accent;
  context.lineWidth = 2.2;
  for (const row of whos.map((who) => rowOf(player.frame, who))) {
    if (row < 0) continue;
    traceBody(context, row);
    context.stroke();
  }
  context.lineWidth = 1.2;
  context.setLineDash([3, 4]);
  drawRing(context, screenX(x), screenY(y), Math.max(14, 0.75 * view.scale));
  context.setLineDash([]);
}

/** Rings around the selected person and the one under the pointer. */
function drawRings(context) {
  context.strokeStyle = colours.accent;
  for (const [who, width] of [[selection.hovered, 1.2], [selection.who, 2]]) {
    const row = who < 0 ? -1 : rowOf(player.frame, who);
    if (row < 0) continue;
    context.lineWidth = width;
    drawRing(context, screenX(standX(row)), screenY(standY(row)),
      Math.max(8, (shapes.radius[people.shape[row]] + 0.06) * view.scale));
  }
}

function drawCrowd() {
  const context = crowdContext;
  context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  context.lineJoin = view.scale < 100 ? "bevel" : "round";  // round ones take twice the time
  context.clearRect(0, 0, view.width, view.height);
  if (frames.count === 0) return;
  sortRows();
  drawTrail(context);
  drawSmallPeople(context);
  drawBodies(context);
  drawHits(context);
  if (player.discs) drawDiscs(context);
  if (view.scale >= 50) {
    drawHeadings(context, drawn.bodies, colours["body-line"]);
    drawHeadings(context, drawn.hits, colours.hit);
    drawHeadings(context, drawn.wallHits, colours.hit);
  }
  if (selection.event !== null) drawEvent(context);
  drawRings(context);
}
