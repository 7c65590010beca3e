# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Collision checks between characters in dense crowds.

Make or load a set of shapes, describe a crowd by arrays, and query:

>>> import bch, numpy as np
>>> people = bch.bake([bch.default_male(), bch.default_female()], poses=50)
>>> n = 1000
>>> random = np.random.default_rng(1)
>>> agents = bch.Agents(
...     random.integers(len(people), size=n),
...     random.uniform(0, 20, n), random.uniform(0, 20, n), random.uniform(-3, 3, n))
>>> crowd = bch.Crowd()
>>> for a, b in crowd.collisions(people, agents): print(a, "collides with", b)
>>> near = crowd.clearances(people, agents, within=0.5)

Lengths are in metres and angles in radians. Queries use your arrays without a copy. If an array has another dtype or layout,
the error says which is expected. Every query releases the GIL, so Python threads run at the same time.
"""

from . import plot
from ._animated import AnimatedShape
from ._arrays import DISC, PENETRATION, POSE, POSE_ID, SPHERE, SPHERE_CONTACT, TOUCH
from ._bake import bake
from ._bodies import BodyModel, BodySet, LiveBodies, default_body, load_models, save_models, spheres_from_capsules, spheres_from_polygons
from ._characters import Bone, Channel, Curve, Joint, Motion, make_character
from ._crowds import Clearances, Contacts, Crowd, Neighbours, Penetrations, Resolved, Rows
from ._library import (
    ArgumentError,
    ArrayError,
    Error,
    FileError,
    FileMissing,
    OutOfMemory,
    RangeError,
    SizeError,
    implementations,
    lib as _lib,
)
from ._motions import Mover, animate, first_contact, free_until
from ._obstacles import Obstacles
from ._outlines import Outline, outline
from ._poses import Transforms, Vertices
from ._queries import (
    Agents,
    Nearest,
    Pairs,
    clearance,
    collide,
    local_densities,
    nearest,
    nearest_free,
    nearest_free_of_all,
    penetration,
    time_of_impact,
    within,
)
from ._recordings import (
    NEAR,
    OVERLAP,
    PASS,
    TRACKED,
    WALL,
    Check,
    NamedBody,
    NamedMotion,
    Trajectory,
    check,
    dataframe,
    read_trajectory,
)
from ._scenes import ScenePlan, plan_scene
from ._shapes import (
    ALL_DEPTHS,
    REST_POSE,
    Character,
    Clip,
    DynamicShapeSet,
    KeptClip,
    Origin,
    Plan,
    ShapeBuilder,
    ShapeSet,
    ShapeSetBuilder,
    default_bulky_male,
    default_female,
    default_male,
    default_pedestrian,
    depth_at_density,
    import_character,
    pedestrian_strides_per_second,
)

__version__: str = _lib.bch_version().decode()
__all__ = [
    "ALL_DEPTHS",
    "Agents",
    "AnimatedShape",
    "ArgumentError",
    "ArrayError",
    "BodyModel",
    "BodySet",
    "Bone",
    "Channel",
    "Character",
    "Check",
    "Clip",
    "Clearances",
    "Contacts",
    "Crowd",
    "Curve",
    "DISC",
    "DynamicShapeSet",
    "Error",
    "FileError",
    "FileMissing",
    "Joint",
    "KeptClip",
    "LiveBodies",
    "Motion",
    "Mover",
    "NEAR",
    "NamedBody",
    "NamedMotion",
    "Nearest",
    "Neighbours",
    "OVERLAP",
    "Obstacles",
    "Origin",
    "Outline",
    "OutOfMemory",
    "PASS",
    "PENETRATION",
    "POSE",
    "POSE_ID",
    "Pairs",
    "Penetrations",
    "Resolved",
    "Plan",
    "REST_POSE",
    "RangeError",
    "Rows",
    "SPHERE",
    "SPHERE_CONTACT",
    "ScenePlan",
    "ShapeBuilder",
    "ShapeSet",
    "ShapeSetBuilder",
    "SizeError",
    "TOUCH",
    "TRACKED",
    "Trajectory",
    "Transforms",
    "Vertices",
    "WALL",
    "animate",
    "bake",
    "check",
    "clearance",
    "collide",
    "dataframe",
    "default_body",
    "default_bulky_male",
    "default_female",
    "default_male",
    "default_pedestrian",
    "depth_at_density",
    "first_contact",
    "free_until",
    "implementations",
    "import_character",
    "load_models",
    "local_densities",
    "make_character",
    "nearest",
    "nearest_free",
    "nearest_free_of_all",
    "outline",
    "pedestrian_strides_per_second",
    "penetration",
    "plan_scene",
    "plot",
    "read_trajectory",
    "save_models",
    "spheres_from_capsules",
    "spheres_from_polygons",
    "time_of_impact",
    "within",
]

for _name in __all__:  # what tracebacks and help() call functions and errors
    _thing = globals()[_name]
    if callable(_thing) and (not isinstance(_thing, type) or issubclass(_thing, Error)):
        _thing.__module__ = "bch"
