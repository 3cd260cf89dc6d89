#!/usr/bin/env python3
"""Mesh stiffness with a cracked tooth by plane finite elements: README.md.

Usage: cracks_fem.py [--size F] [--folder DIR] [--only CASE ...]. Writes cracks.h5. A case is one
gear of a set, the mate that loads its cracked flank, and the profile of both.
"""
import argparse
import functools
import math
import os

import numpy as np

from pairs_fem import CRACK_ANGLE, MODULE, STEEL, bell, gear_geometry, phases, put, stiffness
from plane_fem import many_compliances, table_file
from teeth import Contact, Gear, Pair

SHARES = (0.1, 0.25, 0.4, 0.6)  # relative to the critical section
PHASES = (1, 3, 7)              # of phases(): two with two pairs, one with one
FORCE = 450e3 / 4 / (19 * MODULE / 2 * math.cos(math.radians(20)))


@functools.lru_cache
def pair_of(mate, profile):
    if mate.startswith("bell"):
        return bell(mate.removeprefix("bell-"))
    planet = Gear(31, MODULE, held=20.0, profile=profile)
    if mate == "ring":
        ring = Gear(81, MODULE, internal=True, held=155.0, profile=profile)
        return Pair(planet, ring, 25 * MODULE, STEEL, FORCE)
    sun = Gear(19, MODULE, held=13.0, profile=profile)
    return Pair(sun, planet, 25 * MODULE, STEEL, FORCE)


# Cracked tooth: mate of the planet's pair, gear of the pair, its profiles. The shifted teeth of the
# Bell 206B, 27/35/99, were not used in the calibration.
BOTH = ("fillet", "root-circle")
TEETH = {"sun": ("sun", 1, BOTH), "planet-sun": ("sun", 2, BOTH), "planet-ring": ("ring", 1, BOTH),
         "ring": ("ring", 2, BOTH), "bell-sun": ("bell-sun", 1, ("fillet",)),
         "bell-planet": ("bell-sun", 2, ("fillet",))}


def depth_of(gear, share):
    """Depth along the crack, in mm, for a fraction of the critical section."""
    return share * 2 * gear.critical_point()[1] / math.sin(CRACK_ANGLE)


def touching(pair, chosen):
    """Returns (positions of the pairs in contact, index of the cracked tooth's pair)."""
    for pairs, phase in (phases(pair.contact_ratio)[i] for i in chosen):
        for cracked in range(pairs):
            yield tuple(phase + i for i in range(pairs)), cracked


def contacts_of(pair, which, taus, cracked):
    """Contacts of gear 1 or 2; the cracked pair's tooth is number 0."""
    return [Contact(c.gear, (i - cracked) * (1 if which == 1 else -1), pair.rolls(taus[i])[which - 1],
                    c.half_width) for i, c in enumerate(pair.contacts(which, taus))]


@functools.lru_cache(maxsize=None)
def gear_matrices(size, tooth, profile, which, depth, chosen=PHASES, plane_strain=True):
    """For each of touching(): [i][j], the displacement of flank i per force on flank j, mm/N.
    The cracked pair's tooth is number 0."""
    pair = pair_of(TEETH[tooth][0], profile)
    gear, contacts, groups = pair.gears[which - 1], {}, []
    for taus, cracked in touching(pair, chosen):
        groups.append([contacts.setdefault((c.tooth, round(tau, 9)), c)
                       for tau, c in zip(taus, contacts_of(pair, which, taus, cracked))])
    loads = list(contacts.values())
    geometry = gear_geometry(size, gear, loads, depth, 0 if depth else None)
    moved = many_compliances(geometry, loads, [c.point for c in loads], STEEL, plane_strain)
    at = {c: i for i, c in enumerate(loads)}
    return [moved[np.ix_([at[c] for c in g], [at[c] for c in g])] for g in groups]


def rows(size, tooth, profile, share, chosen=PHASES, plane_strain=True):
    """Phase, pairs in contact, index of the cracked one, mesh stiffness without and with the
    crack."""
    mate, which, _ = TEETH[tooth]
    pair = pair_of(mate, profile)
    depth = depth_of(pair.gears[which - 1], share)
    whole = [gear_matrices(size, tooth, profile, w, 0.0, chosen, plane_strain) for w in (1, 2)]
    left = gear_matrices(size, tooth, profile, which, depth, chosen, plane_strain)
    for i, (taus, cracked) in enumerate(touching(pair, chosen)):
        yield (taus[0], len(taus), cracked, stiffness(whole[0][i] + whole[1][i]),
               stiffness(left[i] + whole[2 - which][i]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=float, default=1.0, help="factor on all element sizes")
    parser.add_argument("--folder", default=".", help="where the table goes")
    parser.add_argument("--only", nargs="*", help="cases, such as sun-fillet")
    parser.add_argument("--shares", nargs="*", type=float, default=SHARES)
    chosen = parser.parse_args()
    with table_file(os.path.join(chosen.folder, "cracks.h5")) as table:
        put(table, "tooth,profile,share,depth_mm,phase,pairs,cracked,healthy_N_m,cracked_N_m")
        for tooth, (mate, which, profiles) in TEETH.items():
            for profile in profiles:
                if chosen.only and f"{tooth}-{profile}" not in chosen.only:
                    continue
                for share in chosen.shares:
                    depth = depth_of(pair_of(mate, profile).gears[which - 1], share)
                    for phase, pairs, cracked, whole, left in rows(chosen.size, tooth, profile, share):
                        put(table, f"{tooth},{profile},{share:g},{depth:.6f},{phase:.6f},{pairs},"
                                   f"{cracked},{whole:.6g},{left:.6g}")


if __name__ == "__main__":
    main()
