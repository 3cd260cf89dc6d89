"""Planetary gearbox with one unilateral spring for each tooth pair (README.md): 9 + 3 N degrees of freedom, index
errors, tip relief and corner contact; compare.py runs it."""
import ctypes
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "corner-contact"))
from gear_mesh import Gear, GearPair, MeshTable, Relief  # noqa: E402

MAX_DOF, BEYOND, NODES = 27, 0.45, 24001
DOUBLES = ctypes.POINTER(ctypes.c_double)


class Mesh(ctypes.Structure):
    _fields_ = [("nodes", ctypes.c_int), ("low", ctypes.c_double), ("high", ctypes.c_double),
                ("stiffness", DOUBLES), ("gap", DOUBLES), ("contact_ratio", ctypes.c_double),
                ("slices", ctypes.c_int), ("delay", ctypes.c_double), ("damping_factor", ctypes.c_double)]


class Contact(ctypes.Structure):
    _fields_ = [("kind", ctypes.c_int), ("start", ctypes.c_double), ("line", ctypes.c_double * MAX_DOF),
                ("error_one", DOUBLES), ("error_two", DOUBLES), ("teeth_one", ctypes.c_int),
                ("teeth_two", ctypes.c_int), ("first_one", ctypes.c_int), ("first_two", ctypes.c_int),
                ("time_in", ctypes.c_double), ("time_out", ctypes.c_double)]


class Gearbox(ctypes.Structure):
    _fields_ = [("dof", ctypes.c_int), ("contacts", ctypes.c_int), ("mass", ctypes.c_double * MAX_DOF),
                ("force", ctypes.c_double * MAX_DOF), ("stiffness", DOUBLES), ("damping", DOUBLES),
                ("period", ctypes.c_double), ("meshes", ctypes.POINTER(Mesh)), ("contact", ctypes.POINTER(Contact))]


def compiled():
    folder = tempfile.mkdtemp()
    library = f"{folder}/solver.so"
    subprocess.run(["gcc", "-O3", "-march=native", "-shared", "-fPIC", str(HERE / "solver.c"), "-o", library, "-lm"],
                   check=True)
    return ctypes.CDLL(library)


class Planetary:
    """A gearbox from the values of a case file. Rows of motions: x, y, u of carrier, ring, sun, planets 1..N."""

    def __init__(self, case, onset):
        self.case, self.onset, self.keep = case, onset, []
        c, n = case, case["planets"]
        helix = math.radians(c.get("helix_angle_deg", 0.0))
        normal = math.radians(c["pressure_angle_deg"])
        module = 1e-3 * c["module_mm"] / math.cos(helix)
        alpha = math.atan(math.tan(normal) / math.cos(helix))
        width = 1e-3 * c["face_width_mm"]
        self.gears = [Gear(z, module, x * math.cos(helix), i == 2, addendum=math.cos(helix),
                           dedendum=1.25 * math.cos(helix), pressure_angle=alpha)
                      for i, (z, x) in enumerate(zip(c["teeth"], c.get("shifts", (0, 0, 0))))]
        sun, planet, ring = self.gears
        material = dict(young_modulus=c["young_modulus_Pa"], poisson_ratio=c["poisson_ratio"], face_width=width,
                        helix=helix, base_helix=math.asin(math.sin(helix) * math.cos(normal)))
        self.pairs = (GearPair(sun, planet, **material), GearPair(planet, ring, **material))
        distance = self.pairs[0].distance
        assert abs(distance - self.pairs[1].distance) < 1e-9, "both meshes need the same centre distance"
        self.force_nominal = c["torque_N_m"] / n / sun.base
        self.speed = c["carrier_speed_rpm"] * math.pi / 30
        self.period = 2 * math.pi / (self.speed * ring.teeth)
        self.position = np.radians(c["planet_positions_deg"])
        relief, length = ([1e-6 * v for v in c.get("tip_relief_um", (0, 0, 0))],
                          [1e-3 * v for v in c.get("tip_relief_length_mm", (1, 1, 1))])
        reliefs = (Relief(relief[0], length[0], relief[1], length[1]),
                   Relief(relief[1], length[1], relief[2], length[2]))
        overlap = width * math.tan(helix) / (2 * math.pi * sun.reference / sun.teeth)
        slices = c.get("slices", 1) if helix else 1
        self.tables = [MeshTable(pair, onset, r, BEYOND) for pair, r in zip(self.pairs, reliefs)]
        self.lead = 0.5 * overlap  # mesh periods by which a tooth's first slice leads the middle of the face
        self.build(distance, overlap, slices)

    def array(self, values):
        values = np.ascontiguousarray(values, dtype=float)
        self.keep.append(values)
        return values.ctypes.data_as(DOUBLES)

    def build(self, distance, overlap, slices):
        c, n = self.case, self.case["planets"]
        sun, planet, ring = self.gears
        dof = self.dof = 9 + 3 * n
        names = ["carrier", "ring", "sun"] + ["planet"] * n
        radius = {"carrier": distance, "ring": ring.base, "sun": sun.base, "planet": planet.base}
        mass = np.concatenate([[c["mass_kg"][b]] * 2 + [c["inertia_kg_m2"][b] / radius[b]**2] for b in names])
        stiffness, damping, force = np.zeros((dof, dof)), np.zeros((dof, dof)), np.zeros(dof)

        def spring(row, k, d, at_rest=0.0):
            nonlocal stiffness, damping, force
            stiffness += k * np.outer(row, row)
            damping += d * np.outer(row, row)
            force += k * at_rest * row

        unit = np.eye(dof)
        for b, body in enumerate(("carrier", "ring", "sun")):
            for axis in (0, 1):
                spring(unit[3 * b + axis], c["bearing_N_m"][body], c["bearing_N_s_m"][body])
        spring(unit[5], c["support_N_m"], c["support_N_s_m"])
        torque = c["torque_N_m"]
        force[8] += torque / sun.base
        force[2] -= torque * (1 + ring.teeth / sun.teeth) / distance
        self.kind_lines = []
        for p, psi in enumerate(self.position):
            x = 9 + 3 * p
            tangential, radial = (1e-6 * c.get(key, [0] * n)[p] for key in ("pin_tangential_um", "pin_radial_um"))
            cos, sin = math.cos(psi), math.sin(psi)
            spring(unit[x] - unit[0] + sin * unit[2], c["bearing_N_m"]["planet"], c["bearing_N_s_m"]["planet"],
                   radial * cos - tangential * sin)
            spring(unit[x + 1] - unit[1] - cos * unit[2], c["bearing_N_m"]["planet"], c["bearing_N_s_m"]["planet"],
                   radial * sin + tangential * cos)
            at = math.pi / 2 - self.pairs[0].working_angle + psi
            self.kind_lines.append((0, p, math.cos(at) * (unit[6] - unit[x]) + math.sin(at) * (unit[7] - unit[x + 1])
                                    + unit[8] + unit[x + 2]))
            at = math.pi / 2 + self.pairs[1].working_angle + psi
            self.kind_lines.append((1, p, math.cos(at) * (unit[3] - unit[x]) + math.sin(at) * (unit[4] - unit[x + 1])
                                    + unit[5] - unit[x + 2]))
            if c.get("inertial_terms", True):
                force[x] += c["mass_kg"]["planet"] * distance * self.speed**2 * cos
                force[x + 1] += c["mass_kg"]["planet"] * distance * self.speed**2 * sin
        if c.get("inertial_terms", True):
            for b in range(3 + n):
                m, x = mass[3 * b], 3 * b
                damping[x, x + 1] -= 2 * m * self.speed
                damping[x + 1, x] += 2 * m * self.speed
                stiffness[x, x] -= m * self.speed**2
                stiffness[x + 1, x + 1] -= m * self.speed**2
        # Rigid rotation of the whole train (the ring held): no spring sees it.
        self.rigid = np.zeros(dof)
        self.rigid[2], self.rigid[8] = 1, math.cos(self.pairs[0].working_angle) + math.cos(self.pairs[1].working_angle)
        for p, psi in enumerate(self.position):
            self.rigid[9 + 3 * p:12 + 3 * p] = -math.sin(psi), math.cos(psi), -math.cos(self.pairs[1].working_angle)
        self.mass, self.stiffness, self.damping, self.force = mass, stiffness, damping, force
        m = c["mass_kg"]
        self.meshes = (Mesh * 2)()
        for kind, (table, other) in enumerate(zip(self.tables, ("sun", "ring"))):
            pair, beyond = table.pair, BEYOND if self.onset == "extended" else 0.0
            tau = np.linspace(-beyond, pair.contact_ratio + beyond, NODES)
            self.meshes[kind] = Mesh(
                NODES, tau[0], tau[-1], self.array(table.stiffness(tau)), self.array(table.gap(tau)),
                pair.contact_ratio, slices, overlap,
                2 * c["mesh_damping_ratio"] * math.sqrt(m["planet"] * m[other] / (m["planet"] + m[other])))
        self.contacts = (Contact * (2 * n))()
        for i, (kind, p, line) in enumerate(self.kind_lines):
            self.contacts[i] = self.contact(kind, p, line)

    def contact(self, kind, p, line):
        """Which teeth meet when. Sun tooth j touches planet 1 at the pitch point at mesh period j; it reaches planet
        p after z_s psi / 2 pi periods. Ring teeth pass backwards. A planet's tooth turns from the sun to the ring."""
        c, psi = self.case, self.position[p]
        sun, planet, ring = self.gears
        errors = {key: self.array(1e-6 * np.array(c[key])) for key in
                  ("sun_index_um", "ring_index_um")}
        zp = planet.teeth
        half = [float(planet.half_angle(planet.base / math.cos(pair.working_angle))) for pair in self.pairs]
        turn = (math.pi - sum(half)) * zp / (2 * math.pi)  # mesh periods from the sun's to the ring's pitch point
        shift = turn - round(turn)
        sun_at, ring_at = sun.teeth * psi / (2 * math.pi), -ring.teeth * psi / (2 * math.pi) + shift
        line = (ctypes.c_double * MAX_DOF)(*line)
        start = [p.start / p.base_pitch for p in self.pairs]
        # Tooth 0 of every gear is that which first starts its contact after mesh period 0: the sun's and the ring's
        # with planet 1, a planet's with the sun.
        first = lambda at: -math.ceil(-(at - self.lead) - 1e-9)
        planet_first = first(sun_at + start[0])
        planet_errors = self.array(1e-6 * np.array(c[("planet_index_um", "planet_ring_side_index_um")[kind]][p]))
        if kind == 0:
            return Contact(0, sun_at + start[0], line, errors["sun_index_um"], planet_errors, sun.teeth, zp,
                           first(start[0]), planet_first, 0, 0)
        later = round(sun_at + turn - ring_at)  # pair number on the ring of the tooth of pair 0 on the sun
        return Contact(1, ring_at + start[1], line, planet_errors, errors["ring_index_um"], zp, ring.teeth,
                       planet_first - later, first(shift + start[1]), 0, 0)

    def transitions(self, last):
        """Mesh periods at which any tooth pair starts or ends its nominal contact (abrupt onset only)."""
        times = []
        for contact in self.contacts:
            ratio = self.meshes[contact.kind].contact_ratio
            for edge in (contact.start, contact.start + ratio):
                times.append(edge % 1.0 + np.arange(last + 1))
        return np.concatenate(times)

    def run(self, run_in, meshes, steps, samples):
        """Motions, velocities and accelerations, mesh forces at `samples` per mesh over `meshes` periods from mesh
        period 0 on, after `run_in` periods. Contact shares are those of the recorded periods."""
        library = compiled()
        sample_times = -run_in + np.arange((run_in + meshes) * samples + 1) / samples
        nodes = [-run_in + np.arange((run_in + meshes) * steps + 1) / steps, sample_times]
        if self.onset == "abrupt" and self.meshes[0].slices == 1:
            nodes.append(self.transitions(run_in + meshes) - run_in)
        times = np.unique(np.round(np.concatenate(nodes), 12))
        times = times[(times >= -run_in) & (times <= meshes)]
        record = np.zeros(len(times), dtype=np.uint8)
        record[np.searchsorted(times, np.round(sample_times[sample_times >= 0], 12))] = 1
        n, count = self.dof, len(self.contacts)
        gearbox = Gearbox(n, count, (ctypes.c_double * MAX_DOF)(*self.mass), (ctypes.c_double * MAX_DOF)(*self.force),
                      self.array(self.stiffness), self.array(self.damping), self.period, self.meshes, self.contacts)
        state = np.concatenate([self.static_deflection(), np.zeros(n)])
        out = np.zeros((int(record.sum()), 3 * n + count))
        library.integrate.argtypes = [ctypes.POINTER(Gearbox), DOUBLES, ctypes.c_void_p, ctypes.c_long,
                                      ctypes.c_double, DOUBLES, DOUBLES]
        library.integrate(gearbox, times.ctypes.data_as(DOUBLES), record.ctypes.data, len(times), 0.0,
                          state.ctypes.data_as(DOUBLES), out.ctypes.data_as(DOUBLES))
        shares = [sum(x.time_out for x in self.contacts if x.kind == kind)
                  / sum(x.time_out + x.time_in for x in self.contacts if x.kind == kind) for kind in (0, 1)]
        return {"phase": times[record == 1], "q": self.without_rotation(out[:, :n]),
                "v": self.without_rotation(out[:, n:2 * n]), "a": out[:, 2 * n:3 * n], "force": out[:, 3 * n:],
                "out_of_contact": np.array(shares)}

    def without_rotation(self, motions):
        return motions - np.outer(motions @ (self.mass * self.rigid), self.rigid) / (self.mass @ self.rigid**2)

    def static_deflection(self):
        """Deflection under mean mesh stiffness; the rigid rotation is held at zero (mass-weighted)."""
        k = self.stiffness.copy()
        for kind, _, line in self.kind_lines:
            table = self.tables[kind]
            mean = table.stiffness(np.linspace(0, table.pair.contact_ratio, 401)).mean() * table.pair.contact_ratio
            k += mean * np.outer(line, line)
        held = self.mass * self.rigid
        k += 1e8 * np.outer(held, held) / (held @ held)
        return self.without_rotation(np.linalg.solve(k, self.force)[None, :])[0]
