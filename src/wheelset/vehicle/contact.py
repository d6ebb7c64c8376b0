"""Contact of one wheel: Eqs. (5)-(7), Hertz, and Eqs. (8)-(14), creep forces.

Signs. Eqs. (8) and (9) lost their signs in the paper's text. ``angle_sign`` is +1 for the physical
reading (the normal force of a wheel that climbs its flange pushes the wheelset back) and -1 for the
reversed one that reproduces the paper's numbers.
"""

from __future__ import annotations

import sympy as sp

from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.quantities import (
    C11,
    C22,
    C23,
    C33,
    A,
    B,
    Equation,
    Fx,
    Fx_track,
    Fy,
    Fy_track,
    Fyn,
    G,
    Kx,
    Ky,
    Kz,
    Mz,
    Mz_track,
    N,
    cos_gamma,
    cube,
    delta,
    dr,
    f11,
    f22,
    f23,
    f33,
    gamma,
    patch,
    phi,
    r,
    ratio,
    rho,
    saturation,
    shape,
    sin_gamma,
    u2,
    xi_s,
    xi_x,
    xi_y,
)
from wheelset.vehicle.symbols import p, psi, psid, s, v, yd

#: Squared saturation below which the creep forces are Kalker's to 1e-10 (Eq. 12 is 1 - u/3 + ...).
LEAST_SATURATION = 1e-20


def wheel_equations(options: ModelOptions) -> tuple[Equation, ...]:
    """All equations of a wheel of side s, in the order of evaluation."""
    return (
        *_contact_equations(options),
        *_creep_coefficients(options),
        *_creepages(options),
        *_linear_forces(options),
        *_saturation_equations(options),
        *_track_equations(),
    )


def _contact_equations(options: ModelOptions) -> tuple[Equation, ...]:
    """Eqs. (5)-(7): Hertz. The ellipse enters through its area a b and its ratio k = b/a."""
    return (
        Equation(r, p.r0 + dr, "1", "m", "rolling radius"),
        Equation(gamma, delta + s * phi, "7", "rad", "slope of the contact plane to the track"),
        Equation(cos_gamma, sp.cos(gamma), "7", "1", "its cosine"),
        Equation(sin_gamma, sp.sin(gamma), "8", "1", "its sine"),
        *_curvature_equations(options),
        Equation(N, p.p0 / _lifting(options), "7", "N", "normal force"),
        *_ellipse_equations(options),
    )


def _lifting(options: ModelOptions) -> sp.Expr:
    """What p0 is divided by to be the normal force: its vertical part, or 1."""
    return {"vertical": cos_gamma, "constant": sp.Integer(1)}[options.normal_force]


def _curvature_equations(options: ModelOptions) -> tuple[Equation, ...]:
    """Eq. (5), and the axis ratio of Eq. (6)."""
    across = {"half": rho / 2, "full": rho}[options.transverse_curvature]
    words = {"half": "half the curvature across the track", "full": "curvature across the track"}
    return (
        Equation(A, 1 / (2 * r), "5", "1/m", "half the curvature along the track"),
        Equation(B, across, "5", "1/m", words[options.transverse_curvature]),
        Equation(ratio, (A / B) ** _EXPONENT, "6", "1", "axis ratio of the contact ellipse, b/a"),
    )


def _ellipse_equations(options: ModelOptions) -> tuple[Equation, ...]:
    """Eq. (6): the ellipse's size. The printed shape factor stands under the power 2/3."""
    factor = shape**_EXPONENT
    under, beside = {
        "inside": (factor, sp.Integer(1)),
        "outside": (sp.Integer(1), factor),
    }[options.shape_exponent]
    hertz = (1 - p.nu**2) / p.E * N * under / (A + B) * sp.Rational(3, 2)
    area = cube ** sp.Rational(2, 3) * beside
    form = (1 + A / B) / (2 * sp.sqrt(A / B))
    return (
        Equation(shape, form, "6", "1", "shape factor of the ellipse"),
        Equation(cube, hertz, "6", "m3", "cube of the mean semi-axis, (a b)^(3/2)"),
        Equation(patch, area, "6", "m2", "product of the semi-axes, a b"),
    )


_EXPONENT = sp.Float("0.63")


def _kalker(*coefficients: str) -> sp.Expr:
    """Fit of a Kalker coefficient in powers of 1/k, Eq. (11)."""
    return sp.Add(*(sp.Float(c) / ratio**j for j, c in enumerate(coefficients)))


def _creep_coefficients(options: ModelOptions) -> tuple[Equation, ...]:
    """Eqs. (10), (11): Kalker's coefficients on the Hertzian ellipse."""
    # C33 has no published fit of this form; within 2.3 % of Kalker's table at nu = 0.28.
    fit = sp.Float("0.3501") + sp.Float("0.8051") * ratio + sp.Float("0.0596") / (1 + ratio)
    spin = {"none": sp.Integer(0), "fit": fit}[options.spin_moment]
    f23_area = patch ** sp.Rational(3, 2)
    kalker = "Kalker coefficient"
    return (
        Equation(C11, _kalker("3.2893", "0.9750", "-0.0120"), "11", "1", kalker),
        Equation(C22, _kalker("2.4014", "1.3179", "-0.0200"), "11", "1", kalker),
        Equation(C23, _kalker("0.4147", "1.0184", "0.0565", "-0.0013"), "11", "1", kalker),
        Equation(C33, spin, "11", "1", kalker),
        Equation(f11, G * patch * C11, "10", "N", "longitudinal creep coefficient"),
        Equation(f22, G * patch * C22, "10", "N", "lateral creep coefficient"),
        Equation(f23, p.f23_factor * G * f23_area * C23, "10", "N m", "lateral-spin coefficient"),
        Equation(f33, G * patch**2 * C33, "10", "N m2", "spin creep coefficient"),
    )


def _creepages(options: ModelOptions) -> tuple[Equation, ...]:
    """Eqs. (8), (9): the lateral part of the normal force, and the creepages."""
    angle_sign = {"physical": 1, "reversed": -1}[options.contact_angle_sign]
    cosine = {"included": cos_gamma, "omitted": sp.Integer(1)}[options.lateral_creepage_cosine]
    gravity = -angle_sign * s * p.p0 * sin_gamma / _lifting(options)
    longitudinal = -p.radius_offset - dr / p.r0 - s * p.b * psid / v
    camber = -angle_sign * s * sin_gamma * cos_gamma**p.spin_cosine_exponent / p.r0
    return (
        Equation(Fyn, gravity, "8", "N", "lateral part of the normal force"),
        Equation(xi_x, longitudinal, "9", "1", "longitudinal creepage"),
        Equation(xi_y, (yd / v - psi) * cosine, "9", "1", "lateral creepage"),
        Equation(xi_s, camber + psid / v * cos_gamma, "9", "1/m", "spin creepage"),
    )


def _linear_forces(options: ModelOptions) -> tuple[Equation, ...]:
    """Eq. (10): Kalker's linear law."""
    sign = {"plus": 1, "minus": -1}[options.lateral_spin_moment]
    return (
        Equation(Kx, -f11 * xi_x, "10", "N", "longitudinal creep force, linear"),
        Equation(Ky, -f22 * xi_y - f23 * xi_s, "10", "N", "lateral creep force, linear"),
        Equation(Kz, sign * f23 * xi_y - f33 * xi_s, "10", "N m", "creep moment, linear"),
    )


def _saturation_equations(options: ModelOptions) -> tuple[Equation, ...]:
    """Eqs. (12), (13): Shen-Hedrick-Elkins scales forces and moment alike, or not at all."""
    if options.creep_law == "linear":
        factor: tuple[Equation, ...] = ()
        scale = sp.Integer(1)
    else:
        factor, scale = _shen_hedrick_elkins(), saturation
    return (
        *factor,
        Equation(Fx, scale * Kx, "13", "N", "longitudinal creep force"),
        Equation(Fy, scale * Ky, "13", "N", "lateral creep force"),
        Equation(Mz, scale * Kz, "13", "N m", "creep moment"),
    )


def _shen_hedrick_elkins() -> tuple[Equation, ...]:
    """F'/F = 1 - u/3 + u^2/27 up to u = F/(mu N) = 3, and 1/u beyond: twice differentiable at 3,
    and at u = 0 only once, since u is a root.
    """
    u = sp.sqrt(u2)
    factor = sp.Piecewise(
        (sp.Integer(1), u2 < LEAST_SATURATION), (1 - u / 3 + u2 / 27, u2 < 9), (1 / u, True)
    )
    return (
        Equation(u2, (Kx**2 + Ky**2) / (p.mu * N) ** 2, "12", "1", "(F / mu N)^2"),
        Equation(saturation, factor, "12", "1", "ratio of saturated to linear creep force"),
    )


def _track_equations() -> tuple[Equation, ...]:
    """Eq. (14): from the contact plane to the track."""
    return (
        Equation(Fx_track, Fx, "14", "N", "longitudinal force in track axes"),
        Equation(Fy_track, Fx * psi + Fy * cos_gamma, "14", "N", "lateral force in track axes"),
        Equation(Mz_track, Mz * cos_gamma, "14", "N m", "yaw moment of the contact patch"),
    )
