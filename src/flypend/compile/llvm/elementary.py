"""Logarithm, sine, cosine and inverse root of all lanes at once, to 1.5 ulp on doubles.

The C library would take one lane at a time; it still does for unusual arguments and for floats. Root and division take
three times as long as the estimate of an inverse root and a series.
"""

from __future__ import annotations

import math
from fractions import Fraction

from llvmlite import ir

from flypend.compile.llvm.vector import I64, Code, Value

# π/2 in three parts, each rounded to what the ones before leave of it.
_HALF_PI = Fraction(math.pi) / 2 + Fraction(6.123233995736766e-17) - Fraction(1.4973849048591833e-33)
FAR = 1e5  # rad; up to here three parts of π/2 are enough
# 2 atanh(s) = s Σ 2/(2i+1) s^(2i): with |s| <= 3 - √8 the first term left out is 1e-17 of the first.
_LOGARITHM = tuple(2 / (2 * i + 1) for i in range(11))
# sin r = r Σ …, cos r = Σ … in r²: with |r| <= π/4 the first term left out is below 1e-17.
_SINE = tuple((-1) ** i / math.factorial(2 * i + 1) for i in range(8))
_COSINE = tuple((-1) ** i / math.factorial(2 * i) for i in range(9))
_ROOT_HALF = 0x3FE6A09E667F3BCD  # bits of √(1/2)
_EIGHT = ir.VectorType(ir.DoubleType(), 8)  # of which one instruction estimates the inverse root


def log(code: Code, x: Value) -> Value:
    """Natural logarithm."""
    if code.lanes.precision != "double":
        return code.library("log", x)
    usual = (x >= 2.0**-1022) & (x < float("inf"))
    return _elsewhere(code, "log", x, usual, log_of_normal(code, x))


def sine(code: Code, x: Value) -> Value:
    """Sine of `x`, rad."""
    return _turned(code, "sin", x)


def cosine(code: Code, x: Value) -> Value:
    """Cosine of `x`, rad."""
    return _turned(code, "cos", x)


def inverse_root(code: Code, x: Value) -> Value:
    """1/√x of lanes that have `estimates_roots`.

    With the estimate r and e = 1 − x r², below 2⁻¹², it is r (1 − e)^(−1/2); the first term left out is (35/128) e⁴.
    """
    r = _joined(code, [_estimate(code, part) for part in _eights(code, x)])
    e = _fma(code, -_exact(code, "fmul", x, r), r, code.value(1.0))
    refined = _fma(code, _exact(code, "fmul", r, e), _series(code, (1 / 2, 3 / 8, 5 / 16), e), r)
    return code.select(e.compare("==", e), refined, r)  # 1/√0 = ∞ and 1/√∞ = 0


def _estimate(code: Code, eight: ir.Value) -> ir.Value:
    bits = ir.IntType(8)
    kind = ir.FunctionType(_EIGHT, [_EIGHT, _EIGHT, bits])
    function = code.lanes.declared("llvm.x86.avx512.rsqrt14.pd.512", kind)
    return code.builder.call(function, [eight, ir.Constant(_EIGHT, ir.Undefined), ir.Constant(bits, 0xFF)])


def _eights(code: Code, x: Value) -> list[ir.Value]:
    """The lanes of `x` by eights."""
    firsts = range(0, code.lanes.width, _EIGHT.count)
    return [code.builder.shuffle_vector(x.raw, x.raw, _mask(range(i, i + _EIGHT.count))) for i in firsts]


def _joined(code: Code, parts: list[ir.Value]) -> Value:
    """One vector from `parts` of equal length."""
    while len(parts) > 1:
        mask = _mask(range(2 * parts[0].type.count))
        parts = [code.builder.shuffle_vector(a, b, mask) for a, b in zip(parts[::2], parts[1::2], strict=True)]
    return Value(code, parts[0])


def _mask(lanes: range) -> ir.Constant:
    return ir.Constant(ir.VectorType(ir.IntType(32), len(lanes)), list(lanes))


def log_of_normal(code: Code, x: Value) -> Value:
    """Natural logarithm of positive, finite, normal doubles.

    x = 2^k m with m in [√½, √2), and log m = 2 atanh(s) with s = (m − 1)/(m + 1).
    """
    builder, kind = code.builder, ir.VectorType(I64, code.lanes.width)
    bits = builder.bitcast(x.raw, kind)
    shift = _integers(kind, 52)
    k = builder.ashr(builder.sub(bits, _integers(kind, _ROOT_HALF)), shift)
    f = Value(code, builder.bitcast(builder.sub(bits, builder.shl(k, shift)), code.lanes.vector)) - 1.0
    s = f / (f + 2.0)
    z = s * s
    # 2s = f − s f, and adding the small parts first keeps the last bits of f.
    rest = s * (z * _series(code, _LOGARITHM[1:], z) - f)
    high = float.fromhex("0x1.62e42fep-1")  # log 2 to 28 bits: k times it is exact
    low = float(Fraction(math.log(2)) - Fraction(high)) + 2.3190468138462996e-17
    n = Value(code, builder.sitofp(k, code.lanes.vector))
    return _exact(code, "fadd", n * high, _exact(code, "fadd", f, rest + n * low))


def turned(code: Code, r: Value, quarters: Value) -> tuple[Value, Value]:
    """Sine and cosine of `r` + `quarters` π/2 with |r| <= π/4 and integer `quarters`."""
    builder, kind = code.builder, ir.VectorType(I64, code.lanes.width)
    z = r * r
    sine = _fma(code, r * z, _series(code, _SINE[1:], z), r)
    cosine = _fma(code, z, _series(code, _COSINE[1:], z), code.value(1.0))
    k = builder.fptosi(quarters.raw, kind)

    def has(number: ir.Value, bit: int) -> Value:
        marked = builder.and_(number, _integers(kind, bit))
        return Value(code, builder.icmp_unsigned("!=", marked, _integers(kind, 0)))

    odd = has(k, 1)
    first, second = code.select(odd, cosine, sine), code.select(odd, sine, cosine)
    following = builder.add(k, _integers(kind, 1))
    return code.select(has(k, 2), -first, first), code.select(has(following, 2), -second, second)


def nearest(code: Code, x: Value) -> Value:
    """The integer nearest to `x`, as a double; ties to even."""
    return Value(code, code.builder.call(code.lanes.intrinsic("nearbyint"), [x.raw]))


def _turned(code: Code, name: str, x: Value) -> Value:
    if code.lanes.precision != "double":
        return code.library(name, x)
    usual = code.fabs(x) < FAR
    quarters = nearest(code, code.select(usual, x, 0.0) * (2 / math.pi))
    r, left = code.select(usual, x, 0.0), _HALF_PI
    for _ in range(3):
        part = float(left)
        r, left = _fma(code, quarters, code.value(-part), r), left - Fraction(part)
    both = turned(code, r, quarters)
    return _elsewhere(code, name, x, usual, both[name == "cos"])


def _elsewhere(code: Code, name: str, x: Value, usual: Value, result: Value) -> Value:
    """`result` in the lanes that are `usual`, and what the C library's `name` says of `x` in the others."""
    memory = code.reserve(1)
    code.store(result, memory)
    with code.when(code.any(~usual)):
        code.store(code.select(usual, result, code.library(name, x)), memory)
    return code.load(memory)


def _series(code: Code, coefficients: tuple[float, ...], z: Value) -> Value:
    """Σ c_i z^i."""
    value = code.value(coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        value = _fma(code, value, z, code.value(coefficient))
    return value


def _fma(code: Code, a: Value, b: Value, c: Value) -> Value:
    """a b + c, rounded once where the processor can."""
    if not code.lanes.target.fuses:
        return a * b + c
    return Value(code, code.builder.call(code.lanes.intrinsic("fma", 3), [a.raw, b.raw, c.raw]))


def _exact(code: Code, name: str, a: Value, b: Value) -> Value:
    """An operation that nothing may reorder."""
    return Value(code, getattr(code.builder, name)(a.raw, b.raw))


def _integers(kind: ir.VectorType, number: int) -> ir.Constant:
    return ir.Constant(kind, [number] * kind.count)
