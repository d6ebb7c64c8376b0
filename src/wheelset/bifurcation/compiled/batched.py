"""Kernels as they are called from hot loops: arrays in, arrays written, outcomes raised.

``kernel(X, p, *arrays)`` reads and writes the arrays of its arguments in place; they are
C-contiguous, of doubles, and belong to the caller. Nothing else is done a call: no copies, no
checks but whether all went well.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NoReturn, Protocol

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.compiled.kernels import Kernel
from wheelset.bifurcation.fields import arrays, domain, regions
from wheelset.bifurcation.fields.field import VectorField
from wheelset.bifurcation.fields.tape import Tape

Array = NDArray[np.float64]
#: Coefficients of the sampled functions up to an order at points (points, n).
Sample = Callable[[Array, int], Array]


class MeshKernel(Protocol):
    """A kernel over the points of a mesh.

    Raises DomainLeft or NotFinite for the first point that has no value, whereupon the arrays
    hold nothing of use; ValueError where the shapes do not fit.
    """

    def __call__(self, *given: Array) -> None:
        """Read and write the arrays of the kernel's arguments."""
        ...


def mesh_kernel(kernel: Kernel, field: VectorField, tape: Tape, sample: Sample) -> MeshKernel:
    """The kernel of a field, as its switch and its sampled functions want it called."""
    kind = SampledKernel if tape.sampled else SmoothKernel
    smooth = kind(kernel, tape, sample, field.state_names)
    return PiecewiseKernel(smooth, field) if field.switch else smooth


@dataclass(frozen=True)
class SmoothKernel:
    """A kernel of a field without switch and without sampled functions."""

    kernel: Kernel
    tape: Tape
    sample: Sample
    names: tuple[str, ...]

    def __call__(self, *given: Array) -> None:
        """Run the machine code."""
        answer = self.kernel.run(*given)
        if answer:
            self._explain(answer, given)

    def _explain(self, answer: int, given: tuple[Array, ...]) -> NoReturn:
        """Say what was met: arrays that do not fit, a condition violated, an overflow."""
        if answer < 0:
            raise ValueError(self.kernel.complaint(given))
        x, p = given[0][answer - 1], given[1]
        sampled = dict(enumerate(self.sample(x[np.newaxis], 0)[0, :, 0]))
        slots = arrays.evaluate(self.tape, [*x, *p], sampled)
        domain.check_orders(self.tape, slots, self.kernel.smoothness, x, self.names)
        bad = ~np.isfinite(np.array(slots, dtype=np.float64))
        raise domain.not_finite(self.tape, bad, x, self.names)


class SampledKernel(SmoothKernel):
    """A kernel of a field with sampled functions."""

    def __call__(self, *given: Array) -> None:
        """Expand the functions at the states and run the machine code."""
        answer = self.kernel.run(*given, self.sample(given[0], self.kernel.order))
        if answer:
            self._explain(answer, given)


@dataclass(frozen=True)
class PiecewiseKernel:
    """A kernel of a field with a switch: every region's points by themselves."""

    smooth: SmoothKernel
    field: VectorField

    def __call__(self, *given: Array) -> None:
        """Run the smooth kernel region by region."""
        X, p, *rest = given
        for p_region, chosen in regions.split(self.field, X, p):
            self._run(p_region, chosen, (X, *rest))

    def _run(self, p: Array, chosen: Array, given: tuple[Array, ...]) -> None:
        first, _, *rest = self.smooth.kernel.arguments
        known = list(zip((first, *rest), given, strict=False))
        parts = [a[chosen] if argument.each else a for argument, a in known]
        self.smooth(parts[0], p, *parts[1:])
        for (argument, a), part in zip(known, parts, strict=True):
            if argument.written:
                a[chosen] = part
