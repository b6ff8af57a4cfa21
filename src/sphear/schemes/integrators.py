"""Source text of the time integrators: the midpoint rule, and kick-drift-kick."""

from __future__ import annotations

from sphear.engine.flags import options_text
from sphear.errors import SphearError, quoted

INTEGRATORS = ("midpoint", "kick_drift_kick")

# what went wrong in a step, by its number in the compiled loop
CAUSES = {
    1: "too few neighbours for a correction or a fit",
    2: "an acceleration that is not a number; the time step may be too large, or the particles unstable",
    3: "a speed above the speed of sound, where the flow is no longer weakly compressible",
    4: "a particle went through a wall, as when the time step is too long or particles have lost their order",
    5: "a density or an energy that is not positive, as when particles run apart",
}

_CHECKS = '''
@njit({strict})
def not_a_number(vectors):
    """The first particle whose vector is not finite, else -1."""
    for i in range(len(vectors)):
        for k in range(vectors.shape[1]):
            if not abs(vectors[i, k]) < np.inf:
                return i
    return -1


@njit({strict})
def not_positive(numbers):
    """The first that is not positive, else -1."""
    for i in range(len(numbers)):
        if not numbers[i] > 0.0:
            return i
    return -1


@njit({options})
def moved(x, v, count, space, spacing, fastest):
    """Particles back into the box along its periodic axes; what is wrong (a key of CAUSES, else 0) with which.

    A particle that steps through a mirror changes places with its image. Before fixed particles it may stand between
    the wall and their first layer for a while.
    """
    lower, upper, kinds, velocities = space
    square, fast, outside = 0.0, 0, -1
    for i in range(count):
        speed = 0.0
        for k in range(x.shape[1]):
            if not lower[k] <= x[i, k] < upper[k]:
                side = 1 if x[i, k] > lower[k] else 0
                wall = upper[k] if side else lower[k]
                if kinds[k] == 0:
                    x[i, k] = lower[k] + (x[i, k] - lower[k]) % (upper[k] - lower[k])
                elif not abs(x[i, k] - wall) < (1.0 if kinds[k] == 1 else 0.5) * spacing:
                    outside = i
                elif kinds[k] == 1:
                    x[i, k] = 2.0 * wall - x[i, k]
                    v[i, k] = 2.0 * velocities[k, side, k] - v[i, k]
            speed += v[i, k] * v[i, k]
        if speed > square:
            square, fast = speed, i
    if outside >= 0:
        return 4, outside
    if square > fastest * fastest:
        return 3, fast
    return 0, -1

'''

_MIDPOINT = '''
@njit({strict})
def advance(x, v, f, change, dt, steps, fresh, fastest, count, parts, space, numbers, constants):
    """Steps of the midpoint rule; the number made, what failed (a key of CAUSES, else 0) and at which particle."""
    dimension = x.shape[1]
    x_half, v_half = x.copy(), v.copy()
    density, energy = {half_density}, {half_energy}
    half_f = Fields(f.mass, f.viscosity, density, f.pressure, energy, f.drift, f.density_gradient, f.normal, f.depth,
                    f.wall_velocity, f.nearest)
    for step in range(steps):
        for i in range(count):
            for k in range(dimension):
                x_half[i, k], v_half[i, k] = x[i, k], v[i, k]
        {copy}
        for half in range(2):  # one call: a second would be compiled a second time
            failed = rates(x_half, v_half, half_f, change, count, parts, space, numbers, constants)
            if failed >= 0:
                return step, 1, failed
            failed = not_a_number(change.velocity)
            if failed >= 0:
                return step, 2, failed
            if half == 0:
                for i in range(count):
                    for k in range(dimension):
                        x_half[i, k] = x[i, k] + 0.5 * dt * (v[i, k]{drift})
                        v_half[i, k] = v[i, k] + 0.5 * dt * change.velocity[i, k]
                {half}
                {test_half}
        for i in range(count):
            for k in range(dimension):
                x[i, k] += dt * (v_half[i, k]{drift})
                v[i, k] += dt * change.velocity[i, k]
        for i in range(count, len(x)):
            for k in range(dimension):
                v[i, k] = v_half[i, k]
        {whole}
        {test}
        status, worst = moved(x, v, count, space, numbers.spacing, fastest)
        if status:
            return step + 1, status, worst
    return steps, 0, -1
'''

_KICK_DRIFT_KICK = '''
@njit({strict})
def advance(x, v, f, change, dt, steps, fresh, fastest, count, parts, space, numbers, constants):
    """Kicks and drifts; the number of steps, what failed (a key of CAUSES, else 0) and at which particle.

    Args:
        fresh: the rates in `change` are those of the state.
    """
    dimension = x.shape[1]
    for step in range(0 if fresh else -1, steps):
        if step >= 0:
            for i in range(count):
                for k in range(dimension):
                    x[i, k] += dt * (v[i, k] + 0.5 * dt * change.velocity[i, k]{drift})
                    # what the velocity will be, with the acceleration before the step
                    v[i, k] += dt * change.velocity[i, k]
            {whole}
            {test}
            status, worst = moved(x, v, count, space, numbers.spacing, fastest)
            if status:
                return step + 1, status, worst
        old = change.velocity.copy()
        {old}
        failed = rates(x, v, f, change, count, parts, space, numbers, constants)
        if failed >= 0:
            return max(step, 0), 1, failed
        failed = not_a_number(change.velocity)
        if failed >= 0:
            return max(step, 0), 2, failed
        if step >= 0:  # half of each acceleration, before and after
            for i in range(count):
                for k in range(dimension):
                    v[i, k] += 0.5 * dt * (change.velocity[i, k] - old[i, k])
            {corrected}
    return steps, 0, -1
'''


def integrator_text(name: str, roles: tuple[str, ...]) -> str:
    """The text of `advance`, of a scheme that integrates these roles beside the velocity.

    Raises:
        SphearError: there is no integrator of this name.
    """
    if name not in INTEGRATORS:
        raise SphearError(f"an integrator is one of {', '.join(INTEGRATORS)}, not {quoted(name)}")
    scalars = [role for role in ("density", "energy") if role in roles]

    def lines(template: str, indent: int) -> str:
        found = [line.format(role=role) for role in scalars for line in template.splitlines()]
        return ("\n" + " " * indent).join(found) if found else "pass"

    test = "failed = not_positive(f.{role})\nif failed >= 0:\n    return step, 5, failed"
    text = _MIDPOINT if name == "midpoint" else _KICK_DRIFT_KICK
    return (_CHECKS + text).format(
        options=options_text(),
        strict=options_text(strict=True),  # finds numbers that are not finite
        drift=" + f.drift[i, k]" if "drift" in roles else "",
        half_density="f.density.copy()" if "density" in roles else "f.density",
        half_energy="f.energy.copy()" if "energy" in roles else "f.energy",
        copy=lines("{role}[:] = f.{role}", 8),
        half=lines("{role}[:] = f.{role} + 0.5 * dt * change.{role}", 16),
        test_half=lines(test.replace("f.{role}", "{role}"), 16),
        whole=lines("f.{role}[:] += dt * change.{role}", 8 if name == "midpoint" else 12),
        test=lines(test, 8 if name == "midpoint" else 12),
        old=lines("old_{role} = change.{role}.copy()", 8),
        corrected=lines("f.{role}[:] += 0.5 * dt * (change.{role} - old_{role})", 12),
    )
