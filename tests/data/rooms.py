#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes rooms.json: form factors of rooms with things in the way, found without any code or method of halflight.

    python3 rooms.py > rooms.json           standard library only, two minutes

Blockers: two parallel rectangles with a parallel rectangle between them. From a point of the first the shadow of the blocker on the plane
of the second is a rectangle, so the visible part is a difference of rectangles, whose factors from a point are exact (Lambert). The integral
over the first rectangle is a Gauss rule between all lines on which an edge of the shadow meets an edge of the second rectangle.

Rooms: a plan of straight walls from floor to ceiling, with or without a column. What a wall's point sees is decided in the plan alone: parts
of walls, exactly, and the triangles of floor and ceiling before them. The integral over a wall is a Gauss rule between all places from which
two corners of the plan lie in one line, graded towards the ends. Floor to ceiling follows from the row sums. What is checked here: factors of
points sum to 1, reciprocity, and how little more points change (`digits`, the largest change of a factor).

Script F (Hottel): the share of the black-body emission of i that j absorbs, directly or after reflections,
e_i [(1 - F R)^-1 F]_ij e_j with emissivities e and reflectances R = 1 - e.
"""
import json
from math import atan2, cos, pi, sin, sqrt


def gauss(n):
    """Nodes and weights on [0, 1]."""
    rule = []
    for i in range(n):
        x = cos(pi * (i + 0.75) / (n + 0.5))
        for _ in range(100):
            p, q = 1.0, 0.0
            for k in range(n):
                p, q = ((2 * k + 1) * x * p - k * q) / (k + 1), p
            slope = n * (x * p - q) / (x * x - 1)
            x, before = x - p / slope, x
            if x == before:
                break
        rule.append(((1 - x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return rule


def between(cuts, n, graded=0):
    """A Gauss rule of n nodes between each two neighbours of `cuts`; each part is cut `graded` times towards both its ends."""
    cuts = sorted(cuts)
    rule = gauss(n)
    for a, b in zip(cuts, cuts[1:]):
        if b - a < 1e-13:
            continue
        steps = [0.0] + [0.5 * 0.15**k for k in range(graded, -1, -1)]
        parts = steps + [1 - s for s in reversed(steps[:-1])]
        for s, t in zip(parts, parts[1:]):
            for x, w in rule:
                yield a + (b - a) * (s + (t - s) * x), w * (b - a) * (t - s)


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def point_factor(x, normal, polygon):
    """From an element at x to a polygon that lies above its horizon and is seen from the front (Lambert)."""
    total = 0.0
    for i, p in enumerate(polygon):
        a, b = sub(p, x), sub(polygon[(i + 1) % len(polygon)], x)
        c = cross(a, b)
        length = sqrt(dot(c, c))
        if length > 0.0:
            total += dot(c, normal) / length * atan2(length, dot(a, b))
    return abs(total) / (2 * pi)


# ---------------------------------------------------------------- blockers

def rectangle(x, y, z):
    return [(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]


def blocked_factor(p, q, blocker, n):
    """p, q, blocker: (x range, y range, z); p faces up, q down."""
    shrink = (q[2] - blocker[2]) / (q[2] - p[2])  # of the way from p, as seen from q

    def cuts(axis):  # where an edge of the shadow, b + (b - s)(1 / (1 - shrink) - 1), is an edge of q
        lines = [(b - (1 - shrink) * e) / shrink for b in blocker[axis] for e in q[axis]]
        return list(p[axis]) + [s for s in lines if p[axis][0] < s < p[axis][1]]

    def shadow(s, axis):
        edges = [s + (b - s) / (1 - shrink) for b in blocker[axis]]
        return max(edges[0], q[axis][0]), min(edges[1], q[axis][1])

    total = 0.0
    up = (0.0, 0.0, 1.0)
    rows = list(between(cuts(1), n))
    for sx, wx in between(cuts(0), n):
        x = shadow(sx, 0)
        for sy, wy in rows:
            y = shadow(sy, 1)
            at = (sx, sy, p[2])
            seen = point_factor(at, up, rectangle(q[0], q[1], q[2]))
            if x[0] < x[1] and y[0] < y[1]:
                seen -= point_factor(at, up, rectangle(x, y, q[2]))
            total += wx * wy * seen
    return total / ((p[0][1] - p[0][0]) * (p[1][1] - p[1][0]))


# ---------------------------------------------------------------- rooms

def visible_parts(at, walls, own, target):
    """The parts [a, b] of the wall `target` that the point `at` of the wall `own` sees in the plan, as parameters along it."""
    a, b = walls[target]
    turn = lambda u, v: u[0] * v[1] - u[1] * v[0]
    along = (b[0] - a[0], b[1] - a[1])
    before = lambda p: turn(along, (p[0] - a[0], p[1] - a[1]))  # how far before the target's line
    if turn(along, (at[0] - a[0], at[1] - a[1])) <= 1e-12:
        return []  # at its back, or in its line
    hidden = []
    for i, (c, d) in enumerate(walls):
        if i == target or turn((d[0] - c[0], d[1] - c[1]), (at[0] - c[0], at[1] - c[1])) <= 1e-12:
            continue  # a line leaves the room through the front of a wall
        # The shadow of c-d on the line of the target; only what lies before the target casts one.
        low, high = 1e-12, before(at) * (1 - 1e-12)
        h = (before(c), before(d))
        if max(h) <= low or min(h) >= high:
            continue
        edges = []
        for k in (0, 1):  # cut at the target's line and at the point's parallel to it
            limit = min(max(h[k], 0.0), high)
            t = (limit - h[k]) / (h[1 - k] - h[k]) if limit != h[k] else 0.0
            p, q = (c, d)[k], (c, d)[1 - k]
            x = (p[0] + t * (q[0] - p[0]) - at[0], p[1] + t * (q[1] - p[1]) - at[1])
            grow = before(at) / (before(at) - limit)
            edges.append(((at[0] + grow * x[0] - a[0]) * along[0] + (at[1] + grow * x[1] - a[1]) * along[1]) / (along[0] ** 2 + along[1] ** 2))
        hidden.append((min(edges), max(edges)))
    c, d = walls[own]  # what lies behind the own wall is not seen
    h = [turn((d[0] - c[0], d[1] - c[1]), (p[0] - c[0], p[1] - c[1])) for p in (a, b)]
    if max(h) <= 1e-12:
        return []
    seen = [(0.0 if h[0] >= 0.0 else h[0] / (h[0] - h[1]), 1.0 if h[1] >= 0.0 else h[0] / (h[0] - h[1]))]
    for lo, hi in hidden:
        rest = []
        for s, t in seen:
            if lo > s:
                rest.append((s, min(t, lo)))
            if hi < t:
                rest.append((max(s, hi), t))
        seen = [(s, t) for s, t in rest if t - s > 1e-13]
    return seen


def room(loops, height, n, graded):
    """Form factors between the walls of all loops (inside on their left), floor and ceiling."""
    walls = [(loop[i], loop[(i + 1) % len(loop)]) for loop in loops for i in range(len(loop))]
    corners = [p for loop in loops for p in loop]
    count = len(walls)
    factors = [[0.0] * (count + 2) for _ in range(count + 2)]
    worst_sum = 0.0
    heights = list(between([0.0, height], n, graded))
    lengths = [sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) for a, b in walls]
    for i, (a, b) in enumerate(walls):
        d = ((b[0] - a[0]) / lengths[i], (b[1] - a[1]) / lengths[i])
        normal = (-d[1], d[0], 0.0)
        cuts = [0.0, 1.0]
        for p in corners:  # where the line through two corners meets the wall
            for q in corners:
                e = (q[0] - p[0], q[1] - p[1])
                down = e[0] * d[1] - e[1] * d[0]
                if abs(down) > 1e-12:
                    t = (e[0] * (p[1] - a[1]) - e[1] * (p[0] - a[0])) / down / lengths[i]
                    if 1e-9 < t < 1 - 1e-9 and all(abs(t - c) > 1e-9 for c in cuts):
                        cuts.append(t)
        for s, ws in between(cuts, n, graded):
            at = (a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]))
            parts = [(j, *walls[j], *part) for j in range(count) if j != i for part in visible_parts(at, walls, i, j)]
            for z, wz in heights:
                x = (at[0], at[1], z)
                weight = ws * wz / height
                whole = 0.0
                for j, c, e, lo, hi in parts:
                    p = (c[0] + lo * (e[0] - c[0]), c[1] + lo * (e[1] - c[1]))
                    q = (c[0] + hi * (e[0] - c[0]), c[1] + hi * (e[1] - c[1]))
                    to_wall = point_factor(x, normal, [(*p, 0.0), (*q, 0.0), (*q, height), (*p, height)])
                    to_floor = point_factor(x, normal, [(*at, 0.0), (*p, 0.0), (*q, 0.0)])
                    to_ceiling = point_factor(x, normal, [(*at, height), (*p, height), (*q, height)])
                    factors[i][j] += weight * to_wall
                    factors[i][count] += weight * to_floor
                    factors[i][count + 1] += weight * to_ceiling
                    whole += to_wall + to_floor + to_ceiling
                worst_sum = max(worst_sum, abs(whole - 1.0))
    plan_area = sum(loop[k - 1][0] * loop[k][1] - loop[k][0] * loop[k - 1][1] for loop in loops for k in range(len(loop))) / 2
    areas = [length * height for length in lengths] + [plan_area, plan_area]
    asymmetry = 0.0
    for i in range(count):
        for j in range(i):
            asymmetry = max(asymmetry, abs(areas[i] * factors[i][j] - areas[j] * factors[j][i]) / max(areas[i], areas[j]))
        for flat in (count, count + 1):
            factors[flat][i] = areas[i] * factors[i][flat] / plan_area
    for flat, other in ((count, count + 1), (count + 1, count)):
        factors[flat][other] = 1.0 - sum(factors[flat][:count])
    assert worst_sum < 1e-12 and asymmetry < 1e-9, (worst_sum, asymmetry)
    return factors, areas


def script_factors(factors, emissivity):
    n = len(factors)
    rows = [[(i == j) - factors[i][j] * (1 - emissivity[j]) for j in range(n)] + factors[i][:] for i in range(n)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda r: abs(rows[r][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for r in range(n):
            if r != k:
                rows[r] = [v - rows[r][k] * w for v, w in zip(rows[r], rows[k])]
    return [[emissivity[i] * rows[i][n + j] * emissivity[j] for j in range(n)] for i in range(n)]


def surfaces(loops, height):
    """Name and polygons of each, facing into the room."""
    result = []
    for number, loop in enumerate(loops):
        for i, a in enumerate(loop):
            b = loop[(i + 1) % len(loop)]
            name = ("wall" if number == 0 else "column") + str(i)
            result.append((name, [[(*b, 0.0), (*a, 0.0), (*a, height), (*b, height)]]))
    plan = [loops[0]]
    if len(loops) == 2:  # a ring of quadrilaterals: the column turns the other way, from its first corner
        outer, inner = loops[0], [loops[1][0]] + loops[1][:0:-1]
        n = len(outer)
        plan = [[outer[i], outer[(i + 1) % n], inner[(i + 1) % n], inner[i]] for i in range(n)]
    result.append(("floor", [[(*p, 0.0) for p in face] for face in plan]))
    result.append(("ceiling", [[(*p, height) for p in reversed(face)] for face in plan]))
    return result


def digits(value):
    return float("%.11g" % value)


BLOCKERS = [
    ("middle of the way, off the centre", ((0.0, 1.0), (0.0, 1.0), 0.0), ((0.0, 1.0), (0.0, 1.0), 1.0), ((0.1, 0.7), (0.35, 0.95), 0.5)),
    ("near the receiver", ((0.0, 1.0), (0.0, 1.0), 0.0), ((0.0, 1.0), (0.0, 1.0), 1.0), ((0.4, 0.6), (0.4, 0.6), 0.9)),
    ("unequal rectangles, beside each other", ((0.0, 2.0), (0.0, 1.0), 0.0), ((1.5, 2.5), (0.5, 3.0), 1.2), ((1.0, 2.25), (0.5, 1.5), 0.4)),
    ("wider than both", ((0.0, 1.0), (0.0, 1.0), 0.0), ((0.0, 1.0), (0.0, 1.0), 0.6), ((-1.0, 3.0), (0.25, 0.5), 0.3)),
]
ROOMS = [
    ("L", [[(0.0, 0.0), (5.0, 0.0), (5.0, 2.0), (2.0, 2.0), (2.0, 4.0), (0.0, 4.0)]], 2.5),
    ("gable", [[(0.0, 0.0), (4.0, 0.0), (4.0, 2.2), (1.6, 3.9), (0.0, 2.2)]], 6.0),
    ("column", [[(0.0, 0.0), (4.0, 0.3), (4.4, 3.0), (-0.5, 3.5)], [(1.4, 1.1), (1.2, 2.0), (2.6, 2.4), (2.5, 1.0)]], 2.8),
]


def main():
    blockers = []
    for name, p, q, blocker in BLOCKERS:
        value, check = blocked_factor(p, q, blocker, 16), blocked_factor(p, q, blocker, 24)
        blockers.append({"name": name, "P": rectangle(*p), "Q": rectangle(*q)[::-1], "occluders": [rectangle(*blocker)],
                         "F_PQ": digits(check), "F_QP": digits(check * (p[0][1] - p[0][0]) * (p[1][1] - p[1][0])
                                                               / ((q[0][1] - q[0][0]) * (q[1][1] - q[1][0]))),
                         "digits": "%.0e" % abs(value - check)})
    rooms = []
    for name, loops, height in ROOMS:
        coarse, areas = room(loops, height, 8, 3)
        factors, areas = room(loops, height, 10, 4)
        change = max(abs(a - b) for r, s in zip(coarse, factors) for a, b in zip(r, s))
        faces = surfaces(loops, height)
        emissivity = [(0.9, 0.3, 0.6, 0.05)[i % 4] for i in range(len(faces))]
        script = script_factors(factors, emissivity)
        rooms.append({"name": name, "surfaces": [{"name": f, "area": digits(area), "polygons": polygons, "emissivity": e}
                                                 for (f, polygons), area, e in zip(faces, areas, emissivity)],
                      "F": [[digits(v) for v in row] for row in factors], "script_F": [[digits(v) for v in row] for row in script],
                      "digits": "%.0e" % change})
    lines = lambda entries: "[\n" + ",\n".join(json.dumps(e, separators=(",", ":")) for e in entries) + "\n]"
    print('{"blockers":' + lines(blockers) + ',\n"rooms":' + lines(rooms) + "}")


main()
