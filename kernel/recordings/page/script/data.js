// The recording: arrays and tables that the page carries, as the program wrote them.

const element = (id) => document.getElementById(id);

const arrayTypes = {u8: Uint8Array, i16: Int16Array, u16: Uint16Array, i32: Int32Array, u32: Uint32Array,
  f64: Float64Array};

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Takes an array out of the document, which needs its text no longer. */
function block(name) {
  const node = element("data-" + name);
  const array = new arrayTypes[node.dataset.type](bytesOf(node.textContent).buffer);
  node.remove();
  return array;
}

const meta = JSON.parse(element("data-meta").textContent);

/** Of the frames that are kept; rows of people and overlaps of frame i are those from begin[i] to begin[i + 1]. */
const frames = {number: block("frame"), seconds: block("seconds"), begin: block("people-begin"),
  overlapsBegin: block("overlaps-begin")};
frames.count = frames.number.length;
frames.end = frames.count > 0 ? frames.seconds[frames.count - 1] : 0;
frames.start = frames.count > 0 ? frames.seconds[0] : 0;

/** A row of each person in each frame; places in millimetres from meta.corner. */
const people = {who: block("who"), shape: block("shape"), x: block("x"), y: block("y"), heading: block("heading"),
  speed: block("speed"), marks: block("marks")};
const marks = {overlaps: 1, inWall: 2};

/** Pairs of numbers of ids; the second one is `wall` for a wall. */
const overlaps = {pairs: block("overlaps")};
overlaps.wall = overlaps.pairs.BYTES_PER_ELEMENT === 2 ? 0xffff : 0xffffffff;

const series = {seconds: block("series-seconds"), overlapping: block("series-overlapping"),
  people: block("series-people")};

const walls = {begin: block("walls-begin"), points: block("walls")};

const numberOfId = new Map(meta.ids.map((id, number) => [id, number]));

/** The list of events, as its rows say; `index` is the place in the list, `whos` are the numbers of its people. */
const events = meta.events.map(([first, second, from, to, worst, depth, x, y, isPass], index) =>
  ({index, first, second, isWall: second === null, isPass: isPass === 1, from, to, worst, depth: depth ?? 0,
    begin: isPass === 1 ? worst : from,
    x: x - meta.corner[0], y: y - meta.corner[1],
    whos: [first, second].map((id) => numberOfId.get(id)).filter((who) => who !== undefined)}));

// Places of the page are metres from meta.corner.
const placeX = (row) => people.x[row] / 1000;
const placeY = (row) => people.y[row] / 1000;
const headingOf = (row) => people.heading[row] * Math.PI / 32768;

/** The last kept frame that is not later; the first one before it. */
function frameAt(seconds) {
  let low = 0, high = frames.count;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (frames.seconds[middle] <= seconds + 1e-6) low = middle;
    else high = middle;
  }
  return low;
}

/** The kept frame nearest in time. */
function nearestFrame(seconds) {
  const frame = frameAt(seconds), next = Math.min(frame + 1, frames.count - 1);
  return frames.seconds[next] - seconds < seconds - frames.seconds[frame] ? next : frame;
}

/** The row of a person, by number of the id, in a frame; -1 where there is none. */
function rowOf(frame, who) {
  for (let row = frames.begin[frame]; row < frames.begin[frame + 1]; ++row)
    if (people.who[row] === who) return row;
  return -1;
}

/** Ids of those whom a person overlaps in a frame, null for a wall. */
function partnersOf(frame, who) {
  const found = [];
  for (let i = frames.overlapsBegin[frame]; i < frames.overlapsBegin[frame + 1]; ++i) {
    const first = overlaps.pairs[2 * i], second = overlaps.pairs[2 * i + 1];
    if (first === who) found.push(second === overlaps.wall ? null : meta.ids[second]);
    else if (second === who) found.push(meta.ids[first]);
  }
  return found;
}

/** Minutes, seconds and hundredths. */
function clockText(seconds) {
  const hundredths = Math.round(Math.abs(seconds) * 100), sign = seconds < 0 && hundredths > 0 ? "-" : "";
  const two = (number) => String(number).padStart(2, "0");
  return sign + Math.floor(hundredths / 6000) + ":" + two(Math.floor(hundredths / 100) % 60) + "." + two(hundredths % 100);
}

const grouped = (number) => String(number).replace(/\B(?=(\d{3})+$)/g, "\u00a0");
const counted = (number, one, many) => grouped(number) + " " + (number === 1 ? one : many);

/** Where people walk, with a margin: metres. Walls count unless they lead far away. */
const bounds = (() => {
  const box = {left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity};
  const add = (b, x, y) => {
    b.left = Math.min(b.left, x); b.right = Math.max(b.right, x);
    b.bottom = Math.min(b.bottom, y); b.top = Math.max(b.top, y);
  };
  for (let row = 0; row < people.x.length; ++row) add(box, placeX(row), placeY(row));
  if (people.x.length === 0) { add(box, -2, -2); add(box, 2, 2); }
  const whole = {...box};
  for (let i = 0; i < walls.points.length; i += 2) add(whole, walls.points[i] / 1000, walls.points[i + 1] / 1000);
  const size = (b) => Math.max(b.right - b.left, b.top - b.bottom);
  return size(whole) <= 3 * size(box) + 4 ? whole : box;
})();
