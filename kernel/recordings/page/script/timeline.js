// How many people overlap over time: the most of each stretch of frames, those that are not kept included.

const timeline = element("timeline");
const chart = {top: 18, bottom: 18};
const mostOverlapping = series.overlapping.reduce((most, count) => Math.max(most, count), 0);

const partOf = (seconds) =>
  frames.end > frames.start ? Math.min(Math.max((seconds - frames.start) / (frames.end - frames.start), 0), 1) : 0;

function placeCursor(part) {
  element("cursor").style.transform = "translateX(" + part * timeline.clientWidth + "px)";
}

/** The most of each column of pixels. */
function columnsOf(width) {
  const columns = new Float64Array(Math.ceil(width) + 1);
  for (let i = 0; i < series.seconds.length; ++i) {
    const first = Math.floor(partOf(series.seconds[i]) * width);
    const next = i + 1 < series.seconds.length ? Math.floor(partOf(series.seconds[i + 1]) * width) : first + 1;
    for (let column = first; column < Math.max(next, first + 1); ++column)
      columns[column] = Math.max(columns[column], series.overlapping[i]);
  }
  return columns;
}

/** An area with a line along its top. */
function drawBars(context, width, height) {
  const columns = columnsOf(width), base = height - chart.bottom, room = base - chart.top - 2;
  const topOf = (count) => base - (count === 0 ? 0 : Math.max(2, room * count / mostOverlapping));
  context.beginPath();
  context.moveTo(0, base);
  for (let column = 0; column < width; ++column) {
    context.lineTo(column, topOf(columns[column]));
    context.lineTo(column + 1, topOf(columns[column]));
  }
  context.strokeStyle = colours.hit;
  context.lineWidth = 1.2;
  if (mostOverlapping > 0) context.stroke();
  context.lineTo(width, base);
  context.closePath();
  context.globalAlpha = 0.22;
  context.fillStyle = colours.hit;
  context.fill();
  context.globalAlpha = 1;
  context.fillStyle = colours.line;
  context.fillRect(0, base, width, 1);
}

function drawTimes(context, width, height) {
  const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600, 7200, 36000, 360000]
    .find((s) => s * width / Math.max(frames.end - frames.start, 1e-9) >= 72) ?? 1e9;
  context.fillStyle = colours.quiet;
  context.font = colours.font;
  context.textAlign = "center";
  for (let time = Math.ceil(frames.start / step) * step; time <= frames.end; time += step) {
    const x = partOf(time) * width, text = step < 1 ? clockText(time).slice(0, -1) : clockText(time).slice(0, -3);
    context.fillStyle = colours.line;
    context.fillRect(Math.round(x), height - chart.bottom, 1, 4);
    context.fillStyle = colours.quiet;
    context.fillText(text, Math.min(Math.max(x, 12), width - 12), height - 3);
  }
}

function drawTimeline() {
  const canvas = element("series"), ratio = Math.min(window.devicePixelRatio || 1, 2);
  const width = timeline.clientWidth, height = timeline.clientHeight;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d"), label = "Number of overlapping people, at most " + grouped(mostOverlapping);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  drawBars(context, width, height);
  drawTimes(context, width, height);
  context.textAlign = "left";
  context.fillStyle = colours.quiet;
  context.fillText(label, 0, 10);
  canvas.setAttribute("aria-label", label);
  placeCursor(partOf(player.time));
}

/** The stretch of the series at a time. */
function stretchAt(seconds) {
  let at = 0;
  for (let i = 0; i < series.seconds.length && series.seconds[i] <= seconds; ++i) at = i;
  return at;
}

function timeUnder(event) {
  const box = timeline.getBoundingClientRect();
  const part = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1);
  return frames.start + part * (frames.end - frames.start);
}

function pointAtTimeline(event) {
  const time = timeUnder(event), tip = element("series-tip"), box = timeline.getBoundingClientRect();
  if (event.buttons & 1) seek(time);
  if (event.pointerType !== "mouse" || series.seconds.length === 0) return;
  tip.textContent = clockText(time) + ": " + grouped(series.overlapping[stretchAt(time)]) + " overlapping";
  placeTip(tip, timeline, event.clientX - box.left, 30);
}

function listenToTimeline() {
  timeline.addEventListener("pointerdown", (event) => {
    timeline.setPointerCapture(event.pointerId);
    seek(timeUnder(event));
  });
  timeline.addEventListener("pointermove", pointAtTimeline);
  timeline.addEventListener("pointerleave", () => { element("series-tip").hidden = true; });
  new ResizeObserver(drawTimeline).observe(timeline);
}
