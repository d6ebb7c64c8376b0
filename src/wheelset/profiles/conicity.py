"""Equivalent conicity of EN 15302 and what goes with it.

The equivalent conicity tan(gamma_e) at an amplitude is that of the cone whose wave has the same
wavelength (integration), whose dr fits best over the amplitude (regression), or whose dr does the
same work on a sine (harmonic linearisation): for a cone all three are half the slope of dr.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from wheelset.profiles.contact import Contact
from wheelset.profiles.curves import Array
from wheelset.profiles.errors import NoPeriodicMotion
from wheelset.profiles.wave import Difference, peaks, wavelength

#: Amplitudes of the tables, m.
AMPLITUDES = np.arange(1, 9) * 1e-3

#: The amplitudes between which Polach's nonlinearity parameter is taken, m.
NONLINEARITY = (0.002, 0.004)

#: Points of a sine in harmonic linearisation.
SINE = 720


@dataclass(frozen=True)
class Conicity:
    """At one amplitude [m]; lengths in m, conicities are tangents.

    integration: by the wavelength of the nonlinear motion, whose peaks are ``low`` and ``high``;
    regression: by the straight line through dr; harmonic: by the first harmonic.
    dr: rolling radius difference at the amplitude, half of that between the peaks.
    contact_angle: parameter ``e/4 times the harmonic slope of tan(delta_l) - tan(delta_r)``.
    """

    amplitude: float
    low: float
    high: float
    wavelength: float
    integration: float
    regression: float
    harmonic: float
    dr: float
    contact_angle: float


def difference_of(contact: Contact, grid: ArrayLike | None = None) -> Difference:
    """dr of the contacts, jumps included, or linear between the points of a grid [m]."""
    if grid is None:
        return Difference(contact.y, contact.dr)
    y = np.asarray(grid, float)
    return Difference(y, np.interp(y, contact.y, contact.dr))


def equivalent_conicity(
    contact: Contact, amplitude: float, difference: Difference | None = None
) -> Conicity:
    """All three conicities at an amplitude [m].

    Raises NoPeriodicMotion where the motion has no such wave.
    """
    difference = difference or difference_of(contact)
    setup = contact.setup
    product = setup.base * setup.mean_radius
    low, high = peaks(difference, amplitude)
    length = wavelength(difference, low, high, 1 / product)
    ends = np.interp([low, high], difference.y, difference.dr)
    return Conicity(
        amplitude,
        low,
        high,
        length,
        product / 2 * (2 * np.pi / length) ** 2,
        0.5 * _regression_slope(difference.between(low, high)),
        0.5 * _harmonic_slope(difference.y, difference.dr, low, high),
        float(ends[1] - ends[0]) / 2,
        setup.base / 4 * _harmonic_slope(contact.y, _tangents(contact), low, high),
    )


def _tangents(contact: Contact) -> Array:
    return np.tan(contact.left.delta) - np.tan(contact.right.delta)


def _regression_slope(part: Difference) -> float:
    """Least squares over the displacement; Simpson's rule is exact for a line times a line."""
    middle = 0.5 * (part.y[0] + part.y[-1])
    y, dr, d = part.y - middle, part.dr, np.diff(part.y)
    centre = (y[1:] + y[:-1]) * (dr[1:] + dr[:-1])
    moment = np.sum(d / 6 * (y[:-1] * dr[:-1] + centre + y[1:] * dr[1:]))
    return float(moment / (2 / 3 * y[-1] ** 3))


def _harmonic_slope(y: Array, values: Array, low: float, high: float) -> float:
    """First harmonic of the values on a sine between low and high, over its amplitude."""
    sine = np.sin((np.arange(SINE) + 0.5) * 2 * np.pi / SINE)
    amplitude = 0.5 * (high - low)
    on_sine = np.interp(0.5 * (low + high) + amplitude * sine, y, values)
    return float(2 * np.mean(on_sine * sine) / amplitude)


@dataclass(frozen=True, eq=False)
class ConicityTable:
    """Conicities by amplitude; ``missing``: amplitudes without a wave, with the reason.

    nonlinearity: Polach's parameter, the slope of the conicity between amplitudes of 2 and
    4 mm, 1/m; None where one of the two is missing.
    """

    rows: tuple[Conicity, ...]
    missing: tuple[NoPeriodicMotion, ...]
    nonlinearity: float | None

    def to_frame(self) -> pd.DataFrame:
        """A row an amplitude, SI units."""
        columns = [field.name for field in fields(Conicity)]
        return pd.DataFrame([vars(row) for row in self.rows], columns=columns).set_index(
            "amplitude"
        )


def conicity_table(
    contact: Contact, amplitudes: ArrayLike = AMPLITUDES, grid: ArrayLike | None = None
) -> ConicityTable:
    """Conicities at the amplitudes [m], and the nonlinearity parameter."""
    difference = difference_of(contact, grid)
    rows, missing = [], []
    for amplitude in np.atleast_1d(np.asarray(amplitudes, float)):
        try:
            rows.append(equivalent_conicity(contact, float(amplitude), difference))
        except NoPeriodicMotion as reason:
            missing.append(reason)
    return ConicityTable(tuple(rows), tuple(missing), _nonlinearity(contact, difference))


def _nonlinearity(contact: Contact, difference: Difference) -> float | None:
    try:
        low, high = (
            equivalent_conicity(contact, amplitude, difference).integration
            for amplitude in NONLINEARITY
        )
    except NoPeriodicMotion:
        return None
    return (high - low) / (NONLINEARITY[1] - NONLINEARITY[0])
