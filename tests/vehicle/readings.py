"""Set M1 typed over a second time, so that tests of the equations need no vehicle file."""

from __future__ import annotations

import types

from wheelset.vehicle.options import ModelOptions

OPTIONS = {
    "contact_angle_sign": "reversed",
    "lateral_creepage_cosine": "included",
    "normal_force": "vertical",
    "shape_exponent": "inside",
    "transverse_curvature": "half",
    "creep_law": "linear",
    "spin_moment": "none",
    "lateral_spin_moment": "plus",
    "flange_law": "none",
    "flange_wheels": 1,
}

M1 = {
    "mw": 1550.0, "Iwz": 990.0, "Kpx": 1e6, "Kpy": 1e6, "Cpx": 0.0, "Cpy": 0.0, "r0": 0.46,
    "b": 0.75, "wp": 1.0, "p0": 5774.4, "E": 2.1e11, "nu": 0.173844, "radius_offset": 1.25684e-3,
    "f23_factor": 1.05106, "spin_cosine_exponent": 0.0,
    "a1": 0.226537, "a2": 0.0, "a3": -499.40, "c0": 0.05, "c1": 14.45, "c2": 0.0, "c3": -44745.28,
    "e0": 14.8349, "e1": 9.14, "e2": 0.0, "e3": -125311.23,
    "f0": 0.0, "f1": 381.83, "f2": 0.0, "f3": 6616287.34,
    **{f"d{letter}{k}": 0.0 for letter in "ach" for k in range(4)},
    "k0": 1.617e7, "eta": 0.00923, "d1": 1.6e11, "d2": 1.6e15, "p1": 3.906e-4, "q1": -1645.0,
    "p2": -1.0, "q2": 0.0112,
}  # fmt: skip


def reading(options=None, values=None):
    """What the door needs of a vehicle: values and options, M1 unless changed."""
    return types.SimpleNamespace(
        values={**M1, **(values or {})}, options=ModelOptions(**{**OPTIONS, **(options or {})})
    )
