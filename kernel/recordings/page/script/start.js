// Puts the page together, and offers what tests need.

const ordinal = (number) => number + ({1: "st", 2: "nd", 3: "rd"}[number % 100 > 10 && number % 100 < 14 ? 0 : number % 10] ?? "th");

function summary() {
  const parts = [counted(new Set(people.who).size, "person", "people"), clockText(frames.end - frames.start)];
  if (meta.fps > 0) parts.push(Number(meta.fps.toFixed(2)) + " frames per second");
  parts.push(counted(meta.frames, "frame", "frames"));
  if (meta.step > 1) parts.push("every " + ordinal(meta.step) + " frame shown");
  return parts.join(" · ");
}

/** Fills a table of texts, the first row of which are the names of its columns. */
function showTable(table, [names, ...rows]) {
  table.tHead.insertRow().append(...names.map((name) => part("th", "", name)));
  for (const row of rows) table.tBodies[0].insertRow().append(...row.map((text, i) => part(i === 0 ? "th" : "td", "", text)));
}

function showFacts() {
  element("summary").textContent = summary();
  for (const [name, value] of meta.facts) element("fact-list").append(part("dt", "", name), part("dd", "", value));
  element("densities").hidden = !meta.table?.length;
  if (meta.table?.length) showTable(element("density-table"), meta.table);
  element("clock-end").textContent = "/ " + clockText(frames.end);
  element("facts").hidden = meta.facts.length === 0;
  element("discs").hidden = element("help-discs").hidden = element("help-discs-text").hidden = !hasDiscs;
  element("legend-wall").hidden = walls.points.length === 0;
}

/** People in the frame that is shown, in the recording's coordinates. */
function peopleNow() {
  const list = [];
  if (frames.count === 0) return list;
  for (let row = frames.begin[player.frame]; row < frames.begin[player.frame + 1]; ++row)
    list.push({id: meta.ids[people.who[row]], x: placeX(row) + meta.corner[0], y: placeY(row) + meta.corner[1],
      heading: headingOf(row), speed: people.speed[row] / 1000, shape: meta.shapes[people.shape[row]],
      overlaps: (people.marks[row] & marks.overlaps) !== 0, inWall: (people.marks[row] & marks.inWall) !== 0});
  return list;
}

/** The moment that a link to the page names, as #t=12.5; NaN where it names none. */
const linkedTime = () => parseFloat(new URLSearchParams(location.hash.slice(1)).get("t"));

function goToLinked() {
  if (linkedTime() >= 0 || linkedTime() < 0) seek(linkedTime());
}

/** Makes the address one of the moment that is shown, and copies it. */
function linkToMoment() {
  pause();
  history.replaceState(null, "", "#t=" + Number(player.time.toFixed(3)));
  const told = (text) => { element("link-told").textContent = text; setTimeout(() => { element("link-told").textContent = ""; }, 2000); };
  navigator.clipboard?.writeText(location.href).then(() => told("copied"), () => told("in the address"));
}

function start() {
  showFacts();
  listenToKeys();
  applyTheme();
  listenToStage();
  listenToTransport();
  listenToPeople();
  listenToTimeline();
  startEvents();
  showTime(frames.start);
  goToLinked();
  window.addEventListener("hashchange", goToLinked);
  element("link").addEventListener("click", linkToMoment);
  showPlaying();
  resizeStage();
}

window.bchPage = Object.freeze({
  time: () => player.time,
  frame: () => frames.number[player.frame],
  isPlaying: () => player.playing,
  seek, play, pause, setSpeed, jumpToEvent, frameRate,
  people: peopleNow,
  events: () => events.length,
  eventsAsCsv,
  standing: () => frames.count === 0 ? [] : Array.from({length: frames.begin[player.frame + 1] - frames.begin[player.frame]},
    (_, i) => ({x: standX(moving.begin + i) + meta.corner[0], y: standY(moving.begin + i) + meta.corner[1]})),
  view: () => ({x: view.x + meta.corner[0], y: view.y + meta.corner[1], scale: view.scale}),
  setView: (x, y, scale) => { view.fitted = false; setView(x - meta.corner[0], y - meta.corner[1], scale); },
  select: (id) => select(numberOfId.get(id) ?? -1),
});

start();
