"""Systems whose cycles, multipliers, bifurcation points and coefficients are known exactly.

Every oracle is a frozen dataclass: its fields are the parameters, ``system`` is the ``System`` at
those values, ``cycle()`` an ``ExactCycle`` with everything known about it. ``sheared`` turns any
of them into one with the same periods, multipliers and coefficients whose cycle is no circle and
whose second and third derivatives do not vanish. What has no closed form stands at the end.

Letters: R = |z|^2 the squared radius of a cycle z = r e^{i phi}, rate = d phi/dt, T its period;
xi' = s xi + c xi^3 the amplitude of the mode that is neutral at the bifurcation.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from wheelset.bifurcation.system import System

Array = NDArray[np.float64]
Symbols = Sequence[sp.Symbol]
Expressions = list[sp.Expr]


# --- what is known about a cycle -----------------------------------------------------------------


@dataclass(frozen=True)
class CriticalMode:
    """The mode that is neutral at a period doubling, torus or pitchfork point of a cycle u.

    Real: x = u(tau) + xi v(tau) + ..., dtau/dt = 1 + a xi^2 + ..., dxi/dt = c xi^3 + ...
    Complex: x = u + xi v + conj + ..., dtau/dt = 1 + a |xi|^2, dxi/dt = i theta xi + c xi |xi|^2.

    vector: v at phases s (points,) -> (points, n); v(1) = -v(0) at a period doubling.
    """

    vector: Callable[[Array], NDArray[Any]]
    c: complex
    a: float = 0.0
    theta: float = 0.0

    def sized(self) -> CriticalMode:
        """The same with int_0^1 <v, v> ds = 1: c and a are divided by that integral."""
        size = float((np.abs(self.vector(_PHASES)) ** 2).sum(axis=1).mean())
        return dataclasses.replace(
            self, vector=lambda s: self.vector(s) / size**0.5, c=self.c / size, a=self.a / size
        )


#: Equidistant phases: the mean over them is the integral, to rounding, of a smooth periodic
#: function.
_PHASES = np.arange(256) / 256


@dataclass(frozen=True)
class ExactCycle:
    """A periodic solution known in closed form.

    state: u at phases s (points,) -> (points, n), s = t / period.

    exponents: sigma [1/s] of the n - 1 modes beside the trivial one. exp(sigma T) are the
    multipliers. signs: the diagonal of S where u(t + T/2) = S u(t) holds, else empty; the
    imaginary part of sigma is such that exp(sigma T/2) are the eigenvalues of S Phi(T/2), which
    is N = -Phi(T/2) for an odd field.
    """

    system: System
    period: float
    state: Callable[[Array], Array]
    exponents: tuple[complex, ...]
    signs: tuple[int, ...] = ()
    mode: CriticalMode | None = None

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """The n - 1 nontrivial multipliers."""
        return np.exp(self.period * np.array(self.exponents, dtype=complex))

    @property
    def half_multipliers(self) -> NDArray[np.complex128]:
        """The n - 1 nontrivial eigenvalues of S Phi(T/2)."""
        if not self.signs:
            raise ValueError("this cycle has no half-period symmetry; use multipliers")
        return np.exp(self.period / 2 * np.array(self.exponents, dtype=complex))

    @property
    def coefficient(self) -> complex:
        """c of the mode for int_0^T <v, v> dt = 1, which is c / T of the mode as sized.

        This is c of a period doubling in the normalisation of Kuznetsov, Govaerts, Doedel and
        Dhooge (2005), d of a torus bifurcation, and the pitchfork's; its real part's sign is
        that of the criticality (negative: the new solutions are stable).
        """
        if self.mode is None:
            raise ValueError("this cycle has no critical mode")
        return self.mode.sized().c / self.period


def sheared(cycle: ExactCycle, strength: float = 0.3) -> ExactCycle:
    """The cycle in coordinates y_1 = x_1, y_i = x_i - strength x_{i-1}^3; n = 3: y_3 with a square.

    The map is invertible (x is y with the power of x_{i-1} added, from the first on) and keeps
    the symmetries used here: -1 for even n, diag(-1, -1, 1) for n = 3. Multipliers, the c and a of
    a given xi, and the LPC coefficient do not depend on coordinates; v is mapped by the derivative.
    """

    def vector(s: Array) -> NDArray[Any]:
        assert cycle.mode is not None
        x, v = cycle.state(s), cycle.mode.vector(s)
        power = _powers(x.shape[1])
        return _less_previous(v, strength * power * x ** (power - 1) * v)

    def state(s: Array) -> Array:
        x = cycle.state(s)
        return _less_previous(x, strength * x ** _powers(x.shape[1]))

    return dataclasses.replace(
        cycle,
        system=_sheared_system(cycle.system, strength),
        state=state,
        mode=cycle.mode and dataclasses.replace(cycle.mode, vector=vector),
    )


def _powers(n: int) -> NDArray[np.int64]:
    """Power of each component that is taken off the next one; the last entry is not used."""
    return np.array([3] * n if n % 2 == 0 else [3] * (n - 2) + [2, 1])


def _less_previous(x: NDArray[Any], term: NDArray[Any]) -> NDArray[Any]:
    """x_i less the term of component i - 1, shape (points, n)."""
    return x - np.pad(term, ((0, 0), (1, 0)))[:, :-1]


def _sheared_system(system: System, strength: float) -> System:
    field, powers = system.field, [int(k) for k in _powers(system.n)]

    def f(y: Symbols, p: Symbols) -> Expressions:
        x = [y[0]]
        for part, k in zip(y[1:], powers, strict=False):
            x.append(part + strength * x[-1] ** k)
        old = dict(zip((*field.state, *field.parameters), (*x, *p), strict=True))
        F = [e.xreplace(old) for e in field.derivative]
        slopes = [strength * k * u ** (k - 1) for u, k in zip(x, powers, strict=True)]
        return [F[0], *(b - k * a for a, b, k in zip(F, F[1:], slopes, strict=False))]

    return System.from_function(f, system.state_names, system.values)


def _turn(grow: sp.Expr, rate: sp.Expr, x: sp.Expr, y: sp.Expr) -> Expressions:
    """(grow + i rate)(x + i y) as real and imaginary part."""
    return [grow * x - rate * y, rate * x + grow * y]


def _circle(s: Array, turns: float = 1.0) -> Array:
    """cos and sin of 2 pi turns s, shape (points, 2)."""
    angle = 2 * np.pi * turns * np.asarray(s)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _real_roots(*coefficients: float) -> Array:
    """Increasing real zeros of a polynomial, constant coefficient first."""
    roots = np.polynomial.Polynomial(coefficients).trim().roots()
    return np.sort(roots[np.abs(roots.imag) < 1e-9].real)


def _system(f: Callable[..., Expressions], state: str, oracle: Any, names: str) -> System:
    values = {name: float(getattr(oracle, name)) for name in names.split()}
    return System.from_function(f, state.split(), values)


# --- folds and cusps of cycles, any even n -------------------------------------------------------


@dataclass(frozen=True)
class Oscillators:
    """z_j' = (q(R_j) + i (w + shift R_j)) z_j + coupling (z_{j+1} - 2 z_j + z_{j-1}), odd.

    q(R) = b1 + b2 R + b3 R^2 + b4 R^3, j = 1..count, ends free, n = 2 count. All in phase,
    r' = r q(R): cycles are the zeros R of q, with T = 2 pi/(w + shift R).

    Deviations z_j = r e^{i phi}(1 + e_j): on the k-th mode of the chain, l = -4 coupling
    sin^2(pi k/(2 count)), (Re e)' = (2 R q' + l) Re e, (Im e)' = 2 R shift Re e + l Im e, so the
    exponents are 2 R q'(R) + l_k and l_k. In phase (k = 0): 2 R q'(R) and the trivial one.

    Hopf at b1 = 0 with frequency w. |q|_2 = 1 makes R = 2 |amplitude|^2/count, so FLC = 2 b2/count
    and, at the generalized Hopf point b1 = b2 = 0, SLC = 4 b3/count^2.

    LPC where q = q' = 0: b1 = b3 R^2 + 2 b4 R^3, b2 = -2 b3 R - 3 b4 R^2; for b4 = 0 the parabola
    b2^2 = 4 b1 b3. Its coefficient: with r = r0 + d, d' = g d^2, g = 2 r0^3 q'', and dtau/dt =
    1 + (2 shift r0/rate) d =: 1 - xi, the normal form dtau/dt = 1 - xi, dxi/dt = b xi^2 has
    b = -g rate/(2 shift r0) = -R q''(R) rate/shift; it is infinite where T is stationary.
    Cusp of cycles (CPC) where also q'' = 0: R = -b3/(3 b4). Then d' = 8 b4 r0^4 d^3, so
    dxi/dt = 2 b4 R (rate/shift)^2 xi^3.
    """

    b1: float = -0.04
    b2: float = 0.5
    b3: float = -1.0
    b4: float = 0.0
    w: float = 2.0
    shift: float = 0.4
    coupling: float = 0.3
    count: int = 1

    @cached_property
    def system(self) -> System:
        """State x1, y1, x2, y2, ...; parameters b1, b2, b3, b4, w, shift, coupling."""
        names = " ".join(f"x{j} y{j}" for j in range(1, self.count + 1))
        return _system(self._field, names, self, "b1 b2 b3 b4 w shift coupling")

    @staticmethod
    def _field(x: Symbols, p: Symbols) -> Expressions:
        b1, b2, b3, b4, w, shift, coupling = p
        pairs = [(x[i], x[i + 1]) for i in range(0, len(x), 2)]
        padded = [pairs[0], *pairs, pairs[-1]]
        out: Expressions = []
        for before, (u, v), after in zip(padded, pairs, padded[2:], strict=False):
            R = u**2 + v**2
            own = _turn(b1 + R * (b2 + R * (b3 + R * b4)), w + shift * R, u, v)
            pull = [a - 2 * m + b for a, m, b in zip(before, (u, v), after, strict=True)]
            out += [f + coupling * d for f, d in zip(own, pull, strict=True)]
        return out

    def _q(self, R: float, order: int) -> float:
        return float(np.polynomial.Polynomial([self.b1, self.b2, self.b3, self.b4]).deriv(order)(R))

    def squared_radii(self) -> tuple[float, ...]:
        """R of every cycle, increasing; a double zero appears twice or not at all."""
        R = _real_roots(self.b1, self.b2, self.b3, self.b4)
        return tuple(R[R > 0].tolist())

    def rate(self, R: float) -> float:
        """dphi/dt = w + shift R."""
        return self.w + self.shift * R

    def cycle(self, R: float) -> ExactCycle:
        """The cycle of squared radius R, a zero of q."""
        k = np.arange(1, self.count)
        chain = -4 * self.coupling * np.sin(np.pi * k / (2 * self.count)) ** 2
        radial = 2 * R * self._q(R, 1)
        return ExactCycle(
            self.system,
            2 * np.pi / self.rate(R),
            lambda s: R**0.5 * np.tile(_circle(s), self.count),
            (radial, *(radial + chain), *chain),
            (-1,) * 2 * self.count,
        )

    @property
    def flc(self) -> float:
        """First Lyapunov coefficient of the Hopf point b1 = 0."""
        return 2 * self.b2 / self.count

    @property
    def slc(self) -> float:
        """Second Lyapunov coefficient of the generalized Hopf point b1 = b2 = 0."""
        return 4 * self.b3 / self.count**2

    def at_fold(self, R: float) -> Oscillators:
        """The same with b1, b2 such that the cycle of squared radius R is an LPC."""
        b1 = self.b3 * R**2 + 2 * self.b4 * R**3
        return dataclasses.replace(self, b1=b1, b2=-2 * self.b3 * R - 3 * self.b4 * R**2)

    def lpc_coefficient(self, R: float) -> float:
        """b [1/s] of the LPC of squared radius R."""
        return -R * self._q(R, 2) * self.rate(R) / self.shift

    @property
    def cusp(self) -> float:
        """R of the cusp of cycles; the parameters are ``at_fold`` of it."""
        return -self.b3 / (3 * self.b4)

    def cusp_coefficient(self) -> float:
        """c [1/s] of dxi/dt = c xi^3 at the cusp of cycles, dtau/dt = 1 - xi."""
        return 2 * self.b4 * self.cusp * (self.rate(self.cusp) / self.shift) ** 2


def hopf(mu: float = 0.2, count: int = 1) -> Oscillators:
    """r' = mu r - r^3: cycle R = mu of exponent -2 mu."""
    return Oscillators(b1=mu, b2=-1.0, b3=0.0, count=count)


def bautin(b1: float = -0.04, b2: float = 0.5, count: int = 1) -> Oscillators:
    """r' = b1 r + b2 r^3 - r^5: GH at 0, LPC where b2^2 + 4 b1 = 0, b2 > 0, with R = b2/2."""
    return Oscillators(b1=b1, b2=b2, count=count)


def cusp_of_cycles(count: int = 1) -> Oscillators:
    """r' = r (b1 + b2 R + 3 R^2 - R^3) at its CPC: R = 1, b1 = 1, b2 = -3."""
    return Oscillators(b3=3.0, b4=-1.0, count=count).at_fold(1.0)


# --- period doubling and symmetry breaking in R^3 ------------------------------------------------


@dataclass(frozen=True)
class TwistedBand:
    """A cycle r = 1 in R^3 whose normal plane turns by ``half_twists`` half turns along it.

    With cylindrical (r, phi, z), (r - 1, z) = xi e + eta e', e = (cos, sin)(h phi/2), e' normal
    to it, h = half_twists:

        xi' = mu xi + c xi^3,  eta' = -k eta,  phi' = omega (1 + a xi^2).

    In the fixed frame, with P = e e^T = [[1 + C, S], [S, 1 - C]]/2,
    C, S = cos, sin(h phi), xi^2 = (r-1, z) P (r-1, z)^T,

        (r-1, z)' = (mu + k + c xi^2) P (r-1, z) - k (r-1, z) + (h/2) phi' (-z, r-1).

    One turn maps xi to (-1)^h e^{mu T} xi, T = 2 pi/omega.

    h = 1 (Moebius band): multipliers -e^{mu T}, -e^{-k T}; PD at mu = 0; the doubled cycle is
    xi^2 = -mu/c with period 4 pi/rate, rate = omega (1 - a mu/c), exponents -2 mu, -k.
    h = 2: symmetric under S = diag(-1, -1, 1), with eigenvalues -e^{mu T/2}, -e^{-k T/2} of
    S Phi(T/2): symmetry breaking (BPC) at mu = 0; the two broken cycles xi = +-sqrt(-mu/c).
    The mode v = e is a unit vector, so the coefficient is c/T.
    """

    half_twists: int = 1
    mu: float = 0.0
    c: float = -0.8
    k: float = 0.6
    omega: float = 2.0
    a: float = 0.3

    @cached_property
    def system(self) -> System:
        """State x, y, z; parameters mu, c, k, omega, a."""
        return _system(self._field, "x y z", self, "mu c k omega a")

    def _field(self, x: Symbols, p: Symbols) -> Expressions:
        (u, v, z), (mu, c, k, omega, a) = x, p
        r = sp.sqrt(u**2 + v**2)
        cos, sin = u / r, v / r
        C, S = {1: (cos, sin), 2: (cos**2 - sin**2, 2 * cos * sin)}[self.half_twists]
        P = sp.Matrix([[1 + C, S], [S, 1 - C]]) / 2
        normal = sp.Matrix([r - 1, z])
        along = P * normal
        xi2 = normal.dot(along)
        rate = omega * (1 + a * xi2)
        turn = sp.Rational(self.half_twists, 2) * rate * sp.Matrix([-z, r - 1])
        dr, dz = (mu + k + c * xi2) * along - k * normal + turn
        return [dr * cos - v * rate, dr * sin + u * rate, dz]

    def cycle(self) -> ExactCycle:
        """The cycle xi = eta = 0."""
        period = 2 * np.pi / self.omega
        twist = 0.5j * self.half_twists * self.omega
        signs = (-1, -1, 1) if self.half_twists == 2 else ()
        mode = CriticalMode(self._band, self.c, self.a)
        exponents = (self.mu + twist, -self.k + twist)
        return ExactCycle(self.system, period, self._curve(0.0, 1), exponents, signs, mode)

    def bifurcated(self, sign: int = 1) -> ExactCycle:
        """The doubled cycle (h = 1) or one of the two broken ones (h = 2); needs mu/c < 0."""
        xi2, turns = -self.mu / self.c, 2 if self.half_twists == 1 else 1
        period = 2 * np.pi * turns / (self.omega * (1 + self.a * xi2))
        curve = self._curve(sign * xi2**0.5, turns)
        return ExactCycle(self.system, period, curve, (-2 * self.mu, -self.k))

    def _band(self, s: Array) -> Array:
        """e as a vector of R^3: cos(h phi/2) radially, sin(h phi/2) along z."""
        radial, along = _circle(s, self.half_twists / 2).T
        return np.column_stack([radial[:, None] * _circle(s), along])

    def _curve(self, xi: float, turns: int) -> Callable[[Array], Array]:
        def state(s: Array) -> Array:
            phase = turns * np.asarray(s)
            return np.column_stack([_circle(phase), 0 * phase]) + xi * self._band(phase)

        return state


# --- torus bifurcation in R^4 --------------------------------------------------------------------


@dataclass(frozen=True)
class TorusBirth:
    """A cycle r = 1 in the plane z with a second plane zeta = u + i v, odd:

        r' = k r (1 - r^2)/2,  phi' = omega (1 + a |zeta|^2),
        zeta' = (mu + i theta + (c + i e) |zeta|^2) zeta.

    Exponents -k and mu +- i theta; T = 2 pi/omega. NS at mu = 0; N has -e^{(mu +- i theta) T/2}.
    The torus |zeta|^2 = -mu/c is a product of circles of frequencies omega (1 - a mu/c) and
    theta - e mu/c. The mode is v = (0, 0, 1, -i)/2 with xi = zeta, so that <v, v> = 1/2 and the
    coefficient is 2 (c + i e)/T. Its imaginary part belongs to theta T in (0, pi), not to
    theta T + 2 pi: xi e^{i m omega tau} has c + i m omega a in place of c.
    """

    mu: float = 0.0
    theta: float = 0.7
    c: float = -0.5
    e: float = 0.25
    k: float = 0.6
    omega: float = 2.0
    a: float = 0.3

    @cached_property
    def system(self) -> System:
        """State x, y, u, v; parameters mu, theta, c, e, k, omega, a."""
        return _system(self._field, "x y u v", self, "mu theta c e k omega a")

    @staticmethod
    def _field(x: Symbols, p: Symbols) -> Expressions:
        (x1, x2, u, v), (mu, theta, c, e, k, omega, a) = x, p
        R, size = x1**2 + x2**2, u**2 + v**2
        first = _turn(k * (1 - R) / 2, omega * (1 + a * size), x1, x2)
        return first + _turn(mu + c * size, theta + e * size, u, v)

    def cycle(self) -> ExactCycle:
        """The cycle zeta = 0."""
        pair = complex(self.mu, self.theta + self.omega)
        vector = _constant(0, 0, 0.5, -0.5j)
        mode = CriticalMode(vector, complex(self.c, self.e), self.a, self.theta)
        exponents = (-self.k, pair, pair.conjugate())
        return ExactCycle(
            self.system, 2 * np.pi / self.omega, _plane(0), exponents, (-1,) * 4, mode
        )

    def torus(self, t: Array) -> Array:
        """The solution on the torus from x = 1, zeta > 0; shape (points, 4); needs mu/c < 0."""
        size = -self.mu / self.c
        first = _circle(t, self.omega * (1 + self.a * size) / (2 * np.pi))
        second = _circle(t, (self.theta + self.e * size) / (2 * np.pi))
        return np.hstack([first, size**0.5 * second])


def _plane(first: int, r: float = 1.0, n: int = 4) -> Callable[[Array], Array]:
    """A circle of radius r in the plane of coordinates first, first + 1."""

    def state(s: Array) -> Array:
        out = np.zeros((np.size(s), n))
        out[:, first : first + 2] = r * _circle(s)
        return out

    return state


def _constant(*v: complex) -> Callable[[Array], NDArray[Any]]:
    return lambda s: np.tile(np.array(v), (np.size(s), 1))


# --- symmetry breaking of an odd field in R^4 ----------------------------------------------------


@dataclass(frozen=True)
class OddPitchfork:
    """A cycle r = 1 with a second plane zeta = (xi + i eta) e^{i m phi}, m = winding, odd:

        r' = k r (1 - r^2)/2,  phi' = omega (1 + a xi^2),
        xi' = mu xi + c xi^3,  eta' = -kappa eta.

    With E = e^{2 i m phi} = z^{2m}/R^m: xi e^{i m phi} = (zeta + conj(zeta) E)/2 and
    xi^2 = (|zeta|^2 + Re(zeta^2 conj(E)))/2. On half a period, zeta of a mode gets (-1)^m, so
    N = -Phi(T/2) has the eigenvalues -(-1)^m e^{mu T/2}, -(-1)^m e^{-kappa T/2}, e^{-k T/2}.

    m even: symmetry breaking (BPC) at mu = 0. m odd: a branch point inside the symmetric family,
    eigenvalue +1 of N that is no fold. The new cycles zeta = +-sqrt(-mu/c) e^{i m phi} have rate
    omega (1 - a mu/c) and exponents -2 mu, -kappa, -k; they are symmetric for odd m only.
    The mode v = e^{i m phi} is a unit vector, so the coefficient is c/T; it is given for even m,
    where parity tells v from f.
    """

    winding: int = 2
    mu: float = 0.0
    c: float = -0.8
    kappa: float = 0.5
    k: float = 0.6
    omega: float = 2.0
    a: float = 0.3

    @cached_property
    def system(self) -> System:
        """State x, y, u, v; parameters mu, c, kappa, k, omega, a."""
        return _system(self._field, "x y u v", self, "mu c kappa k omega a")

    def _field(self, x: Symbols, p: Symbols) -> Expressions:
        (x1, x2, u, v), (mu, c, kappa, k, omega, a) = x, p
        R, m = x1**2 + x2**2, self.winding
        Ex, Ey = (part / R**m for part in ((x1 + sp.I * x2) ** (2 * m)).as_real_imag())
        mirrored = (u * Ex + v * Ey, u * Ey - v * Ex)  # conj(zeta) E
        xi2 = (u**2 + v**2 + u * mirrored[0] + v * mirrored[1]) / 2
        rate = omega * (1 + a * xi2)
        first = _turn(k * (1 - R) / 2, rate, x1, x2)
        second = _turn((mu + c * xi2 - kappa) / 2, m * rate, u, v)
        return first + [
            s + (mu + c * xi2 + kappa) * w / 2 for s, w in zip(second, mirrored, strict=True)
        ]

    def cycle(self) -> ExactCycle:
        """The symmetric cycle zeta = 0."""
        turn = 1j * self.omega * (self.winding + 1)
        exponents = (-self.k, self.mu + turn, -self.kappa + turn)
        band = CriticalMode(lambda s: self._broken(s, 1.0) - _plane(0)(s), self.c, self.a)
        mode = None if self.winding % 2 else band
        return ExactCycle(
            self.system, 2 * np.pi / self.omega, _plane(0), exponents, (-1,) * 4, mode
        )

    def bifurcated(self, sign: int = 1) -> ExactCycle:
        """One of the two new cycles; needs mu/c < 0."""
        xi2 = -self.mu / self.c
        return ExactCycle(
            self.system,
            2 * np.pi / (self.omega * (1 + self.a * xi2)),
            lambda s: self._broken(s, sign * xi2**0.5),
            (-2 * self.mu, -self.kappa, -self.k),
            (-1,) * 4 if self.winding % 2 else (),
        )

    def _broken(self, s: Array, xi: float) -> Array:
        return np.hstack([_circle(s), xi * _circle(s, self.winding)])


# --- equilibria, and the cycles born there -------------------------------------------------------


@dataclass(frozen=True)
class StaticForm:
    """x' = p1 + p2 x + a x^2 + (c - coupling) x^3 + coupling x y,  y' = -y + x^2.

    Equilibria: y = x^2, p1 + p2 x + a x^2 + c x^3 = 0; the Jacobian's determinant is minus the
    derivative of that polynomial. With A q = 0, q = (1, 0), the fold coefficient <p, B(q,q)>/2 at
    the origin is a, and where a = 0 the cubic one <p, C(q,q,q) + 3 B(q, (0, 2))>/6 is c.

    fold: a != 0, p2 = c = 0, at p1 = 0, x = +-sqrt(-p1/a). transcritical: p1 = c = 0, a != 0, x = 0
    and -p2/a exchange stability at p2 = 0. pitchfork: p1 = a = 0, x = 0 and x^2 = -p2/c.
    cusp: a = 0, folds on p1 = 2 c x^3, p2 = -3 c x^2, that is 27 c p1^2 + 4 p2^3 = 0.
    """

    p1: float = 0.0
    p2: float = 0.0
    a: float = 0.0
    c: float = 0.0
    coupling: float = 0.5

    @cached_property
    def system(self) -> System:
        """State x, y; parameters p1, p2, a, c, coupling."""
        return _system(self._field, "x y", self, "p1 p2 a c coupling")

    @staticmethod
    def _field(x: Symbols, p: Symbols) -> Expressions:
        (u, y), (p1, p2, a, c, coupling) = x, p
        cubic = (c - coupling) * u**3 + coupling * u * y
        return [p1 + p2 * u + a * u**2 + cubic, -y + u**2]

    def equilibria(self) -> Array:
        """Every equilibrium, increasing in x, shape (count, 2)."""
        x = _real_roots(self.p1, self.p2, self.a, self.c)
        return np.column_stack([x, x**2])

    def at_fold(self, x: float) -> StaticForm:
        """The same with p1, p2 such that the equilibrium at x is a fold."""
        p2 = -2 * self.a * x - 3 * self.c * x**2
        return dataclasses.replace(self, p1=self.a * x**2 + 2 * self.c * x**3, p2=p2)


def fold(p1: float = -0.1) -> StaticForm:
    """Equilibria x^2 = -p1; fold at p1 = 0 with coefficient 1."""
    return StaticForm(p1=p1, a=1.0)


def transcritical(p2: float = -0.1) -> StaticForm:
    """Equilibria x = 0 and x = p2."""
    return StaticForm(p2=p2, a=-1.0)


def pitchfork(p2: float = 0.1) -> StaticForm:
    """Equilibria x = 0 and x^2 = p2; supercritical, coefficient -1."""
    return StaticForm(p2=p2, c=-1.0)


def cusp(p1: float = 0.0, p2: float = 0.1) -> StaticForm:
    """p1 + p2 x - x^3 = 0: folds on 27 p1^2 = 4 p2^3, cusp coefficient -1."""
    return StaticForm(p1=p1, p2=p2, c=-1.0)


@dataclass(frozen=True)
class BogdanovTakens:
    """x' = y, y' = b1 + b2 x + x^2 + s x y: BT at b1 = b2 = 0, coefficients a = 1, b = s.

    Kuznetsov, Elements of Applied Bifurcation Theory, Sec. 8.4. Folds: b1 = b2^2/4 at x = -b2/2.
    Hopf: x = 0, that is b1 = 0, for b2 < 0 with w^2 = -b2. There u = x, v = -y/w turn as
    u' = -w v, v' = w u - u^2/w + s u v, and the planar formula gives r' = s/(8 w^2) r^3 in x's
    amplitude; |q|_2 = 1 has |q_x|^2 = 1/(1 + w^2), so FLC = s/(2 w^2 (1 + w^2)).
    """

    b1: float = 0.0
    b2: float = -0.5
    s: float = -1.0

    @cached_property
    def system(self) -> System:
        """State x, y; parameters b1, b2, s."""
        return _system(self._field, "x y", self, "b1 b2 s")

    @staticmethod
    def _field(x: Symbols, p: Symbols) -> Expressions:
        (u, y), (b1, b2, s) = x, p
        return [y, b1 + b2 * u + u**2 + s * u * y]

    def equilibria(self) -> Array:
        """The saddle last, the other one first; shape (2, 2) or empty."""
        root = np.emath.sqrt(self.b2**2 - 4 * self.b1)
        if np.iscomplex(root):
            return np.empty((0, 2))
        return np.array([[(-self.b2 - root) / 2, 0.0], [(-self.b2 + root) / 2, 0.0]])

    @property
    def frequency(self) -> float:
        """w of the Hopf point b1 = 0, b2 < 0."""
        return (-self.b2) ** 0.5

    @property
    def flc(self) -> float:
        """First Lyapunov coefficient of the Hopf point b1 = 0, b2 < 0."""
        w2 = -self.b2
        return self.s / (2 * w2 * (1 + w2))


@dataclass(frozen=True)
class ZeroHopf:
    """x' = b1 + x^2 + s R,  z' = (b2 + i w + theta x + x^2) z,  R = |z|^2; state (z, x).

    Kuznetsov, Sec. 8.5. Equilibria z = 0, x^2 = -b1: fold at b1 = 0, Hopf (frequency w) where
    b2 = -theta x - x^2. Cycles: theta x0 + x0^2 = -b2, R = -s (b1 + x0^2), T = 2 pi/w, exponents
    x0 +- sqrt(x0^2 + 2 s R (theta + 2 x0)).

    NS on b2 = 0 (x0 = 0) if s theta < 0 and s b1 < 0: exponents +-i W, W^2 = -2 s theta R. There
    X = x and Y = -2 s r (|z| - r)/W turn as X' = -W Y + X^2 - theta Y^2/2,
    Y' = W X + (W/theta) X^2 + theta X Y + X^2 Y; with Z = X + i Y, Z' = i W Z + c1 Z |Z|^2 + ...,
    c1 = 1/8 + i (h (h + theta) - 7/3 |h|^2)/(2 W), h = (2 - theta)/4 + i W/(2 theta), so
    Re c1 = -1/(4 theta). With xi = Z/2 the mode is v = (i W/(2 s r) (cos, sin)(phi), 1)
    and c = 4 c1; dphi/dt does not vary, so a = 0.
    """

    b1: float = -0.04
    b2: float = 0.0
    s: float = 1.0
    theta: float = -1.0
    w: float = 2.0

    @cached_property
    def system(self) -> System:
        """State y1, y2, x with z = y1 + i y2; parameters b1, b2, s, theta, w."""
        return _system(self._field, "y1 y2 x", self, "b1 b2 s theta w")

    @staticmethod
    def _field(x: Symbols, p: Symbols) -> Expressions:
        (y1, y2, u), (b1, b2, s, theta, w) = x, p
        grow = b2 + theta * u + u**2
        return [*_turn(grow, w, y1, y2), b1 + u**2 + s * (y1**2 + y2**2)]

    def equilibria(self) -> Array:
        """x = -+sqrt(-b1), shape (2, 3); needs b1 < 0."""
        x = (-self.b1) ** 0.5
        return np.array([[0.0, 0.0, -x], [0.0, 0.0, x]])

    def at_hopf(self, x: float) -> ZeroHopf:
        """The same with b1, b2 such that the equilibrium at x is a Hopf point."""
        return dataclasses.replace(self, b1=-(x**2), b2=-self.theta * x - x**2)

    def cycle(self) -> ExactCycle:
        """The cycle; it carries its critical mode on the NS curve b2 = 0."""
        root = np.copysign((self.theta**2 - 4 * self.b2) ** 0.5, self.theta)
        x0 = -2 * self.b2 / (self.theta + root)
        R = -self.s * (self.b1 + x0**2)
        spread = np.emath.sqrt(x0**2 + 2 * self.s * R * (self.theta + 2 * x0))
        return ExactCycle(
            self.system,
            2 * np.pi / self.w,
            lambda s: _constant(0, 0, x0)(s) + _plane(0, R**0.5, 3)(s),
            (x0 + spread, x0 - spread),
            (-1, -1, 1),
            self._mode(R) if self.b2 == 0 else None,
        )

    def _mode(self, R: float) -> CriticalMode:
        W = (-2 * self.s * self.theta * R) ** 0.5
        h = complex((2 - self.theta) / 4, W / (2 * self.theta))
        c1 = 1 / 8 + 0.5j / W * (h * (h + self.theta) - 7 / 3 * abs(h) ** 2)
        radial = 0.5j * W / (self.s * R**0.5)
        return CriticalMode(
            lambda s: _constant(0, 0, 1)(s) + radial * _plane(0, 1.0, 3)(s), 4 * c1, 0.0, W
        )


@dataclass(frozen=True)
class HopfHopf:
    """z_j' = (b_j + i w_j + p_j1 R_1 + p_j2 R_2) z_j, j = 1, 2, odd; Kuznetsov, Sec. 8.6.

    Hopf curves b1 = 0 and b2 = 0, FLC 2 p11 and 2 p22. Cycle 1: R_1 = -b1/p11, T = 2 pi/w1,
    exponents -2 b1 and b2 + p21 R_1 +- i w2; cycle 2 with the indices exchanged. NS of cycle 1 on
    b2 = (p21/p11) b1: near it R_1 follows R_2 as R_1 = -(b1 + p12 R_2)/p11, so that
    z_2' = i w2 z_2 + (p22 - p21 p12/p11) R_2 z_2: with v = (0, 0, 1, -i)/2, c is the bracket.
    """

    b1: float = 0.1
    b2: float = 0.05
    p11: float = -1.0
    p12: float = -0.6
    p21: float = -0.8
    p22: float = -1.5
    w1: float = 2.0
    w2: float = 0.7

    @cached_property
    def system(self) -> System:
        """State x1, y1, x2, y2; parameters b1, b2, p11, p12, p21, p22, w1, w2."""
        return _system(self._field, "x1 y1 x2 y2", self, "b1 b2 p11 p12 p21 p22 w1 w2")

    @staticmethod
    def _field(x: Symbols, p: Symbols) -> Expressions:
        (x1, y1, x2, y2), (b1, b2, p11, p12, p21, p22, w1, w2) = x, p
        R1, R2 = x1**2 + y1**2, x2**2 + y2**2
        first = _turn(b1 + p11 * R1 + p12 * R2, w1, x1, y1)
        return first + _turn(b2 + p21 * R1 + p22 * R2, w2, x2, y2)

    def at_torus_birth(self) -> HopfHopf:
        """The same with b2 on the NS curve of cycle 1."""
        return dataclasses.replace(self, b2=self.p21 / self.p11 * self.b1)

    def first_cycle(self) -> ExactCycle:
        """Cycle 1; its critical mode is meant on the NS curve."""
        R = -self.b1 / self.p11
        pair = complex(self.b2 + self.p21 * R, self.w1 + self.w2)
        c = self.p22 - self.p21 * self.p12 / self.p11
        return ExactCycle(
            self.system,
            2 * np.pi / self.w1,
            _plane(0, R**0.5),
            (-2 * self.b1, pair, pair.conjugate()),
            (-1,) * 4,
            CriticalMode(_constant(0, 0, 0.5, -0.5j), c, 0.0, self.w2),
        )

    def second_cycle(self) -> ExactCycle:
        """Cycle 2."""
        R = -self.b2 / self.p22
        pair = complex(self.b1 + self.p12 * R, self.w1 + self.w2)
        exponents = (-2 * self.b2, pair, pair.conjugate())
        return ExactCycle(self.system, 2 * np.pi / self.w2, _plane(2, R**0.5), exponents, (-1,) * 4)


# --- systems without a closed form, and what is known to many digits ------------------------------


def van_der_pol(mu: float = 1.0, count: int = 1, coupling: float = 0.1) -> System:
    """x_j' = y_j, y_j' = mu (1 - x_j^2) y_j - x_j, plus coupling to the neighbours; n = 2 count.

    Odd. All in phase is the single oscillator's cycle, whatever the coupling.
    """

    def f(x: Symbols, p: Symbols) -> Expressions:
        (m, d), n = p, len(x)
        pull = [x[max(i - 2, i % 2)] - 2 * x[i] + x[min(i + 2, n - 2 + i % 2)] for i in range(n)]
        own = [
            part
            for q, v in zip(x[::2], x[1::2], strict=True)
            for part in (v, m * (1 - q**2) * v - q)
        ]
        return [a + d * b for a, b in zip(own, pull, strict=True)] if n > 2 else own

    names = [f"{letter}{j}" for j in range(1, count + 1) for letter in "xy"]
    return System.from_function(f, names, {"mu": mu, "coupling": coupling})


#: mu: (period, y where x = 0 and grows, logarithm of the nontrivial multiplier = int mu (1 - x^2)).
#: Taylor series of order 36 in 32 digits.
VAN_DER_POL = {
    1.0: (6.663286859323130, 2.172713692622547, -7.058932808798959),
    10.0: (19.07836956693901, 7.552812306161863, -311.8442192862280),
    50.0: (82.50833389323078, 33.91221391834489, -7296.823864992526),
}


def lorenz(r: float = 28.0, sigma: float = 10.0, b: float = 8 / 3) -> System:
    """x' = sigma (y - x), y' = r x - y - x z, z' = x y - b z; symmetric under diag(-1, -1, 1)."""

    def f(x: Symbols, p: Symbols) -> Expressions:
        (u, v, z), (s, rho, beta) = x, p
        return [s * (v - u), rho * u - v - u * z, u * v - beta * z]

    return System.from_function(f, ("x", "y", "z"), {"sigma": sigma, "r": r, "b": b})


def lorenz_hopf(sigma: float = 10.0, b: float = 8 / 3) -> tuple[float, float]:
    """(r, w) of the subcritical Hopf points at x = y = +-sqrt(b (r - 1)), z = r - 1.

    r = sigma (sigma + b + 3)/(sigma - b - 1), w^2 = 2 sigma (sigma + 1) b/(sigma - b - 1).
    """
    r = sigma * (sigma + b + 3) / (sigma - b - 1)
    return r, (2 * sigma * (sigma + 1) * b / (sigma - b - 1)) ** 0.5


@dataclass(frozen=True)
class KnownCycle:
    """A cycle known to many digits: a state on it, its period, parameter and what is critical.

    half: a nontrivial eigenvalue of S Phi(T/2) where there is the symmetry; multiplier: of Phi(T).
    """

    parameter: float
    period: float
    state: tuple[float, ...]
    half: float | None = None
    multiplier: float | None = None
    coefficient: float | None = None


#: The symmetric cycle AB at r = 28; Viswanath, Nonlinearity 16 (2003).
LORENZ_AB = KnownCycle(28.0, 1.5586522107161747, (-13.763610682134201, -19.578751942451795, 27.0))

#: Symmetry breaking of the cycle that is stable above it; by shooting on half the period.
LORENZ_BPC = KnownCycle(
    312.973532984175,
    0.41116605612125734,
    (-5.681556282336769, 39.33498309944635, 276.3631889337532),
    half=-1.0,
)


def adaptive_control(alpha: float = 0.8, beta: float = 1.0) -> System:
    """x' = y, y' = z, z' = -alpha z - beta y - x + x^2: the tutorial example of MATCONT.

    Hopf at the origin for alpha beta = 1, w^2 = beta. At beta = 1, harmonic balance of
    x = A e^{it} + conj + 2 |A|^2 - A^2 e^{2it}/(3 + 6i) + ... gives
    A' = A |A|^2 (4 - 2/(3 + 6i))/(-2 + 2i), real part -9/10; |q|_2 = 1 has |q_x|^2 = 1/3, so
    FLC = -3/10.
    """

    def f(x: Symbols, p: Symbols) -> Expressions:
        (u, v, z), (a, b) = x, p
        return [v, z, -a * z - b * v - u + u**2]

    return System.from_function(f, ("x", "y", "z"), {"alpha": alpha, "beta": beta})


ADAPTIVE_CONTROL_FLC = -0.3

#: alpha and T as MATCONT and AUTO-07p give them; the state by shooting.
ADAPTIVE_CONTROL_PD = KnownCycle(
    0.63030200616,
    6.36407133944,
    (-0.1143828774123, -0.4437120350635, 0.2299703709972),
    multiplier=-1.0,
    coefficient=-0.3051,
)
