"""The registry of the model's parameters: name, SI unit, bounds, meaning, equation.

The order here is the order of every table and of every vector of parameters. The
speed v is not among them: it belongs to a run, not to a vehicle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial


@dataclass(frozen=True)
class Bounds:
    """An interval of finite numbers, in the SI unit of its parameter."""

    low: float = -math.inf
    high: float = math.inf
    includes_low: bool = False

    def contain(self, value: float) -> bool:
        """Whether ``value`` is finite and inside."""
        above = value >= self.low if self.includes_low else value > self.low
        return math.isfinite(value) and above and value < self.high

    def describe(self, name: str) -> str:
        """The interval as an inequality, such as ``0 <= nu < 0.5``."""
        sign = "<=" if self.includes_low else "<"
        if math.isinf(self.low) and math.isinf(self.high):
            return f"{name} any finite number"
        if math.isinf(self.high):
            return f"{name} {sign.replace('<', '>')} {self.low:g}"
        return f"{self.low:g} {sign} {name} < {self.high:g}"


@dataclass(frozen=True)
class Parameter:
    """One parameter of the model.

    ``default`` is the value of a parameter that may be left out. ``needed_by``
    names the (option, value) without which the parameter has no effect, so that
    it may be absent otherwise. ``hidden`` marks what the paper does not print.
    """

    table: str
    name: str
    unit: str
    bounds: Bounds
    latex: str
    equation: str
    meaning: str
    default: float | None = None
    needed_by: tuple[str, str] | None = None
    hidden: bool = False

    @property
    def path(self) -> str:
        """Where a vehicle file holds it: ``table.name``."""
        return f"{self.table}.{self.name}"


ANY = Bounds()
POSITIVE = Bounds(low=0.0)
NOT_NEGATIVE = Bounds(low=0.0, includes_low=True)
POISSON = Bounds(low=0.0, high=0.5, includes_low=True)
ANGLE = Bounds(low=-math.pi / 2, high=math.pi / 2)
OFFSET = Bounds(low=-1.0)

_wheelset = partial(Parameter, "wheelset")
_suspension = partial(Parameter, "suspension")
_contact = partial(Parameter, "contact")
_geometry = partial(Parameter, "geometry")
_flange = partial(Parameter, "flange")
_piecewise = partial(_flange, needed_by=("flange_law", "piecewise_linear"))
_quintic = partial(_flange, needed_by=("flange_law", "quintic"))
_exponential = partial(_flange, needed_by=("flange_law", "exponential"))
_reciprocal = partial(_flange, needed_by=("flange_law", "reciprocal"))

_POWERS = ("constant", "linear", "quadratic", "cubic")


def _asymmetry(letter: str, what: str, equation: str, units: tuple[str, ...]) -> list[Parameter]:
    """Half the left-minus-right differences of one geometry function, constant to cubic."""
    return [
        Parameter(
            table="asymmetry",
            name=f"d{letter}{power}",
            unit=unit,
            bounds=ANGLE if unit == "rad" else ANY,
            latex=rf"\Delta {letter}_{power}",
            equation=equation,
            meaning=f"half the left-minus-right difference of the {word} term of the {what}",
            default=0.0,
        )
        for power, (word, unit) in enumerate(zip(_POWERS, units, strict=True))
    ]


# fmt: off
PARAMETERS: tuple[Parameter, ...] = (
    _wheelset("mw", "kg", POSITIVE, r"m_\mathrm{w}", "16", "wheelset mass"),
    _wheelset("Iwz", "kg m2", POSITIVE, r"I_{\mathrm{w}z}", "17", "yaw moment of inertia"),
    _wheelset("r0", "m", POSITIVE, r"r_0", "1", "nominal rolling radius"),
    _wheelset("b", "m", POSITIVE, r"b", "9", "half the distance between the contact points"),
    _suspension("Kpx", "N/m", NOT_NEGATIVE, r"K_{\mathrm{p}x}", "18",
                "longitudinal stiffness at one wheelset end"),
    _suspension("Kpy", "N/m", NOT_NEGATIVE, r"K_{\mathrm{p}y}", "19",
                "lateral stiffness at one wheelset end"),
    _suspension("Cpx", "N s/m", NOT_NEGATIVE, r"C_{\mathrm{p}x}", "18",
                "longitudinal damping at one wheelset end", default=0.0),
    _suspension("Cpy", "N s/m", NOT_NEGATIVE, r"C_{\mathrm{p}y}", "19",
                "lateral damping at one wheelset end", default=0.0),
    _suspension("wp", "m", POSITIVE, r"w_\mathrm{p}", "17",
                "half the lateral distance of the suspension"),
    _contact("p0", "N", POSITIVE, r"p_0", "7", "vertical load of one wheel", hidden=True),
    _contact("E", "Pa", POSITIVE, r"E", "6", "Young's modulus of wheel and rail", hidden=True),
    _contact("nu", "1", POISSON, r"\nu", "6", "Poisson's ratio of wheel and rail", hidden=True),
    _contact("mu", "1", POSITIVE, r"\mu", "12", "friction coefficient",
             needed_by=("creep_law", "shen_hedrick_elkins"), hidden=True),
    _contact("radius_offset", "1", OFFSET, r"\epsilon_r", "9",
             "relative excess over r0 of the rolling radius at y = 0 in the longitudinal creepage",
             default=0.0),
    _contact("f23_factor", "1", NOT_NEGATIVE, r"\kappa_{23}", "10",
             "factor on the lateral-spin creep coefficient f23", default=1.0),
    _contact("spin_cosine_exponent", "1", ANY, r"n_s", "9",
             "exponent n of the factor cos(g)^n on the sine term of the spin creepage",
             default=0.0),
    _geometry("a1", "1", ANY, r"a_1", "1", "linear term of the rolling radius (conicity)"),
    _geometry("a2", "1/m", ANY, r"a_2", "1", "quadratic term of the rolling radius", default=0.0),
    _geometry("a3", "1/m2", ANY, r"a_3", "1", "cubic term of the rolling radius"),
    _geometry("c0", "rad", ANGLE, r"c_0", "2", "contact angle at the centre", hidden=True),
    _geometry("c1", "1/m", ANY, r"c_1", "2", "linear term of the contact angle"),
    _geometry("c2", "1/m2", ANY, r"c_2", "2", "quadratic term of the contact angle", default=0.0),
    _geometry("c3", "1/m3", ANY, r"c_3", "2", "cubic term of the contact angle"),
    _geometry("e0", "1/m", ANY, r"e_0", "3", "wheel curvature at the centre", hidden=True),
    _geometry("f0", "1/m", ANY, r"f_0", "4", "rail curvature at the centre", hidden=True),
    _geometry("e1", "1/m2", ANY, r"e_1", "3", "linear term of the wheel curvature"),
    _geometry("f1", "1/m2", ANY, r"f_1", "4", "linear term of the rail curvature"),
    _geometry("e2", "1/m3", ANY, r"e_2", "3", "quadratic term of the wheel curvature", default=0.0),
    _geometry("f2", "1/m3", ANY, r"f_2", "4", "quadratic term of the rail curvature", default=0.0),
    _geometry("e3", "1/m4", ANY, r"e_3", "3", "cubic term of the wheel curvature"),
    _geometry("f3", "1/m4", ANY, r"f_3", "4", "cubic term of the rail curvature"),
    *_asymmetry("a", "rolling radius", "1", ("m", "1", "1/m", "1/m2")),
    *_asymmetry("c", "contact angle", "2", ("rad", "1/m", "1/m2", "1/m3")),
    *_asymmetry("h", "curvature sum e + f", "3, 4", ("1/m", "1/m2", "1/m3", "1/m4")),
    _piecewise("k0", "N/m", NOT_NEGATIVE, r"k_0", "24", "flange stiffness"),
    _piecewise("eta", "m", POSITIVE, r"\eta", "24", "flange clearance"),
    _quintic("d1", "N/m3", ANY, r"d_1", "25", "cubic coefficient, pushes outward if positive"),
    _quintic("d2", "N/m5", ANY, r"d_2", "25", "quintic coefficient, restoring if positive"),
    _exponential("p1", "N", ANY, r"p_1", "26", "factor of the exponential flange force"),
    _exponential("q1", "1/m", ANY, r"q_1", "26", "rate of the exponential flange force"),
    _reciprocal("p2", "N m", ANY, r"p_2", "27", "factor of the reciprocal flange force"),
    _reciprocal("q2", "m", POSITIVE, r"q_2", "27", "pole of the reciprocal flange force"),
)
# fmt: on

BY_NAME: dict[str, Parameter] = {parameter.name: parameter for parameter in PARAMETERS}

TABLES: tuple[str, ...] = tuple(dict.fromkeys(parameter.table for parameter in PARAMETERS))
