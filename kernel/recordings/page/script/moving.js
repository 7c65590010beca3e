// Where people stand at the time that is shown: between two frames, on the straight way from the one to the other.

const farthestStep = 6, longestGap = 1;  // metres, beyond which it is a jump; seconds

/** Of the frame that is shown: where its rows begin, the row of each person in the next frame, or -1, and how much of the way is done. */
const moving = {frame: -1, begin: 0, next: new Int32Array(0), share: 0};
const nextRowOf = new Int32Array(meta.ids.length).fill(-1);  // by number of the id

function findNext(frame) {
  const begin = frames.begin[frame], end = frames.begin[frame + 1];
  moving.frame = frame;
  moving.begin = begin;
  moving.next = new Int32Array(end - begin).fill(-1);
  if (frame + 1 >= frames.count || frames.seconds[frame + 1] - frames.seconds[frame] > longestGap) return;
  for (let row = end; row < frames.begin[frame + 2]; ++row) nextRowOf[people.who[row]] = row;
  for (let row = begin; row < end; ++row) {
    const next = nextRowOf[people.who[row]];
    if (next >= 0 && Math.hypot(placeX(next) - placeX(row), placeY(next) - placeY(row)) < farthestStep)
      moving.next[row - begin] = next;
  }
  for (let row = end; row < frames.begin[frame + 2]; ++row) nextRowOf[people.who[row]] = -1;
}

/** Takes the time that is shown, in its frame. Returns whether anybody stands elsewhere than before. */
function moveTo(seconds, frame) {
  const before = moving.share, isNew = frame !== moving.frame;
  moving.share = 0;
  if (frames.count === 0) return false;
  if (isNew) findNext(frame);
  if (frame + 1 < frames.count) {
    const share = (seconds - frames.seconds[frame]) / (frames.seconds[frame + 1] - frames.seconds[frame]);
    moving.share = share < 1e-3 ? 0 : Math.min(share, 1);
  }
  return isNew || before !== moving.share;
}

/** The row of the same person in the next frame, if he is on his way there. */
const nextOf = (row) => moving.share > 0 ? moving.next[row - moving.begin] ?? -1 : -1;

/** Where the person in a row stands; those of other frames than the one that is shown stand where they are in it. */
function standX(row) {
  const next = nextOf(row);
  return next < 0 ? placeX(row) : placeX(row) + moving.share * (placeX(next) - placeX(row));
}
function standY(row) {
  const next = nextOf(row);
  return next < 0 ? placeY(row) : placeY(row) + moving.share * (placeY(next) - placeY(row));
}

/** He turns the shorter way. */
function standHeading(row) {
  const next = nextOf(row);
  if (next < 0) return headingOf(row);
  const turn = (people.heading[next] - people.heading[row]) << 16 >> 16;
  return (people.heading[row] + moving.share * turn) * Math.PI / 32768;
}
