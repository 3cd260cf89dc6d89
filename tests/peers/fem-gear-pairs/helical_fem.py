#!/usr/bin/env python3
"""Helical pairs as solids against thin slices, by finite elements (gmsh, CalculiX's matrices,
scipy's solver): README.md. Writes helical.h5.

Usage: helical_fem.py [--size F] [--layers N] [--out helical.h5] [--only CASE]

solid: the drawn gears; slices: mean over the slices in contact; _weber: with Weber and Banaschek's
contact instead of the linear one. Lengths in mm, forces in N; stiffness in N/m.
"""
import argparse
import math
import os
import tempfile

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from pairs_fem import linear_hertz, stiffness, tooth_outline
from plane_fem import Geometry, Mesh, run_ccx, table_file
from teeth import Contact, Gear, Pair, weber


class HelicalPair(Pair):
    def __init__(self, teeth, normal_module, helix, width, held, force):
        helix, cosine = math.radians(helix), math.cos(math.radians(helix))
        angle = math.atan(math.tan(math.radians(20)) / cosine)
        gears = [Gear(z, normal_module / cosine, held=h, angle=angle, addendum=cosine,
                      dedendum=1.25 * cosine) for z, h in zip(teeth, held)]
        super().__init__(*gears, sum(teeth) * normal_module / cosine / 2, (2.06e5, 0.3, width), force)
        self.overlap = width * math.sin(helix) / (math.pi * normal_module)
        self.base_lean = self.overlap * self.base_pitch / width  # tangent of the base helix angle

    def slice_tau(self, tau, z):
        """Position tau of the slice at z, 0 to the width; tau counts from the first slice's
        engagement."""
        return tau - self.overlap * z / self.material[2]

    def local_compliance(self, tau, width_in_contact):
        """Compliance of the contact, between the flanks and the teeth's centre lines, in mm
        per N/mm, for a pair of slices in contact at tau: linear, and Weber and Banaschek's
        for an evenly distributed load."""
        young, poisson, width = self.material
        lean = math.sqrt(1 + self.base_lean**2)
        rolls = self.rolls(tau)
        modulus = young / (2 * (1 - poisson**2))
        half = math.sqrt(4 * self.force / width_in_contact * lean
                         / (math.pi * modulus * (1 / rolls[0] + 1 / rolls[1])))
        deep = sum(weber(Contact(gear, 0, roll, half), poisson)
                   for gear, roll in zip(self.gears, rolls))
        return np.array([linear_hertz(self.material) * width,
                         2 * (1 - poisson**2) / (math.pi * young) * deep]) * lean

    def twist(self, which, z):
        sign = -1 if which == 1 else 1
        teeth = self.gears[which - 1].teeth
        return sign * self.overlap * z / self.material[2] * 2 * math.pi / teeth


def stage(helix, width, force):
    return HelicalPair((21, 39), 12.0, helix, width, (50.0, 135.0), force)


# The pair and the layers of its mesh.
CASES = {"helix-8": (lambda: stage(8.0, 280.0, 3.9e5), 12),
         "helix-20": (lambda: stage(20.0, 120.0, 1.67e5), 12),
         "helix-20-wide": (lambda: stage(20.0, 240.0, 3.34e5), 14),
         "helix-0.5": (lambda: stage(0.5, 120.0, 1.67e5), 8),
         "helix-0.5-wide": (lambda: stage(0.5, 240.0, 3.34e5), 10)}


def section(size, gear, teeth):
    """Transverse section: a disc of the root circle with some teeth, quadratic triangles."""
    geo, loop = Geometry(size), []
    outlines = [tooth_outline(geo, gear, tooth) for tooth in teeth]
    for (curves, _, _, last), (_, _, following, _) in zip(outlines, outlines[1:]):
        loop += curves + [geo.curve("Circle", [last, (0, 0), following])]
    loop += outlines[-1][0]
    # Return along the root circle, in parts below a half turn.
    first, last = outlines[0][2], outlines[-1][3]
    begin = math.atan2(last[1], last[0])
    span = (math.atan2(first[1], first[0]) - begin) % (2 * math.pi)
    stops = [last] + [(gear.root * math.cos(begin + span * part), gear.root * math.sin(begin + span * part))
                      for part in (0.25, 0.5, 0.75)] + [first]
    loop += [geo.curve("Circle", [a, (0, 0), b]) for a, b in zip(stops, stops[1:])]
    held = geo.circle(gear.held)
    for tooth in teeth[1:-1]:
        turn = 2 * math.pi * tooth / gear.teeth
        radius = 0.5 * (gear.root + gear.tip)
        geo.refine((radius * math.cos(turn), radius * math.sin(turn)), 0.32 * gear.module, 0.25)
    geo.background(f"{2.0 * gear.module}")
    with tempfile.TemporaryDirectory() as folder:
        return Mesh(geo.finish([loop, held], [], held), folder)


class Solid:
    """A section extruded along the axis with a twist, in layers of 15-node wedges; fixed at the
    bore. plane: no displacement along the axis (a slice in plane strain)."""

    def __init__(self, mesh, heights, twist, material, plane=False):
        self.mesh, self.heights, self.twist = mesh, heights, twist
        corners = {n for t in mesh.triangles for n in t[:3]}
        self.number, places = {}, []
        for k, z in enumerate(heights):
            for n in mesh.nodes:
                self.add(places, (n, 2 * k), z)
            if k + 1 < len(heights):
                for n in corners:
                    self.add(places, (n, 2 * k + 1), 0.5 * (z + heights[k + 1]))
        self.wedges = [[self.number[key] for key in self.keys(t, k)]
                       for k in range(len(heights) - 1) for t in mesh.triangles]
        held = {n for e in mesh.edges[2] for n in e}
        fixed = [v for (n, _), v in self.number.items() if n in held]
        self.factors, self.dof = self.factorise(places, fixed, material, plane)
        self.corner = np.array([[mesh.nodes[n] for n in t[:3]] for t in mesh.triangles])

    def add(self, places, key, z):
        x, y = self.mesh.nodes[key[0]]
        c, s = math.cos(self.twist(z)), math.sin(self.twist(z))
        places.append((c * x - s * y, s * x + c * y, z))
        self.number[key] = len(places)

    @staticmethod
    def keys(triangle, k):
        """Node order of CalculiX: bottom, top, bottom's edges, top's edges, between."""
        a, b = triangle[:3], triangle[3:]
        return ([(n, 2 * k) for n in a] + [(n, 2 * k + 2) for n in a] + [(n, 2 * k) for n in b]
                + [(n, 2 * k + 2) for n in b] + [(n, 2 * k + 1) for n in a])

    def factorise(self, places, fixed, material, plane):
        text = ["*NODE, NSET=ALL"]
        text += [f"{i + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for i, (x, y, z) in enumerate(places)]
        text.append("*ELEMENT, TYPE=C3D15, ELSET=BODY")
        text += [f"{i + 1}, " + ", ".join(map(str, w[:8])) + ",\n" + ", ".join(map(str, w[8:]))
                 for i, w in enumerate(self.wedges)]
        text += ["*MATERIAL, NAME=M", "*ELASTIC", f"{material[0]}, {material[1]}", "*DENSITY", "1",
                 "*SOLID SECTION, ELSET=BODY, MATERIAL=M", "*BOUNDARY"]
        text += [f"{n}, 1, 3" for n in fixed] + (["ALL, 3, 3"] if plane else [])
        text += ["*STEP", "*FREQUENCY, SOLVER=MATRIXSTORAGE", "*END STEP"]
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "g.inp"), "w") as f:
                f.write("\n".join(text) + "\n")
            run_ccx(folder)
            with open(os.path.join(folder, "g.dof")) as f:
                dof = {line.strip(): i for i, line in enumerate(f)}
            upper = np.loadtxt(os.path.join(folder, "g.sti"))
        row, column = upper[:, 0].astype(int) - 1, upper[:, 1].astype(int) - 1
        half = sparse.coo_matrix((upper[:, 2], (row, column)), shape=(len(dof), len(dof))).tocsc()
        whole = half + half.T - sparse.diags(half.diagonal())
        return splu(whole.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
                    options={"SymmetricMode": True}), dof

    def weights(self, point, z):
        """Shape functions at a point of the untwisted section: {node: weight}."""
        a, b, c = self.corner[:, 0], self.corner[:, 1], self.corner[:, 2]
        cross = lambda u, v: u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        area = cross(b - a, c - a)
        l2, l3 = cross(point - a, c - a) / area, cross(b - a, point - a) / area
        at = int(np.argmax(np.minimum(np.minimum(l2, l3), 1 - l2 - l3)))
        l = np.clip([1 - l2[at] - l3[at], l2[at], l3[at]], 0, 1)
        l /= l.sum()
        k = min(int(np.searchsorted(self.heights, z, side="right")) - 1, len(self.heights) - 2)
        t = 2 * (z - self.heights[k]) / (self.heights[k + 1] - self.heights[k]) - 1
        edges = [l[0] * l[1], l[1] * l[2], l[2] * l[0]]
        shape = ([0.5 * v * ((2 * v - 1) * (1 - t) - (1 - t * t)) for v in l]
                 + [0.5 * v * ((2 * v - 1) * (1 + t) - (1 - t * t)) for v in l]
                 + [2 * e * (1 - t) for e in edges] + [2 * e * (1 + t) for e in edges]
                 + [v * (1 - t * t) for v in l])
        return zip([self.number[key] for key in self.keys(self.mesh.triangles[at], k)], shape)

    def put(self, column, point, z, vector, weight):
        """Adds the force (or the measured displacement) `vector` with that weight, given
        untwisted."""
        c, s = math.cos(self.twist(z)), math.sin(self.twist(z))
        turned = (c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2])
        for node, shape in self.weights(point, z):
            for d in range(3):
                at = self.dof.get(f"{node}.{d + 1}")
                if at is not None:
                    column[at] += weight * shape * turned[d]


class Segment:
    """A stretch of a pair's contact line, z from low to high."""

    def __init__(self, pair, tooth, tau, low, high):
        self.tooth, self.tau, self.low, self.high = tooth, tau, low, high
        self.length = high - low

    def middle(self, pair):
        """Mesh periods since contact began at its middle."""
        return pair.slice_tau(self.tau, 0.5 * (self.low + self.high))

    def columns(self, solid, pair, which, lean):
        """Unit load on the flank, and mean displacement of the centre line beneath. lean 0:
        a slice in contact at tau throughout."""
        load, seen = np.zeros(len(solid.dof)), np.zeros(len(solid.dof))
        for x, w in zip(*np.polynomial.legendre.leggauss(4)):
            z = 0.5 * (self.low + self.high) + 0.5 * self.length * x
            tooth = self.tooth if which == 1 else -self.tooth
            tau = pair.slice_tau(self.tau, z) if lean else self.tau
            contact = Contact(pair.gears[which - 1], tooth, pair.rolls(tau)[which - 1], 0.0)
            vector = (*contact.direction, -lean if which == 1 else lean)
            solid.put(load, contact.point, z, vector, 0.5 * w)
            solid.put(seen, contact.beneath(), z, vector, 0.5 * w)
        return load, seen


def compliance(solid, pair, which, segments, lean):
    both = [s.columns(solid, pair, which, lean) for s in segments]
    moved = solid.factors.solve(np.array([load for load, _ in both]).T)
    matrix = np.array([seen for _, seen in both]) @ moved
    return 0.5 * (matrix + matrix.T)


def line_segments(pair, tooth, tau, count):
    """Segments of the stretch in contact at tau, about as long as a `count`th of the width."""
    width = pair.material[2]
    low = max(0.0, (tau - pair.contact_ratio) / pair.overlap * width)
    high = min(width, tau / pair.overlap * width)
    if high - low < 1e-6 * width:
        return []
    parts = max(1, round((high - low) / width * count))
    stops = np.linspace(low, high, parts + 1)
    return [Segment(pair, tooth, tau, a, b) for a, b in zip(stops, stops[1:])]


def drawn(pair, which, mesh, layers):
    return Solid(mesh, np.linspace(0, pair.material[2], layers + 1),
                 lambda z: pair.twist(which, z), pair.material)


def sliced(pair, which, mesh):
    """One millimetre of the section in plane strain."""
    return Solid(mesh, np.array([0.0, 1.0]), lambda z: 0.0, pair.material, plane=True)


def with_contacts(pair, matrix, segments):
    """Stiffness with the linear contact and with Weber and Banaschek's."""
    touched = sum(s.length for s in segments)
    local = np.array([pair.local_compliance(s.middle(pair), touched) / s.length for s in segments])
    return np.array([stiffness(matrix + np.diag(c)) for c in local.T])


def lines_at(pair, phase, count):
    return [s for i in range(math.ceil(pair.contact_ratio + pair.overlap))
            for s in line_segments(pair, i, phase + i, count)]


def solid_rows(pair, sections, layers, phases):
    """At each phase: the mesh, and each of its pairs alone."""
    lines = [lines_at(pair, p, layers) for p in phases]
    every = sum(lines, [])
    both = sum(compliance(drawn(pair, which, sections[which - 1], layers), pair, which, every,
                          pair.base_lean) for which in (1, 2))
    rows, at = [], 0
    for p, line in zip(phases, lines):
        own = np.arange(at, at + len(line))
        at += len(line)
        alone = []
        for i in sorted({s.tooth for s in line}):
            mine = [k for k in own if every[k].tooth == i]
            alone.append((p + i, with_contacts(pair, both[np.ix_(mine, mine)],
                                               [every[k] for k in mine])))
        rows.append((p, with_contacts(pair, both[np.ix_(own, own)], line), alone))
    return rows


def slice_curves(pair, sections):
    """Stiffness per mm of the slices' spur pairs: functions of the phase (mesh) and of tau (one
    pair), and of the length of all contact lines."""
    solids = [sliced(pair, which, sections[which - 1]) for which in (1, 2)]
    found = {}

    def matrix(taus):
        segments = [Segment(pair, tooth, tau, 0.0, 1.0) for tooth, tau in taus]
        return sum(compliance(s, pair, w, segments, 0.0) for w, s in zip((1, 2), solids))

    def curve(taus, touched):
        if taus not in found:
            found[taus] = matrix(taus)
        local = np.array([pair.local_compliance(tau, touched) for _, tau in taus])
        return np.array([stiffness(found[taus] + np.diag(c)) for c in local.T])

    def mesh(phase, touched):
        phase -= math.floor(phase)
        return curve(tuple((i, phase + i) for i in range(4) if phase + i < pair.contact_ratio),
                     touched)

    return mesh, lambda tau, touched: curve(((0, tau),), touched)


def mean(curve, low, high, breaks):
    """Integral between low and high over pieces, by Gauss."""
    total, stops = 0.0, [low] + sorted(b for b in breaks if low < b < high) + [high]
    for a, b in zip(stops, stops[1:]):
        for x, w in zip(*np.polynomial.legendre.leggauss(3)):
            total += 0.5 * (b - a) * w * curve(0.5 * (a + b) + 0.5 * (b - a) * x)
    return total


def rows(name, size, layers):
    pair = CASES[name][0]()
    most = math.ceil(pair.contact_ratio + pair.overlap)
    sections = [section(size, pair.gears[0], range(-1, most + 1)),
                section(size, pair.gears[1], range(-most, 2))]
    mesh, one = slice_curves(pair, sections)
    ratio, e, width = pair.contact_ratio, pair.overlap, pair.material[2]
    breaks = [k + part for k in range(-2, 4) for part in (0, ratio - math.floor(ratio))]
    touched = lambda tau: (min(ratio, tau) - max(0.0, tau - e)) / e * width
    found = []
    for phase, total, alone in solid_rows(pair, sections, layers, (0.1, 0.3, 0.5, 0.7, 0.9)):
        length = sum(touched(tau) for tau, _ in alone)
        slices = width / e * mean(lambda t: mesh(t, length), phase - e, phase, breaks)
        found.append(("mesh", phase, total, slices))
        for tau, own in alone:
            length = touched(tau)
            slices = width / e * mean(lambda t: one(t, length), max(0.0, tau - e),
                                      min(ratio, tau), [])
            found.append(("pair", tau, own, slices))
    return found


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=float, default=1.0, help="factor on the section's elements")
    parser.add_argument("--layers", type=int, help="instead of the case's own")
    parser.add_argument("--out", default="helical.h5")
    parser.add_argument("--only", choices=sorted(CASES))
    chosen = parser.parse_args()
    with table_file(chosen.out) as f:
        f.write("case,what,tau,solid_N_m,slices_N_m,solid_weber_N_m,slices_weber_N_m\n")
        for name in [chosen.only] if chosen.only else CASES:
            for what, tau, solid, slices in rows(name, chosen.size,
                                                  chosen.layers or CASES[name][1]):
                values = ",".join(f"{v[i]:.6g}" for i in (0, 1) for v in (solid, slices))
                f.write(f"{name},{what},{tau:.6f},{values}\n")
                print(name, what, f"{tau:.4f}", values, solid / slices, flush=True)
