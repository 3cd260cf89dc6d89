#!/usr/bin/env python3
"""Mesh and tooth stiffness of spur pairs by plane finite elements (gmsh, CalculiX): README.md.

Usage: pairs_fem.py [--size F] [--folder DIR] [--only pairs|drop|checks]. Writes cases.h5, mesh.h5,
teeth.h5 and drop.h5. Lengths in mm, forces in N; stiffness in N/m, compliance in m/N.
"""
import argparse
import functools
import math
import os

import numpy as np

from plane_fem import Geometry, compliance, table_file
from teeth import (TRANSVERSE_ANGLE, Contact, Gear, Pair, inverse_involute, involute, shifts_for,
                   turned, weber)

STEEL = (2.068e5, 0.3, 38.1)
MODULE = 3.175
CRACK_ANGLE = math.radians(45)


def stage_gears(teeth, module, distance, sun_shift):
    """Sun, planet and ring without backlash at a distance; sun and planet with the usual tip shortening."""
    both = shifts_for(*teeth[:2], module, distance)
    planet_shift = both - sun_shift
    ring_shift = shifts_for(*teeth[1:], module, distance, True) - planet_shift
    shortening = max(0.0, both - (distance / module - sum(teeth[:2]) / 2))
    return (Gear(teeth[0], module, sun_shift, shortening=shortening),
            Gear(teeth[1], module, planet_shift, shortening=shortening), Gear(teeth[2], module, ring_shift, internal=True))


def bell(which):
    """Stage of studies/bell-206b.toml: 27/35 (sun) or 35/99 (ring), with fillets."""
    distance = 100.0125
    sun, planet, ring = stage_gears((27, 35, 99), MODULE, distance, 0.3)
    sun.held, planet.held, ring.held = 24.0, 31.5, 177.5
    force = 1405e3 / 4 / sun.base
    return Pair(*((sun, planet) if which == "sun" else (planet, ring)), distance, STEEL, force)


@functools.lru_cache
def liang_ring():
    """Pair of studies/published/liang-fig-3-16.toml: 31/81, straight feet; bores of
    studies/real-teeth.toml."""
    planet = Gear(31, MODULE, held=20.0, profile="root-circle")
    ring = Gear(81, MODULE, internal=True, held=155.0)
    return Pair(planet, ring, 25 * MODULE, STEEL, 450e3 / 4 / (19 * MODULE / 2 * math.cos(planet.angle)))


def steel_discs(teeth, shifts, bore=1 / 3):
    """External pair of the ISO 6336-1 table (tests/stiffness/test_iso_6336.cpp): m = 4 mm, 20
    mm wide, 300 N/mm on the pitch circle. bore: relative to the root circle."""
    module, material = 4.0, (2.06e5, 0.3, 20.0)
    sum_of_shifts, sum_of_teeth = sum(shifts), sum(teeth)
    distance = 0.5 * module * sum_of_teeth
    if sum_of_shifts:
        working = inverse_involute(involute(TRANSVERSE_ANGLE)
                                   + 2 * sum_of_shifts * math.tan(TRANSVERSE_ANGLE) / sum_of_teeth)
        distance *= math.cos(TRANSVERSE_ANGLE) / math.cos(working)
    shortening = max(0.0, sum_of_shifts - (distance / module - 0.5 * sum_of_teeth))
    gears = [Gear(z, module, x, shortening=shortening) for z, x in zip(teeth, shifts)]
    for gear in gears:
        gear.held = bore * gear.root
    return Pair(*gears, distance, material, 300.0 * 20.0 / math.cos(TRANSVERSE_ANGLE))


def wind_turbine(which):
    """Second stage of the NREL 5 MW reference gearbox: 18/36 (sun) or 36/93 (ring), m = 21 mm. Bores of
    half the root circles; the ring's rim is three tooth heights."""
    distance, material = 584.0, (2.06e5, 0.3, 550.0)
    sun, planet, ring = stage_gears((18, 36, 93), 21.0, distance, 0.389)
    sun.held, planet.held = sun.root / 2, planet.root / 2
    ring.held = ring.root + 3 * (ring.root - ring.tip)
    return Pair(*((sun, planet) if which == "sun" else (planet, ring)), distance, material,
                1000.0 * 550.0)


CASES = {"bell-sun": (lambda: bell("sun"), 0.0), "bell-ring": (lambda: bell("ring"), 0.0),
         "liang-ring": (liang_ring, 0.0), "liang-ring-2.15": (liang_ring, 2.15),
         "liang-ring-4.28": (liang_ring, 4.28),
         "discs-19-48": (lambda: steel_discs((19, 48), (0, 0)), 0.0),
         "rims-19-48": (lambda: steel_discs((19, 48), (0, 0), 0.75), 0.0),
         "discs-30-60": (lambda: steel_discs((30, 60), (0, 0)), 0.0),
         "discs-20-30": (lambda: steel_discs((20, 30), (0.4, 0.2)), 0.0),
         "turbine-sun": (lambda: wind_turbine("sun"), 0.0),
         "turbine-ring": (lambda: wind_turbine("ring"), 0.0)}


# For the level of mesh stiffness (docs/validation/mesh-stiffness-level.md): fewer rows, plane strain.
LEVEL_CASES = ("discs-19-48", "rims-19-48", "discs-30-60", "discs-20-30", "turbine-sun", "turbine-ring")


def loaded_side(geo, gear, at, contacts, until=None):
    """Curves of the involute from the tip to its end (or the radius `until`), with a node at
    each contact, and for each contact those near it, which carry the pressure."""
    low = gear.lowest() if until is None else until
    inwards = -1 if gear.internal else 1
    stops, spans = [gear.tip], []
    for contact in sorted(contacts, key=lambda c: -inwards * c.radius):
        upper = min(2 * contact.half_width, 0.9 * inwards * (gear.tip - contact.radius))
        lower = min(2 * contact.half_width, 0.9 * inwards * (contact.radius - low))
        stops += [contact.radius + inwards * upper, contact.radius,
                  contact.radius - inwards * lower]
        spans.append((contact, len(stops) - 3))
    stops.append(low)
    curves = [geo.curve("Spline", [at(gear.flank(r)) for r in
                                   np.linspace(a, b, 6 if abs(a - b) < 0.3 * gear.module else 15)])
              for a, b in zip(stops, stops[1:])]
    return curves, {contact: curves[first:first + 2] for contact, first in spans}


class Slit:
    """A crack from the critical point of the loaded side: at 45 degrees to the centre line into
    the body, beyond the centre line at 45 degrees up again (Liang 2016, Fig. 3.9). An open
    wedge with lips WIDTH apart at its mouth."""

    WIDTH = 0.01

    def __init__(self, gear, depth):
        self.gear, self.start = gear, gear.critical_point()
        sign = 1 if gear.internal else -1  # direction into the body
        x, y = self.start
        down, across = math.cos(CRACK_ANGLE), math.sin(CRACK_ANGLE)
        first = min(depth, y / across)
        bend = (x + sign * first * down, y - first * across)
        rest = depth - first
        self.tip = (bend[0] - sign * rest * down, bend[1] - rest * across)
        self.lower, self.upper = [], []  # points of the lips between tip and mouth
        if rest > 0:
            self.lower = [bend]
            self.upper = [(bend[0] - sign * 0.6 * self.WIDTH, bend[1])]
        self.involute_end = gear.root - self.WIDTH if gear.internal else gear.lowest()

    def foot(self):
        """Pieces from the involute's end to the root circle, around the slit."""
        above, below = self.foot_parts()
        lips = [above[-1][-1] if above else self.gear.flank(self.involute_end), *self.upper,
                self.tip, *self.lower, self.start]
        return above + [[a, b] for a, b in zip(lips, lips[1:])] + below

    def foot_parts(self):
        """The foot above and below the slit."""
        if self.gear.internal:
            return [], []
        foot = self.gear.foot()
        if self.gear.profile != "fillet":
            return [[foot[0][0], (self.start[0] + self.WIDTH, self.start[1])]], []
        centre, radius = self.gear.fillet_centre(), self.gear.arc
        angle = lambda p: math.atan2(*(np.array(p) - centre)[::-1]) % (2 * math.pi)
        arc = lambda a, b: [tuple(centre + radius * np.array([math.cos(t), math.sin(t)]))
                            for t in np.linspace(a, b, 7)]
        first, last, start = (angle(p) for p in (foot[-1][0], foot[-1][-1], self.start))
        away = math.copysign(self.WIDTH / radius, first - start)
        above = arc(first, start + away)
        above[0] = foot[-1][0]
        below = arc(start, last)
        below[0], below[-1] = self.start, foot[-1][-1]
        return foot[:-1] + [above], [below]


def tooth_outline(geo, gear, tooth, contacts=(), crack=0.0, chord=None):
    """Curves of a tooth from its root on the unloaded side around the tip to its root on the
    loaded one. chord: radius of the involute at which it is cut off instead. Returns (curves,
    loaded curves by contact, first point, last point)."""
    at = lambda p: turned(p, 2 * math.pi * tooth / gear.teeth)
    mirrored = lambda p: at((p[0], -p[1]))
    low = gear.lowest() if chord is None else chord
    foot = [] if chord is not None else gear.foot()
    end = foot[-1][-1] if foot else gear.flank(low)
    curves = [geo.curve("Spline" if len(p) > 2 else "Line", [mirrored(q) for q in p[::-1]])
              for p in foot[::-1]]
    curves.append(geo.curve("Spline",
                            [mirrored(gear.flank(r)) for r in np.linspace(low, gear.tip, 15)]))
    curves.append(geo.curve("Line", [mirrored(gear.flank(gear.tip)), at(gear.flank(gear.tip))]))
    slit = Slit(gear, crack) if crack else None
    side, loaded = loaded_side(geo, gear, at, contacts, slit.involute_end if slit else low)
    curves += side
    pieces = slit.foot() if slit else foot
    curves += [geo.curve("Spline" if len(p) > 2 else "Line", [at(q) for q in p]) for p in pieces]
    if slit:
        geo.refine(at(slit.tip), 0.025, 0.15)
    return curves, loaded, mirrored(end), at(end)


def refine_teeth(geo, gear, contacts):
    for contact in contacts:
        geo.refine(contact.point, contact.half_width / 6, 0.15)
    for tooth in {c.tooth for c in contacts}:
        foot = gear.foot()
        x, y = foot[-1][len(foot[-1]) // 2] if foot else gear.flank(gear.root)
        for side in (1, -1):
            geo.refine(turned((x, side * y), 2 * math.pi * tooth / gear.teeth),
                       0.02 * gear.module, 0.2)


def gear_geometry(size, gear, contacts, crack=0.0, cracked=None):
    """A whole gear, fixed at its bore or outer circle, with nodes beneath the contacts."""
    geo, outlines = Geometry(size), []
    inner = [geo.point(c.beneath()) for c in contacts]
    for tooth in range(gear.teeth):
        touching = [c for c in contacts if c.tooth % gear.teeth == tooth]
        outlines.append(tooth_outline(geo, gear, tooth, touching, crack if tooth == cracked else 0))
    loop, loaded = [], {}
    for tooth, (curves, flank, _, last) in enumerate(outlines):
        following = outlines[(tooth + 1) % gear.teeth][2]
        loop += curves + [geo.curve("Circle", [last, (0, 0), following])]
        loaded.update(flank)
    held = geo.circle(gear.held)
    refine_teeth(geo, gear, contacts)
    near = " + ".join(f"Sqrt((x-({c.point[0]:.9g}))^2 + (y-({c.point[1]:.9g}))^2)" for c in contacts)
    geo.background(f"Min({2.0 * gear.module}, {0.4 * gear.module} + 0.06 * ({near}) / {len(contacts)})")
    return geo.finish([held, loop] if gear.internal else [loop, held],
                      [loaded[c] for c in contacts], held, inner)


def tooth_geometry(size, gear, contact, chord=None):
    """One tooth alone, fixed along the chord of its root or of the radius given."""
    geo = Geometry(size)
    inner = [geo.point(contact.beneath())]
    curves, flank, first, last = tooth_outline(geo, gear, 0, [contact], chord=chord)
    held = geo.curve("Line", [last, first])
    refine_teeth(geo, gear, [contact])
    geo.background(f"{0.2 * gear.module}")
    return geo.finish([curves + [held]], [flank[contact]], [held], inner)


@functools.lru_cache(maxsize=None)
def gear_compliance(size, pair, which, taus, crack=0.0, cracked=None, element="CPE6"):
    """Flank and centre line: [i][j], the displacement at contact i per force on contact j,
    mm/N. cracked: index of the contact on the cracked tooth."""
    gear, contacts = pair.gears[which - 1], pair.contacts(which, taus)
    tooth = None if cracked is None else contacts[cracked].tooth % gear.teeth
    both = compliance(gear_geometry(size, gear, contacts, crack, tooth), contacts,
                      [c.point for c in contacts] + [c.beneath() for c in contacts],
                      pair.material, element)
    return both[:len(taus)], both[len(taus):]


def linear_hertz(material):
    young, poisson, width = material
    return 4 * (1 - poisson**2) / (math.pi * young * width)


def stiffness(matrix):
    """Stiffness with equal approach of all pairs, N/m."""
    return 1e3 * float(np.linalg.inv(matrix).sum())


def mesh_row(size, pair, taus, crack=0.0, cracked=None, element="CPE6"):
    """Stiffness of the mesh by the displacement of the flanks under Hertz pressures, and by
    that of the centre lines with a linear contact; the two gears' matrices."""
    gears = [gear_compliance(size, pair, which, taus, crack if which == 1 else 0.0,
                             cracked if which == 1 else None, element) for which in (1, 2)]
    flank, centre = gears[0][0] + gears[1][0], gears[0][1] + gears[1][1]
    contact = linear_hertz(pair.material) * np.eye(len(taus))
    return stiffness(flank), stiffness(centre + contact), gears


def phases(contact_ratio, count=5):
    """Returns (pairs, phase): so many phases with the larger number of pairs, so many with the
    smaller."""
    whole = math.floor(contact_ratio)
    part = contact_ratio - whole
    margin = min(0.04, 0.1 * part, 0.1 * (1 - part))
    return ([(whole + 1, p) for p in np.linspace(margin, part - margin, count)]
            + [(whole, p) for p in np.linspace(part + margin, 1 - margin, count)])


def cracked_rows(size, name, pair, crack, mesh):
    """The cracked tooth is that of each pair in contact in turn."""
    for pairs, phase in phases(pair.contact_ratio):
        taus = tuple(phase + i for i in range(pairs))
        mate = gear_compliance(size, pair, 2, taus)
        for cracked in range(pairs):
            own = gear_compliance(size, pair, 1, taus, crack, cracked)
            flank, centre = own[0] + mate[0], own[1] + mate[1]
            contact = linear_hertz(pair.material) * np.eye(pairs)
            put(mesh, f"{name},{phase:.6f},{pairs},{cracked},{stiffness(flank):.6g},"
                      f"{stiffness(centre + contact):.6g},")


def healthy_rows(size, name, pair, mesh, teeth):
    level = name in LEVEL_CASES
    for pairs, phase in phases(pair.contact_ratio, 3 if level else 5):
        taus = tuple(phase + i for i in range(pairs))
        flank, centre, gears = mesh_row(size, pair, taus)
        stress = "" if level else f"{mesh_row(size, pair, taus, element='CPS6')[0]:.6g}"
        put(mesh, f"{name},{phase:.6f},{pairs},,{flank:.6g},{centre:.6g},{stress}")
        for which in (1, 2):
            for i, tau in enumerate(taus):
                c = [1e-3 * m[i, i] for m in gears[which - 1]]
                put(teeth, f"{name},{which},{tau:.6f},{c[0]:.6g},{c[1]:.6g}")


def put(file, line):
    file.write(line + "\n")
    print(line, flush=True)


def alone(size, gear, contact, material, chord=None):
    """One tooth: displacement of flank and centre line, mm/N."""
    return compliance(tooth_geometry(size, gear, contact, chord), [contact],
                      [contact.point, contact.beneath()], material)[:, 0]


def drop_row(size, pair, taus):
    """Teeth fixed at their roots, no bodies: planet from the root circle and from the base
    circle; by flanks and by centre lines with a linear contact."""
    found = np.zeros(4)
    for i, tau in enumerate(taus):
        planet, ring = [pair.contacts(w, taus)[i] for w in (1, 2)]
        planet, ring = [Contact(c.gear, 0, pair.rolls(tau)[w], c.half_width)
                        for w, c in enumerate((planet, ring))]
        mate = alone(size, pair.gears[1], ring, pair.material, pair.gears[1].root)
        root = alone(size, pair.gears[0], planet, pair.material) + mate
        base = alone(size, pair.gears[0], planet, pair.material, pair.gears[0].base) + mate
        contact = np.array([0.0, linear_hertz(pair.material)])
        found += np.concatenate([1e3 / (root + contact), 1e3 / (base + contact)])
    return found


def drop_table(size, folder):
    pair = liang_ring()
    with table_file(os.path.join(folder, "drop.h5")) as f:
        put(f, "phase,pairs,root_N_m,root_centre_N_m,base_N_m,base_centre_N_m")
        for pairs, phase in phases(pair.contact_ratio):
            values = drop_row(size, pair, tuple(phase + i for i in range(pairs)))
            put(f, f"{phase:.6f},{pairs}," + ",".join(f"{v:.6g}" for v in values))


def tables(size, folder, names):
    with table_file(os.path.join(folder, "cases.h5")) as cases, \
         table_file(os.path.join(folder, "mesh.h5")) as mesh, \
         table_file(os.path.join(folder, "teeth.h5")) as teeth:
        put(cases, "case,contact_ratio,force_N,tip_1_mm,tip_2_mm,crack_mm")
        put(mesh, "case,phase,pairs,cracked,flank_N_m,centre_N_m,plane_stress_N_m")
        put(teeth, "case,gear,tau,flank_m_N,centre_m_N")
        for name in names:
            make, crack = CASES[name]
            pair = make()
            put(cases, f"{name},{pair.contact_ratio:.8g},{pair.force:.8g},{pair.gears[0].tip:.8g},"
                       f"{pair.gears[1].tip:.8g},{crack:g}")
            if crack:
                cracked_rows(size, name, pair, crack, mesh)
            else:
                healthy_rows(size, name, pair, mesh, teeth)


def weber_check(name, pair):
    """Compliance between flank and centre line, over Weber and Banaschek's."""
    young, poisson, width = pair.material
    for pairs, phase in phases(pair.contact_ratio)[7:8]:
        for which in (1, 2):
            flank, centre = gear_compliance(1.0, pair, which, (phase,))
            local = weber(pair.contacts(which, (phase,))[0], poisson)
            local *= 2 * (1 - poisson**2) / (math.pi * young * width)
            print(f"{name}, gear {which}: local {(flank - centre)[0, 0] / local:.4f} of Weber's")


def checks():
    """Same rows with elements twice as large, as in the tables, and half as large."""
    for name, (make, crack) in CASES.items():
        pair = make()
        for pairs, phase in (phases(pair.contact_ratio)[i] for i in (2, 7)):
            taus = tuple(phase + i for i in range(pairs))
            for size in (2.0, 1.0, 0.5):
                flank, centre, _ = mesh_row(size, pair, taus, crack, 0 if crack else None)
                print(f"{name}, phase {phase:.4f}, elements x {size}: {flank:.5e} {centre:.5e}")
        if not crack:
            weber_check(name, pair)
    pair = liang_ring()
    for pairs, phase in (phases(pair.contact_ratio)[i] for i in (2, 7)):
        for size in (2.0, 1.0, 0.5):
            values = drop_row(size, pair, tuple(phase + i for i in range(pairs)))
            print(f"drop, phase {phase:.4f}, elements x {size}: {values}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=float, default=1.0, help="factor on all element sizes")
    parser.add_argument("--folder", default=".", help="where the tables go")
    parser.add_argument("--only", choices=["pairs", "drop", "checks"])
    chosen = parser.parse_args()
    if chosen.only in (None, "checks"):
        checks()
    if chosen.only in (None, "drop"):
        drop_table(chosen.size, chosen.folder)
    if chosen.only in (None, "pairs"):
        tables(chosen.size, chosen.folder, CASES)
