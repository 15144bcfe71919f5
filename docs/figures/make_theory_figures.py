#!/usr/bin/env python3
"""usage: docs/figures/make_theory_figures.py [RESULT RECORDING]

Draws the figures of docs/theory/identification.md and evidence.md as SVG, beside the pages: coverage_by_world.svg from
tests/coverage/worlds.csv, and from the demo (RESULT of `myoid run`, RECORDING of `myoid twin`, as run-demo makes them)
belief_and_readings.svg, two_readings.svg and voluntary_torque.svg. Python's own library is enough.
"""

import csv
import math
import sys
from pathlib import Path
from statistics import NormalDist

SOURCE = Path(__file__).resolve().parents[2]
THEORY, WORLDS = SOURCE / "docs/theory", SOURCE / "tests/coverage/worlds.csv"

PERSON, GIVEN, BELIEF, TRUTH = "#2a6496", "#c0562b", "#8a8a8a", "#111111"
MUSCLES = {"BIC": "biceps", "BRA": "brachialis", "BRD": "brachioradialis", "TRI": "triceps"}
NUMBERS = {"voluntary_torque": "voluntary torque", "max_isometric_force": "F_max", "optimal_fiber_length": "l_m⁰"}
NORMAL = NormalDist().inv_cdf(0.975)


class Svg:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.parts = []

    def line(self, x0, y0, x1, y1, color, width=1.0, dash=""):
        dashed = f" stroke-dasharray='{dash}'" if dash else ""
        self.parts.append(f"<line x1='{x0:.1f}' y1='{y0:.1f}' x2='{x1:.1f}' y2='{y1:.1f}' stroke='{color}' "
                          f"stroke-width='{width:g}'{dashed}/>")

    def text(self, x, y, text, anchor="start", color="#111111"):
        self.parts.append(f"<text x='{x:.1f}' y='{y:.1f}' text-anchor='{anchor}' fill='{color}'>{text}</text>")

    def path(self, points, color, width=1.5, fill="none", opacity=1.0):
        steps = "L".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.parts.append(f"<path d='M{steps}' stroke='{color}' stroke-width='{width:g}' fill='{fill}' "
                          f"fill-opacity='{opacity:g}'/>")

    def dot(self, x, y, color, hollow=False, radius=4.0):
        fill = "white" if hollow else color
        self.parts.append(f"<circle cx='{x:.1f}' cy='{y:.1f}' r='{radius:g}' fill='{fill}' stroke='{color}' "
                          f"stroke-width='1.5'/>")

    def square(self, x, y, color, hollow=False, half=3.6):
        fill = "white" if hollow else color
        self.parts.append(f"<rect x='{x - half:.1f}' y='{y - half:.1f}' width='{2 * half:g}' height='{2 * half:g}' "
                          f"fill='{fill}' stroke='{color}' stroke-width='1.5'/>")

    def write(self, name):
        head = (f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {self.width} {self.height}' "
                f"font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' fill='white'/>\n")
        (THEORY / name).write_text(head + "\n".join(self.parts) + "\n</svg>\n")


class Scale:
    """A linear scale from values to places."""

    def __init__(self, low, high, begin, end):
        self.low, self.high, self.begin, self.end = low, high, begin, end

    def __call__(self, value):
        return self.begin + (value - self.low) / (self.high - self.low) * (self.end - self.begin)


def axis(svg, scale, y, ticks, label, top):
    for tick in ticks:
        svg.line(scale(tick), top, scale(tick), y, "#e3e3e3")
        svg.text(scale(tick), y + 16, f"{tick:g}", "middle")
    svg.line(scale.begin, y, scale.end, y, "#111111")
    svg.text((scale.begin + scale.end) / 2, y + 34, label, "middle")


def rows_of(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def coverage():
    worlds = rows_of(WORLDS)
    top, step = 44, 26
    svg = Svg(720, top + step * len(worlds) + 50)
    scale, bottom = Scale(0, 100, 190, 690), top + step * len(worlds)
    axis(svg, scale, bottom, range(0, 101, 20), "95 % intervals that hold the truth [%]", top - 8)
    svg.line(scale(85), top - 8, scale(85), bottom, TRUTH, 1.0, "4 3")
    svg.text(scale(85), top - 12, "85 asked", "middle")
    for x, mark, color, hollow, label in ((190, "dot", PERSON, False, "F_max"), (260, "square", PERSON, False, "l_m⁰"),
                                          (330, "dot", GIVEN, True, "F_max, least squares"),
                                          (490, "square", GIVEN, True, "l_m⁰, least squares")):
        getattr(svg, mark)(x + 6, 12, color, hollow)
        svg.text(x + 16, 16, label)
    for i, world in enumerate(worlds):
        y = top + step * (i + 0.5)
        svg.text(180, y + 4, world["world"] + ("" if int(world["identified"]) else " *"), "end")
        svg.line(scale.begin, y, scale.end, y, "#f0f0f0")
        for key, mark, color, hollow, lift in (("least_squares_f_max_held", "dot", GIVEN, True, -4),
                                               ("least_squares_l_m0_held", "square", GIVEN, True, 5),
                                               ("f_max_held", "dot", PERSON, False, -4),
                                               ("l_m0_held", "square", PERSON, False, 5)):
            if world[key]:
                getattr(svg, mark)(scale(float(world[key])), y + lift, color, hollow)
    svg.text(10, bottom + 34, "* nothing is identified")
    svg.write("coverage_by_world.svg")


def estimates(result):
    return {(row["muscle"], row["parameter"]): row for row in rows_of(result / "parameters.csv")
            if row["method"] == "torque"}


def truths(recording):
    return {(row["muscle"], row["parameter"]): float(row["value"]) for row in rows_of(recording / "truth.csv")}


def smooth(values, at):
    """Density of the values' logarithms at points, by Gaussian kernels."""
    logs = [math.log(v) for v in values]
    mean = sum(logs) / len(logs)
    sd = (sum((x - mean) ** 2 for x in logs) / len(logs)) ** 0.5
    kernel = NormalDist(0.0, 1.06 * sd * len(logs) ** -0.2)
    return [sum(kernel.pdf(math.log(x) - v) for v in logs) for x in at]


def belief_and_readings(result, recording):
    row = estimates(result)["BIC", "max_isometric_force"]
    draws = [float(r["BIC.max_isometric_force"]) for r in rows_of(result / "posterior.csv")]
    value, low, high = (float(row["given_" + key]) for key in ("estimate", "ci_low", "ci_high"))
    mean = float(row["prior_mean"])
    prior = NormalDist(math.log(mean), float(row["prior_sd"]) / mean)
    given = NormalDist(math.log(value), math.log(high / low) / (2 * NORMAL))
    svg, scale, bottom = Svg(720, 300), Scale(400, 2400, 40, 690), 245
    axis(svg, scale, bottom, range(400, 2401, 400), "F_max of the demo's biceps [N]", 30)
    at = [400 + 10 * i for i in range(201)]
    curves = ((BELIEF, "belief", [prior.pdf(math.log(x)) for x in at]), (PERSON, "of the person", smooth(draws, at)),
              (GIVEN, "given geometry and sensors", [given.pdf(math.log(x)) for x in at]))
    for i, (color, label, density) in enumerate(curves):
        most = max(density)
        points = [(scale(x), bottom - 190 * p / most) for x, p in zip(at, density)]
        svg.path([(scale(at[0]), bottom), *points, (scale(at[-1]), bottom)], "none", 0, color, 0.15)
        svg.path(points, color)
        svg.line(480, 50 + 18 * i, 500, 50 + 18 * i, color, 2.5)
        svg.text(506, 54 + 18 * i, label)
    truth = truths(recording)["BIC", "max_isometric_force"]
    svg.line(scale(truth), 30, scale(truth), bottom, TRUTH, 1.2, "4 3")
    svg.text(scale(truth) + 5, 26, "truth")
    svg.text(40, 18, "Curves of the same height")
    svg.write("belief_and_readings.svg")


def two_readings(result, recording):
    rows, truth = estimates(result), truths(recording)
    top, step = 50, 20
    svg = Svg(720, top + step * 15 + 60)
    scale, bottom = Scale(65, 140, 270, 690), top + step * 15
    axis(svg, scale, bottom, range(70, 141, 10), "value over the truth [%]", top - 10)
    svg.line(scale(100), top - 10, scale(100), bottom, TRUTH, 1.2, "4 3")
    svg.line(270, 16, 300, 16, PERSON, 2)
    svg.text(306, 20, "of the person")
    svg.line(420, 16, 450, 16, GIVEN, 6)
    svg.text(456, 20, "given geometry and sensors")
    y = top
    for parameter, label in NUMBERS.items():
        for muscle, name in MUSCLES.items():
            row, true = rows[muscle, parameter], truth[muscle, parameter]
            share = {key: scale(100 * float(row[key]) / true) for key in
                     ("estimate", "ci_low", "ci_high", "given_estimate", "given_ci_low", "given_ci_high")}
            svg.text(260, y + 4, f"{label}, {name}", "end")
            svg.line(share["given_ci_low"], y, share["given_ci_high"], y, GIVEN, 6)
            svg.line(share["ci_low"], y, share["ci_high"], y, PERSON, 2)
            svg.line(share["estimate"], y - 6, share["estimate"], y + 6, PERSON, 2)
            y += step
        y += step
    svg.write("two_readings.svg")


def voluntary_torque(result, recording):
    rows = [row for row in rows_of(result / "voluntary_torque.csv") if row["owner"] == "BIC"]
    angle = [math.degrees(float(row["angle_rad"])) for row in rows]
    svg, across, up = Svg(720, 320), Scale(0, 140, 60, 690), Scale(0, 60, 265, 20)
    axis(svg, across, 265, range(0, 141, 20), "elbow angle [°]", 20)
    for tick in range(0, 61, 20):
        svg.line(60, up(tick), 690, up(tick), "#e3e3e3")
        svg.text(54, up(tick) + 4, f"{tick:g}", "end")
    svg.text(66, 30, "N m")
    for low, high, color, opacity in (("low_nm", "high_nm", PERSON, 0.25),
                                      ("given_low_nm", "given_high_nm", GIVEN, 0.45)):
        band = [(across(q), up(float(row[high]))) for q, row in zip(angle, rows)]
        band += [(across(q), up(float(row[low]))) for q, row in reversed(list(zip(angle, rows)))]
        svg.path([*band, band[0]], "none", 0, color, opacity)
    svg.path([(across(q), up(float(row["torque_nm"]))) for q, row in zip(angle, rows)], PERSON)
    true = truths(recording)
    at = math.degrees(true["BIC", "voluntary_torque_angle"])
    svg.dot(across(at), up(true["BIC", "voluntary_torque"]), TRUTH)
    for i, (color, label) in enumerate(((PERSON, "of the person, band of 95 %"), (GIVEN, "given geometry and sensors"))):
        svg.line(300, 200 + 18 * i, 320, 200 + 18 * i, color, 4)
        svg.text(326, 204 + 18 * i, label)
    svg.dot(310, 236, TRUTH)
    svg.text(326, 240, "truth of the maximum")
    svg.write("voluntary_torque.svg")


def main():
    if len(sys.argv) not in (1, 3):
        sys.exit(__doc__)
    coverage()
    if len(sys.argv) == 3:
        result, recording = Path(sys.argv[1]), Path(sys.argv[2])
        belief_and_readings(result, recording)
        two_readings(result, recording)
        voluntary_torque(result, recording)


if __name__ == "__main__":
    main()
