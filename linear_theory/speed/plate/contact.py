"""Whether a bending sheet lies on its ground everywhere, known from its deflection alone."""

from linear_theory.deformation.plate import foundation, plate_field
from linear_theory.scene.scene import Scene
from linear_theory.speed.plate.quadratic_form import check_contact

RTOL = 1e-2
"""Of the deflection."""


def require_contact(scene: Scene) -> None:
    """Raise ValueError for a curvature coupling at which the sheet of a scene lifts off somewhere.

    scene: of a sheet that bends, which the level PLATE represents. Raises NotConvergedError for a
    ground so stiff that the deflection takes more memory than is available.

    >>> from fem_check import Bending, Gravity, Ground, Material, Membrane
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> from linear_theory.speed.plate.contact import require_contact
    >>> material = Material(0.03, 0.5)
    >>> effects = [Membrane(material), Bending(material), Gravity(2.5e-4), Ground(0.5)]
    >>> require_contact(Scene(Sheet(), SineWave(), 0.01, -0.1, effects))
    """
    plate = plate_field(scene.sheet, scene.wave, foundation(scene.effects), RTOL)
    check_contact(scene.curvature_coupling, (plate.lift_off(-1.0), plate.lift_off(1.0)))
