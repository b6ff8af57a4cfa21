"""Kernels: the weight functions of SPH, 1-D to 3-D, each with its first and second derivative."""

from __future__ import annotations

from sphear.kernels.base import Kernel
from sphear.kernels.cubic_spline import CubicSpline
from sphear.kernels.gaussian import Gaussian
from sphear.kernels.quartic_spline import QuarticSpline
from sphear.kernels.quintic_spline import QuinticSpline
from sphear.kernels.wendland_c2 import WendlandC2
from sphear.kernels.wendland_c4 import WendlandC4
from sphear.kernels.wendland_c6 import WendlandC6
from sphear.names import Registry

KERNELS: Registry[type[Kernel]] = Registry("kernel")
for _kernel in (CubicSpline, QuarticSpline, QuinticSpline, WendlandC2, WendlandC4, WendlandC6, Gaussian):
    KERNELS.add(_kernel.name, _kernel, _kernel.aliases)
KERNELS.open()

__all__ = [
    "KERNELS",
    "CubicSpline",
    "Gaussian",
    "Kernel",
    "QuarticSpline",
    "QuinticSpline",
    "WendlandC2",
    "WendlandC4",
    "WendlandC6",
]
