"""Tables of an excitable wave: its equation, eq. 12, from which state it starts, and what paces it."""

from typing import Literal

from fem_check.files.fields import Size, Table, Time


class StartTable(Table):
    """c and w at time 0."""

    kind: Literal["rational", "uniform", "bump", "crossed"] = "rational"
    """That of the paper, c = s^2/(1 + s^2) with s = (y - origin)/scale; the same everywhere; at rest
    but for a bump; c rising across and w along, from which a spiral winds."""
    origin: float | None = None
    """Of "rational": in lengths of the sheet from its centre, -0.5 unless given."""
    scale: Size | None = None
    """Of "rational": 1 length of the sheet unless given."""
    c: float | None = None
    """Of "uniform"."""
    w: float | None = None
    """Of "uniform"."""
    height: float | None = None
    """Of "bump": c at its middle, 1 unless given."""
    radius: Size | None = None
    """Of "bump": 0.1 lengths of the sheet unless given."""
    x: float | None = None
    """Of "bump": its middle in widths of the sheet from the centre; all across unless given."""
    y: float | None = None
    """Of "bump": likewise in lengths, -0.5 unless given."""
    c_size: float | None = None
    """Of "crossed": c at the sides, 0.5 unless given."""
    w_size: float | None = None
    """Of "crossed": w at the ends, 0.1 unless given."""
    step: Size | None = None
    """Of "crossed": width of the steps, 0.1 lengths of the sheet unless given."""


class PacingTable(Table):
    """A stimulus at the rear end that repeats."""

    period: Time
    """Between two stimuli."""
    strength: float = 0.3
    """Added to dc/dt at its middle."""
    duration: Time | None = None
    """8 units of time unless given."""
    reach: Size | None = None
    """Along the sheet, 0.1 lengths of it unless given."""
    front: bool = False
    """At the front end instead."""


class EquationTable(Table):
    """Eq. 12, in the file's unit of time, by a preset or by its numbers."""

    preset: (
        Literal["printed", "nu = -0.1", "nu = -0.05", "pulse train", "spiral", "turbulent"] | None
    ) = None
    """Numbers, start and pacing by name, lengths in lengths of the sheet; what else is said replaces
    those of the preset."""
    threshold: float | None = None
    """nu of eq. 12."""
    recovery_decay: float | None = None
    """kappa of eq. 12."""
    recovery_rate: float | None = None
    """epsilon of eq. 12."""
    diffusion_length: Size | None = None
    """gamma of eq. 12."""
    feedback: float | None = None
    """Of the strain: times tr eps, added to c_t; the scene must then be stepped."""
    start: StartTable | None = None
    """State at time 0."""
    pacing: PacingTable | None = None
    """A stimulus that repeats."""
