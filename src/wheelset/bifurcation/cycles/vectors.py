"""Rows of doubles as machine vectors, for use inside compiled functions.

A vector holds a number of doubles that the compiler knows: len(signs) * len(blocks) of two tuples.
It is kept in registers of at most ``WIDEST`` doubles, so no loop over it is left, and loads and
stores are whole. (Plain loops over rows of arrays stay scalar: numba's arrays may overlap for all
the compiler knows.) Products are fused and sums taken in any order.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.core.datamodel import models
from numba.core.errors import TypingError
from numba.extending import intrinsic as typed_intrinsic
from numba.extending import register_model

#: Doubles in the widest register used: wider ones were not faster.
WIDEST = 4

FLAGS = ("contract", "nsz", "reassoc")
_OPTIONS: dict[str, Any] = {
    "cache": True, "error_model": "numpy", "fastmath": set(FLAGS), "no_cfunc_wrapper": True
}  # fmt: skip

_INNER: dict[str, Any] = {"no_cpython_wrapper": True, "forceinline": True}

#: Compiles a function that Python calls, and one that only compiled functions call.
entry: Any = njit(**_OPTIONS)
part: Any = njit(**_OPTIONS, **_INNER)

DOUBLE, INTEGER, LANE = ir.DoubleType(), ir.IntType(64), ir.IntType(32)

intrinsic: Any = typed_intrinsic  # its declared type keeps the typing context as an argument


class Vector(types.Type):
    """The type of a vector of ``count`` doubles."""

    def __init__(self, count: int) -> None:
        self.count = count
        super().__init__(f"Vector({count})")

    @property
    def registers(self) -> list[Any]:
        """The machine's types that hold it: full registers, then powers of two."""
        full, rest = divmod(self.count, WIDEST)
        sizes = [WIDEST] * full + [bit for bit in (16, 8, 4, 2, 1) if bit < WIDEST and rest & bit]
        return [ir.VectorType(DOUBLE, size) for size in sizes]


@register_model(Vector)
class VectorModel(models.PrimitiveModel):
    """A vector is a structure of registers."""

    def __init__(self, manager: Any, kind: Vector) -> None:
        super().__init__(manager, kind, ir.LiteralStructType(kind.registers))


@intrinsic
def zeros(typing: Any, signs: Any, blocks: Any) -> Any:
    """A vector of zeros, one for every pair of entries of two tuples."""
    kind = Vector(len(signs) * len(blocks))

    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        return ir.Constant(context.get_value_type(kind), None)

    return kind(signs, blocks), build


@intrinsic
def load(typing: Any, like: Any, array: Any, index: Any) -> Any:
    """The doubles of a contiguous array from an index on, as many as ``like`` has."""
    _contiguous(array)

    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        places = _places(context, builder, signature.args[1:], values[1:], like)
        return _joined(builder, [builder.load(place, align=8) for place in places])

    return like(like, array, index), build


@intrinsic
def store(typing: Any, array: Any, index: Any, vector: Any) -> Any:
    """Write a vector to a contiguous array from an index on."""
    _contiguous(array)

    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        places = _places(context, builder, signature.args, values, vector)
        for place, register in zip(places, _parted(builder, values[2]), strict=True):
            builder.store(register, place, align=8)
        return context.get_dummy_value()

    return types.none(array, index, vector), build


@intrinsic
def plus(typing: Any, vector: Any, factor: Any, other: Any) -> Any:
    """vector + factor other."""

    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        pairs = zip(_parted(builder, values[0]), _scaled(builder, *values[1:]), strict=True)
        return _joined(builder, [builder.fadd(a, b, flags=FLAGS) for a, b in pairs])

    return vector(vector, types.float64, vector), build


@intrinsic
def times(typing: Any, factor: Any, vector: Any) -> Any:
    """Factor times vector."""

    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        return _joined(builder, _scaled(builder, *values))

    return vector(types.float64, vector), build


@intrinsic
def dot(typing: Any, vector: Any, other: Any) -> Any:
    """The inner product of two vectors."""

    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        sums: dict[int, Any] = {}
        for a, b in zip(*(_parted(builder, value) for value in values), strict=True):
            product, size = builder.fmul(a, b, flags=FLAGS), a.type.count
            old = sums.get(size)
            sums[size] = product if old is None else builder.fadd(old, product, flags=FLAGS)
        total = DOUBLE(-0.0)
        for register in sums.values():
            total = _sum(builder, total, register)
        return total

    return types.float64(vector, vector), build


def _contiguous(array: Any) -> None:
    if not (isinstance(array, types.Array) and array.layout == "C"):
        raise TypingError(f"vectors are loaded from and stored to contiguous arrays, not {array}")


def _places(context: Any, builder: Any, kinds: Any, values: Any, vector: Vector) -> list[Any]:
    """Pointers to where each register of a vector belongs in an array."""
    array = context.make_array(kinds[0])(context, builder, values[0])
    index = cgutils.unpack_tuple(builder, values[1], len(kinds[1]))
    start = cgutils.get_item_pointer(context, builder, kinds[0], array, index)
    places = []
    for register in vector.registers:
        places.append(builder.bitcast(start, register.as_pointer()))
        start = builder.gep(start, [INTEGER(register.count)])
    return places


def _parted(builder: Any, value: Any) -> list[Any]:
    """The registers of a vector."""
    return [builder.extract_value(value, i) for i in range(len(value.type.elements))]


def _joined(builder: Any, registers: list[Any]) -> Any:
    """A vector from its registers."""
    kind = ir.LiteralStructType([register.type for register in registers])
    value = ir.Constant(kind, ir.Undefined)
    for i, register in enumerate(registers):
        value = builder.insert_value(value, register, i)
    return value


def _scaled(builder: Any, factor: Any, vector: Any) -> list[Any]:
    """Registers of factor times vector."""
    registers = _parted(builder, vector)
    spread = {r.type.count: _spread(builder, factor, r.type) for r in registers}
    return [builder.fmul(spread[r.type.count], r, flags=FLAGS) for r in registers]


def _spread(builder: Any, factor: Any, kind: Any) -> Any:
    """A register with a factor in every place."""
    undefined = ir.Constant(kind, ir.Undefined)
    first = builder.insert_element(undefined, factor, LANE(0))
    mask = ir.Constant(ir.VectorType(LANE, kind.count), [0] * kind.count)
    return builder.shuffle_vector(first, undefined, mask)


def _sum(builder: Any, total: Any, register: Any) -> Any:
    """Total plus the doubles of a register."""
    name = f"llvm.vector.reduce.fadd.v{register.type.count}f64"
    kind = ir.FunctionType(DOUBLE, [DOUBLE, register.type])
    known = builder.module.globals.get(name) or ir.Function(builder.module, kind, name)
    return builder.call(known, [total, register], fastmath=FLAGS)
