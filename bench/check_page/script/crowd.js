// People: bodies, or dots where these would be too small to see.

const crowdContext = element("crowd").getContext("2d");
const dotBelow = 12;      // pixels: smaller people are dots
const outlinedFrom = 40;  // pixels: smaller bodies have no outline unless they overlap

/** Rows of the current frame that the view shows, by how they are drawn; filled anew for each frame. */
const drawn = {bodies: [], hits: [], wallHits: [], dots: [], hitDots: []};

function sortRows() {
  for (const list of Object.values(drawn)) list.length = 0;
  const left = groundX(0), right = groundX(view.width), bottom = groundY(view.height), top = groundY(0);
  const frame = player.frame;
  for (let row = frames.begin[frame]; row < frames.begin[frame + 1]; ++row) {
    const x = placeX(row), y = placeY(row), radius = shapes.radius[people.shape[row]];
    if (x + radius < left || x - radius > right || y + radius < bottom || y - radius > top) continue;
    const isDot = sizeOf(people.shape[row]) * view.scale < dotBelow;
    const mark = people.marks[row];
    if (isDot) (mark === 0 ? drawn.dots : drawn.hitDots).push(row);
    else (mark === 0 ? drawn.bodies : mark === marks.inWall ? drawn.wallHits : drawn.hits).push(row);
  }
}

function drawDots(context, rows, radius) {
  context.beginPath();
  for (const row of rows) {
    const x = screenX(placeX(row)), y = screenY(placeY(row));
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  }
}

function drawSmallPeople(context) {
  const radius = Math.max(1.5, 0.2 * view.scale);
  drawDots(context, drawn.dots, radius);
  context.fillStyle = colours["body-line"];
  context.fill();
  drawDots(context, drawn.hitDots, radius + 1);
  context.fillStyle = colours.hit;
  context.fill();
  drawDots(context, drawn.hitDots, radius + 3);
  context.strokeStyle = colours.hit;
  context.lineWidth = 1.2;
  context.stroke();
}

/** Turns the context into the frame of the person in a row. */
function enter(context, row) {
  const heading = headingOf(row), scale = view.scale * view.ratio;
  const cosine = Math.cos(heading) * scale, sine = Math.sin(heading) * scale;
  context.setTransform(cosine, -sine, -sine, -cosine, screenX(placeX(row)) * view.ratio,
    screenY(placeY(row)) * view.ratio);
}

const leave = (context) => context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);

function drawBodies(context) {
  const paths = bodyPaths(view.scale), isOutlined = 2 * shapes.typicalRadius * view.scale >= outlinedFrom;
  context.fillStyle = colours[isOutlined ? "body" : "body-small"];
  context.strokeStyle = colours["body-line"];
  context.lineWidth = 1 / view.scale;
  for (const row of drawn.bodies) {
    const path = paths(people.shape[row]);
    enter(context, row);
    context.fill(path);
    if (isOutlined) context.stroke(path);
  }
}

const rimFrom = 32, strokedFrom = 128;  // pixels a metre

/** People in each other, as large as they are seen well: bold bodies; two areas, one in the other; a thick stroke. The first two
 * take half the time of strokes, and dense crowds are drawn so. */
function drawHits(context) {
  if (view.scale < rimFrom) return fillAll(context, drawn.hits, boldBodies(view.scale), colours.hit);
  if (view.scale < strokedFrom) return drawRims(context);
  const paths = bodyPaths(view.scale);
  context.fillStyle = colours["hit-fill"];
  context.strokeStyle = colours.hit;
  context.lineWidth = 3.2 / view.scale;
  for (const row of drawn.hits) {
    enter(context, row);
    context.fill(paths(people.shape[row]));
    context.stroke(paths(people.shape[row]));
  }
}

function fillAll(context, rows, paths, colour) {
  context.fillStyle = colour;
  for (const row of rows) {
    enter(context, row);
    context.fill(paths(people.shape[row]));
  }
}

function drawRims(context) {
  const paths = bodyPaths(view.scale), insides = withoutRim(view.scale);
  for (const row of drawn.hits) {
    enter(context, row);
    context.fillStyle = colours.hit;
    context.fill(paths(people.shape[row]));
    context.fillStyle = colours["hit-fill"];
    context.fill(insides(people.shape[row]));
  }
}

/** People in walls alone: a dashed rim. */
function drawWallHits(context) {
  if (view.scale < rimFrom) return fillAll(context, drawn.wallHits, boldBodies(view.scale), colours.hit);
  const paths = bodyPaths(view.scale);
  context.fillStyle = colours["hit-fill"];
  context.strokeStyle = colours.hit;
  context.lineWidth = Math.min(Math.max(view.scale * 0.03, 1.8), 3.2) / view.scale;
  context.setLineDash([5 / view.scale, 4 / view.scale]);
  for (const row of drawn.wallHits) {
    const path = paths(people.shape[row]);
    enter(context, row);
    context.fill(path);
    context.stroke(path);
  }
  context.setLineDash([]);
}

/** Small triangles that point to where bodies are heading, all in one path. */
function drawHeadings(context, rows, colour) {
  context.beginPath();
  for (const row of rows) {
    const x = screenX(placeX(row)), y = screenY(placeY(row)), heading = headingOf(row);
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
  context.lineWidth = 1 / view.scale;
  context.globalAlpha = 0.7;
  for (const [rows, colour] of [[drawn.bodies, "body-line"], [drawn.hits, "hit"], [drawn.wallHits, "hit"]]) {
    context.strokeStyle = colours[colour];
    for (const row of rows) {
      enter(context, row);
      context.stroke(discsOf(people.shape[row]));
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
      context.lineTo(screenX(placeX(row)), screenY(placeY(row)));
      context.stroke();
    }
    drawing = row >= 0;
    if (drawing) [x, y] = [screenX(placeX(row)), screenY(placeY(row))];
  }
  context.globalAlpha = 1;
}

function drawRing(context, x, y, radius, width) {
  context.beginPath();
  context.arc(screenX(x), screenY(y), radius, 0, 2 * Math.PI);
  context.strokeStyle = colours.accent;
  context.lineWidth = width;
  context.stroke();
}

/** Traces the two of an event, and where it is deepest. */
function drawEvent(context) {
  const {whos, x, y} = selection.event;
  context.strokeStyle = colours.accent;
  for (const row of whos.map((who) => rowOf(player.frame, who))) {
    if (row < 0) continue;
    enter(context, row);
    context.lineWidth = 2.2 / view.scale;
    context.stroke(bodyPaths(view.scale)(people.shape[row]));
  }
  leave(context);
  context.setLineDash([3, 4]);
  drawRing(context, x, y, Math.max(14, 0.75 * view.scale), 1.2);
  context.setLineDash([]);
}

/** Rings around the selected person and the one under the pointer. */
function drawRings(context) {
  for (const [who, width] of [[selection.hovered, 1.2], [selection.who, 2]]) {
    const row = who < 0 ? -1 : rowOf(player.frame, who);
    if (row < 0) continue;
    drawRing(context, placeX(row), placeY(row),
      Math.max(8, (shapes.radius[people.shape[row]] + 0.06) * view.scale), width);
  }
}

function drawCrowd() {
  const context = crowdContext;
  leave(context);
  context.clearRect(0, 0, view.width, view.height);
  if (frames.count === 0) return;
  sortRows();
  drawTrail(context);
  drawSmallPeople(context);
  context.lineJoin = view.scale < 100 ? "bevel" : "round";  // round ones take twice the time
  drawBodies(context);
  drawWallHits(context);
  drawHits(context);
  if (player.discs) drawDiscs(context);
  leave(context);
  if (view.scale >= 50) {
    drawHeadings(context, drawn.bodies, colours["body-line"]);
    drawHeadings(context, drawn.hits, colours.hit);
    drawHeadings(context, drawn.wallHits, colours.hit);
  }
  if (selection.event !== null) drawEvent(context);
  drawRings(context);
}
