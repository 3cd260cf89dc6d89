"""Geometry, tooth-pair stiffness and loaded deflection of involute spur gear pairs, external and internal.

Geometry: ISO 21771. Stiffness: potential energy of tapered beams (Yang and Lin 1987; Liang 2016, Eqs. 2.2.6 to
2.2.31 and 3.2.3 to 3.2.20) by Gauss-Legendre quadrature over the tooth sections. SI units, angles in rad.
Gear 1 drives. Gear 2 is external, or the internal gear (ring) of an internal pair.
"""
import dataclasses
import functools
import math

import numpy as np
from scipy.optimize import brentq


def involute(angle):
    return np.tan(angle) - angle


def inverse_involute(value):
    return brentq(lambda a: math.tan(a) - a - value, 0.0, 1.2, xtol=1e-15)


@dataclasses.dataclass(frozen=True)
class Gear:
    """An involute gear whose flanks continue below the base circle parallel to the tooth's centre line."""
    teeth: int
    module: float
    shift: float = 0.0  # profile shift over module (ISO 21771: a positive one makes a ring's tip circle smaller)
    internal: bool = False
    tip: float = 0.0  # tip radius; 0: from addendum and shift
    addendum: float = 1.0
    dedendum: float = 1.25
    pressure_angle: float = math.radians(20)

    @property
    def sign(self):
        return -1 if self.internal else 1

    @property
    def reference(self):
        return self.teeth * self.module / 2

    @property
    def base(self):
        return self.reference * math.cos(self.pressure_angle)

    @property
    def tip_radius(self):
        return self.tip or self.reference + self.sign * self.module * (self.addendum + self.shift)

    @property
    def root_radius(self):
        return self.reference - self.sign * self.module * (self.dedendum - self.shift)

    @property
    def half_base_angle(self):
        """Half the angle of a tooth at the base circle (internal teeth: of the flanks continued to it)."""
        half = (math.pi / 2 + 2 * self.shift * math.tan(self.pressure_angle)) / self.teeth
        return half + self.sign * involute(self.pressure_angle)

    def half_angle(self, radius):
        """Half the angle of a tooth at given radii."""
        radius = np.asarray(radius, dtype=float)
        inv = involute(np.arccos(np.minimum(1.0, self.base / radius)))
        above = self.half_base_angle - self.sign * inv
        below = np.arcsin(np.minimum(1.0, self.base * math.sin(self.half_base_angle) / radius))
        return np.where(radius >= self.base, above, below)

    def compliance(self, roll, young_modulus, poisson_ratio, face_width, helix=0.0, nodes=60):
        """Deflection per force (m/N) of a tooth touched at the roll angle `roll` (tangent of the pressure angle
        there), along the line of action: bending, shear and axial compression; rigid body. A slice of a helical tooth
        (helix angle `helix`) is cos^4 of it as stiff in bending and cos^2 in shear."""
        half, base = self.half_base_angle, self.base

        def section(u):  # height above the gear's axis and half thickness at roll angle u
            g = (half + u) if self.internal else (u - half)
            height = base * (np.cos(g) + u * np.sin(g))
            thick = base * (np.sin(g) - u * np.cos(g)) if self.internal else base * (u * np.cos(g) - np.sin(g))
            return height, thick

        if self.internal:
            angle, at_root = half + roll, math.tan(math.acos(base / self.root_radius))
        else:
            angle = roll - half
            at_root = math.tan(math.acos(base / self.root_radius)) if self.root_radius > base else 0.0
        contact_height, contact_half = section(roll)
        x, weight = np.polynomial.legendre.leggauss(nodes)
        u = 0.5 * (roll + at_root) + 0.5 * (roll - at_root) * x
        height, half_thickness = section(u)
        g = (half + u) if self.internal else (u - half)
        d_height = base * u * np.cos(g)  # derivative of the height by u
        widths = [(height, half_thickness, np.abs(0.5 * (roll - at_root) * d_height * weight))]
        if not self.internal and self.root_radius < base:  # parallel sides from the base to the root circle
            h0 = base * math.sin(half)
            low, high = math.sqrt(self.root_radius**2 - h0**2), base * math.cos(half)
            y = 0.5 * (high + low) + 0.5 * (high - low) * x
            widths.append((y, np.full(nodes, h0), 0.5 * (high - low) * weight))
        shear_modulus = young_modulus / (2 * (1 + poisson_ratio))
        total = 0.0
        for y, h, dy in widths:
            area, inertia = 2 * h * face_width, (2 * h)**3 * face_width / 12
            arm = np.abs(contact_height - y) * math.cos(angle) - contact_half * math.sin(angle)
            total += np.sum(dy * (arm**2 / (young_modulus * inertia * math.cos(helix)**4)
                                  + 1.2 * math.cos(angle)**2 / (shear_modulus * area * math.cos(helix)**2)
                                  + math.sin(angle)**2 / (young_modulus * area)))
        return total


@dataclasses.dataclass(frozen=True)
class GearPair:
    """A driving external gear and an external or internal driven gear at a working centre distance.

    Position s: distance of the theoretical contact point from the pitch point along the line of action, positive
    in recess. tau: the same from the start of the path of contact, in base pitches."""
    one: Gear
    two: Gear
    centre_distance: float = 0.0  # 0: without backlash
    young_modulus: float = 2.068e11
    poisson_ratio: float = 0.3
    face_width: float = 0.0381
    helix: float = 0.0  # helix angle of the slices' tooth
    base_helix: float = 0.0

    @functools.cached_property
    def working_angle(self):
        a, b = self.one, self.two
        if self.centre_distance:
            return math.acos((b.base + b.sign * a.base) / self.centre_distance)
        shifts, teeth = (a.shift + b.sign * b.sign * b.shift, a.teeth + b.sign * b.teeth)
        return inverse_involute(involute(a.pressure_angle) + 2 * shifts * math.tan(a.pressure_angle) / teeth)

    @property
    def distance(self):
        return (self.two.base + self.two.sign * self.one.base) / math.cos(self.working_angle)

    @property
    def base_pitch(self):
        return 2 * math.pi * self.one.base / self.one.teeth

    @property
    def start(self):
        """s at which the driven gear's tip corner is on the line of action."""
        b, pitch = self.two, self.two.base * math.tan(self.working_angle)
        return -b.sign * (math.sqrt(b.tip_radius**2 - b.base**2) - pitch)

    @property
    def end(self):
        """s at which the driving gear's tip corner is on the line of action."""
        a = self.one
        return math.sqrt(a.tip_radius**2 - a.base**2) - a.base * math.tan(self.working_angle)

    @property
    def path_length(self):
        return self.end - self.start

    @property
    def contact_ratio(self):
        return self.path_length / self.base_pitch

    def gap(self, s, samples=4001):
        """Gap at position s, the gears standing at their exact ratio: rotation times base radius of the gear whose
        flank the other's tip corner meets (gear 1 before the pitch point, gear 2 after it), until the two touch.
        Measured so it is a distance along the normal of that flank. Every point of a flank up to its tip corner is
        held against the other flank up to its tip corner; no formula of the line of action enters."""
        a, b, aw = self.one, self.two, self.working_angle
        # Flanks of both gears pass through the pitch point at s = 0. Angles about axis 1 count from the line of
        # centres, those about axis 2 likewise (external: towards axis 1); both grow with the sense of rotation.
        at_one = s / a.base - float(a.half_angle(a.base / math.cos(aw)))
        at_two = s / b.base + float(b.half_angle(b.base / math.cos(aw)))
        distance = self.distance

        def about_other(radius, angle):
            x, y = radius * np.cos(angle), radius * np.sin(angle)
            x = distance - x if not b.internal else x
            return x, y

        def from_two(radius):
            """Points of flank 2, in polar coordinates about axis 1."""
            x, y = about_other(radius, at_two - b.half_angle(radius))
            x = x - distance if b.internal else x
            return np.hypot(x, y), np.arctan2(y, x)

        def from_one(radius):
            """Points of flank 1, in polar coordinates about axis 2."""
            x, y = about_other(radius, at_one + a.half_angle(radius))
            x = x + distance if b.internal else x
            return np.hypot(x, y), np.arctan2(y, x)

        if s < 0:  # points of flank 2; gear 1 would turn forwards
            points = np.linspace(min(b.tip_radius, b.root_radius), max(b.tip_radius, b.root_radius), samples)
            place, limit = from_two, a.tip_radius
            miss = lambda r, angle: a.base * (angle - at_one - a.half_angle(r))
            inside = lambda r: (r <= limit * (1 + 1e-13)) & (r >= a.root_radius)
        else:  # points of flank 1; gear 2 would turn backwards
            points = np.linspace(a.root_radius, a.tip_radius, samples)
            place, limit = from_one, b.tip_radius
            miss = lambda r, angle: b.base * (at_two - b.half_angle(r) - angle)
            inside = lambda r: b.sign * (limit - r) >= -1e-13 * limit
        reach = place(points)[0] - limit  # the other tip corner meets this flank
        corners = [brentq(lambda q: float(place(np.array(q))[0]) - limit, points[i], points[i + 1], xtol=1e-15)
                   for i in np.nonzero(reach[:-1] * reach[1:] < 0)[0]]
        radius, angle = place(np.append(points, corners))
        return float(np.min(np.where(inside(radius), miss(radius, angle), np.inf)))

    def gap_curvature(self):
        """Limits of gap / s^2 at the start and at the end of the path, in closed form: half of
        t (t' + t) / (t' r^2), where t is the distance of the contact point from the base circle (radius r) of the
        gear with the corner, and t' that from the other's; with t - t' in place of t' + t (and its amount) if internal.
        Independent of gap(): the normal acceleration of the corner, and the curvature of the flank it passes."""
        a, b, span = self.one, self.two, self.distance * math.sin(self.working_angle)
        limits = []
        for s in (self.start, self.end):
            t1 = a.base * math.tan(self.working_angle) + s
            t2 = b.base * math.tan(self.working_angle) - b.sign * s
            corner, other, base = (t2, t1, b.base) if s < 0 else (t1, t2, a.base)
            limits.append(0.5 * corner * span / (other * base**2))
        return limits

    def gap_table(self, beyond=0.5, points=400):
        """tau and gaps before the start and after the end of the path, up to `beyond` base pitches."""
        tau = beyond * np.linspace(0, 1, points)**1.5
        before = [self.gap(self.start - t * self.base_pitch) for t in tau]
        after = [self.gap(self.end + t * self.base_pitch) for t in tau]
        return tau, np.array(before), np.array(after)

    def pair_stiffness(self, tau):
        """Stiffness (N/m) of one tooth pair; outside the path of contact the value at that end of it."""
        tau = np.clip(tau, 0, self.contact_ratio)
        s = self.start + tau * self.base_pitch
        roll_one = math.tan(self.working_angle) + s / self.one.base
        roll_two = math.tan(self.working_angle) - self.two.sign * s / self.two.base
        material = (self.young_modulus, self.poisson_ratio, self.face_width, self.helix)
        contact = 4 * (1 - self.poisson_ratio**2) / (math.pi * self.young_modulus * self.face_width
                                                     * math.cos(self.base_helix))
        return 1 / (contact + self.one.compliance(roll_one, *material) + self.two.compliance(roll_two, *material))


@dataclasses.dataclass
class Relief:
    """Linear tip relief along the line of action, from the end of the path of contact (amount, length)."""
    one: float = 0.0
    one_length: float = 1.0
    two: float = 0.0
    two_length: float = 1.0

    def __call__(self, pair, tau):
        s = pair.start + np.clip(tau, 0, pair.contact_ratio) * pair.base_pitch
        return (self.one * np.maximum(0, 1 - (pair.end - s) / self.one_length)
                + self.two * np.maximum(0, 1 - (s - pair.start) / self.two_length))


class MeshTable:
    """Stiffness and gap of a tooth pair tabulated over tau, corner gap and relief included."""

    def __init__(self, pair, onset="extended", relief=None, beyond=0.5):
        self.pair, self.onset, self.beyond = pair, onset, beyond
        self.relief = relief or Relief()
        self._grid, self._stiffness = _stiffness_table(pair)
        if onset == "extended":
            self._tau, self._before, self._after = _gap_table(pair, beyond)

    def stiffness(self, tau):
        return np.interp(tau, self._grid, self._stiffness)

    def gap(self, tau):
        """Gap of an error-free tooth pair; infinite where it can never touch."""
        pair, tau = self.pair, np.asarray(tau, dtype=float)
        gap = self.relief(pair, tau)
        before, after = -tau, tau - pair.contact_ratio
        if self.onset == "extended":
            corner = np.where(before > 0, _at(before, self._tau, self._before, self.beyond),
                              _at(after, self._tau, self._after, self.beyond))
        else:
            corner = np.inf
        return gap + np.where((before > 0) | (after > 0), corner, 0.0)

    def deflection(self, phases, force, errors=None):
        """Loaded deflection d and each touching tooth pair's force at given mesh phases (in periods; pair j starts
        its nominal contact at phase j). errors: index error of pair j at errors[j modulo its length].
        Columns of the forces: pairs floor(phase) + 1, floor(phase), floor(phase) - 1, ..."""
        phases = np.asarray(phases, dtype=float)
        period = np.floor(phases).astype(int)
        pairs = period[:, None] - np.arange(-1, math.ceil(self.pair.contact_ratio) + 1)[None, :]
        tau = phases[:, None] - pairs
        k, gap = self.stiffness(tau), self.gap(tau)
        if errors is not None:
            gap = gap + np.asarray(errors)[pairs % len(errors)]
        far = ~np.isfinite(gap)
        k, gap = np.where(far, 0.0, k), np.where(far, 0.0, gap)
        low, high = np.full(len(phases), gap.min()), np.full(len(phases), 1e-3)
        for _ in range(48):
            d = 0.5 * (low + high)
            more = (k * np.maximum(0, d[:, None] - gap)).sum(1) > force
            high, low = np.where(more, d, high), np.where(more, low, d)
        return d, k * np.maximum(0, d[:, None] - gap)


@functools.lru_cache(maxsize=None)
def _stiffness_table(pair):
    grid = np.linspace(0, pair.contact_ratio, 801)
    return grid, np.array([pair.pair_stiffness(t) for t in grid])


@functools.lru_cache(maxsize=None)
def _gap_table(pair, beyond):
    return pair.gap_table(beyond)


def _at(tau, nodes, values, beyond):
    """Corner gap between table nodes: gap / tau^2 is smooth, so that is what is interpolated."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = values[1:] / nodes[1:]**2
    tau = np.maximum(tau, 0)
    return np.where(tau > beyond, np.inf, np.interp(tau, nodes[1:], ratio) * tau**2)


def planetary_pairs(module, teeth, shifts=(0.0, 0.0, 0.0), centre_distance=0.0, tips=(0.0, 0.0, 0.0), **material):
    """Sun-planet and planet-ring pairs of a planetary set (sun drives)."""
    sun, planet, ring = (Gear(z, module, x, i == 2, tip)
                         for i, (z, x, tip) in enumerate(zip(teeth, shifts, tips)))
    return (GearPair(sun, planet, centre_distance, **material), GearPair(planet, ring, centre_distance, **material))
