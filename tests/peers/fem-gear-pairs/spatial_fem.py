#!/usr/bin/env python3
"""Spatial cracks (depth changes along the face) as solids, by finite elements (gmsh, CalculiX's
matrices, scipy's solver): README.md. Writes spatial.h5.

Usage: spatial_fem.py [--size F] [--layers N] [--out spatial.h5] [--only TOOTH ...] [--plane]
       spatial_fem.py --check

Lengths in mm, forces in N; stiffness in N/m.
"""
import argparse
import copy
import itertools
import math
import tempfile

import numpy as np

from cracks_fem import PHASES, TEETH, contacts_of, depth_of, pair_of, touching
from helical_fem import Solid
from pairs_fem import STEEL, Slit, put, stiffness, tooth_outline
from plane_fem import Geometry, Mesh, table_file
from teeth import weber

WIDTH = STEEL[2]
SHARES = (0.1, 0.25, 0.4, 0.6)
TOOTH_NAMES = ("sun", "planet-sun", "planet-ring", "ring")
SIZE, LAYERS = 1.6, 8
# Lengths along the face and end depths (relative to the deepest one) of Yang's parabola.
SHAPES = {"through": (1.0, 1.0), "half": (0.5, 0.0), "face": (1.0, 0.0), "face-half-depth": (1.0, 0.5)}


def depth_at(shape, deepest, z):
    """Depth of the crack at the position z along the face (src/stiffness/faults/spatial_crack.hpp)."""
    length, end = SHAPES[shape]
    t = z / (length * WIDTH)
    return deepest * math.sqrt(max(0.0, 1 + (end**2 - 1) * t)) if t < 1 + 1e-9 else 0.0


# Depths of the nodes along the slit, relative to the section; closer about the deepest points.
STOPS = (0, 0.05, 0.075, 0.1, 0.125, 0.15, 0.2, 0.225, 0.25, 0.275, 0.3, 0.35, 0.375, 0.4, 0.425, 0.45, 0.5,
         0.55, 0.575, 0.6, 0.625)


def layer_depths(shape, deepest, stops, heights):
    """Depth of each layer: a node's. The difference from the profile's squared depth at the layer's
    middle is carried to the next layer. The deepest layer has at most the depth `deepest`."""
    depths, carried = [], 0.0
    for z in 0.5 * (heights[1:] + heights[:-1]):
        here = depth_at(shape, deepest, z)
        square = here**2 + carried if here else 0.0
        depths.append(min((d for d in stops if d < deepest + 1e-9), key=lambda d: abs(d * d - square)))
        carried = square - depths[-1]**2
    return depths


class Section:
    """Transverse section of a gear: the loaded tooth and one more on either side on the body, with a
    line of nodes along the slit."""

    def __init__(self, size, gear, stops=()):
        self.gear, self.stops = gear, list(stops)
        geo, drawn, line = Geometry(size), gear, []
        if self.stops:
            points = [self.place(d) for d in self.stops]
            if not gear.internal:
                drawn = copy.copy(gear)
                slit = Slit(gear, self.stops[-1])
                slit.WIDTH = 0.0
                above, below = slit.foot_parts()
                above[-1][-1] = below[0][0] = points[0] = tuple(slit.start)
                drawn.foot = lambda: above + below
        loop = self.loop(geo, drawn)
        held = self.body(geo, drawn, loop)
        if self.stops:
            line = [geo.curve("Line", [a, b]) for a, b in zip(points, points[1:])]
            gaps = np.diff(self.stops)
            for i, point in enumerate(points):
                geo.refine(point, min(gaps[max(0, i - 1):i + 1]) / size, 0.45)
        for tooth in (-1, 0, 1):
            turn = 2 * math.pi * tooth / gear.teeth
            radius = 0.5 * (gear.root + gear.tip)
            geo.refine((radius * math.cos(turn), radius * math.sin(turn)),
                       (0.3 if tooth == 0 else 0.6) * gear.module, 0.4)
        geo.background(f"{3.0 * gear.module}")
        loops = [loop] if gear.internal else [loop, held]
        text = geo.finish(loops, [line] if line else [], held)
        if line:
            curves = ", ".join(map(str, line))
            text += f"Transfinite Curve{{{curves}}} = 2;\nCurve{{{curves}}} In Surface{{1}};\n"
        with tempfile.TemporaryDirectory() as folder:
            self.mesh = Mesh(text, folder)
        self.find_sides()

    def place(self, depth):
        return tuple(Slit(self.gear, depth).tip) if depth else tuple(self.gear.critical_point())

    def loop(self, geo, gear):
        outlines = [tooth_outline(geo, gear, tooth) for tooth in (-1, 0, 1)]
        loop = list(outlines[0][0])
        for (_, _, _, last), (curves, _, following, _) in zip(outlines, outlines[1:]):
            loop += [geo.curve("Circle", [last, (0, 0), following])] + curves
        self.first, self.last = outlines[0][2], outlines[-1][3]
        return loop

    def body(self, geo, gear, loop):
        """Closes the loop by the body; returns the curves that are fixed. A ring is a sector of 60
        degrees, fixed at its outer circle and its cuts."""
        angle = lambda p: math.atan2(p[1], p[0])
        at = lambda radius, turn: (radius * math.cos(turn), radius * math.sin(turn))
        arc = lambda a, b: geo.curve("Circle", [a, (0, 0), b])
        if gear.internal:
            low, high = math.radians(-30), math.radians(30)
            held = [geo.curve("Line", [at(gear.root, high), at(gear.held, high)]),
                    arc(at(gear.held, high), at(gear.held, 0)), arc(at(gear.held, 0), at(gear.held, low)),
                    geo.curve("Line", [at(gear.held, low), at(gear.root, low)])]
            loop += [arc(self.last, at(gear.root, high))] + held + [arc(at(gear.root, low), self.first)]
            return held
        begin = angle(self.last)
        span = (angle(self.first) - begin) % (2 * math.pi)
        stops = [self.last] + [at(gear.root, begin + span * part) for part in (0.25, 0.5, 0.75)] + [self.first]
        loop += [arc(a, b) for a, b in zip(stops, stops[1:])]
        return geo.circle(gear.held)

    def find_sides(self):
        """Nodes of the slit by their depth, and the triangles on its lower side at each node."""
        self.edges, self.lower = [], set()
        if not self.stops:
            return
        depth_of_node = {}
        corners = {n for e in self.mesh.edges[3] for n in e[:2]}
        for stop in self.stops:
            node = min(corners, key=lambda n: np.hypot(*(self.mesh.nodes[n] - self.place(stop))))
            assert np.hypot(*(self.mesh.nodes[node] - self.place(stop))) < 1e-6
            depth_of_node[node] = stop
        assert len(depth_of_node) == len(corners) == len(self.stops)
        chain = sorted(depth_of_node, key=depth_of_node.get)
        middle = {frozenset(e[:2]): e[2] for e in self.mesh.edges[3]}
        self.edges = [(a, middle[frozenset((a, b))], b) for a, b in zip(chain, chain[1:])]
        on_slit = {frozenset((a, b)) for a, _, b in self.edges}
        forward = {(a, b) for a, _, b in self.edges}
        around = {n: [t for t in self.mesh.triangles if n in t[:3]] for n in chain}
        sides = lambda t: [(t[i], t[(i + 1) % 3]) for i in range(3)]
        for node in chain[:-1]:
            grown = [t for t in around[node] if any(s in forward for s in sides(t) if node in s)]
            done = {tuple(t) for t in grown}
            while grown:
                here = grown.pop()
                joins = {frozenset(s) for s in sides(here) if node in s} - on_slit
                for t in around[node]:
                    if tuple(t) not in done and joins & {frozenset(s) for s in sides(t)}:
                        done.add(tuple(t))
                        grown.append(t)
            assert len(done) < len(around[node])
            self.lower |= {(t, node) for t in done}
        for _, mid, _ in self.edges:
            self.lower |= {(tuple(t), mid) for t in self.mesh.triangles
                           if mid in t[3:] and any(s in forward for s in sides(t))}


class CrackedSolid(Solid):
    """A section extruded along the axis in layers of 15-node wedges. depths: of the crack, by
    layer. plane: no displacement along the axis."""

    def __init__(self, section, heights, depths=None, plane=False):
        self.section, self.mesh, self.heights = section, section.mesh, np.asarray(heights)
        self.twist = lambda z: 0.0
        mesh, layers = section.mesh, len(heights) - 1
        self.split = self.opened(depths or [0.0] * layers)
        corners = {n for t in mesh.triangles for n in t[:3]}
        self.number, places = {}, []
        for level in range(2 * layers + 1):
            z = 0.5 * (heights[level // 2] + heights[(level + 1) // 2])
            for n in mesh.nodes if level % 2 == 0 else corners:
                self.add(places, (n, level), z)
                if (n, level) in self.split:
                    self.add(places, (n, level, 1), z)
        self.wedges = [[self.number[key] for key in self.keys(t, k)]
                       for k in range(layers) for t in mesh.triangles]
        held = {n for e in mesh.edges[2] for n in e}
        fixed = [v for key, v in self.number.items() if key[0] in held]
        self.factors, self.dof = self.factorise(places, fixed, STEEL, plane)
        self.corner = np.array([[mesh.nodes[n] for n in t[:3]] for t in mesh.triangles])

    def opened(self, depths):
        """Nodes of the slit at which every adjoining face of the slit is open."""
        edges, stops, faces = self.section.edges, self.section.stops, {}
        for k, depth in enumerate(depths):
            for i, (a, mid, b) in enumerate(edges):
                is_open = stops[i + 1] <= depth + 1e-5
                for n in (a, mid, b):
                    for level in (2 * k, 2 * k + 2) if n == mid else (2 * k, 2 * k + 1, 2 * k + 2):
                        faces.setdefault((n, level), []).append(is_open)
        last = edges[-1][2] if edges else None
        return {key for key, found in faces.items() if all(found) and key[0] != last}

    def keys(self, triangle, k):
        name = tuple(triangle)
        return [(*key, 1) if key in self.split and (name, key[0]) in self.section.lower else key
                for key in Solid.keys(triangle, k)]

    def columns(self, contacts):
        """For each contact and layer: a unit load on the flank, and the mean displacement of the
        centre line."""
        layers = list(zip(self.heights, self.heights[1:]))
        loads, seen = [np.zeros((len(self.dof), len(contacts) * len(layers))) for _ in range(2)]
        for k, (contact, (low, high)) in enumerate(itertools.product(contacts, layers)):
            vector = (*contact.direction, 0.0)
            for x, w in zip(*np.polynomial.legendre.leggauss(3)):
                z = 0.5 * (low + high) + 0.5 * (high - low) * x
                self.put(loads[:, k], contact.point, z, vector, 0.5 * w)
                self.put(seen[:, k], contact.beneath(), z, vector, 0.5 * w)
        return loads, seen


def centre_matrix(solid, contacts):
    """Compliances of the centre lines between contacts and layers, mm/N."""
    loads, seen = solid.columns(contacts)
    centre = seen.T @ solid.factors.solve(loads)
    return 0.5 * (centre + centre.T)


class CrackedGear:
    """Solid with the deepest slit open across the face, factorised once. Forces between the lips
    close it where a crack does not reach."""

    def __init__(self, section, heights, contacts, plane=False):
        self.solid = solid = CrackedSolid(section, heights, [section.stops[-2]] * (len(heights) - 1), plane)
        self.lips = sorted(solid.split)
        loads, seen = solid.columns(contacts)
        moved = solid.factors.solve(loads)
        dofs = [[(solid.dof[f"{solid.number[key]}.{d}"], solid.dof[f"{solid.number[(*key, 1)]}.{d}"])
                 for d in (1, 2, 3) if f"{solid.number[key]}.{d}" in solid.dof] for key in self.lips]
        self.of_lip = np.repeat(np.arange(len(dofs)), [len(d) for d in dofs])
        upper, lower = np.array([d for lip in dofs for d in lip]).T
        self.between = np.zeros((len(upper), len(upper)))  # compliance between the lips
        centre = np.zeros((loads.shape[1], len(upper)))
        for at in range(0, len(upper), 100):
            part = np.arange(at, min(at + 100, len(upper)))
            pulls = np.zeros((len(solid.dof), len(part)))
            pulls[upper[part], np.arange(len(part))] = 1
            pulls[lower[part], np.arange(len(part))] -= 1
            relative = solid.factors.solve(pulls)
            self.between[:, part] = relative[upper] - relative[lower]
            centre[:, part] = seen.T @ relative
        self.open, self.opening = loads.T @ moved, moved[upper] - moved[lower]
        middle = seen.T @ moved - centre @ np.linalg.solve(self.between, self.opening)
        self.centre = 0.5 * (middle + middle.T)  # of the healthy gear
        self.healthy = self.flank([0.0] * (len(heights) - 1))

    def flank(self, depths):
        """Compliances of the flanks between contacts and layers, mm/N, with a crack of these depths."""
        is_open = self.solid.opened(depths)
        shut = np.array([key not in is_open for key in self.lips])[self.of_lip]
        if not shut.any():
            return self.open
        opening = self.opening[shut]
        return self.open - opening.T @ np.linalg.solve(self.between[np.ix_(shut, shut)], opening)

    def added(self, depths):
        return self.flank(depths) - self.healthy


def local_compliance(contacts):
    """Compliance of the contact between both centre lines, mm per N/mm: Weber and Banaschek's, times
    1.09, which plane elements of these gears show (README.md)."""
    return (1.09 * 2 * (1 - STEEL[1]**2) / (math.pi * STEEL[0])
            * sum(weber(c, STEEL[1]) for c in contacts))


class Model:
    """Solids of a tooth's gear and its mate. groups: pairs in contact, of touching()."""

    def __init__(self, size, layers, tooth, plane=False):
        mate, which, _ = TEETH[tooth]
        self.pair = pair_of(mate, "fillet")
        self.groups = list(touching(self.pair, PHASES))
        own, other = [[contacts_of(self.pair, w, *group) for group in self.groups]
                      for w in (which, 3 - which)]
        gear, mate_gear = self.pair.gears[which - 1], self.pair.gears[2 - which]
        self.heights = np.array([0.0, WIDTH]) if plane else np.linspace(0, WIDTH, layers + 1)
        self.section_length = depth_of(gear, 1.0)
        self.stops = [self.section_length * s for s in STOPS]
        self.gear = CrackedGear(Section(size, gear, self.stops), self.heights, sum(own, []), plane)
        layer = np.diff(self.heights)
        local = [local_compliance(both) for both in zip(sum(own, []), sum(other, []))]
        self.healthy = (self.gear.centre + np.diag(np.outer(local, 1 / layer).ravel())
                        + centre_matrix(CrackedSolid(Section(size, mate_gear), self.heights, None, plane),
                                        sum(other, [])))
        ends = len(layer) * np.cumsum([0] + [len(taus) for taus, _ in self.groups])
        self.parts = [slice(a, b) for a, b in zip(ends, ends[1:])]

    def rows(self, shape, share):
        """For each of the groups, mesh stiffness in N/m without and with the crack: with equal
        approach of all pairs across the face, and for a load that each pair carries evenly; and the
        healthy cracked pair's share of the load."""
        depths = layer_depths(shape, share * self.section_length, self.stops, self.heights)
        cracked = self.healthy + self.gear.added(depths)
        for (taus, at), part in zip(self.groups, self.parts):
            both = [m[part, part] for m in (self.healthy, cracked)]
            even = np.kron(np.eye(len(taus)), np.diff(self.heights)[:, None] / WIDTH)
            load = np.linalg.inv(both[0]).sum(axis=1).reshape(len(taus), -1).sum(axis=1)
            yield ([stiffness(m) for m in both] + [stiffness(even.T @ m @ even) for m in both]
                   + [load[at] / load.sum()])


def check(size=2.4, layers=4):
    """Compliance that a crack over half of the face adds, between contacts and layers: by forces between the lips,
    and by a solid of its own. Returns the largest difference over the largest entry."""
    pair = pair_of("sun", "fillet")
    gear, length = pair.gears[0], depth_of(pair.gears[0], 1.0)
    contacts = sum((contacts_of(pair, 1, *group) for group in touching(pair, PHASES)), [])
    section, heights = Section(size, gear, [length * s for s in STOPS]), np.linspace(0, WIDTH, layers + 1)
    depths = layer_depths("half", 0.4 * length, section.stops, heights)
    by_forces = CrackedGear(section, heights, contacts).added(depths)
    found = []
    for opened in (depths, None):
        solid = CrackedSolid(section, heights, opened)
        loads = solid.columns(contacts)[0]
        found.append(loads.T @ solid.factors.solve(loads))
    own = found[0] - found[1]
    return np.abs(by_forces - own).max() / np.abs(own).max()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=float, default=SIZE, help="factor on all element sizes")
    parser.add_argument("--layers", type=int, default=LAYERS)
    parser.add_argument("--out", default="spatial.h5")
    parser.add_argument("--only", nargs="*", default=TOOTH_NAMES, help="teeth")
    parser.add_argument("--plane", action="store_true", help="plane strain: through cracks only")
    parser.add_argument("--check", action="store_true", help="forces between the lips")
    chosen = parser.parse_args()
    if chosen.check:
        print(f"largest difference {check():.1e}")
        return
    with table_file(chosen.out) as table:
        put(table, "tooth,shape,share,depth_mm,end_depth_mm,length_mm,phase,pairs,cracked,healthy_N_m,cracked_N_m,"
                   "even_healthy_N_m,even_cracked_N_m,load_share")
        for tooth in chosen.only:
            model = Model(chosen.size, chosen.layers, tooth, chosen.plane)
            for shape in ("through",) if chosen.plane else SHAPES:
                length, end = SHAPES[shape]
                for share in SHARES:
                    depth = share * model.section_length
                    for (taus, cracked), row in zip(model.groups, model.rows(shape, share)):
                        values = ",".join(f"{v:.6g}" for v in row)
                        put(table, f"{tooth},{shape},{share:g},{depth:.6f},{end * depth:.6f},"
                                   f"{length * WIDTH:g},{taus[0]:.6f},{len(taus)},{cracked},{values}")


if __name__ == "__main__":
    main()
