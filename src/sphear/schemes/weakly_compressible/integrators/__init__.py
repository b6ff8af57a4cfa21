"""Time integrators of the explicit scheme, by name."""

from __future__ import annotations

from sphear.names import Registry
from sphear.schemes.weakly_compressible.integrators.base import Integrated, Integrator, Step
from sphear.schemes.weakly_compressible.integrators.kick_drift_kick import KickDriftKick
from sphear.schemes.weakly_compressible.integrators.midpoint import Midpoint

INTEGRATORS: Registry[Integrator] = Registry("integrator")
for _integrator in (Midpoint(), KickDriftKick()):
    INTEGRATORS.add(_integrator.name, _integrator, _integrator.aliases)
INTEGRATORS.open()

__all__ = ["INTEGRATORS", "Integrated", "Integrator", "KickDriftKick", "Midpoint", "Step"]
