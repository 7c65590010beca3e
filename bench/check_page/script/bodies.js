// What shapes look like: paths in metres, x to the right and y up, made when they are first drawn.

const shapes = {contours: block("contours-begin"), points: block("points-begin"), xy: block("points"),
  discsBegin: block("discs-begin"), discs: block("discs")};
shapes.count = shapes.contours.length - 1;

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

/** The points of a contour in metres, the first one once more at the end. */
function closedContour(contour) {
  const points = [];
  for (let i = shapes.points[contour]; i < shapes.points[contour + 1]; ++i)
    points.push([shapes.xy[2 * i] / 1000, shapes.xy[2 * i + 1] / 1000]);
  if (points.length > 0) points.push(points[0]);
  return points;
}

function distanceFromSegment([px, py], [ax, ay], [bx, by]) {
  const dx = bx - ax, dy = by - ay, length2 = dx * dx + dy * dy;
  const along = length2 > 0 ? Math.min(Math.max(((px - ax) * dx + (py - ay) * dy) / length2, 0), 1) : 0;
  return Math.hypot(px - ax - along * dx, py - ay - along * dy);
}

/** Adds to `kept` the points after the first one that describe a line within a tolerance (Douglas and Peucker). */
function simplify(points, first, last, tolerance, kept) {
  let farthest = tolerance, at = -1;
  for (let i = first + 1; i < last; ++i) {
    const distance = distanceFromSegment(points[i], points[first], points[last]);
    if (distance > farthest) [farthest, at] = [distance, i];
  }
  if (at < 0) {
    kept.push(points[last]);
    return;
  }
  simplify(points, first, at, tolerance, kept);
  simplify(points, at, last, tolerance, kept);
}

/** The contours of a shape with the points that it takes within a tolerance. */
function simplifiedContours(shape, tolerance) {
  const contours = [];
  for (let contour = shapes.contours[shape]; contour < shapes.contours[shape + 1]; ++contour) {
    const points = closedContour(contour), kept = [];
    if (points.length < 4) continue;
    simplify(points, 0, points.length - 1, tolerance, kept);
    if (kept.length >= 3) contours.push(kept);
  }
  return contours;
}

function pathOf(contours) {
  const path = new Path2D();
  for (const points of contours) {
    path.moveTo(...points[0]);
    for (const point of points.slice(1)) path.lineTo(...point);
    path.closePath();
  }
  return path;
}

/** Moves the sides of a contour, which is counter-clockwise, inwards; corners by twice that at most. */
function inset(points, distance) {
  const normals = points.map(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length], length = Math.hypot(bx - ax, by - ay) || 1;
    return [(ay - by) / length, (bx - ax) / length];
  });
  return points.map(([x, y], i) => {
    const [ax, ay] = normals[(i + points.length - 1) % points.length], [bx, by] = normals[i];
    const part = distance / Math.max(1 + ax * bx + ay * by, 0.5);
    return [x + (ax + bx) * part, y + (ay + by) * part];
  });
}

function discPath(shape) {
  const path = new Path2D();
  for (let i = shapes.discsBegin[shape]; i < shapes.discsBegin[shape + 1]; ++i) {
    const x = shapes.discs[3 * i] / 1000, y = shapes.discs[3 * i + 1] / 1000, r = shapes.discs[3 * i + 2] / 1000;
    path.moveTo(x + r, y);
    path.arc(x, y, r, 0, 2 * Math.PI);
  }
  return path;
}

/** Makes paths once for each shape. */
function cached(make) {
  const paths = new Array(shapes.count);
  return (shape) => paths[shape] ??= make(shape);
}

const discsOf = cached(discPath);
const hasDiscs = shapes.discs.length > 0;

// Outlines have details for 2^0, 2^1, ... pixels a metre, and all points from 2^9 on.
const finestDetail = 9, outlineError = 0.7, rimWidth = 2.4;  // pixels, about
const detailOf = (scale) => Math.min(Math.max(Math.floor(Math.log2(scale)), 0), finestDetail);
const pixelAt = (detail) => 2 ** -(detail + 0.5);
const toleranceAt = (detail) => detail === finestDetail ? 0 : outlineError * pixelAt(detail);

const outlinePaths = Array.from({length: finestDetail + 1}, (_, detail) =>
  cached((shape) => pathOf(simplifiedContours(shape, toleranceAt(detail)))));
const insetPaths = (pixels) => Array.from({length: finestDetail + 1}, (_, detail) =>
  cached((shape) => pathOf(simplifiedContours(shape, toleranceAt(detail))
    .map((points) => inset(points, pixels * pixelAt(detail))))));
const innerPaths = insetPaths(rimWidth), boldPaths = insetPaths(-0.5 * rimWidth);

/** The paths of shapes with as much detail as so many pixels a metre show, what a rim leaves of them, and larger ones. */
const bodyPaths = (scale) => outlinePaths[detailOf(scale)];
const withoutRim = (scale) => innerPaths[detailOf(scale)];
const boldBodies = (scale) => boldPaths[detailOf(scale)];
