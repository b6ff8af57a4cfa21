"""Observers of a simulation: small objects with an interval and one method."""

from sphear.simulation.observers.base import Observer
from sphear.simulation.observers.call import Call, StopWhen
from sphear.simulation.observers.history import History
from sphear.simulation.observers.probe import Probe
from sphear.simulation.observers.profile import Profile
from sphear.simulation.observers.progress import Progress
from sphear.simulation.observers.snapshots import Snapshot, Snapshots

__all__ = ["Call", "History", "Observer", "Probe", "Profile", "Progress", "Snapshot", "Snapshots", "StopWhen"]
