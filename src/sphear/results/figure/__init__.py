"""Pictures of results, all in one style; a viscous term has the same colour and marker in every one of them.

A figure belongs to its caller alone: `matplotlib.pyplot`, with its global state and its windows, is not used.
"""

from sphear.results.figure.channel import Lines, Snapshot, line_panels, snapshots
from sphear.results.figure.convergence import Convergence, convergence_panels, loglog_convergence
from sphear.results.figure.flow import flow_panels
from sphear.results.figure.panels import Profile, profiles, scatter_panels, surface_panels
from sphear.results.figure.style import LOOKS, look, save

__all__ = [
    "LOOKS",
    "Convergence",
    "Lines",
    "Profile",
    "Snapshot",
    "convergence_panels",
    "flow_panels",
    "line_panels",
    "loglog_convergence",
    "look",
    "profiles",
    "save",
    "scatter_panels",
    "snapshots",
    "surface_panels",
]
