// What shapes look like on the stage: outlines with as many points as its scale shows, and discs.

const shapes = {contours: block("contours-begin"), points: block("points-begin"), xy: block("points"),
  discsBegin: block("discs-begin"), discs: block("discs")};
shapes.count = shapes.contours.length - 1;
const hasDiscs = shapes.discs.length > 0;

/** The distance of the farthest point from the person's place, for each shape. */
shapes.radius = Float32Array.from({length: shapes.count}, (_, shape) => {
  let most = 0;
  for (let i = shapes.points[shapes.contours[shape]]; i < shapes.points[shapes.contours[shape + 1]]; ++i)
    most = Math.max(most, Math.hypot(shapes.xy[2 * i], shapes.xy[2 * i + 1]) / 1000);
  return most || 0.25;
});

/** What most bodies measure, so that all of them change to dots together, whatever their pose. */
shapes.typicalRadius = shapes.count > 0 ? shapes.radius.slice().sort()[shapes.count >> 1] : 0.4;
const sizeOf = (shape) => 2 * (shapes.radius[shape] < 2 * shapes.typicalRadius ? shapes.typicalRadius : shapes.radius[shape]);

/** By how many millimetres outlines without a point and those between its neighbours that go before it would miss it (Douglas and
 * Peucker): 0 as long as nobody knows, endless where a contour begins. */
const missed = new Float32Array(shapes.xy.length / 2);

/** Ranks the points between two others of a contour, whose end is its beginning again; none above `most`, what came before. */
function rank(contour, first, last, most) {
  const {points, xy} = shapes, to = last === points[contour + 1] ? points[contour] : last;
  const ax = xy[2 * first], ay = xy[2 * first + 1], dx = xy[2 * to] - ax, dy = xy[2 * to + 1] - ay;
  const length2 = dx * dx + dy * dy;
  let farthest = -1, at = first;
  for (let i = first + 1; i < last; ++i) {
    const px = xy[2 * i] - ax, py = xy[2 * i + 1] - ay;
    const along = length2 > 0 ? Math.min(Math.max((px * dx + py * dy) / length2, 0), 1) : 0;
    const distance2 = (px - along * dx) ** 2 + (py - along * dy) ** 2;
    if (distance2 > farthest) { farthest = distance2; at = i; }
  }
  if (at === first) return;
  missed[at] = Math.min(Math.sqrt(farthest), most);
  rank(contour, first, at, missed[at]);
  rank(contour, at, last, missed[at]);
}

/** Where the person in a row stands on the stage, and how his shape is turned there, in pixels a millimetre. */
function standOf(row) {
  const heading = standHeading(row), pixels = view.scale / 1000;
  return {x: screenX(standX(row)), y: screenY(standY(row)), cosine: Math.cos(heading) * pixels, sine: Math.sin(heading) * pixels};
}

/** Points of the latest contour on the stage, x and y by turns, and where their insets are. */
const corners = [], insets = [];

const outlineError = 0.7;  // pixels

/** Takes the points that a contour needs where its person stands, and returns how many numbers these are. */
function takeCorners(contour, {x, y, cosine, sine}) {
  const {points, xy} = shapes, begin = points[contour], end = points[contour + 1];
  if (missed[begin] === 0) rank(contour, begin, end, missed[begin] = Infinity);
  const pixels = view.scale / 1000;
  let count = 0;
  for (let i = begin; i < end; ++i) {
    if (missed[i] * pixels <= outlineError) continue;
    corners[count++] = x + cosine * xy[2 * i] - sine * xy[2 * i + 1];
    corners[count++] = y - sine * xy[2 * i] - cosine * xy[2 * i + 1];
  }
  return count;
}

/** Moves the sides between corners inwards by so many pixels; corners by twice that at most. */
function moveInwards(count, distance) {
  let ax = 0, ay = 0;  // what is inwards of the side before
  for (let i = -2; i < count; i += 2) {
    const at = i < 0 ? count - 2 : i, next = i + 2 < count ? i + 2 : 0;
    const dx = corners[next] - corners[at], dy = corners[next + 1] - corners[at + 1], length = Math.sqrt(dx * dx + dy * dy) || 1;
    const bx = dy / length, by = -dx / length, part = distance / Math.max(1 + ax * bx + ay * by, 0.5);
    insets[at] = corners[at] + (ax + bx) * part;
    insets[at + 1] = corners[at + 1] + (ay + by) * part;
    ax = bx;
    ay = by;
  }
  return insets;
}

/** Begins a path with the outlines of the person in a row, moved inwards by so many pixels. */
function traceBody(context, row, inwards = 0) {
  const shape = people.shape[row], stand = standOf(row);
  context.beginPath();
  for (let contour = shapes.contours[shape]; contour < shapes.contours[shape + 1]; ++contour) {
    const count = takeCorners(contour, stand), points = inwards === 0 ? corners : moveInwards(count, inwards);
    if (count < 6) continue;
    context.moveTo(points[0], points[1]);
    for (let i = 2; i < count; i += 2) context.lineTo(points[i], points[i + 1]);
    context.closePath();
  }
}

/** Begins a path with the discs of the person in a row. */
function traceDiscs(context, row) {
  const {discsBegin, discs} = shapes, shape = people.shape[row], {x, y, cosine, sine} = standOf(row);
  context.beginPath();
  for (let i = 3 * discsBegin[shape]; i < 3 * discsBegin[shape + 1]; i += 3) {
    const centreX = x + cosine * discs[i] - sine * discs[i + 1], centreY = y - sine * discs[i] - cosine * discs[i + 1];
    const radius = discs[i + 2] * view.scale / 1000;
    context.moveTo(centreX + radius, centreY);
    context.arc(centreX, centreY, radius, 0, 2 * Math.PI);
  }
}
