#!/usr/bin/env python3
"""Writes docs/_static/problem.svg, the picture of the README: docs/problem.py > docs/_static/problem.svg."""
import math

H, M, N = 30, 3, 9  # mesh size in pixels, horizon / h, cells per side of the domain
LAYER = M * H
SIZE = N * H + 2 * LAYER


def circle(x, y, r, style):
    return f'<circle cx="{x:g}" cy="{y:g}" r="{r:g}" {style}/>'


def text(x, y, words, style="", size=15):
    return f'<text x="{x:g}" y="{y:g}" font-size="{size}" {style}>{words}</text>'


def lattice(centre):
    """Nodes and cells; cells that the ball cuts are marked."""
    nodes, cells = [], []
    for i in range(N + 2 * M):
        for j in range(N + 2 * M):
            x, y = (i + .5) * H, (j + .5) * H
            corners = [math.hypot(x + a * H / 2 - centre, y + b * H / 2 - centre) for a in (-1, 1) for b in (-1, 1)]
            nearest = math.hypot(max(abs(x - centre) - H / 2, 0), max(abs(y - centre) - H / 2, 0))
            if nearest < M * H < max(corners):
                cells.append(f'<rect x="{x - H / 2:g}" y="{y - H / 2:g}" width="{H}" height="{H}" fill="#f2b872"/>')
            nodes.append(f"M{x:g} {y:g}h0")
    return cells, "".join(nodes)


def picture():
    centre = SIZE / 2
    cells, nodes = lattice(centre)
    end = centre + M * H * math.cos(.6), centre - M * H * math.sin(.6)
    words = SIZE + 24
    legend = [("#f3efe2", "interaction domain: u = g"), ("#dbe7f3", "domain Ω: L u = b"),
              ("#f2b872", "cells that the ball cuts:"), ("", "rules differ in their weights")]
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE + 270} {SIZE}" '
             'font-family="DejaVu Sans, Helvetica, sans-serif" fill="#22303c">',
             f'<rect width="{SIZE + 270}" height="{SIZE}" fill="#ffffff"/>',
             f'<rect width="{SIZE}" height="{SIZE}" fill="#f3efe2"/>',
             f'<rect x="{LAYER}" y="{LAYER}" width="{N * H}" height="{N * H}" fill="#dbe7f3" stroke="#7a8ca0"/>',
             *cells,
             f'<path d="{nodes}" stroke="#34495e" stroke-width="4" stroke-linecap="round"/>',
             circle(centre, centre, M * H, 'fill="#d9822b" fill-opacity=".12" stroke="#c0611b" stroke-width="2"'),
             f'<path d="M{centre:g} {centre:g}L{end[0]:.1f} {end[1]:.1f}" stroke="#c0392b" stroke-width="2"/>',
             circle(centre, centre, 4.5, 'fill="#c0392b"'),
             text(centre - 30, centre - 34, "δ = m h", 'fill="#c0392b" font-style="italic"', 16),
             text(centre - 22, centre + 20, "x", 'font-style="italic"', 16)]
    for i, (colour, line) in enumerate(legend):
        y = 130 + 34 * i
        if colour:
            parts.append(f'<rect x="{words}" y="{y - 14}" width="18" height="18" fill="{colour}" stroke="#7a8ca0"/>')
        parts.append(text(words + 28, y, line))
    parts += [text(words, 300, "L u(x) = -∫ C(ξ) (u(x+ξ) - u(x)) dξ", size=13),
              text(words, 328, "Does the rule converge", size=15), text(words, 348, "as h and δ tend to 0?", size=15),
              "</svg>"]
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    print(picture(), end="")
