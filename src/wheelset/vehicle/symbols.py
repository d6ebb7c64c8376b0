"""The symbols every equation of the model is written in; one symbol a name, all real.

y, psi: lateral displacement [m, to the left] and yaw [rad]; yd, psid: their rates; v: speed [m/s];
s: side, +1 for the left wheel and -1 for the right; p: the parameters, e.g. ``p.a1``; reach: the
largest |y| that a contact geometry made from points knows [m].
"""

from __future__ import annotations

from types import SimpleNamespace

import sympy as sp

from wheelset.vehicle.parameters import PARAMETERS

y, psi, yd, psid, v, s = sp.symbols("y psi yd psid v s", real=True)
reach = sp.Symbol("contact_reach", real=True)

STATE = (y, psi, yd, psid)

p = SimpleNamespace(**{q.name: sp.Symbol(q.name, real=True) for q in PARAMETERS})
