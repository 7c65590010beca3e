// Who is under the pointer, and who is selected.

/** `who` and `hovered` are numbers of ids, -1 for nobody. */
const selection = {who: -1, hovered: -1, event: null, following: false};

/** The row of the person at a point of the stage, -1 for none. */
function rowAt(point) {
  let best = -1, nearest = Infinity;
  const x = groundX(point.x), y = groundY(point.y);
  if (frames.count === 0) return best;
  for (let row = frames.begin[player.frame]; row < frames.begin[player.frame + 1]; ++row) {
    const distance = Math.hypot(standX(row) - x, standY(row) - y);
    if (distance < nearest && distance < Math.max(shapes.radius[people.shape[row]], 14 / view.scale)) {
      nearest = distance;
      best = row;
    }
  }
  return best;
}

function line(className, text) {
  const node = document.createElement("div");
  node.className = className;
  node.textContent = text;
  return node;
}

function overlapText(row) {
  const partners = partnersOf(player.frame, people.who[row]);
  const others = partners.filter((id) => id !== null);
  const shown = others.slice(0, 6).join(", ") + (others.length > 6 ? " and " + (others.length - 6) + " more" : "");
  const inWall = (people.marks[row] & marks.inWall) !== 0;
  if (others.length === 0) return inWall ? "in a wall" : people.marks[row] !== 0 ? "overlaps" : "";
  return "overlaps " + shown + (inWall ? ", in a wall" : "");
}

/** What is known of the person in a row. */
function describe(row) {
  const degrees = (Math.round(people.heading[row] * 360 / 65536) + 360) % 360;
  const lines = [line("who", "Person " + meta.ids[people.who[row]])];
  const name = meta.shapes[people.shape[row]], bad = overlapText(row);
  if (name) lines.push(line("what", name));
  lines.push(line("how", (people.speed[row] / 1000).toFixed(2) + " m/s, heading " + degrees + "°"));
  if (bad) lines.push(line("bad", bad));
  return lines;
}

const hideTip = () => { element("tip").hidden = true; };

/** Puts a tip beside a point of the box that holds it. */
function placeTip(tip, box, x, y) {
  tip.hidden = false;
  const left = x + 16 + tip.offsetWidth > box.clientWidth ? x - 16 - tip.offsetWidth : x + 16;
  const top = Math.min(Math.max(y - tip.offsetHeight - 8, 4), Math.max(box.clientHeight - tip.offsetHeight - 4, 4));
  tip.style.transform = "translate(" + Math.round(Math.max(left, 4)) + "px, " + Math.round(top) + "px)";
}

function hover(point) {
  const row = point ? rowAt(point) : -1, who = row < 0 ? -1 : people.who[row];
  stage.classList.toggle("pointing", row >= 0);
  if (who !== selection.hovered) requestDraw();
  selection.hovered = who;
  if (row < 0) return hideTip();
  element("tip").replaceChildren(...describe(row));
  placeTip(element("tip"), stage, point.x, point.y);
}

function select(who) {
  selection.who = who;
  if (who < 0) follow(false);
  showCard();
  requestDraw();
}

function selectAt(point) {
  const row = rowAt(point);
  hideTip();
  select(row < 0 ? -1 : people.who[row]);
}

function showCard() {
  element("card").hidden = selection.who < 0;
  if (selection.who < 0) return;
  const row = rowOf(player.frame, selection.who);
  element("card-text").replaceChildren(...(row >= 0 ? describe(row)
    : [line("who", "Person " + meta.ids[selection.who]), line("what", "not in this frame")]));
}

function follow(on) {
  selection.following = on && selection.who >= 0;
  element("follow").setAttribute("aria-pressed", String(selection.following));
  if (!selection.following) return;
  view.fitted = false;
  keepInMiddle();
}

function keepInMiddle() {
  const row = rowOf(player.frame, selection.who);
  if (row < 0) return;
  ++view.moving;
  setView(standX(row), standY(row), view.scale);
}

function listenToPeople() {
  element("card-close").addEventListener("click", () => select(-1));
  element("follow").addEventListener("click", () => follow(!selection.following));
}
