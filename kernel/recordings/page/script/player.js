// Time: which frame is shown, and the loop that draws.

const player = {time: frames.start, frame: 0, playing: false, speed: 1, discs: false, last: 0, told: 0, waiting: false, stale: true};
const ticks = [];  // times of the latest animation frames while playing

function draw() {
  if (view.changed) drawGround();
  view.changed = player.stale = false;
  drawCrowd();
}

function requestDraw() {
  player.stale = true;
  requestTick();
}

function requestTick() {
  if (player.waiting) return;
  player.waiting = true;
  requestAnimationFrame(tick);
}

function tick(now) {
  player.waiting = false;
  if (player.playing) advance(now);
  if (player.stale) draw();  // not what is there already
  if (player.playing) requestTick();
}

function advance(now) {
  ticks.push(now);
  while (ticks.length > 1 && now - ticks[0] > 1000) ticks.shift();
  // A page that was hidden goes on where it stopped.
  const passed = Math.min((now - player.last) / 1000, 0.25) * player.speed;
  player.last = now;
  showTime(player.time + Math.max(passed, 0));
  if (player.time >= frames.end) pause();
}

/** Shows the last frame up to a time, which is brought into the recording, and its people on their way to the next one. */
function showTime(seconds) {
  player.time = Math.min(Math.max(seconds, frames.start), frames.end);
  player.frame = frameAt(player.time);
  const hasMoved = moveTo(player.time, player.frame);
  player.stale ||= hasMoved;
  if (hasMoved && selection.following) keepInMiddle();
  if (!player.playing || player.last - player.told > tellEvery) tell();
}

const tellEvery = 100;  // milliseconds: nobody reads faster, and whatever changes beside the crowd takes a sixth of a frame

/** Shows the time, and what the current frame has. */
function tell() {
  player.told = player.last;
  showPosition();
  showClock();
  showNow();
  showCard();
  const isOver = selection.event !== null && player.playing && player.time > selection.event.to + 2;
  if (isOver) forgetEvent();
}

function seek(seconds) {
  showTime(seconds);
  requestDraw();
}

function play() {
  if (player.playing || frames.count === 0) return;
  if (player.time >= frames.end) showTime(frames.start);
  player.playing = true;
  player.last = performance.now();
  ticks.length = 0;
  showPlaying();
  requestDraw();
}

function pause() {
  player.playing = false;
  showPlaying();
  tell();
}

const togglePlaying = () => player.playing ? pause() : play();

function stepFrame(by) {
  pause();
  const frame = Math.min(Math.max(player.frame + by, 0), frames.count - 1);
  if (frames.count > 0) seek(frames.seconds[frame]);
}

/** Animation frames a second over the latest second of playing. */
function frameRate() {
  return ticks.length < 2 ? 0 : 1000 * (ticks.length - 1) / (ticks[ticks.length - 1] - ticks[0]);
}

function showPlaying() {
  element("play").setAttribute("aria-label", player.playing ? "Pause" : "Play");
  element("play-icon").setAttribute("href", player.playing ? "#icon-pause" : "#icon-play");
}

function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

function showPosition() {
  const part = partOf(player.time);
  scrub.value = part;
  placeCursor(part);
}

function showClock() {
  setText(element("clock"), clockText(player.time));
  scrub.setAttribute("aria-valuetext", clockText(player.time));
}

function showNow() {
  if (frames.count === 0) return;
  let hits = 0;
  const first = frames.begin[player.frame], last = frames.begin[player.frame + 1];
  for (let row = first; row < last; ++row) hits += people.marks[row] !== 0 ? 1 : 0;
  const now = element("now-hits");
  setText(element("clock-frame"), "frame " + grouped(frames.number[player.frame]));
  setText(element("now-people"), counted(last - first, "person", "people"));
  setText(now, (hits > 0 ? grouped(hits) : "none") + " overlapping");
  now.classList.toggle("some", hits > 0);
}

function setSpeed(speed) {
  player.speed = speed;
  element("speed").value = String(speed);
}

/** The next speed of the list, up or down. */
function changeSpeed(by) {
  const choice = element("speed"), at = choice.selectedIndex + by;
  if (at >= 0 && at < choice.options.length) setSpeed(Number(choice.options[at].value));
}

const scrub = element("scrub");

function listenToTransport() {
  element("play").addEventListener("click", togglePlaying);
  element("frame-back").addEventListener("click", () => stepFrame(-1));
  element("frame-on").addEventListener("click", () => stepFrame(1));
  element("speed").addEventListener("change", (event) => setSpeed(Number(event.target.value)));
  scrub.addEventListener("input", () => seek(frames.start + scrub.value * (frames.end - frames.start)));
}
