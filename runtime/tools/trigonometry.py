#!/usr/bin/env python3
"""The numbers of runtime/src/scalar/circle.rs and runtime/src/scalar/software, and the reference data of runtime/tests/data.

    trigonometry.py             prints parts of pi/2 and pi/4, words of 2/pi, and polynomial coefficients
    trigonometry.py reference   prints trigonometry.txt, angles as bits: f32 or f64, angle, sine, cosine
    trigonometry.py inverse     prints arctangent.txt, points as bits: f32 or f64, y, x, angle

Needs mpmath. Coefficients are minimax in the relative error (Remez's exchange), rounded one after the other, the
remaining ones fitted anew each time.
"""

import random
import struct
import sys

from mpmath import atan, atan2, cos, floor, frexp, ldexp, log, lu_solve, matrix, mp, mpf, nint, nstr, pi, sin, sqrt

mp.prec = 2000


def rounded(x, bits):
    m, e = frexp(mpf(x))
    return ldexp(nint(ldexp(m, bits)), e - bits)


def parts(cuts):
    """pi/2 from one cut of its binary digits to the next, and the rest."""
    digits = bin(int(floor(pi / 2 * mpf(2) ** 400)))[2:]
    found, first = [], 0
    for last in cuts:
        found.append(mpf(int(digits[first:last], 2)) * mpf(2) ** (1 - last))
        first = last
    return found + [pi / 2 - sum(found)]


def words(bits, count):
    whole = int(floor(2 / pi * mpf(2) ** (bits * count)))
    return [(whole >> (bits * (count - 1 - i))) & (2**bits - 1) for i in range(count)]


def remez(f, weight, degrees, low, high):
    n = len(degrees)
    nodes = [(low + high) / 2 - (high - low) / 2 * mp.cos(pi * k / n) for k in range(n + 1)]
    for _ in range(12):
        a, b = matrix(n + 1, n + 1), matrix(n + 1, 1)
        for i, x in enumerate(nodes):
            for j, degree in enumerate(degrees):
                a[i, j] = x**degree * weight(x)
            a[i, n], b[i] = (-1) ** i, f(x) * weight(x)
        solution = lu_solve(a, b)
        points = [low + (high - low) * k / mpf(2000) for k in range(2001)]
        errors = [(f(x) - sum(solution[j] * x**d for j, d in enumerate(degrees))) * weight(x) for x in points]
        extrema, i = [], 0
        while i < len(points):
            j = i
            while j + 1 < len(points) and (errors[j + 1] > 0) == (errors[i] > 0):
                j += 1
            extrema.append(max(range(i, j + 1), key=lambda k: abs(errors[k])))
            i = j + 1
        if len(extrema) <= n:
            break
        while len(extrema) > n + 1:
            extrema.pop(0 if abs(errors[extrema[0]]) < abs(errors[extrema[-1]]) else -1)
        nodes = [points[k] for k in extrema]
    return [solution[j] for j in range(n)]


def fit(f, weight, count, bits, low, high):
    fixed = []
    for k in range(count):
        rest = lambda z: f(z) - sum(c * z**i for i, c in enumerate(fixed))
        fixed.append(rounded(remez(rest, weight, range(k, count), low, high)[0], bits))
    points = [low + (high - low) * k / mpf(1000) for k in range(1001)]
    return fixed, max(abs((f(z) - sum(c * z**i for i, c in enumerate(fixed))) * weight(z)) for z in points)


def constants():
    print("f32 pi/2:", [nstr(rounded(p, 24), 9) for p in parts([11, 23, 35])])
    print("f64 pi/2:", [nstr(rounded(p, 53), 17) for p in parts([33, 53, 86])])
    print("f32 pi/4:", [nstr(rounded(p / 2, 24), 9) for p in parts([22])])
    print("f64 pi/4:", [nstr(rounded(p / 2, 53), 17) for p in parts([51])])
    print("f32 2/pi:", [f"{w:#010x}" for w in words(32, 7)])
    print("f64 2/pi:", [f"{w:#018x}" for w in words(64, 19)])
    mp.prec = 200
    low, high = mpf("1e-6"), (pi / 4 * mpf("1.0001")) ** 2
    arctangent = lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z
    for name, bits, count in (("f32", 24, 5), ("f64", 53, 13)):
        show(name, "arctangent", bits, fit(arctangent, lambda z: z * sqrt(z) / atan(sqrt(z)), count, bits, low, mpf("0.2501")))
    for name, bits, count in (("f32", 24, 3), ("f64", 53, 6)):
        sine = lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z
        cosine = lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2
        for title, f, weight in (
            ("sine", sine, lambda z: z * sqrt(z) / sin(sqrt(z))),
            ("cosine", cosine, lambda z: z * z / cos(sqrt(z))),
        ):
            show(name, title, bits, fit(f, weight, count, bits, low, high))


def show(name, title, bits, fitted):
    coefficients, error = fitted
    print(name, title, [nstr(c, 9 if bits == 24 else 17) for c in coefficients], f"error 2^{nstr(log(error, 2), 4)}")


FORMATS = ("f32", 32, 23, 255, "fI"), ("f64", 64, 52, 2047, "dQ")


def conversions(pack):
    bits_of = lambda x: struct.unpack("<" + pack[1], struct.pack("<" + pack[0], float(x)))[0]
    value_of = lambda b: struct.unpack("<" + pack[0], struct.pack("<" + pack[1], b))[0]
    return bits_of, value_of


def reference():
    generator = random.Random(1)
    for name, width, mantissa, top, pack in FORMATS:
        bits_of, value_of = conversions(pack)
        # Every exponent, and what comes near multiples of pi/2 in every binade.
        angles = [e << mantissa | generator.getrandbits(mantissa) for e in range(0, top, max(1, top // 200))]
        for k in range(0, 100):
            n = generator.getrandbits(1 + k * (28 if width == 32 else 60) // 100) | 1
            angles.append(bits_of(rounded(n * pi / 2, mantissa + 1)))
        if width == 64:
            angles.append(bits_of(6381956970095103.0 * 2.0**797))  # the nearest of all (Muller et al., table 11.1)
        for bits in angles:
            x = mpf(value_of(bits))
            print(name, *(f"{b:x}" for b in (bits, bits_of(sin(x)), bits_of(cos(x)))))


def nearest(x, mantissa, bias):
    """The number next to x, as bits; where numbers are subnormal, float() alone would round a second time."""
    exponent = max(frexp(x)[1] - 1, 1 - bias)
    unit = mpf(2) ** (exponent - mantissa)
    return nint(x / unit) * unit


def inverse():
    generator = random.Random(2)
    for name, width, mantissa, top, pack in FORMATS:
        bits_of, value_of = conversions(pack)
        number = lambda exponent: exponent << mantissa | generator.getrandbits(mantissa)
        sign = lambda bits: bits | generator.getrandbits(1) << (width - 1)
        bias = top >> 1
        points = []
        for _ in range(300):  # of like size, in every octant
            points.append((sign(number(bias + generator.randint(-2, 2))), sign(number(bias + generator.randint(-2, 2)))))
        for _ in range(200):  # of every size, subnormal too
            points.append((sign(number(generator.randrange(top))), sign(number(generator.randrange(top)))))
        for _ in range(100):  # quotients next to where the reduction changes: one half, one, two
            y = number(generator.randrange(2, top - 2))
            x = y + (generator.randint(-1, 1) << mantissa) + generator.randint(-3, 3)
            points.append((sign(y), sign(x)))
        for y, x in points:
            angle = nearest(atan2(abs(mpf(value_of(y))), mpf(value_of(x))), mantissa, bias)
            print(name, *(f"{b:x}" for b in (y, x, bits_of(angle) | y >> (width - 1) << (width - 1))))


{"reference": reference, "inverse": inverse}.get(" ".join(sys.argv[1:]), constants)()
