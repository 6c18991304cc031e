#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Derives the nonlinear bicycle with sympy and writes its equations as C.

Example: python3 derive.py -o sympy_equations.h

Whipple's bicycle with discs that roll without slipping on a level plane, by
sympy.physics.mechanics.KanesMethod: four rigid bodies, the front contact's height as configuration
constraint, the front contact's velocity as three velocity constraints. The rear wheel rolls by the
choice of its speed. Axes are ISO 8855's (x forward, y left, z up); the four angles are yaw, lean
(right positive), the lean of the steering axis in the rear wheel's plane (back positive, the
paper's beta_r) and steer (left positive).

Nothing of this project's equations takes part. Needs sympy (Debian: python3-sympy); a few seconds.
"""
import argparse
import hashlib
import os
import pathlib
import sys

import sympy
from sympy import Matrix, Symbol, cos, cse, sin, symbols
from sympy.physics.mechanics import (
    KanesMethod,
    Point,
    ReferenceFrame,
    RigidBody,
    dynamicsymbols,
    inertia,
    msubs,
)
from sympy.printing.c import C99CodePrinter

# Members of `struct sympy_bicycle`, in its order.
PARAMETERS = """
    R_r R_f L_r L_f L_s gravity damping
    m_r x_r z_r r_xx r_yy r_zz r_xz
    m_w w_xx w_yy
    m_f x_f z_f f_xx f_yy f_zz f_xz
    m_v v_xx v_yy
""".split()


class Motion:
    """Coordinates and speeds."""

    def __init__(self):
        self.yaw, self.lean, self.tilt, self.steer = dynamicsymbols("yaw lean tilt steer")
        # rates of those angles; the rear contact's speed along its track; the front wheel's spin
        self.yaw_rate, self.lean_rate, self.tilt_rate, self.steer_rate = dynamicsymbols(
            "yaw_rate lean_rate tilt_rate steer_rate"
        )
        self.speed, self.spin = dynamicsymbols("speed spin")
        self.angles = [self.yaw, self.lean, self.tilt, self.steer]
        self.rates = [self.yaw_rate, self.lean_rate, self.tilt_rate, self.steer_rate]
        self.independent = [self.lean_rate, self.steer_rate, self.speed]
        self.dependent = [self.yaw_rate, self.tilt_rate, self.spin]

    def kinematics(self):
        return [q.diff() - u for q, u in zip(self.angles, self.rates)]


class Frames:
    """ground -yaw-> heading -lean-> plane -tilt-> rear -steer-> fork, and the two wheels."""

    def __init__(self, m, p):
        self.ground = ReferenceFrame("ground")
        self.heading = self.ground.orientnew("heading", "Axis", [m.yaw, self.ground.z])
        self.plane = self.heading.orientnew("plane", "Axis", [m.lean, self.heading.x])
        self.rear = self.plane.orientnew("rear", "Axis", [-m.tilt, self.plane.y])
        self.fork = self.rear.orientnew("fork", "Axis", [m.steer, self.rear.z])
        self.heading.set_ang_vel(self.ground, m.yaw_rate * self.ground.z)
        self.plane.set_ang_vel(self.heading, m.lean_rate * self.heading.x)
        self.rear.set_ang_vel(self.plane, -m.tilt_rate * self.plane.y)
        self.fork.set_ang_vel(self.rear, m.steer_rate * self.rear.z)
        # round wheels need no angle of their own
        self.rear_wheel = ReferenceFrame("rear_wheel")
        self.rear_wheel.set_ang_vel(self.plane, m.speed / p["R_r"] * self.plane.y)
        self.front_wheel = ReferenceFrame("front_wheel")
        self.front_wheel.set_ang_vel(self.fork, m.spin * self.fork.y)


def set_points(f, p):
    """Centres of mass, and place and velocity of the front contact."""
    ground, rear, fork = f.ground, f.rear, f.fork
    contact = Point("rear_contact")
    hub = contact.locatenew("rear_hub", p["R_r"] * f.plane.z)
    hub.set_vel(ground, f.rear_wheel.ang_vel_in(ground) ^ (p["R_r"] * f.plane.z))
    centre = hub.locatenew("rear_centre", p["x_r"] * rear.x + p["z_r"] * rear.z)
    centre.v2pt_theory(hub, ground, rear)
    # of the perpendicular from the front hub onto the steering axis
    foot = hub.locatenew("foot", p["L_r"] * rear.x - p["L_s"] * rear.z)
    foot.v2pt_theory(hub, ground, rear)
    fork_centre = foot.locatenew("fork_centre", p["x_f"] * fork.x + p["z_f"] * fork.z)
    fork_centre.v2pt_theory(foot, ground, fork)
    front_hub = foot.locatenew("front_hub", p["L_f"] * fork.x)
    front_hub.v2pt_theory(foot, ground, fork)
    up = f.heading.z
    radius = p["R_f"] * ((up & fork.y) * fork.y - up).normalize()
    place = front_hub.pos_from(contact) + radius
    velocity = front_hub.vel(ground) + (f.front_wheel.ang_vel_in(ground) ^ radius)
    return (hub, centre, fork_centre, front_hub), place, velocity


def rigid_bodies(f, p, points):
    hub, centre, fork_centre, front_hub = points

    def body(name, point, frame, mass, axes, xx, yy, zz, xz=0):
        tensor = inertia(axes, xx, yy, zz, 0, 0, xz)
        return RigidBody(name, point, frame, mass, (tensor, point))

    return [
        body("rear", centre, f.rear, p["m_r"], f.rear, p["r_xx"], p["r_yy"], p["r_zz"], p["r_xz"]),
        body("rear_wheel", hub, f.rear_wheel, p["m_w"], f.plane, p["w_xx"], p["w_yy"], p["w_xx"]),
        body("fork", fork_centre, f.fork, p["m_f"], f.fork, p["f_xx"], p["f_yy"], p["f_zz"], p["f_xz"]),
        body("front_wheel", front_hub, f.front_wheel, p["m_v"], f.fork, p["v_xx"], p["v_yy"], p["v_xx"]),
    ]


def derive():
    """Motion, height of the front contact, and Kane's equations."""
    p = {name: Symbol("p->" + name) for name in PARAMETERS}
    m = Motion()
    f = Frames(m, p)
    points, place, velocity = set_points(f, p)
    height = place & f.heading.z
    slip = [velocity & axis for axis in (f.heading.y, f.heading.z, f.heading.x)]
    kane = KanesMethod(
        f.ground,
        q_ind=[m.yaw, m.lean, m.steer],
        q_dependent=[m.tilt],
        configuration_constraints=[height],
        u_ind=m.independent,
        u_dependent=m.dependent,
        velocity_constraints=slip,
        kd_eqs=m.kinematics(),
    )
    bodies = rigid_bodies(f, p, points)
    damper = p["damping"] * m.steer_rate * f.rear.z
    loads = [(b.masscenter, -b.mass * p["gravity"] * f.ground.z) for b in bodies]
    kane.kanes_equations(bodies, loads + [(f.fork, -damper), (f.rear, damper)])
    return m, height, kane


def plain(m):
    """What the C functions call the angles' functions and the speeds. The yaw angle drops out."""
    names = {}
    for angle in (m.lean, m.steer, m.tilt):
        names[sin(angle)] = Symbol("s_" + angle.name)
        names[cos(angle)] = Symbol("c_" + angle.name)
    for speed in m.rates + [m.speed, m.spin]:
        names[speed] = Symbol(speed.name)
    return names


def with_one_root(values):
    """The one square root (of the front wheel's downward radius) and its powers as powers of `root`,
    its reciprocal, so that it is taken, and divided by, once. Returns its definition too."""
    values = [Matrix(value) for value in values]
    powers = {q for v in values for q in v.atoms(sympy.Pow) if q.exp.is_Rational and q.exp.q == 2}
    (base,) = {q.base for q in powers}
    root = Symbol("root")
    named = {q: root ** (-2 * q.exp) for q in powers}
    return 1 / sympy.sqrt(base), [value.xreplace(named) for value in values]


class Printer(C99CodePrinter):
    """Powers as products, quotients and square roots: what a person would write."""

    def _print_Pow(self, power):
        base, exponent = self.parenthesize(power.base, 1000), power.exp
        if exponent == sympy.Rational(-1, 2):
            return f"(1.0/sqrt({self._print(power.base)}))"
        if not exponent.is_integer:
            raise ValueError(f"no C for {power}")
        product = "*".join([base] * abs(int(exponent)))
        return f"({product})" if exponent > 0 else f"(1.0/({product}))"


def written(names, values):
    return [f"  {name} = {Printer().doprint(value)};" for name, value in zip(names, values)]


def shared(values):
    """Common subexpressions of some matrices: names and values of the parts, what is left of the
    matrices, and the number of operations. A part stands before its first use."""
    root, values = with_one_root(values)
    definition = Matrix([root])
    parts, (definition, *values) = cse([definition, *values], symbols=symbols("t0:9999"))
    # the root right behind the parts of its own
    own = next(i for i, (_, e) in enumerate(parts + [(0, Symbol("root"))]) if e.has(Symbol("root")))
    parts.insert(own, (Symbol("root"), definition[0]))
    count = sympy.count_ops([e for _, e in parts]) + sum(sympy.count_ops(list(v)) for v in values)
    return parts, values, count


def height_function(m, height):
    values = Matrix([msubs(e, plain(m)) for e in (height, height.diff(m.tilt))])
    parts, (values,), count = shared([values])
    names = [f"const double {name}" for name, _ in parts] + ["*height", "*slope"]
    return written(names, [e for _, e in parts] + list(values)), count


def system_function(m, onto, names_out, system):
    """The parts that the dependent speeds need come first, then those speeds, then the others."""
    onto, system = msubs(Matrix(onto), plain(m)), msubs(Matrix(system), plain(m))
    dependent = onto * Matrix([Symbol(u.name) for u in m.independent])
    parts, (speeds, system), count = shared([dependent, system])
    unknown = {Symbol(u.name) for u in m.dependent}
    names = [f"const double {name}" for name, _ in parts]
    values = [e for _, e in parts]
    first = next(i for i, e in enumerate(values) if e.free_symbols & unknown)
    names[first:first] = [f"const double {u.name}" for u in m.dependent]
    values[first:first] = list(speeds)
    return written(names + names_out, values + list(system)), count


def full_function(m, kane):
    """KanesMethod's own mass_matrix and forcing, of independent and dependent speeds."""
    names = [f"M[{i}][{j}]" for i in range(6) for j in range(6)] + [f"f[{i}]" for i in range(6)]
    return system_function(m, kane._Ars, names, list(kane.mass_matrix) + list(kane.forcing))


def reduced_function(m, kane):
    """The dependent speeds' derivatives eliminated with sympy's LUsolve."""
    full, force, onto = kane.mass_matrix, kane.forcing, kane._Ars
    rest = full[3:, 3:].LUsolve(force[3:, :])
    mass = full[:3, :3] + full[:3, 3:] * onto
    lower = [mass[i, j] for i in range(3) for j in range(i + 1)]
    names = [f"M[{i}]" for i in range(6)] + [f"f[{i}]" for i in range(3)]
    return system_function(m, onto, names, lower + list(force[:3, :] - full[:3, 3:] * rest))


TEXT = """\
// SPDX-License-Identifier: Apache-2.0
// The nonlinear bicycle as sympy's Kane method writes it. Made by derive.py, not by hand.
// sympy {version}; sha256 of derive.py: {digest}
// clang-format off

// Height of the front contact over the rear one, m, and its derivative by the tilt of the steering
// axis: {height_count} operations.
static inline void sympy_height(double *height, double *slope, {given}) {{
{height}
}}

// M u' = f for the speeds u = (lean rate, steer rate, speed; yaw rate, tilt rate, front wheel's
// spin): KanesMethod's mass_matrix and forcing. {full_count} operations.
static inline void sympy_full(double M[6][6], double f[6], {given},
                              {speeds}) {{
{full}
}}

// M u' = f for u = (lean rate, steer rate, speed) alone, M's lower half by rows; the other speeds
// eliminated by sympy. {reduced_count} operations.
static inline void sympy_reduced(double M[6], double f[3], {given},
                                 {speeds}) {{
{reduced}
}}
"""
GIVEN = ", ".join(["const sympy_bicycle *p"] + [
    f"double {part}_{angle}" for angle in ("lean", "steer", "tilt") for part in "sc"])
SPEEDS = "double lean_rate, double steer_rate, double speed"


def generated():
    m, height, kane = derive()
    functions = {
        "height": height_function(m, height),
        "full": full_function(m, kane),
        "reduced": reduced_function(m, kane),
    }
    bodies = {name: "\n".join(body) for name, (body, _) in functions.items()}
    counts = {name + "_count": count for name, (_, count) in functions.items()}
    digest = hashlib.sha256(pathlib.Path(__file__).read_bytes()).hexdigest()
    return TEXT.format(version=sympy.__version__, digest=digest, given=GIVEN, speeds=SPEEDS,
                       **bodies, **counts)


def main():
    parser = argparse.ArgumentParser(description="Derives the nonlinear bicycle and writes it as C.",
                                     epilog="Example: derive.py -o sympy_equations.h")
    parser.add_argument("-o", "--output", required=True, metavar="FILE")
    output = parser.parse_args().output
    text = generated()
    aside = output + ".part"
    try:
        pathlib.Path(aside).write_text(text)
        os.replace(aside, output)
    except OSError as error:
        sys.exit(f"derive.py: {output}: {error.strerror}")


if __name__ == "__main__":
    main()
