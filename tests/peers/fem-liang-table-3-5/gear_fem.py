#!/usr/bin/env python3
"""Mesh stiffness of Liang (2016), Table 3.4, by plane-strain finite elements (gmsh, CalculiX).

Writes table.h5 (README.md explains its columns) and prints the checks. Lengths in mm, forces in N.
Usage: gear_fem.py [--size F] [--out table.h5] [--only checks|table]
"""
import argparse
import math
import pathlib
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "fem-gear-pairs"))
from pairs_fem import linear_hertz, stiffness
from plane_fem import Geometry, Mesh, compliance, edge_loads, solve, table_file
from teeth import Gear, Pair, turned

YOUNG, POISSON, WIDTH = MATERIAL = 69e3, 0.33, 15.0
CRACK, CRACK_ANGLE = 4.7, math.radians(45)
TORQUE = 60e3  # N mm; affects the width of the contact only
TEETH, MODULE = 23, 6.0
GEAR = Gear(TEETH, MODULE, held=25.0, profile="root-circle")  # the thesis gives no bore
PAIR = Pair(GEAR, GEAR, TEETH * MODULE, MATERIAL, TORQUE / GEAR.base)
LOW = GEAR.foot()[0][-1]  # end of the loaded side at the root circle


def tooth_outline(geo, turn, contact, cracked):
    """Curves of one tooth from its root on the -side around the tip to the root on the + side.
    The +side is the loaded one. Returns (curves, loaded curves, first point, last point)."""
    at = lambda p: turned(p, turn)
    low, base = LOW, GEAR.flank(GEAR.base)
    mirrored = lambda p: (p[0], -p[1])
    radii = np.linspace(GEAR.base, GEAR.tip, 15)
    curves = [geo.curve("Line", [at(mirrored(low)), at(mirrored(base))]),
              geo.curve("Spline", [at(mirrored(GEAR.flank(r))) for r in radii])]
    curves.append(geo.curve("Line", [at(mirrored(GEAR.flank(GEAR.tip))), at(GEAR.flank(GEAR.tip))]))
    loaded, ends = [], [GEAR.tip, GEAR.base]
    if contact is not None:
        reach = min(2 * contact.half_width, 0.9 * (GEAR.tip - contact.radius))
        ends = [GEAR.tip, contact.radius + reach, contact.radius, contact.radius - reach, GEAR.base]
    for upper, lower in zip(ends, ends[1:]):
        count = 6 if upper - lower < 2 else 15
        loaded.append(geo.curve("Spline", [at(GEAR.flank(r)) for r in np.linspace(upper, lower, count)]))
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
            geo.refine(turned((LOW[0], side * LOW[1]), 2 * math.pi * tooth / TEETH), 0.1, 0.2)


def gear_geometry(size, contacts, cracked_tooth):
    """A whole gear, fixed at its bore."""
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
    bore = geo.circle(GEAR.held)
    refine_teeth(geo, contacts)
    geo.background("3.5")
    return geo.finish([loop, bore], loaded, bore)


def tooth_geometry(size, contact):
    """One tooth, fixed along its root chord, with a node beneath the contact."""
    geo = Geometry(size)
    inner = geo.point(tuple(contact.beneath()))
    outline, flank, first, last = tooth_outline(geo, 0.0, contact, False)
    chord = geo.curve("Line", [last, first])
    refine_teeth(geo, [contact])
    geo.background("1.0")
    return geo.finish([outline + [chord]], [flank], [chord], [inner])


def gear_compliance(size, taus, cracked=None):
    """Compliance of a gear driven from the root side: contacts at taus[0] (tooth 0), taus[1]
    (tooth 1)."""
    contacts = PAIR.contacts(1, taus)
    return compliance(gear_geometry(size, contacts, cracked), contacts, [c.point for c in contacts], MATERIAL)


def tooth_compliance(size, taus, which):
    """Compliance of one tooth fixed at its root: at the flank, and at the centre line beneath
    the contact. taus: of all pairs that carry the load; which: the tooth's."""
    contact = PAIR.contacts(1, taus[which:] + taus[:which])[0]
    return compliance(tooth_geometry(size, contact), [contact], [contact.point, contact.beneath()], MATERIAL)[:, 0]


def row(size, taus):
    """The mesh with pairs at taus: one, or two a mesh period apart."""
    mates = [PAIR.contact_ratio - tau for tau in reversed(taus)]  # gear 2, its low contact first
    mate = gear_compliance(size, mates)[::-1, ::-1]
    values = [stiffness(gear_compliance(size, taus) + mate)]
    cracked = [stiffness(gear_compliance(size, taus, i) + mate) for i in range(len(taus))]
    both = [tooth_compliance(size, taus, i) + tooth_compliance(size, mates[::-1], i) for i in range(len(taus))]
    teeth = sum(1e3 / flank for flank, _ in both)
    beams = sum(1e3 / (centre + linear_hertz(MATERIAL)) for _, centre in both)
    return values + cracked + [float("nan")] * (2 - len(taus)) + [teeth, beams]


def table(size, out):
    double = np.linspace(0.04, PAIR.contact_ratio - 1.04, 5)
    single = np.linspace(PAIR.contact_ratio - 0.99, 0.99, 5)
    with table_file(out) as f:
        f.write("phase,pairs,gears_N_m,cracked_entering_N_m,cracked_leaving_N_m,teeth_N_m,"
                "beams_N_m\n")
        for pairs, phases in ((2, double), (1, single)):
            for phase in phases:
                values = row(size, [phase, phase + 1][:pairs])
                line = ",".join("" if v != v else f"{v:.6g}" for v in values)
                f.write(f"{phase:.6f},{pairs},{line}\n")
                print(f"{phase:.4f} {line}", flush=True)


def beam_check(length, height):
    """A cantilever against Timoshenko's beam in plane strain: finite elements over closed form.
    The fixed end cannot warp or contract, which stiffens it by a fraction of height over
    length."""
    geo = Geometry(1.0)
    corners = [(0.0, 0.0), (length, 0.0), (length, height), (0.0, height)]
    sides = [geo.curve("Line", [corners[i], corners[(i + 1) % 4]]) for i in range(4)]
    geo.background("0.5")
    with tempfile.TemporaryDirectory() as folder:
        mesh = Mesh(geo.finish([sides], [[sides[1]]], [sides[3]]), folder)
        # Parabolic shear over the end.
        loads = {node: np.array([0.0, v]) for node, v in
                 edge_loads(mesh, mesh.edges[3], lambda x: x[1] * (height - x[1])).items()}
        middle = mesh.nearest(np.array([length, height / 2]))
        found = solve(mesh, [loads], [middle], folder, MATERIAL)[0][middle][1]
    modulus, shear = YOUNG / (1 - POISSON**2), YOUNG / (2 * (1 + POISSON))
    second_moment = WIDTH * height**3 / 12
    beam = length**3 / (3 * modulus * second_moment) + 1.2 * length / (shear * WIDTH * height)
    return found / beam


def checks():
    print(f"contact ratio {PAIR.contact_ratio:.4f}")
    iso = 1 / (0.04723 + (0.15551 + 0.25791) / TEETH) * 1e9 * YOUNG / 206e3 * WIDTH * 1e-3
    print(f"ISO 6336-1, theoretical single stiffness: {iso:.4e} N/m")
    for length in (20.0, 40.0, 80.0):
        print(f"cantilever {length:g} x 4 mm, finite elements over Timoshenko: "
              f"{beam_check(length, 4.0):.5f}")
    for size in (2.0, 1.0, 0.5):
        values = " ".join(f"{v:.5e}" for v in row(size, [PAIR.contact_ratio / 2]))
        both = " ".join(f"{v:.5e}" for v in row(size, [0.3, 1.3]))
        print(f"element size x {size}: phase {PAIR.contact_ratio / 2:.4f}: {values}; phase 0.3: {both}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=float, default=1.0, help="factor on all element sizes")
    parser.add_argument("--out", default="table.h5")
    parser.add_argument("--only", choices=["checks", "table"])
    chosen = parser.parse_args()
    if chosen.only != "table":
        checks()
    if chosen.only != "checks":
        table(chosen.size, chosen.out)
