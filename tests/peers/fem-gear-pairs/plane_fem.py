"""Plane finite elements of gears by gmsh and CalculiX: outline, mesh, Hertz pressure, solution.
Lengths in mm, forces in N."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
from reference_tables import TableFile, read_table


def table_file(path):
    """Open table of the running script."""
    folder = pathlib.Path(sys.argv[0]).resolve().parent.name
    return TableFile(path, f"finite elements (gmsh, CalculiX, scipy) of tests/peers/{folder}, see its README.md",
                     " ".join(sys.argv))


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

    def circle(self, radius):
        """Circle about the origin, in quarters."""
        corners = [(radius, 0), (0, radius), (-radius, 0), (0, -radius)]
        return [self.curve("Circle", [corners[i], (0, 0), corners[(i + 1) % 4]]) for i in range(4)]

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

    def finish(self, loops, loaded, held, inner=(), order=2):
        """Text of the file: the surface within loops[0] and without the others; element
        sets 2 (held) and 3, 4, ... (loaded); `inner`: points that get a node."""
        text = self.lines
        for i, loop in enumerate(loops):
            text.append(f"Curve Loop({i + 1}) = {{{', '.join(map(str, loop))}}};")
        text.append(f"Plane Surface(1) = {{{', '.join(str(i + 1) for i in range(len(loops)))}}};")
        text += [f"Point{{{point}}} In Surface{{1}};" for point in inner]
        text.append('Physical Surface("body", 1) = {1};')
        text.append(f'Physical Curve("held", 2) = {{{", ".join(map(str, held))}}};')
        for i, flank in enumerate(loaded):
            text.append(
                f'Physical Curve("flank{i}", {3 + i}) = {{{", ".join(map(str, flank))}}};')
        last = self.fields + 1
        text.append(f"Field[{last}] = Min; Field[{last}].FieldsList = "
                    f"{{{', '.join(map(str, range(1, last)))}}}; Background Field = {last};")
        text += ["Mesh.MeshSizeExtendFromBoundary = 0;", "Mesh.MeshSizeFromPoints = 0;",
                 f"Mesh.ElementOrder = {order};", "Mesh.MshFileVersion = 2.2;",
                 "Mesh.Algorithm = 6;"]
        return "\n".join(text) + "\n"


class Mesh:
    """Triangles and, by element set, edges: corners first, then (order 2) middle nodes."""

    def __init__(self, geometry, folder):
        with open(os.path.join(folder, "g.geo"), "w") as f:
            f.write(geometry)
        subprocess.run(["gmsh", "-2", "-v", "0", "g.geo", "-o", "g.msh"], cwd=folder, check=True)
        self.triangles, self.edges = [], {}
        with open(os.path.join(folder, "g.msh")) as f:
            lines = f.read().split("\n")
        at = lines.index("$Nodes")
        nodes = [lines[at + 2 + i].split() for i in range(int(lines[at + 1]))]
        self.nodes = {int(n[0]): np.array([float(n[1]), float(n[2])]) for n in nodes}
        at = lines.index("$Elements")
        for i in range(int(lines[at + 1])):
            n = [int(v) for v in lines[at + 2 + i].split()]
            if n[1] in (2, 9):
                self.triangles.append(n[5:])
            elif n[1] in (1, 8):
                self.edges.setdefault(n[3], []).append(n[5:])
        used = {v for t in self.triangles for v in t}
        self.nodes = {k: v for k, v in self.nodes.items() if k in used}
        self.triangles = [self.anticlockwise(t) for t in self.triangles]

    def anticlockwise(self, triangle):
        a, b, c = (self.nodes[n] for n in triangle[:3])
        (p, q), (r, s) = b - a, c - a
        return triangle if p * s > q * r else [triangle[i] for i in (0, 2, 1, 5, 4, 3)[:len(triangle)]]

    def nearest(self, point):
        return min(self.nodes, key=lambda n: np.hypot(*(self.nodes[n] - point)))


def edge_loads(mesh, edges, pressure, points=12):
    """Nodal weights of a pressure (a function of the point) over quadratic edges, of sum 1."""
    gauss, weights = np.polynomial.legendre.leggauss(points)
    loads = {}
    for a, b, mid in edges:
        xa, xb, xm = mesh.nodes[a], mesh.nodes[b], mesh.nodes[mid]
        for z, w in zip(gauss, weights):
            shape = np.array([z * (z - 1) / 2, z * (z + 1) / 2, 1 - z * z])
            slope = (z - 0.5) * xa + (z + 0.5) * xb - 2 * z * xm
            force = pressure(shape @ np.array([xa, xb, xm])) * w * np.hypot(*slope)
            if force:
                for node, n in zip((a, b, mid), shape):
                    loads[node] = loads.get(node, 0.0) + n * force
    total = sum(loads.values())
    return {node: value / total for node, value in loads.items()}


def hertz_load(mesh, edges, contact):
    """Nodal forces of the elliptic pressure of a Hertz contact, of resultant 1 N. A contact has
    point, direction (into the tooth) and half_width."""
    along = np.array([-contact.direction[1], contact.direction[0]])

    def pressure(x):
        s = (x - contact.point) @ along / contact.half_width
        return math.sqrt(1 - s * s) if abs(s) < 1 else 0.0

    return {n: v * contact.direction for n, v in edge_loads(mesh, edges, pressure).items()}


def run_ccx(folder):
    subprocess.run(["ccx", "g"], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "OMP_NUM_THREADS": "1"})


def solve(mesh, load_cases, watched, folder, material, element="CPE6"):
    """Displacements of the watched nodes in each load case, by CalculiX. material: Young's modulus,
    Poisson's ratio, width; element: CPE6 (plane strain) or CPS6 (plane stress)."""
    young, poisson, width = material
    text = ["*NODE, NSET=ALL"]
    text += [f"{n}, {x[0]:.12g}, {x[1]:.12g}, 0" for n, x in mesh.nodes.items()]
    text.append(f"*ELEMENT, TYPE={element}, ELSET=BODY")
    text += [f"{i + 1}, " + ", ".join(map(str, t)) for i, t in enumerate(mesh.triangles)]
    text += ["*MATERIAL, NAME=M", "*ELASTIC", f"{young}, {poisson}",
             "*SOLID SECTION, ELSET=BODY, MATERIAL=M", f"{width}", "*BOUNDARY"]
    text += [f"{n}, 1, 2" for n in sorted({v for e in mesh.edges[2] for v in e})]
    text.append("*NSET, NSET=SEEN")
    text += [f"{n}," for n in dict.fromkeys(watched)]
    for loads in load_cases:
        text += ["*STEP", "*STATIC", "*CLOAD, OP=NEW"]
        for node, force in loads.items():
            text += [f"{node}, {d + 1}, {force[d]:.12g}" for d in (0, 1)]
        text += ["*NODE PRINT, NSET=SEEN", "U", "*END STEP"]
    with open(os.path.join(folder, "g.inp"), "w") as f:
        f.write("\n".join(text) + "\n")
    run_ccx(folder)
    found = []
    with open(os.path.join(folder, "g.dat")) as f:
        for line in f:
            if line.strip().startswith("displacements"):
                found.append({})
            elif found and line.split():
                words = line.split()
                found[-1][int(words[0])] = np.array([float(words[1]), float(words[2])])
    return found


def stiffness_matrix(mesh, number, material, plane_strain=True):
    """Stiffness matrix of quadratic triangles with three Gauss points, rows 2 i and 2 i + 1 for
    the node numbered i."""
    from scipy.sparse import coo_matrix
    young, poisson, width = material
    if not plane_strain:  # the same law with other constants
        young, poisson = young * (1 + 2 * poisson) / (1 + poisson)**2, poisson / (1 + poisson)
    factor = width * young / ((1 + poisson) * (1 - 2 * poisson))
    law = factor * np.array([[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0],
                             [0, 0, 0.5 - poisson]])
    nodes = np.array([[mesh.nodes[n] for n in t] for t in mesh.triangles])
    total = np.zeros((len(nodes), 12, 12))
    for p, q in ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3)):
        r = 1 - p - q
        slopes = np.array([[1 - 4 * r, 1 - 4 * r], [4 * p - 1, 0], [0, 4 * q - 1],
                           [4 * (r - p), -4 * p], [4 * q, 4 * p], [-4 * q, 4 * (r - q)]])
        jacobian = np.einsum("kd,eki->edi", slopes, nodes)
        here = np.einsum("eid,kd->eki", np.linalg.inv(jacobian), slopes)
        strain = np.zeros((len(nodes), 3, 12))
        strain[:, 0, 0::2] = strain[:, 2, 1::2] = here[:, :, 0]
        strain[:, 1, 1::2] = strain[:, 2, 0::2] = here[:, :, 1]
        total += np.einsum("eai,ab,ebj,e->eij", strain, law, strain,
                           np.linalg.det(jacobian) / 6, optimize=True)
    places = np.array([[2 * number[n] + d for n in t for d in (0, 1)] for t in mesh.triangles])
    rows, columns = np.repeat(places, 12, axis=1), np.tile(places, (1, 12))
    return coo_matrix((total.ravel(), (rows.ravel(), columns.ravel()))).tocsc()


def many_compliances(geometry, contacts, places, material, plane_strain=True):
    """Same as compliance(), by one factorisation for all loads."""
    from scipy.sparse.linalg import splu
    with tempfile.TemporaryDirectory() as folder:
        mesh = Mesh(geometry, folder)
    number = {n: i for i, n in enumerate(mesh.nodes)}
    held = {number[n] for e in mesh.edges[2] for n in e}
    free = np.array([2 * i + d for i in range(len(number)) if i not in held for d in (0, 1)])
    matrix = stiffness_matrix(mesh, number, material, plane_strain)
    solver = splu(matrix[free][:, free].tocsc(), permc_spec="MMD_AT_PLUS_A",
                  diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    forces = np.zeros((2 * len(number), len(contacts)))
    for i, contact in enumerate(contacts):
        for node, force in hertz_load(mesh, mesh.edges[3 + i], contact).items():
            forces[2 * number[node]:2 * number[node] + 2, i] = force
    moved = np.zeros_like(forces)
    moved[free] = solver.solve(forces[free])
    found = []
    for i, place in enumerate(places):
        node = number[mesh.nearest(place)]
        found.append(contacts[i % len(contacts)].direction @ moved[2 * node:2 * node + 2])
    return np.array(found)


def compliance(geometry, contacts, places, material, element="CPE6"):
    """Returns [i][j]: displacement of place i along the force of contact i per force on contact
    j, mm/N. Places beyond the number of contacts correspond to the contacts from the first
    again."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = Mesh(geometry, folder)
        cases = [hertz_load(mesh, mesh.edges[3 + i], c) for i, c in enumerate(contacts)]
        watched = [mesh.nearest(place) for place in places]
        moved = solve(mesh, cases, watched, folder, material, element)
    directions = [c.direction for c in contacts] * len(places)
    return np.array([[case[node] @ directions[i] for case in moved]
                     for i, node in enumerate(watched)])
