// Keyboard, help, and the choice of dark or light.

const keys = {
  " ": togglePlaying,
  "ArrowLeft": (event) => event.shiftKey ? seek(player.time - 1) : stepFrame(-1),
  "ArrowRight": (event) => event.shiftKey ? seek(player.time + 1) : stepFrame(1),
  "ArrowUp": () => changeSpeed(1),
  "ArrowDown": () => changeSpeed(-1),
  "Home": () => seek(frames.start),
  "End": () => seek(frames.end),
  "+": zoomIn,
  "=": zoomIn,
  "-": zoomOut,
  "0": () => fit(false),
  "n": () => nextEvent(1),
  "p": () => nextEvent(-1),
  "f": () => follow(!selection.following),
  "d": toggleDiscs,
  "l": linkToMoment,
  "?": () => element("help").showModal(),
  "Escape": deselect,
};

function deselect() {
  forgetEvent();
  select(-1);
}

function toggleDiscs() {
  if (!hasDiscs) return;
  player.discs = !player.discs;
  element("discs").setAttribute("aria-pressed", String(player.discs));
  requestDraw();
}

/** Whether the element that has the focus needs the key for itself. */
function isTaken(event) {
  const target = event.target;
  if (element("help").open || event.ctrlKey || event.metaKey || event.altKey) return true;
  if (target.tagName === "SELECT") return event.key !== "Escape";
  return target.tagName === "BUTTON" && event.key === " ";
}

function keyDown(event) {
  const action = keys[event.key];
  if (action === undefined || isTaken(event)) return;
  event.preventDefault();
  action(event);
}

const systemDark = matchMedia("(prefers-color-scheme: dark)");
let chosenTheme = null;  // null: the system's

function storedTheme() {
  try {
    return localStorage.getItem("bch-theme");
  } catch {
    return null;  // pages without an origin have no storage
  }
}

function applyTheme() {
  document.documentElement.dataset.theme = chosenTheme ?? (systemDark.matches ? "dark" : "light");
  readColours();
  view.changed = true;
  drawTimeline();
  requestDraw();
}

function switchTheme() {
  chosenTheme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  try {
    localStorage.setItem("bch-theme", chosenTheme);
  } catch {
    // It lasts as long as the page.
  }
  applyTheme();
}

function listenToKeys() {
  chosenTheme = ["dark", "light"].includes(storedTheme()) ? storedTheme() : null;
  document.addEventListener("keydown", keyDown);
  document.addEventListener("click", (event) => {
    // After a click the space bar plays; buttons that were reached by keys keep it.
    if (event.detail > 0) event.target.closest?.("main button")?.blur();
  });
  systemDark.addEventListener("change", applyTheme);
  element("theme").addEventListener("click", switchTheme);
  element("discs").addEventListener("click", toggleDiscs);
  element("help-open").addEventListener("click", () => element("help").showModal());
  element("help-close").addEventListener("click", () => element("help").close());
  element("help").addEventListener("click", (event) => {
    if (event.target === element("help")) element("help").close();  // beside it
  });
}
