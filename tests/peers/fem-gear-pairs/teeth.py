"""Outlines of external and internal involute teeth, with and without shift, and their contact
points, from ISO 21771 and DIN 3960, independent of the program's own. Lengths in mm, angles in rad."""
import math

import numpy as np

TRANSVERSE_ANGLE = math.radians(20)


def involute(angle):
    return math.tan(angle) - angle


def inverse_involute(value):
    low, high = 0.0, 1.5
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if involute(middle) < value else (low, middle)
    return 0.5 * (low + high)


def turned(point, angle):
    c, s = math.cos(angle), math.sin(angle)
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


class Gear:
    """Gear geometry. profile: 'fillet' (an arc between involute, or the radius below the base
    circle, and root circle) or 'root-circle' (sides parallel to the centre line below the base
    circle). Internal teeth end on their root circle. held: radius of the circle on which the
    body is fixed."""

    def __init__(self, teeth, module, shift=0.0, internal=False, shortening=0.0, held=0.0,
                 profile="fillet", angle=TRANSVERSE_ANGLE, addendum=1.0, dedendum=1.25):
        self.teeth, self.internal, self.held, self.profile = teeth, internal, held, profile
        self.module, self.angle = module, angle
        pitch, sign = teeth * module / 2, -1 if internal else 1
        self.base = pitch * math.cos(angle)
        self.tip = pitch + sign * (addendum + shift - shortening) * module
        self.root = pitch - sign * (dedendum - shift) * module
        self.half_base = (math.pi / 2 + 2 * shift * math.tan(angle)) / teeth + sign * involute(angle)
        self.arc = 0.0 if internal else (dedendum - addendum) * module / (1 - math.sin(angle))

    def roll(self, radius):
        return math.sqrt(radius**2 - self.base**2)

    def flank(self, radius):
        """Point of the loaded flank; the tooth's centre line is the x axis."""
        inv = involute(math.acos(min(1.0, self.base / radius)))
        angle = self.half_base + (inv if self.internal else -inv)
        return radius * math.cos(angle), radius * math.sin(angle)

    def lowest(self):
        """Radius down to which (internal: up to which) the flank is an involute."""
        if self.internal or self.root > self.base and self.profile == "root-circle":
            return self.root
        if self.profile == "root-circle":
            return self.base
        roll = math.sqrt(max(0.0, (self.root + self.arc)**2 - self.base**2)) - self.arc
        return math.hypot(self.base, max(0.0, roll))

    def fillet_centre(self):
        """Centre of the arc on the loaded side of external teeth with fillets."""
        reach = self.root + self.arc
        roll = math.sqrt(max(0.0, reach**2 - self.base**2)) - self.arc
        tangent = self.half_base - max(0.0, roll) / self.base
        y = roll if roll > 0 else 0.0
        start = np.array(self.flank(math.hypot(self.base, y)))
        if roll < 0:
            end = math.sqrt(reach**2 - self.arc**2)
            start = np.array([end * math.cos(self.half_base), end * math.sin(self.half_base)])
        return start + self.arc * np.array([-math.sin(tangent), math.cos(tangent)])

    def critical_point(self):
        """Start of a root crack on the loaded side: where the tangent to the fillet is at
        30 degrees to the tooth's centre line, or, without a fillet, the end of the root
        chord."""
        if self.profile == "fillet" and not self.internal:
            return tuple(self.fillet_centre() - self.arc * np.array([0.5, math.sqrt(0.75)]))
        foot = self.foot()
        return foot[-1][-1] if foot else self.flank(self.root)

    def foot(self):
        """Pieces below the involute, down to the root circle: lists of points."""
        start = self.flank(self.lowest())
        if self.internal or self.root > self.base and self.profile == "root-circle":
            return []
        if self.profile == "root-circle":
            return [[start, (math.sqrt(self.root**2 - start[1]**2), start[1])]]
        reach = self.root + self.arc  # relative to the arc's centre
        roll = math.sqrt(max(0.0, reach**2 - self.base**2)) - self.arc
        pieces = []
        if roll >= 0:
            tangent = self.half_base - roll / self.base  # where the normal is tangent to the base circle
            normal = np.array([-math.sin(tangent), math.cos(tangent)])
        else:
            normal = np.array([-math.sin(self.half_base), math.cos(self.half_base)])
            end = math.sqrt(reach**2 - self.arc**2)
            below = (end * math.cos(self.half_base), end * math.sin(self.half_base))
            pieces.append([start, below])
            start = below
        centre = np.array(start) + self.arc * normal
        assert abs(np.hypot(*centre) - reach) < 1e-9 * reach
        first = math.atan2(*(np.array(start) - centre)[::-1])
        last = math.atan2(*(-centre)[::-1])
        last += 2 * math.pi * round((first - last) / (2 * math.pi))
        pieces.append([tuple(centre + self.arc * np.array([math.cos(a), math.sin(a)]))
                       for a in np.linspace(first, last, 9)])
        return pieces


class Contact:
    """Contact of one tooth with a mate: tooth number, counted against the force, and roll
    distance."""

    def __init__(self, gear, tooth, roll, half_width):
        self.tooth, self.half_width, self.gear = tooth, half_width, gear
        turn, sign = 2 * math.pi * tooth / gear.teeth, -1 if gear.internal else 1
        tangent = turn + gear.half_base - sign * roll / gear.base
        self.radius = math.hypot(gear.base, roll)
        self.direction = np.array([math.sin(tangent), -math.cos(tangent)])  # into the tooth
        self.point = (gear.base * np.array([math.cos(tangent), math.sin(tangent)])
                      - sign * roll * self.direction)

    def beneath(self):
        """Intersection of the force with the tooth's centre line."""
        turn = 2 * math.pi * self.tooth / self.gear.teeth
        across = np.array([-math.sin(turn), math.cos(turn)])
        along = -(self.point @ across) / (self.direction @ across)
        return self.point + along * self.direction


def weber(contact, poisson):
    """Displacement of a flank under the pressure of a Hertz contact towards the tooth's centre
    line, times pi E L / (2 (1 - poisson^2)) over the force: Weber and Banaschek (1953)."""
    depth = np.hypot(*(contact.point - contact.beneath()))
    return math.log(2 * depth / contact.half_width) - poisson / (2 * (1 - poisson))


class Pair:
    """Gear 1 drives; positions count mesh periods since a pair's engagement began."""

    def __init__(self, gear_1, gear_2, centre_distance, material, force):
        self.gears, self.material, self.force = (gear_1, gear_2), material, force
        inner = gear_2.internal
        bases = gear_2.base - gear_1.base if inner else gear_2.base + gear_1.base
        self.working_angle = math.acos(min(1.0, bases / centre_distance))
        self.line = centre_distance * math.sin(self.working_angle)
        tip = gear_2.roll(gear_2.tip)
        self.start = tip - self.line if inner else self.line - tip
        self.base_pitch = 2 * math.pi * gear_1.base / gear_1.teeth
        self.contact_ratio = (gear_1.roll(gear_1.tip) - self.start) / self.base_pitch

    def rolls(self, tau):
        first = self.start + tau * self.base_pitch
        return first, (self.line + first if self.gears[1].internal else self.line - first)

    def contacts(self, which, taus):
        """Contacts of gear 1 or 2: pairs a mesh period apart; tooth 0 is that of taus[0]."""
        young, poisson, width = self.material
        found = []
        for i, tau in enumerate(taus):
            rolls = self.rolls(tau)
            curvature = 1 / rolls[0] + (-1 if self.gears[1].internal else 1) / rolls[1]
            modulus = young / (2 * (1 - poisson**2))
            half_width = math.sqrt(4 * self.force / len(taus) / width
                                   / (math.pi * modulus * curvature))
            found.append(Contact(self.gears[which - 1], i if which == 1 else -i,
                                 rolls[which - 1], half_width))
        return found


def shifts_for(teeth_1, teeth_2, module, distance, internal=False):
    """Sum of the shifts for zero backlash at a distance."""
    signed = teeth_1 + (-teeth_2 if internal else teeth_2)
    cosine = abs(signed) * module * math.cos(TRANSVERSE_ANGLE) / 2 / distance
    return ((involute(math.acos(cosine)) - involute(TRANSVERSE_ANGLE)) * signed
            / (2 * math.tan(TRANSVERSE_ANGLE)))
