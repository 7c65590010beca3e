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

/** Points of a contour that are at least a distance, in metres, from those before them. */
function thinned(contour, distance) {
  const kept = [];
  let x = Infinity, y = Infinity;
  for (let i = shapes.points[contour]; i < shapes.points[contour + 1]; ++i) {
    const px = shapes.xy[2 * i] / 1000, py = shapes.xy[2 * i + 1] / 1000;
    if (Math.hypot(px - x, py - y) < distance) continue;
    kept.push(px, py);
    x = px;
    y = py;
  }
  return kept;
}

function outlinePath(shape, distance) {
  const path = new Path2D();
  for (let contour = shapes.contours[shape]; contour < shapes.contours[shape + 1]; ++contour) {
    const points = thinned(contour, distance);
    if (points.length < 6) continue;
    path.moveTo(points[0], points[1]);
    for (let i = 2; i < points.length; i += 2) path.lineTo(points[i], points[i + 1]);
    path.closePath();
  }
  return path;
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

const finePath = cached((shape) => outlinePath(shape, 0));
const coarsePath = cached((shape) => outlinePath(shape, 0.05));
const discsOf = cached(discPath);
const hasDiscs = shapes.discs.length > 0;

const coarseBelow = 60;  // pixels a metre, where 0.05 m are 3 pixels
const bodyPath = (shape, scale) => scale < coarseBelow ? coarsePath(shape) : finePath(shape);
