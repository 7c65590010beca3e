// The list of overlaps.

const listed = {order: [], shown: 0, byDepth: true};
const isNarrow = matchMedia("(max-width: 860px)");
const rowsAtATime = () => isNarrow.matches ? 5 : 100;  // what lies below should not be too far away

const depthText = (event) => event.isPass ? "pass" : (event.depth * 100).toFixed(1) + " cm";
const lastsText = (seconds) => seconds < 9.995 ? seconds.toFixed(2) + " s" : seconds.toFixed(1) + " s";
const whenText = (event) => event.isPass ? "at " + clockText(event.worst) + ", between two frames"
  : "from " + clockText(event.from) + " for " + lastsText(event.to - event.from + 1 / meta.fps);
const pairText = (event) => event.first + (event.isWall ? " in a wall" : " and " + event.second);
const deepest = events.reduce((most, event) => Math.max(most, event.depth), 0);

function sortEvents(byDepth) {
  listed.byDepth = byDepth;
  listed.order = [...events];
  if (byDepth) listed.order.sort((a, b) => b.depth - a.depth || a.begin - b.begin);
  else listed.order.sort((a, b) => a.begin - b.begin || b.depth - a.depth);
  element("by-depth").setAttribute("aria-pressed", String(byDepth));
  element("by-time").setAttribute("aria-pressed", String(!byDepth));
  listed.shown = 0;
  element("event-list").replaceChildren();
  showMoreEvents(rowsAtATime());
  markEvent();
}

function part(name, className, text) {
  const node = document.createElement(name);
  node.className = className;
  node.textContent = text;
  return node;
}

function depthBar(event) {
  const bar = document.createElement("meter");
  bar.max = deepest || 1;
  bar.value = event.depth;
  bar.setAttribute("aria-hidden", "true");
  bar.hidden = event.isPass;
  return bar;
}

function eventRow(event) {
  const item = document.createElement("li"), button = document.createElement("button");
  button.type = "button";
  button.dataset.index = event.index;
  button.append(part("span", "pair", pairText(event)), part("span", "depth", depthText(event)),
    part("span", "when", whenText(event)), depthBar(event));
  button.addEventListener("click", () => jumpToEvent(event.index));
  item.append(button);
  return item;
}

function showMoreEvents(count) {
  const more = listed.order.slice(listed.shown, listed.shown + count);
  element("event-list").append(...more.map(eventRow));
  listed.shown += more.length;
  element("more-events").hidden = listed.shown >= listed.order.length;
}

/** Marks the row of the event that is shown. */
function markEvent() {
  for (const button of document.querySelectorAll("#event-list button[aria-current]"))
    button.removeAttribute("aria-current");
  if (selection.event === null) return;
  const place = listed.order.indexOf(selection.event);
  if (place >= listed.shown) showMoreEvents(place - listed.shown + rowsAtATime());
  const button = element("event-list").children[place].firstChild;
  button.setAttribute("aria-current", "true");
  // On a phone the list lies below the picture, which should stay in sight.
  if (!isNarrow.matches) button.scrollIntoView({block: "nearest"});
}

function forgetEvent() {
  selection.event = null;
  markEvent();
  requestDraw();
}

/** Shows an event, by its place in the program's list, where it is deepest, or at the moment of a pass. */
function jumpToEvent(index) {
  const event = events[index];
  if (event === undefined) return;
  pause();
  follow(false);
  view.fitted = false;
  selection.event = event;
  listed.last = event;
  if (frames.count > 0) seek(event.isPass ? event.worst : frames.seconds[nearestFrame(event.worst)]);
  if (isNarrow.matches) stage.scrollIntoView({block: "start"});
  moveView(event.x, event.y, Math.max(view.scale, Math.min(view.width, view.height) / 6));
  markEvent();
}

/** The event of the list that follows the one shown last, or comes before it. */
function nextEvent(by) {
  if (events.length === 0) return;
  const at = listed.last ? listed.order.indexOf(listed.last) + by : 0;
  jumpToEvent(listed.order[Math.min(Math.max(at, 0), listed.order.length - 1)].index);
}

/** The list as the program writes it with --events, in the order of the list. */
function eventsAsCsv() {
  const rows = listed.order.map((event) => [event.first, event.isWall ? "wall" : event.second,
    event.isWall ? "wall" : event.isPass ? "pass" : "overlap", event.from.toFixed(4), event.to.toFixed(4), event.worst.toFixed(4),
    event.depth.toFixed(4), (event.x + meta.corner[0]).toFixed(3), (event.y + meta.corner[1]).toFixed(3)].join(","));
  return "first,second,kind,from,to,worst,depth,x,y\n" + rows.map((row) => row + "\n").join("");
}

function saveEvents() {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([eventsAsCsv()], {type: "text/csv"}));
  link.download = document.title.replace(/[^\w.-]+/g, "_") + "-events.csv";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function noteOfEvents() {
  if (meta.allEvents === 0) return "Nobody overlaps anybody, and nobody is in a wall.";
  if (events.length < meta.allEvents)
    return "The " + grouped(events.length) + " deepest of " + grouped(meta.allEvents) + ".";
  return "";
}

function startEvents() {
  const note = noteOfEvents();
  element("events-note").textContent = note;
  element("events-note").hidden = note === "";
  element("events-count").textContent = meta.allEvents > 0 ? grouped(meta.allEvents) : "";
  element("by-depth").parentNode.hidden = element("save-events").hidden = events.length === 0;
  element("save-events").addEventListener("click", saveEvents);
  element("by-depth").addEventListener("click", () => sortEvents(true));
  element("by-time").addEventListener("click", () => sortEvents(false));
  element("more-events").addEventListener("click", () => showMoreEvents(rowsAtATime()));
  sortEvents(true);
}
