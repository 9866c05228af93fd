"""The welcome screen, shown without arguments, and the examples."""

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
"""Commands to paste."""

SPEED = 'sheetcrawl speed --growth "10 %"'

MORE = (
    (
        "With units; by default half as wide as long",
        'sheetcrawl speed --length "2 cm" --period "0.5 s" --growth "5 %"',
    ),
    ("A larger tolerance", f'{SPEED} --rtol "20 %"'),
    ("Two waves on the sheet, towards -y", f'{SPEED} --count -2 --rtol "5 %"'),
    ("Any periodic wave, by its Fourier series", f'{SPEED} --sine 1 0.2 --cosine 0 0.1 --rtol "5 %"'),
    ("Regularised dry friction", f'{SPEED} --friction tanh --slip-speed 0.01 --rtol "5 %"'),
    ("JSON, for programs", f"{SPEED} --json"),
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
"""Tasks beyond the command, and their calls in Python."""

SPEED_HELP = f"""How fast the sheet crawls, how accurate that is, and what it cost.

Quantities may have units, as in "40 mm", "8 s", "12 %"; plain numbers are in units of the sheet.

  {FIRST[0]}
"""

EXPLORE = "sheetcrawl explore --port 8800 --no-browser"

EXPLORE_HELP = f"""A page with sliders in the browser: shape, friction, V(alpha) and cost, with errors.

What small strain answers is drawn at once, the nonlinear answer follows. The page is served to this
computer alone and needs no network; Ctrl-C ends. Needs the extra: pip install 'sheetcrawl[explorer]'

  {EXPLORE}
"""

EXAMPLES_HELP = "More examples, and the Python calls for tasks beyond this command."


def welcome() -> str:
    """The welcome screen, shown without arguments."""
    pasted = "\n".join(f"  {line}" for line in FIRST)
    return f"""sheetcrawl {version("sheetcrawl")}
How fast a thin sheet crawls when a wave of growth runs through it, and how accurate that is

Examples to paste

{pasted}

Other commands

  sheetcrawl speed --help         all options: sheet, wave, growth, friction, tolerance, output
  sheetcrawl explore              a page with sliders, in the browser
  sheetcrawl examples             more examples, pictures and films; what to do in Python
  sheetcrawl --install-completion shell completion of commands and options
  sheetcrawl --version

In Python: from fem_check import predict; help(predict)"""


def examples() -> str:
    """Commands by purpose, and the Python calls for everything else."""
    lines = [f"{title}\n  {command}\n" for title, command in MORE]
    width = max(len(title) for title, _ in BEYOND)
    lines.append("Beyond the command, in Python (help(name) shows an example of each)")
    lines += [f"  {title:<{width}}  {call}" for title, call in BEYOND]
    return "\n".join(lines)
