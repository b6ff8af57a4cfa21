"""A saved simulation goes on in the same one only."""

from pathlib import Path

import pytest

import sphear


def channel(force: float, spacing: float = 0.125) -> sphear.Simulation:
    return sphear.Simulation(
        sphear.Rectangle((0, 0), (1, 1)),
        spacing=spacing,
        fluid=sphear.Fluid(kinematic_viscosity=0.1),
        boundaries={"x": sphear.Periodic()},
        body_force=(force, 0),
        speed=1.0,
    )


def test_a_saved_state_is_gone_on_with(tmp_path: Path) -> None:
    channel(0.8).save(tmp_path / "state.npz")
    assert channel(0.8).restore(tmp_path / "state.npz").time == 0.0


def test_a_state_under_another_force_is_refused(tmp_path: Path) -> None:
    channel(0.8).save(tmp_path / "state.npz")
    with pytest.raises(sphear.SphearError, match=r"has body_force = \(0\.8, 0\.0\), not \(0\.1, 0\.0\)$"):
        channel(0.1).restore(tmp_path / "state.npz")


def test_a_file_may_be_named_by_a_text(tmp_path: Path) -> None:
    channel(0.8).save(str(tmp_path / "state.npz"))
    assert channel(0.8).restore(str(tmp_path / "state.npz")).steps == 0
    run = sphear.flow("taylor-green", scheme="incompressible", resolution=12, max_steps=1)
    steps = run.run(keep=str(tmp_path / "vortices.npz")).flow.steps
    again = sphear.flow("taylor-green", scheme="incompressible", resolution=12, max_steps=1)
    again.restore(str(tmp_path / "vortices.npz"))
    assert again.flow.steps == steps == 1
