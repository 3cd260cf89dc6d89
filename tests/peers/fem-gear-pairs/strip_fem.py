#!/usr/bin/env python3
"""Geometry factors of an edge crack in a strip by plane finite elements: README.md.

Usage: strip_fem.py [--size F] [--folder DIR]. Writes strip.h5. The energy release rate is the
central difference of the strain energy between two crack lengths, K = sqrt(E' G). By symmetry half
of the strip is modelled, with its ligament fixed across. Width, stress and modulus are 1.
"""
import argparse
import math
import os
import tempfile

import numpy as np
from scipy.sparse.linalg import splu

from pairs_fem import put
from plane_fem import Geometry, Mesh, stiffness_matrix, table_file

LENGTH, POISSON, STEP = 3.0, 0.3, 0.01


def strip(size, crack):
    geo = Geometry(size)
    corners = [(crack, 0), (1, 0), (1, LENGTH), (0, LENGTH), (0, 0)]
    ligament, _, top, _, _ = curves = [geo.curve("Line", pair) for pair in
                                       zip(corners, corners[1:] + corners[:1])]
    geo.refine((crack, 0), 0.0005, 0.08)
    geo.background("0.08")
    return geo.finish([curves], [[top]], [ligament])


def energies(size, crack):
    """Strain energy of half a strip in tension and in bending, for a stress of 1 at the edge."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = Mesh(strip(size, crack), folder)
    number = {n: i for i, n in enumerate(mesh.nodes)}
    held = {2 * number[n] + 1 for edge in mesh.edges[2] for n in edge}
    held.add(2 * number[mesh.nearest((1, 0))])
    free = np.array([i for i in range(2 * len(number)) if i not in held])
    matrix = stiffness_matrix(mesh, number, (1.0, POISSON, 1.0))
    forces = np.zeros((2 * len(number), 2))
    gauss, weights = np.polynomial.legendre.leggauss(4)
    for a, b, middle in mesh.edges[3]:
        ends = mesh.nodes[a][0], mesh.nodes[b][0], mesh.nodes[middle][0]
        for z, w in zip(gauss, weights):
            shape = np.array([z * (z - 1) / 2, z * (z + 1) / 2, 1 - z * z])
            x = shape @ ends
            for node, share in zip((a, b, middle), shape):
                load = w * share * abs(ends[1] - ends[0]) / 2
                forces[2 * number[node] + 1] += load, load * (1 - 2 * x)
    moved = splu(matrix[free][:, free].tocsc()).solve(forces[free])
    return 0.5 * np.einsum("ij,ij->j", forces[free], moved)


def factors(size, share):
    """Factors in tension and in bending."""
    rate = (energies(size, share + STEP) - energies(size, share - STEP)) / STEP
    return np.sqrt(rate / (1 - POISSON**2) / (math.pi * share))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=float, default=1.0, help="factor on all element sizes")
    parser.add_argument("--folder", default=".", help="where the table goes")
    chosen = parser.parse_args()
    with table_file(os.path.join(chosen.folder, "strip.h5")) as table:
        put(table, "share,tension,bending")
        for share in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7):
            tension, bending = factors(chosen.size, share)
            put(table, f"{share:g},{tension:.5f},{bending:.5f}")


if __name__ == "__main__":
    main()
