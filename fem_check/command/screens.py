"""What the program says of itself: the screen without arguments, and the examples."""

from importlib.metadata import version

PULSE = (
    'sheetcrawl speed --length "40 mm" --width "15 mm" --thickness "0.8 mm" --period "8 s" '
    '--growth "12 %" --pulse 0.2'
)

FIRST = (
    'sheetcrawl speed --growth "12 %"',
    PULSE,
    "sheetcrawl speed --alpha 0.1 --width 0.2 --rtol 0.02 --why",
)
"""To be pasted."""

SPEED = 'sheetcrawl speed --growth "10 %"'

MORE = (
    (
        "In mm/s; half as wide as long unless said otherwise",
        'sheetcrawl speed --length "2 cm" --period "0.5 s" --growth "5 %"',
    ),
    ("The error that you can live with", f'{SPEED} --rtol "20 %"'),
    ("Two waves on the sheet, towards -y", f'{SPEED} --count -2 --rtol "5 %"'),
    ("Any periodic wave, by its harmonics", f'{SPEED} --sine 1 0.2 --cosine 0 0.1 --rtol "5 %"'),
    ("Friction that is not quite dry", f'{SPEED} --friction tanh --slip-speed 0.01 --rtol "5 %"'),
    ("For programs", f"{SPEED} --json"),
    ("V(t) as a table", f"{SPEED} --csv"),
    ("A picture", f"{SPEED} --plot crawl.png"),
    ("A film", f"{SPEED} --movie crawl.gif"),
)

BEYOND = (
    ("the same answer in Python", "fem_check.predict(Sheet(), SineWave(), alpha=0.1)"),
    ("bending, thickness, weight, ground", "Scene(..., effects=[Bending(...), Ground(...), ...])"),
    ("friction that deforms the sheet, inertia", "fem_check.simulate(scene)"),
    ("outlines and holes, at small strain", "fem_check.plane_stress_field(Outline(...), wave)"),
    ("waves c(x, y, t), turning, paths", "FieldWave(...), rigid_path(...)"),
)
"""What the command does not do, and what in Python does."""

SPEED_HELP = f"""How fast the sheet crawls, how sure that is, and what it cost.

Quantities have units, as in "40 mm", "8 s", "12 %"; plain numbers are in units of the sheet.

  {FIRST[0]}
"""

EXAMPLES_HELP = "More examples, and what in Python does what the command leaves out."


def welcome() -> str:
    """The screen without arguments."""
    pasted = "\n".join(f"  {line}" for line in FIRST)
    return f"""sheetcrawl {version("sheetcrawl")}
How fast a thin sheet crawls when a wave of growth runs through it, and how sure that is

To try, paste one of

{pasted}

What else there is

  sheetcrawl speed --help         all options: sheet, wave, growth, friction, tolerance, output
  sheetcrawl examples             more examples, pictures and films; what the answer leaves out
  sheetcrawl --install-completion completion of commands and options by your shell
  sheetcrawl --version

In Python: from fem_check import predict; help(predict)"""


def examples() -> str:
    """Commands by what they are for, and Python for the rest."""
    lines = [f"{title}\n  {command}\n" for title, command in MORE]
    width = max(len(title) for title, _ in BEYOND)
    lines.append("What the command leaves out, in Python (help(name) shows an example of each)")
    lines += [f"  {title:<{width}}  {call}" for title, call in BEYOND]
    return "\n".join(lines)
