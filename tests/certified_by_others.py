#!/usr/bin/env python3
"""Certified values are those of programs that share nothing with Plumbline. NLB-21 and NLB-22, by this program:
collocation at Gauss points of pieces between all places where u or a derivative jumps, with integrals that are exact
for the polynomials. NLB-24: the radial solution in scenes/meshes/curved_disk.prm, by Nystroem's method.

usage: certified_by_others.py SOURCE

The operator is L u(x) = ∫_{-δ}^{δ} C(|s|) (u(x) - u(x + s)) ds with ∫ C s^2 ds = 2, so that it tends to -u'':
C = 3/δ^3 (constant), C = 12/δ^3 (1 - r/δ) (conical). Where b or the prescribed u jumps at z, u jumps at z and its
derivatives at z ± kδ. Standard library only.
"""
import json
import math
import pathlib
import re
import sys

PIECE = .1  # all jumps of both problems lie at multiples of it
PROBLEMS = {
    "NLB_21": {"pieces": [(0, 10)], "kernel": lambda r, d: 3 / d**3,
               "load": lambda x: 1 + math.sin(3 * x), "around": lambda x: 0},
    "NLB_22": {"pieces": [(0, 10), (11, 16)], "kernel": lambda r, d: 12 / d**3 * (1 - r / d),
               "load": lambda x: 1 if x < .5 else -.5, "around": lambda x: 0 if x < .5 else .1},
}


def gauss(n):
    """Points and weights on (0, 1), by Newton's method on Legendre's polynomial."""
    rule = []
    for k in range(n):
        x = math.cos(math.pi * (k + .75) / (n + .5))
        for _ in range(100):
            p, before = x, 1.
            for i in range(2, n + 1):
                p, before = ((2 * i - 1) * x * p - (i - 1) * before) / i, p
            slope = n * (x * p - before) / (x * x - 1)
            step = p / slope
            x -= step
            if abs(step) < 1e-16:
                break
        rule.append(((1 - x) / 2, 1 / ((1 - x * x) * slope**2)))
    return rule


def lagrange(nodes, s):
    """Values of the polynomials of the nodes at s."""
    return [math.prod((s - b) / (a - b) for b in nodes if b != a) for a in nodes]


def solve(matrix, right):
    """Gaussian elimination with pivots."""
    n = len(right)
    rows = [row + [b] for row, b in zip(matrix, right)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        pivot = rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / pivot[k]
            if factor:
                rows[i] = rows[i][:k + 1] + [a - factor * b for a, b in zip(rows[i][k + 1:], pivot[k + 1:])]
    u = [0.] * n
    for k in reversed(range(n)):
        u[k] = (rows[k][n] - math.fsum(rows[k][j] * u[j] for j in range(k + 1, n))) / rows[k][k]
    return u


class Collocation:
    def __init__(self, problem, horizon, n):
        self.problem, self.horizon = problem, horizon
        self.rule = gauss(n)
        self.nodes = [s for s, _ in self.rule]
        self.inside = {k: i for i, k in enumerate(k for a, b in problem["pieces"] for k in range(a, b))}
        places = [(k + s) * PIECE for k in self.inside for s in self.nodes]
        n_all = len(places)
        matrix, right = [], []
        for i, x in enumerate(places):
            row, known = self.integral(x)
            row = [-a for a in row]
            row[i] += self.mass()
            matrix.append(row)
            right.append(problem["load"](x) + known)
        self.u = solve(matrix, right)
        assert len(self.u) == n_all

    def mass(self):
        """∫ C."""
        d, C = self.horizon, self.problem["kernel"]
        return 2 * d * sum(w * C(s * d, d) for s, w in self.rule)

    def integral(self, x):
        """∫ C(|x - y|) u(y) dy within the horizon: coefficients of the values at nodes, and what is known."""
        d, C, n = self.horizon, self.problem["kernel"], len(self.nodes)
        row, known = [0.] * (n * len(self.inside)), 0.
        for k in range(math.floor((x - d) / PIECE) - 1, math.ceil((x + d) / PIECE) + 1):
            ends = sorted({min(max(end, x - d), x + d) for end in (k * PIECE, (k + 1) * PIECE)}
                          | ({x} if k * PIECE < x < (k + 1) * PIECE else set()))
            for a, b in zip(ends, ends[1:]):
                for s, w in self.rule:
                    y = a + (b - a) * s
                    weight = (b - a) * w * C(abs(x - y), d)
                    if k in self.inside:
                        for j, value in enumerate(lagrange(self.nodes, y / PIECE - k)):
                            row[n * self.inside[k] + j] += weight * value
                    else:
                        known += weight * self.problem["around"](y)
        return row, known

    def __call__(self, x):
        """u by the equation itself."""
        row, known = self.integral(x)
        return (self.problem["load"](x) + known + math.fsum(a * u for a, u in zip(row, self.u))) / self.mass()


def on_disk(source):
    """u at (x, y) by the formula of the scene."""
    text = (source / "scenes/meshes/curved_disk.prm").read_text().replace("\\\n", " ")
    formula, = re.findall(r"^ *set solution *= one: (.*)$", text, flags=re.M)
    inner, outer = re.fullmatch(r"x\^2 \+ y\^2 < 0\.25 \?(.*):(.*)", formula).groups()

    def u(x, y):
        names = {"__builtins__": {}, "max": max, "sqrt": math.sqrt, "x": x, "y": y}
        return eval((inner if x * x + y * y < .25 else outer).strip().replace("^", "**"), names)
    return u


def largest_difference(name, certificate, u):
    """Of the certified values; none is above its bound."""
    largest = 0
    for one in certificate["points"]:
        value = u(*one["x"])
        largest = max(largest, abs(value - one["value"][0]))
        if not abs(value - one["value"][0]) <= one["bound"]:
            sys.exit(f"{name}: u{one['x']} = {value:.16g}, but {one['value'][0]:.16g} is certified to {one['bound']:.2g}")
        if not abs(value - one["other"][0]) <= one["other_bound"]:
            sys.exit(f"{name}: u{one['x']} = {value:.16g}, but the rule has {one['other'][0]:.16g}")
    return f"the largest difference is {largest:.1e}, that is {-math.log10(largest / certificate['size']):.1f} digits"


def main():
    source = pathlib.Path(sys.argv[1])

    def read(name):
        return json.loads((source / f"scenes/certified/{name}.certificate.json").read_text())
    for name, problem in PROBLEMS.items():
        certificate = read(name)
        coarse, fine = (Collocation(problem, certificate["horizon"], n) for n in (9, 12))
        found = largest_difference(name, certificate, fine)
        changed = max(abs(fine(x) - coarse(x)) for x, in (one["x"] for one in certificate["points"]))
        if not changed <= 1e-12 * certificate["size"]:
            sys.exit(f"{name}: the collocation itself changes by {changed:.2g}")
        print(f"{name}: {found}; the collocation changes by {changed:.1e}")
    print(f"NLB_24: {largest_difference('NLB_24', read('NLB_24'), on_disk(source))}")


main()
