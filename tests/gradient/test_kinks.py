"""Where V has a kink, the gradient is a subgradient, and says so."""

import math

import numpy as np
import pytest

from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FieldWave,
    Scene,
    Sheet,
    SineWave,
    TravellingWave,
    crawl_speed,
)
from linear_theory.gradient import WaveFamily, speed_gradient

ALPHA = 0.1


def humps(share):
    """c = 0 but on a share of the sheet, where it is the top of a cosine."""
    floor = math.cos(math.pi * share)

    def growth(x, y, t):
        return np.maximum(np.cos(2 * np.pi * (y - t)) - floor, 0.0) + 0 * x

    return FieldWave(growth, 1.0)


def strip_slope(share):
    """dV/dshare over alpha L/T of an infinitely narrow strip, dry, of constant weight, as alpha -> 0.

    V = median c - mean c; the part at rest is the median, up to a share of 1/2, where V has a kink.
    """
    by_mean = share * math.pi * math.sin(math.pi * share)
    return (math.pi * math.sin(math.pi * share) if share > 0.5 else 0.0) - by_mean


def humped(share, rtol):
    """The gradient with respect to the share."""
    contact = Contact("material", Coulomb())
    scene = Scene(Sheet(width=0.05), humps(share), alpha=ALPHA, contact=contact)
    return speed_gradient(scene, WaveFamily("share", share, humps), rtol=rtol)


def test_a_sheet_of_which_more_than_half_sticks():
    found = humped(0.4, 0.1)
    assert "part of the sheet is at rest" in found.kinks[0]
    want = ALPHA * strip_slope(0.4)
    assert found.values[0] == pytest.approx(want, rel=0.1)
    assert abs(found.values[0] - want) <= found.errors[0]


def test_the_slope_beyond_the_kink_is_of_the_other_sign():
    """At shares of 0.4 and 0.6 it is -1.195 and 1.195 alpha L/T."""
    found = humped(0.6, 0.1)
    want = ALPHA * strip_slope(0.6)
    assert want == pytest.approx(-ALPHA * strip_slope(0.4))
    assert found.values[0] == pytest.approx(want, rel=0.2)
    assert abs(found.values[0] - want) <= found.errors[0]
    assert not found.kinks


def test_a_wave_of_no_height_between_its_one_sided_differences():
    """c -> -c is half a period: under dry friction with a direction V = C |amplitude|, exactly."""
    law = Directional(0.5, 1.5, form=Coulomb())
    scene = Scene(Sheet(width=0.1), TravellingWave(np.zeros(1), np.zeros(1)), alpha=0.01)
    scene = scene.but(contact=Contact("current", law))
    found = speed_gradient(scene, "wave.sine.0", rtol=1e-2)
    step = 0.5
    ends = [
        crawl_speed(scene.but(wave=TravellingWave(np.zeros(1), np.array([sign * step]))), rtol=1e-2)
        for sign in (-1, 1)
    ]
    behind, ahead = (sign * end.mean / step for sign, end in zip((-1, 1), ends, strict=True))
    assert ahead == pytest.approx(0.01 * math.sin(math.pi / 4), rel=0.03)
    assert behind == pytest.approx(-ahead, rel=1e-2)
    assert "part of the sheet is at rest" in found.kinks[0]
    assert behind <= found["wave.sine.0"] <= ahead


@pytest.mark.parametrize("wave", [SineWave(), TravellingWave([0.5, 0.2], [0.3, -0.1], mean=0.1)])
def test_dry_friction_without_a_part_at_rest_has_a_gradient(wave):
    """Points at rest alone are no kink, at whatever tolerance."""
    scene = Scene(Sheet(), wave, alpha=0.2, contact=Contact("current", Coulomb()))
    assert not speed_gradient(scene, "alpha", rtol=3e-2).kinks
