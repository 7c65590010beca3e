# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Recordings of people, and checks of who runs into whom."""

from __future__ import annotations

import ctypes
import inspect
import os
from ctypes import byref
from datetime import datetime, timezone
from types import MappingProxyType
from typing import Any, Dict, List, Literal, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import Records, address, bounded, copied, encoded, f4, f8, i4, i8, instances, number, one_of, rejected, u4, u8
from ._library import ArgumentError, ArrayError, Handle, check as _check, lib, said
from ._obstacles import walls_of, well_known_text
from ._progress import Watched
from ._queries import LEAVES, Leaves
from ._shapes import ALL_DEPTHS, Character, Path, ShapeSet
from ._tables import Columns, Table, table_of

#: A person in a frame, in metres, radians and seconds; NaN where the file has no value. `motion` indexes `Trajectory.motions`, or is -1.
TRACKED = np.dtype(
    [("frame", i8), ("id", i8), ("x", f8), ("y", f8), ("heading", f4), ("stature", f4), ("motion", i4), ("clip_time", f4)]
)
#: Kinds of pairs and events: a gap of at most `max_distance`; an overlap; a contact between two frames only; an overlap with a
#: wall.
NEAR, OVERLAP, PASS, WALL = 0, 1, 2, 3
_KINDS = np.array(["near", "overlap", "pass", "wall"])
_FRAME = np.dtype(
    [("frame", i8), ("seconds", f8), ("people", u4), ("overlapping", u4), ("overlapping_pairs", u4), ("in_walls", u4)]
    + [("density", f4), ("_", f4)]
)
_PAIR = np.dtype(
    [("frame", i8), ("first", i8), ("second", i8), ("depth", f4), ("gap", f4), ("x", f4), ("y", f4), ("kind", i4)]
    + [("_", i4)]
)
_DENSITY = np.dtype(
    [("from", f8), ("person_frames", u8), ("overlapping", u8), ("in_walls", u8), ("near_pairs", u8), ("overlapping_near_pairs", u8)]
)
_EVENT = np.dtype(
    [("first", i8), ("second", i8), ("from", i8), ("to", i8), ("worst", i8), ("x", f8), ("y", f8), ("depth", f4)]
    + [("frames", u4), ("kind", i4), ("after", f4)]
)
_MEASURE = np.dtype(
    [("frame", i8), ("id", i8), ("density", f4), ("voronoi_density", f4), ("clearance", f4), ("disc_clearance", f4), ("ttc", f4)]
    + [("disc_ttc", f4), ("pet", f4), ("intrusion", f4), ("disc_intrusion", f4), ("avoidance", f4), ("disc_avoidance", f4)]
    + [("_", f4), ("intimate", u4), ("personal", u4), ("collides", i4), ("disc_collides", i4)]
)
_CONFLICT = np.dtype(
    [("frame", i8), ("first", i8), ("second", i8), ("distance", f4), ("clearance", f4), ("disc_clearance", f4), ("ttc", f4)]
    + [("disc_ttc", f4), ("_", f4)]
)
CheckTable = Literal["events", "frames", "pairs", "measures", "conflicts"]
_TABLES = {"events": 0, "frames": 1, "pairs": 2, "measures": 3, "conflicts": 4}
Bodies = Literal["outlines", "spheres"]
_BODIES = {"outlines": 0, "spheres": 1}
#: Units of arrays.
_UNITS = {"time": "s", "heading": "rad", **dict.fromkeys(("x", "y", "stature", "length", "width", "radius"), "m")}
#: People whom a frame has at most.
_MOST_PEOPLE = 1_000_000


class NamedMotion(NamedTuple):
    """The character and the clip that rows of a recording name. One of the two may be empty."""

    character: str
    clip: str


class NamedBody(NamedTuple):
    """The body that rows of a recording have if it is not a walking person's, such as a cart. `kind` is empty for people."""

    kind: str  #: such as "box", or a name of `footprints`
    length: float  #: metres; 0 if rows do not state it
    width: float


class Trajectory(NamedTuple):
    """A recording of people."""

    rows: Records  #: (n,) TRACKED, frame by frame, and by ascending id within a frame
    fps: float  #: frames per second
    format: str  #: such as "JuPedSim SQLite, version 2"
    geometry: str  #: the walkable area as well-known text, or empty
    assumptions: List[str]  #: what the file does not state, and what is assumed instead
    motions: List[NamedMotion]  #: all motions that rows name, in the order of the file
    notes: Sequence[str] = ()  #: what seems to be wrong: columns that are not read, values of another unit
    bodies: Sequence[NamedBody] = ()  #: one per motion; bodies that do not walk have neither a character nor a clip

    @property
    def character(self) -> "np.ndarray[Any, Any]":
        """The character that each row names, or an empty text, (n,)."""
        return self._names("character")

    @property
    def clip(self) -> "np.ndarray[Any, Any]":
        """The clip that each row names, or an empty text, (n,)."""
        return self._names("clip")

    @property
    def body(self) -> "np.ndarray[Any, Any]":
        """The kind of body that each row has, or an empty text for a walking person, (n,)."""
        return self._names("kind")

    def _names(self, of: str) -> "np.ndarray[Any, Any]":
        named = self.bodies if of == "kind" else self.motions
        names: "np.ndarray[Any, Any]" = np.array([getattr(one, of) for one in named] + [""])
        by_row: "np.ndarray[Any, Any]" = names[self.rows["motion"]]
        return by_row


def dataframe(records: Union[Records, Trajectory]) -> Any:
    """Return a structured array as a pandas dataframe, with one column per field. It needs pandas.

    For a `Trajectory`, the columns `character`, `clip` and `body` hold names in place of `motion`.
    """
    if not isinstance(records, (Trajectory, np.ndarray)) or isinstance(records, np.ndarray) and records.dtype.names is None:
        raise rejected(records, "records", "a structured array or a bch.Trajectory")
    import pandas

    if not isinstance(records, Trajectory):
        return pandas.DataFrame({name: records[name] for name in records.dtype.names or () if name != "_"})
    rows = dataframe(records.rows).drop(columns="motion")
    return rows.assign(character=records.character, clip=records.clip, body=records.body)


def _open(recording: Union[Path, bytes, Columns], fps: Optional[float], unit: Optional[float], columns: Optional[str]) -> Handle:
    with Watched("reading", False) as watched:
        options = _library.TrajectoryOptions(
            fps=0.0 if fps is None else number(fps, "fps"),
            unit=0.0 if unit is None else number(unit, "unit"),
            columns=None if columns is None else encoded(columns, "columns"),
            progress=watched.callback,
        )
        if isinstance(recording, Columns):
            table = (recording.array, len(recording.array), recording.rows)
            return Handle("trajectory", "from_columns", *table, byref(options), checked=watched.run)
        return Handle("trajectory", "open", encoded(recording, "path"), byref(options), checked=watched.run)


def _info(handle: Handle) -> _library.TrajectoryInfo:
    info = _library.TrajectoryInfo()
    _check(lib.bch_trajectory_get_info(handle.pointer, byref(info)))
    return info


def _motions(handle: Handle) -> List[NamedMotion]:
    pointer, count = ctypes.POINTER(_library.NamedMotion)(), ctypes.c_size_t()
    _check(lib.bch_trajectory_get_motions(handle.pointer, byref(pointer), byref(count)))
    found = pointer[: count.value]
    return [NamedMotion(one.character.decode(errors="replace"), one.clip.decode(errors="replace")) for one in found]


def _bodies(handle: Handle) -> List[NamedBody]:
    pointer, count = ctypes.POINTER(_library.NamedBody)(), ctypes.c_size_t()
    _check(lib.bch_trajectory_get_bodies(handle.pointer, byref(pointer), byref(count)))
    return [NamedBody(one.kind.decode(errors="replace"), one.length, one.width) for one in pointer[: count.value]]


def read_trajectory(
    path: Path, *, fps: Optional[float] = None, unit: Optional[float] = None, columns: Optional[str] = None
) -> Trajectory:
    """Read a recording: JuPedSim, PeTrack, Pedestrian Dynamics Data Archive, Pathfinder, TrajNet++, ETH/UCY or CSV.

    Ctrl-C interrupts it.

    Parameters
    ----------
    path : path
    fps : float, optional
        Frames per second, instead of the rate that the file states.
    unit : float, optional
        Metres per unit of the file, instead of what it states; 0.01 for centimetres.
    columns : str, optional
        Column names of text or CSV, in order, such as "frame,id,x,y".
    """
    handle = _open(path, fps, unit, columns)
    info = _info(handle)
    rows = np.empty(info.rows, TRACKED)
    count = ctypes.c_size_t()
    done = 0
    while done < len(rows):
        rest = rows[done : done + _MOST_PEOPLE]  # Ctrl-C gets through between the calls
        _check(lib.bch_trajectory_read(handle.pointer, address(rest), len(rest), byref(count)))
        if count.value == 0:
            break
        done += count.value
    lines = said(info.assumptions).splitlines()
    geometry = info.geometry.decode(errors="replace")
    notes = said(info.notes).splitlines()
    return Trajectory(rows[:done], info.fps, info.format.decode(), geometry, lines, _motions(handle), notes, _bodies(handle))


class Check(NamedTuple):
    """The result of `check`: who runs into whom in a recording. Ids are those of the file; depths and positions are in metres."""

    #: first, second, from, to, worst (frames), x, y, depth, frames, kind, after: overlaps in successive frames, and passes. `worst`
    #: is the frame of the deepest overlap, or the frame before a pass, which follows it by `after` frames (a fraction). `x` and
    #: `y` are the position of the first person at that time.
    events: Records
    #: frame, seconds, people, overlapping, overlapping_pairs, in_walls, density (people per square metre within 1 m of a person, the mean
    #: over all people)
    frames: Records
    #: frame, first, second (an id, or a wall's number), depth, gap, x and y (unit vector: the move of the first), kind
    pairs: Records
    #: Counts of the whole recording: person_frames, overlapping, near_pairs (pairs of people in a frame within 1.2 m) ... And `by_density`:
    #: the same counts per class of density, as a list of mappings. `from` is the least density of a class, in people per square metre
    #: within 1 m of the person.
    summary: Dict[str, Any]
    assumptions: List[str]  #: what is assumed where the file does not say, and what was found about the characters
    #: What seems to be wrong: columns that are not read, people who are too fast or too slow, headings in degrees, walls without a segment.
    notes: List[str]
    #: With `measures=True` a row per person and frame: frame, id, density, voronoi_density (people per square metre), clearance (the least
    #: signed distance of bodies, metres), ttc (the least time to a collision, seconds), pet (time after an encroachment,
    #: seconds), intrusion and avoidance (numbers of Cordes et al. 2024), `disc_` and these for discs of 0.1 m, intimate,
    #: personal (others within 0.45 and 1.2 m), collides, disc_collides (0 or 1). bench/README.md defines them. Infinite: nobody
    #: is that near.
    measures: Records
    #: With `measures=True` a row per pair and frame of people who overlap or will collide within 5 s: frame, first, second, distance,
    #: clearance, disc_clearance, ttc, disc_ttc.
    conflicts: Records
    #: With `page=True` the page that `html` writes.
    page: bytes = b""

    def html(self, path: Path) -> None:
        """Write the page of a check with `page=True`: HTML that plays the recording without a network, as `bch check --html` does.

        Parameters
        ----------
        path : path
        """
        if not self.page:
            raise ArgumentError("there is no page: check(page=True) makes one")
        with open(path, "wb") as file:
            file.write(self.page)

    def table(self, name: CheckTable = "events") -> "Dict[str, np.ndarray[Any, Any]]":
        """Return a table as a mapping of names to columns, (n,) each. Kinds are words, and there are seconds, counted from
        frame 0, as well as frames.

        Parameters
        ----------
        name : {"events", "frames", "pairs", "measures", "conflicts"}
        """
        one_of(_TABLES, name, "name")
        records: Records = getattr(self, name)
        columns: "Dict[str, np.ndarray[Any, Any]]" = {}
        for field in filter("_".__ne__, records.dtype.names or ()):
            columns[field] = _KINDS[records[field]] if field == "kind" else records[field]
            if field in ("from", "to", "worst") or field == "frame" and name != "frames":
                time = records[field] + (records["after"].astype(f8) if field == "worst" else 0.0)
                columns["seconds" if field == "frame" else field + "_seconds"] = time / self.summary["fps"]
        return columns

    def to_dataframe(self, name: CheckTable = "events") -> Any:
        """Return a table, as `table` does, as a pandas dataframe. It needs pandas."""
        import pandas

        return pandas.DataFrame(self.table(name))


def _records(get: Any, handle: Handle, dtype: "np.dtype[Any]") -> Records:
    pointer, count = ctypes.c_void_p(), ctypes.c_size_t()
    _check(get(handle.pointer, byref(pointer), byref(count)))
    return copied(pointer.value, dtype, (count.value,))


def _text(get: Any, handle: Handle) -> bytes:
    pointer, size = ctypes.c_void_p(), ctypes.c_size_t()
    _check(get(handle.pointer, byref(pointer), byref(size)))
    return ctypes.string_at(pointer.value or 0, size.value)


def _lines(get: Any, handle: Handle) -> List[str]:
    lines = ctypes.c_char_p()
    _check(get(handle.pointer, byref(lines)))
    return said(lines.value or b"").splitlines()


def _table_of(recording: Any, arrays: Dict[str, Any]) -> Optional[Table]:
    """Return the table that a recording is, or arrays are; None where it is a file."""
    given = {name: values for name, values in arrays.items() if values is not None}
    if recording is not None and given:
        raise ArrayError(f"recording and {given.popitem()[0]} are both given; expected one of them")
    if recording is None and not given:
        raise ArrayError("recording is not given, nor are arrays; expected id, x, y and frame or time")
    if isinstance(recording, (str, bytes, os.PathLike)):
        return None
    return Table(given, _UNITS) if recording is None else table_of(recording)


def _page(recording: Any, given: Dict[str, Any]) -> _library.Page:
    """Return what the page shows beside the answers: the name and the date of a file, and options that are not the usual ones."""
    title, date = "recording", None
    if isinstance(recording, (str, bytes, os.PathLike)):
        title = os.fsdecode(recording)
        date = datetime.fromtimestamp(os.stat(recording).st_mtime, timezone.utc).strftime("%Y-%m-%d %H:%M UTC").encode()
    usual = inspect.signature(check).parameters
    options = " ".join(f"{name}={value!r}" for name, value in given.items() if value != usual[name].default)
    return _library.Page(title=os.fsencode(title), date=date, options=options.encode())


def check(
    recording: Any = None,
    *,
    frame: Optional[npt.ArrayLike] = None,
    time: Optional[npt.ArrayLike] = None,
    id: Optional[npt.ArrayLike] = None,
    x: Optional[npt.ArrayLike] = None,
    y: Optional[npt.ArrayLike] = None,
    heading: Optional[npt.ArrayLike] = None,
    stature: Optional[npt.ArrayLike] = None,
    length: Optional[npt.ArrayLike] = None,
    width: Optional[npt.ArrayLike] = None,
    radius: Optional[npt.ArrayLike] = None,
    body: Optional[Sequence[Optional[str]]] = None,
    footprints: Mapping[str, Any] = MappingProxyType({}),
    characters: Union[Sequence[Character], ShapeSet] = (),
    clip_speeds: Mapping[str, float] = MappingProxyType({}),
    facing: float = 0.0,
    bodies: Bodies = "outlines",
    spheres: int = 256,
    depth: int = ALL_DEPTHS,
    leaves: Leaves = "segments",
    max_distance: float = 0.0,
    max_pairs: int = 0,
    measures: bool = False,
    page: bool = False,
    truth: Any = None,
    walls: Any = None,
    fps: Optional[float] = None,
    unit: Optional[float] = None,
    columns: Optional[str] = None,
    threads: int = 0,
    progress: bool = False,
) -> Check:
    """Find who runs into whom in a recording: each row becomes a walking person, or the body that the row names.

    A recording is a file, a table with columns by name, or arrays with an entry per row: `check("walk.sqlite")`, `check(dataframe, fps=25)`
    or `check(frame=frame, id=id, x=x, y=y, fps=25)`. Rows may be in any order. Arrays may have any numeric type and any stride;
    lists are accepted, too. The result is that of a CSV file with these columns. Ctrl-C interrupts the work.

    Parameters
    ----------
    recording : path, or table, optional
        A table is a mapping of names to arrays, a structured array, a dataframe of pandas or polars, a table of Arrow, or anything that
        gives a column by `table[name]` and names in `columns`, `column_names` or `dtype.names`. Its columns have the names and units
        that a header of CSV has; layout/README.md lists them. PedPy's TrajectoryData and JuPedSim's Recording are accepted,
        too, with their frame rates, and the latter with its geometry.
    frame, id : (n,) whole numbers, optional
        Each row's frame number, which needs `fps`, and the id of its person. A person has at most one row per frame.
    time : (n,) numbers, optional
        Instead of `frame`: seconds from any origin, or numpy's datetime64 or timedelta64.
    x, y : (n,) numbers, optional
        Positions of heads, in metres or in `unit`, within 1e8 m.
    heading : (n,) numbers, optional
        Radians, counter-clockwise from +x; NaN: the direction in which the person walks.
    stature : (n,) numbers, optional
        Heights of people, in metres or in `unit`, from 1 to 2.5 m; NaN: drawn from a normal distribution, seeded by the id.
    length, width, radius : (n,) numbers, optional
        Sizes of bodies that do not walk, in metres or in `unit`, up to 20 m; NaN or 0: unknown. A radius is half of the length
        and of the width. Rows without a size and without a `body` are walking people.
    body : (n,) str, optional
        The kind of each row's body: "disc", "box", "ellipse", "wheelchair", "bicycle", "trolley", "robot", or a name of
        `footprints`. The first three need a size; the others have one, and are stretched to the given size if there is one. "",
        None, "person" or "pedestrian": a walking person. If `body` is not given, a row with a length or a width is a box, and
        one with a radius is a disc.
    footprints : mapping of str to a geometry
        What other kinds of bodies cover on the ground: polygons, as `Obstacles.from_wkt` takes them, in metres, about the
        body's position, facing +x; `outline(character).wkt` of a character, for instance.
    characters : sequence of Character, or ShapeSet
        The bodies of the people, assigned by id or as rows name them, and scaled to the people's statures; by default built-in
        pedestrians. Each character needs a clip that walks straight on, and should have one that stands. Alternatively a set that
        was loaded or baked. People then have its shapes, at its last level and unscaled, and `depth` has no effect.
    clip_speeds : mapping of str to float
        For a baked set: the walking speed in the clips of each name, metres per second; 0 where people stand.
    facing : float
        For a baked set: the direction that people face, radians, counter-clockwise from +x.
    bodies : {"outlines", "spheres"}
        What collides: outlines, seen from above, or bodies of spheres, in space, which are posed anew for each person and
        frame. `depth`, `leaves` and baked sets are for outlines only.
    spheres : int
        Spheres per body: 64, 128, 256 or 512; up to 4096 for characters that are not built in.
    depth : int
        Depth of the cut: 0 is one disc per body, ALL_DEPTHS all discs, or the outlines (see `leaves`).
    leaves : {"segments", "discs"}
        What decides at ALL_DEPTHS: segments of the outlines, or discs that cover them.
    max_distance : float
        Also report pairs with gaps up to this distance, metres.
    max_pairs : int
        Limit of pairs of people near each other, in one frame or in the frames that one task checks (about 4096 rows); 0: 4
        million plus 100 per person. More pairs are an error, because each takes memory.
    measures : bool
        Also fill `Check.measures` and `Check.conflicts`.
    page : bool
        Also make the page that `Check.html` writes, of up to 30 MB. With bodies of spheres it shows outlines, which have to be made, too.
    truth : path, or table, optional
        A recording of what people did whose ways `recording` predicts, with the same ids, frames and frame rate: the summary's
        `truth_colliding_people` are those whose bodies overlap those of others as these truly went, `truth_disc_colliding_people` the same
        for discs of 0.1 m (TrajNet++'s Col-II).
    walls : Obstacles, or a geometry as `Obstacles.from_wkt` takes, optional
        Walls to use instead of the geometry of the recording. Polygons of a geometry are the floor that people walk on, and their
        rings are walls.
    fps, unit, columns
        As for `read_trajectory`. `columns` is for files only.
    threads : int
        Number of threads; 0: all processors. The answer is the same for any number.
    progress : bool
        Show a progress bar on a terminal.

    Returns
    -------
    Check

    Raises
    ------
    FileNotFoundError, OSError
        A file that does not exist, or cannot be read. The message names the file, the row and the value.
    TypeError, ValueError
        Arrays that are not numeric or differ in length, or an invalid argument or value. The message names the argument or the
        column, the row (counted from 0), and the value.
    """
    arrays: Dict[str, Any] = {"frame": frame, "time": time, "id": id, "x": x, "y": y, "heading": heading, "stature": stature}
    arrays.update(length=length, width=width, radius=radius, body=body)
    table = _table_of(recording, arrays)
    if table is not None:
        walls = table.walls if walls is None else walls
        fps = table.fps if fps is None else fps
    obstacles = None if walls is None else walls_of(walls)
    baked = characters if isinstance(characters, ShapeSet) else None
    own = [] if isinstance(characters, ShapeSet) else instances(characters, Character, "characters")
    if not isinstance(clip_speeds, Mapping):
        raise rejected(clip_speeds, "clip_speeds", "a mapping of str to float")
    ahead = number(facing, "facing")
    if baked is None and (clip_speeds or ahead):
        raise ArrayError("clip_speeds and facing are for characters of a bch.ShapeSet")
    rows = None if table is None else Columns(table)  # which live until the check has read them
    trajectory = _open(rows or encoded(recording, "recording"), fps, unit, columns)
    true_table = None if truth is None else _table_of(truth, {})
    true_rows = None if true_table is None else Columns(true_table)
    true_fps = fps if true_table is None or true_table.fps is None else true_table.fps
    true_ways = None if truth is None else _open(true_rows or encoded(truth, "truth"), true_fps, unit, columns)
    cast = (ctypes.c_void_p * len(own))(*(character._pointer for character in own))
    speeds = (_library.ClipSpeed * len(clip_speeds))(
        *(_library.ClipSpeed(encoded(clip, "clip_speeds"), number(speed, "clip_speeds")) for clip, speed in clip_speeds.items())
    )
    if not isinstance(footprints, Mapping):
        raise rejected(footprints, "footprints", "a mapping of str to geometries")
    prints = (_library.Footprint * len(footprints))(
        *(
            _library.Footprint(encoded(name, "footprints"), encoded(well_known_text(geometry, "footprints"), "footprints"))
            for name, geometry in footprints.items()
        )
    )
    given = dict(facing=facing, bodies=bodies, spheres=spheres, depth=depth, leaves=leaves, max_distance=max_distance)
    shown = _page(recording, dict(given, fps=fps, unit=unit, columns=columns)) if page else None
    with Watched("checking", progress) as watched:
        options = _library.CheckOptions(
            threads=bounded(threads, "threads", 0, 1024),
            depth=bounded(depth, "depth", 0, ALL_DEPTHS),
            characters=ctypes.cast(cast, ctypes.c_void_p),
            character_count=len(own),
            baked=None if baked is None else baked._pointer,
            clip_speeds=ctypes.cast(speeds, ctypes.c_void_p),
            clip_speed_count=len(speeds),
            facing=ahead,
            leaves=one_of(LEAVES, leaves, "leaves"),
            spheres=bounded(spheres, "spheres", 1, 4096) if one_of(_BODIES, bodies, "bodies") else 0,
            max_distance=number(max_distance, "max_distance"),
            max_pairs=bounded(max_pairs, "max_pairs", 0, 1_000_000_000),
            walls=None if obstacles is None else obstacles._pointer,
            measures=bool(measures),
            footprints=ctypes.cast(prints, ctypes.c_void_p),
            footprint_count=len(prints),
            page=None if shown is None else ctypes.addressof(shown),
            truth=None if true_ways is None else true_ways.pointer,
            progress=watched.callback,
        )
        handle = Handle("check", "run", trajectory.pointer, byref(options), checked=watched.run)
    summary = _library.CheckSummary()
    _check(lib.bch_check_get_summary(handle.pointer, byref(summary)))
    densities = _records(lib.bch_check_get_densities, handle, _DENSITY)
    return Check(
        _records(lib.bch_check_get_events, handle, _EVENT),
        _records(lib.bch_check_get_frames, handle, _FRAME),
        _records(lib.bch_check_get_pairs, handle, _PAIR),
        {name: getattr(summary, name) for name, *_ in _library.CheckSummary._fields_ if name != "size"}
        | {"by_density": [dict(zip(densities.dtype.names or (), row)) for row in densities.tolist()]},
        _lines(lib.bch_check_get_assumptions, handle),
        _lines(lib.bch_check_get_notes, handle),
        _records(lib.bch_check_get_measures, handle, _MEASURE),
        _records(lib.bch_check_get_conflicts, handle, _CONFLICT),
        _text(lib.bch_check_get_page, handle),
    )
