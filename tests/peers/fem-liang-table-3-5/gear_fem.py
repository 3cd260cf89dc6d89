#!/usr/bin/env python3
"""Mesh stiffness of Liang (2016), Table 3.4, by plane-strain finite elements (gmsh, CalculiX).

Writes table.csv (README.md says what its columns are) and prints the checks. Lengths in mm, forces
in N. Usage: gear_fem.py [--size F] [--out table.csv] [--only checks|table]
"""
import argparse
import math
import os
import subprocess
import tempfile

import numpy as np

TEETH, MODULE, PRESSURE_ANGLE = 23, 6.0, math.radians(20)
YOUNG, POISSON, WIDTH = 69e3, 0.33, 15.0
CRACK, CRACK_ANGLE = 4.7, math.radians(45)
BORE = 25.0  # the thesis gives none
TORQUE = 60e3  # N mm; sets the width of the contact only

PITCH_RADIUS = MODULE * TEETH / 2
BASE = PITCH_RADIUS * math.cos(PRESSURE_ANGLE)
TIP, ROOT = PITCH_RADIUS + MODULE, PITCH_RADIUS - 1.25 * MODULE
HALF_BASE_ANGLE = math.pi / (2 * TEETH) + math.tan(PRESSURE_ANGLE) - PRESSURE_ANGLE
HALF_ROOT = BASE * math.sin(HALF_BASE_ANGLE)
BASE_PITCH = 2 * math.pi * BASE / TEETH
LINEAR_HERTZ = 4 * (1 - POISSON**2) / (math.pi * YOUNG * WIDTH)  # mm/N
LINE = 2 * PITCH_RADIUS * math.sin(PRESSURE_ANGLE)  # between the base circles' tangent points
ROLL_START = LINE - math.sqrt(TIP**2 - BASE**2)
CONTACT_RATIO = (LINE - 2 * ROLL_START) / BASE_PITCH


def roll(tau):
    """Distance of the contact from gear 1's tangent point, tau mesh periods after engagement."""
    return ROLL_START + tau * BASE_PITCH


def flank_point(radius, side):
    alpha = math.acos(min(1.0, BASE / radius))
    angle = side * (HALF_BASE_ANGLE - math.tan(alpha) + alpha)
    return radius * math.cos(angle), radius * math.sin(angle)


def turned(point, angle):
    c, s = math.cos(angle), math.sin(angle)
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


def contact_half_width(gear_roll, force):
    """Hertz half width of two cylinders of the same material."""
    curvature = 1 / gear_roll + 1 / (LINE - gear_roll)
    modulus = YOUNG / (2 * (1 - POISSON**2))
    return math.sqrt(4 * force / WIDTH / (math.pi * modulus * curvature))


class Contact:
    """Load on the flank of one tooth: tooth number (0 or 1, counted forwards) and roll distance."""

    def __init__(self, tooth, gear_roll, force):
        self.tooth, self.half_width = tooth, contact_half_width(gear_roll, force)
        turn = 2 * math.pi * tooth / TEETH
        tangent = turn + HALF_BASE_ANGLE - gear_roll / BASE
        self.radius = math.hypot(BASE, gear_roll)
        self.point = turned(flank_point(self.radius, 1), turn)
        self.direction = np.array([math.sin(tangent), -math.cos(tangent)])  # into the tooth


class Geometry:
    """Collects a gmsh .geo file."""

    def __init__(self, size):
        self.size, self.lines, self.points, self.curves, self.fields = size, [], 0, 0, 0
        self.known = {}

    def point(self, xy):
        key = (round(xy[0], 9), round(xy[1], 9))
        if key not in self.known:
            self.points += 1
            self.known[key] = self.points
            self.lines.append(f"Point({self.points}) = {{{xy[0]:.12g}, {xy[1]:.12g}, 0}};")
        return self.known[key]

    def curve(self, kind, points):
        self.curves += 1
        numbers = ", ".join(str(self.point(p)) for p in points)
        self.lines.append(f"{kind}({self.curves}) = {{{numbers}}};")
        return self.curves

    def refine(self, xy, finest, growth):
        """Elements of size `finest` at a point, growing by `growth` per unit of distance."""
        self.fields += 1
        self.lines.append(
            f'Field[{self.fields}] = MathEval; Field[{self.fields}].F = "{self.size * finest:.6g}'
            f' + {self.size * growth:.6g} * Sqrt((x-({xy[0]:.9g}))^2 + (y-({xy[1]:.9g}))^2)";')

    def background(self, expression):
        self.fields += 1
        self.lines.append(f'Field[{self.fields}] = MathEval; '
                          f'Field[{self.fields}].F = "{self.size:.6g} * ({expression})";')


def tooth_outline(geo, turn, contact, cracked):
    """Curves of one tooth from its root on the -side round the tip to the root on the + side.
    The +side is the loaded one. Returns (curves, loaded curves, first point, last point)."""
    at = lambda p: turned(p, turn)
    low, base = (math.sqrt(ROOT**2 - HALF_ROOT**2), HALF_ROOT), flank_point(BASE, 1)
    mirrored = lambda p: (p[0], -p[1])
    radii = np.linspace(BASE, TIP, 15)
    curves = [geo.curve("Line", [at(mirrored(low)), at(mirrored(base))]),
              geo.curve("Spline", [at(flank_point(r, -1)) for r in radii])]
    curves.append(geo.curve("Line", [at(flank_point(TIP, -1)), at(flank_point(TIP, 1))]))
    loaded, ends = [], [TIP, BASE]
    if contact is not None:
        reach = min(2 * contact.half_width, 0.9 * (TIP - contact.radius))
        ends = [TIP, contact.radius + reach, contact.radius, contact.radius - reach, BASE]
    for upper, lower in zip(ends, ends[1:]):
        count = 6 if upper - lower < 2 else 15
        loaded.append(geo.curve("Spline", [at(flank_point(r, 1))
                                           for r in np.linspace(upper, lower, count)]))
    curves += loaded
    if cracked:
        mouth, tip = (low[0] + 0.02, low[1]), (low[0] - CRACK * math.cos(CRACK_ANGLE),
                                              low[1] - CRACK * math.sin(CRACK_ANGLE))
        curves.append(geo.curve("Line", [at(base), at(mouth)]))
        curves.append(geo.curve("Line", [at(mouth), at(tip)]))
        curves.append(geo.curve("Line", [at(tip), at(low)]))
        geo.refine(at(tip), 0.05, 0.15)
    else:
        curves.append(geo.curve("Line", [at(base), at(low)]))
    return curves, loaded, at(mirrored(low)), at(low)


def refine_teeth(geo, contacts):
    for contact in contacts:
        geo.refine(contact.point, contact.half_width / 6, 0.15)
    for tooth in {c.tooth for c in contacts}:
        for side in (1, -1):
            corner = (math.sqrt(ROOT**2 - HALF_ROOT**2), side * HALF_ROOT)
            geo.refine(turned(corner, 2 * math.pi * tooth / TEETH), 0.1, 0.2)


def gear_geometry(size, contacts, cracked_tooth):
    """A whole gear, held at its bore."""
    geo, curves, loaded, roots = Geometry(size), [], [], []
    for tooth in range(TEETH):
        contact = next((c for c in contacts if c.tooth == tooth), None)
        outline, flank, first, last = tooth_outline(
            geo, 2 * math.pi * tooth / TEETH, contact, tooth == cracked_tooth)
        if contact is not None:
            loaded.append(flank)
        roots.append((first, last))
        curves.append(outline)
    loop = []
    for tooth in range(TEETH):
        loop += curves[tooth]
        loop.append(geo.curve("Circle", [roots[tooth][1], (0, 0), roots[(tooth + 1) % TEETH][0]]))
    quarter = [(BORE, 0), (0, BORE), (-BORE, 0), (0, -BORE)]
    bore = [geo.curve("Circle", [quarter[i], (0, 0), quarter[(i + 1) % 4]]) for i in range(4)]
    refine_teeth(geo, contacts)
    geo.background("3.5")
    return finish(geo, [loop, bore], loaded, bore)


def beneath(contact):
    """Where the line of action crosses the tooth's centre line (tooth 0)."""
    along = -contact.point[1] / contact.direction[1]
    return np.array(contact.point) + along * contact.direction


def tooth_geometry(size, contact):
    """One tooth, held along its root chord, with a node beneath the contact."""
    geo = Geometry(size)
    inner = geo.point(tuple(beneath(contact)))
    outline, flank, first, last = tooth_outline(geo, 0.0, contact, False)
    chord = geo.curve("Line", [last, first])
    refine_teeth(geo, [contact])
    geo.background("1.0")
    return finish(geo, [outline + [chord]], [flank], [chord], inner)


def finish(geo, loops, loaded, held, inner=None):
    text = geo.lines
    for i, loop in enumerate(loops):
        text.append(f"Curve Loop({i + 1}) = {{{', '.join(map(str, loop))}}};")
    text.append(f"Plane Surface(1) = {{{', '.join(str(i + 1) for i in range(len(loops)))}}};")
    if inner is not None:
        text.append(f"Point{{{inner}}} In Surface{{1}};")
    text.append('Physical Surface("body", 1) = {1};')
    text.append(f'Physical Curve("held", 2) = {{{", ".join(map(str, held))}}};')
    for i, flank in enumerate(loaded):
        text.append(f'Physical Curve("flank{i}", {3 + i}) = {{{", ".join(map(str, flank))}}};')
    last = geo.fields + 1
    text.append(f"Field[{last}] = Min; Field[{last}].FieldsList = "
                f"{{{', '.join(map(str, range(1, last)))}}}; Background Field = {last};")
    text += ["Mesh.MeshSizeExtendFromBoundary = 0;", "Mesh.MeshSizeFromPoints = 0;",
             "Mesh.ElementOrder = 2;", "Mesh.MshFileVersion = 2.2;", "Mesh.Algorithm = 6;"]
    return "\n".join(text) + "\n"


class Mesh:
    def __init__(self, geometry, folder):
        with open(os.path.join(folder, "g.geo"), "w") as f:
            f.write(geometry)
        subprocess.run(["gmsh", "-2", "-v", "1", "g.geo", "-o", "g.msh"], cwd=folder, check=True)
        self.triangles, self.edges = [], {}
        with open(os.path.join(folder, "g.msh")) as f:
            lines = f.read().split("\n")
        at = lines.index("$Nodes")
        nodes = [lines[at + 2 + i].split() for i in range(int(lines[at + 1]))]
        self.nodes = {int(n[0]): np.array([float(n[1]), float(n[2])]) for n in nodes}
        at = lines.index("$Elements")
        for i in range(int(lines[at + 1])):
            n = [int(v) for v in lines[at + 2 + i].split()]
            if n[1] == 9:
                self.triangles.append(n[5:])
            elif n[1] == 8:
                self.edges.setdefault(n[3], []).append(n[5:])
        used = {v for t in self.triangles for v in t}
        self.nodes = {k: v for k, v in self.nodes.items() if k in used}

    def nearest(self, point):
        return min(self.nodes, key=lambda n: np.hypot(*(self.nodes[n] - point)))


def hertz_load(mesh, edges, contact):
    """Nodal forces of the elliptic pressure of a Hertz contact, of resultant 1 N."""
    points, weights = np.polynomial.legendre.leggauss(12)
    loads, along = {}, np.array([-contact.direction[1], contact.direction[0]])
    for a, b, mid in edges:
        xa, xb, xm = mesh.nodes[a], mesh.nodes[b], mesh.nodes[mid]
        for z, w in zip(points, weights):
            shape = np.array([z * (z - 1) / 2, z * (z + 1) / 2, 1 - z * z])
            slope = (z - 0.5) * xa + (z + 0.5) * xb - 2 * z * xm
            s = (shape @ np.array([xa, xb, xm]) - contact.point) @ along / contact.half_width
            if abs(s) < 1:
                pressure = math.sqrt(1 - s * s) * w * np.hypot(*slope)
                for node, n in zip((a, b, mid), shape):
                    loads[node] = loads.get(node, 0.0) + n * pressure
    total = sum(loads.values())
    return {node: value / total * contact.direction for node, value in loads.items()}


def solve(mesh, load_cases, watched, folder):
    """Displacements of the watched nodes in each load case, by CalculiX."""
    text = ["*NODE, NSET=ALL"]
    text += [f"{n}, {x[0]:.12g}, {x[1]:.12g}, 0" for n, x in mesh.nodes.items()]
    text.append("*ELEMENT, TYPE=CPE6, ELSET=BODY")
    text += [f"{i + 1}, " + ", ".join(map(str, t)) for i, t in enumerate(mesh.triangles)]
    text += ["*MATERIAL, NAME=M", "*ELASTIC", f"{YOUNG}, {POISSON}",
             "*SOLID SECTION, ELSET=BODY, MATERIAL=M", f"{WIDTH}", "*BOUNDARY"]
    text += [f"{n}, 1, 2" for n in sorted({v for e in mesh.edges[2] for v in e})]
    text.append("*NSET, NSET=SEEN")
    text += [f"{n}," for n in watched]
    for loads in load_cases:
        text += ["*STEP", "*STATIC", "*CLOAD, OP=NEW"]
        for node, force in loads.items():
            text += [f"{node}, {d + 1}, {force[d]:.12g}" for d in (0, 1)]
        text += ["*NODE PRINT, NSET=SEEN", "U", "*END STEP"]
    with open(os.path.join(folder, "g.inp"), "w") as f:
        f.write("\n".join(text) + "\n")
    subprocess.run(["ccx", "g"], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "OMP_NUM_THREADS": "1"})
    found = []
    with open(os.path.join(folder, "g.dat")) as f:
        for line in f:
            if line.strip().startswith("displacements"):
                found.append({})
            elif found and line.split():
                words = line.split()
                found[-1][int(words[0])] = np.array([float(words[1]), float(words[2])])
    return found


def compliance(geometry, contacts, places):
    """[i][j]: motion of place i along contact i's force per force on contact j, mm/N."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = Mesh(geometry, folder)
        cases = [hertz_load(mesh, mesh.edges[3 + i], c) for i, c in enumerate(contacts)]
        watched = [mesh.nearest(place) for place in places]
        moved = solve(mesh, cases, watched, folder)
    directions = [c.direction for c in contacts] * len(places)
    return np.array([[case[node] @ directions[i] for case in moved]
                     for i, node in enumerate(watched)])


def gear_compliance(size, taus, force, cracked=None):
    """Of a gear driven from the root side: contacts at taus[0] (tooth 0), taus[1] (tooth 1)."""
    contacts = [Contact(i, roll(tau), force) for i, tau in enumerate(taus)]
    return compliance(gear_geometry(size, contacts, cracked), contacts,
                      [c.point for c in contacts])


def tooth_compliance(size, tau, force):
    """Of one tooth held at its root: at the flank, and at the centre line beneath the contact."""
    contact = Contact(0, roll(tau), force)
    return compliance(tooth_geometry(size, contact), [contact],
                      [contact.point, beneath(contact)])[:, 0]


def mesh_stiffness(matrix):
    """All pairs approach alike: N/m."""
    return 1e3 * float(np.linalg.inv(matrix).sum())


def row(size, taus):
    """The mesh with pairs at taus: one, or two a mesh period apart."""
    force = TORQUE / BASE / len(taus)
    mates = [CONTACT_RATIO - tau for tau in reversed(taus)]  # gear 2, its low contact first
    mate = gear_compliance(size, mates, force)[::-1, ::-1]
    values = [mesh_stiffness(gear_compliance(size, taus, force) + mate)]
    cracked = [mesh_stiffness(gear_compliance(size, taus, force, i) + mate)
               for i in range(len(taus))]
    both = [tooth_compliance(size, tau, force) + tooth_compliance(size, CONTACT_RATIO - tau, force)
            for tau in taus]
    teeth = sum(1e3 / flank for flank, _ in both)
    beams = sum(1e3 / (centre + LINEAR_HERTZ) for _, centre in both)
    return values + cracked + [float("nan")] * (2 - len(taus)) + [teeth, beams]


def table(size, out):
    double = np.linspace(0.04, CONTACT_RATIO - 1.04, 5)
    single = np.linspace(CONTACT_RATIO - 0.99, 0.99, 5)
    with open(out, "w") as f:
        f.write("phase,pairs,gears_N_m,cracked_entering_N_m,cracked_leaving_N_m,teeth_N_m,"
                "beams_N_m\n")
        for pairs, phases in ((2, double), (1, single)):
            for phase in phases:
                values = row(size, [phase, phase + 1][:pairs])
                line = ",".join("" if v != v else f"{v:.6g}" for v in values)
                f.write(f"{phase:.6f},{pairs},{line}\n")
                f.flush()
                print(f"{phase:.4f} {line}")


def beam_check(length, height):
    """A cantilever against Timoshenko's beam in plane strain: finite elements over closed form.
    The held end cannot warp or narrow, which stiffens it by a share of height over length."""
    geo = Geometry(1.0)
    corners = [(0.0, 0.0), (length, 0.0), (length, height), (0.0, height)]
    sides = [geo.curve("Line", [corners[i], corners[(i + 1) % 4]]) for i in range(4)]
    geo.background("0.5")
    with tempfile.TemporaryDirectory() as folder:
        mesh = Mesh(finish(geo, [sides], [[sides[1]]], [sides[3]]), folder)
        loads = {}
        for a, b, mid in mesh.edges[3]:  # parabolic shear over the end
            points, weights = np.polynomial.legendre.leggauss(4)
            ya, yb = mesh.nodes[a][1], mesh.nodes[b][1]
            for z, w in zip(points, weights):
                y = (ya + yb) / 2 + z * (yb - ya) / 2
                t = 6 * y * (height - y) / height**3 * w * abs(yb - ya) / 2
                for node, n in zip((a, b, mid), (z * (z - 1) / 2, z * (z + 1) / 2, 1 - z * z)):
                    loads[node] = loads.get(node, np.zeros(2)) + np.array([0.0, n * t])
        middle = mesh.nearest(np.array([length, height / 2]))
        found = solve(mesh, [loads], [middle], folder)[0][middle][1]
    modulus, shear = YOUNG / (1 - POISSON**2), YOUNG / (2 * (1 + POISSON))
    second_moment = WIDTH * height**3 / 12
    beam = length**3 / (3 * modulus * second_moment) + 1.2 * length / (shear * WIDTH * height)
    return found / beam


def checks():
    print(f"contact ratio {CONTACT_RATIO:.4f}")
    iso = 1 / (0.04723 + (0.15551 + 0.25791) / TEETH) * 1e9 * YOUNG / 206e3 * WIDTH * 1e-3
    print(f"ISO 6336-1, theoretical single stiffness: {iso:.4e} N/m")
    for length in (20.0, 40.0, 80.0):
        print(f"cantilever {length:g} x 4 mm, finite elements over Timoshenko: "
              f"{beam_check(length, 4.0):.5f}")
    for size in (2.0, 1.0, 0.5):
        values = " ".join(f"{v:.5e}" for v in row(size, [CONTACT_RATIO / 2]))
        both = " ".join(f"{v:.5e}" for v in row(size, [0.3, 1.3]))
        print(f"element size x {size}: phase {CONTACT_RATIO / 2:.4f}: {values}; phase 0.3: {both}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=float, default=1.0, help="factor on all element sizes")
    parser.add_argument("--out", default="table.csv")
    parser.add_argument("--only", choices=["checks", "table"])
    chosen = parser.parse_args()
    if chosen.only != "table":
        checks()
    if chosen.only != "checks":
        table(chosen.size, chosen.out)
