"""The welcome screen, shown without arguments, and the examples."""

from importlib.metadata import version

from fem_check.files.gallery import names, title

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

FILES = (
    ("Your own scene: a file to start from, with comments", "sheetcrawl new hydrogel"),
    ("What would be simulated, how, and at what cost", "sheetcrawl check hydrogel.toml"),
    ("Its answer", "sheetcrawl speed hydrogel.toml"),
    ("For your editor, which then knows the keys", "sheetcrawl schema > scene.schema.json"),
    ("A measured wave: a scene with a table of samples y, t, c", "sheetcrawl new measured"),
    (
        "A wave from such a table, without a scene file",
        f'{SPEED} --length 40 --width 15 --wave-csv measured.csv --rtol "20 %"',
    ),
)
"""In this order, each with what those before it have written."""

RUNS = (
    ("A scene to a folder: answer, table, pictures, film, page", "sheetcrawl run hydrogel.toml"),
    ("The answer of that run, again", "sheetcrawl show hydrogel"),
    ("Another film of it", "sheetcrawl movie hydrogel --file crawl.gif --periods 2"),
    ("Another picture of it", "sheetcrawl plot hydrogel --file crawl.pdf --what kymographs"),
    ("Its motion for ParaView", "sheetcrawl paraview hydrogel"),
)
"""In this order, after `FILES`."""

SWEEPS = (
    ("Many scenes: a sweep file to start from, with comments", "sheetcrawl new sweep"),
    ("How many scenes, and at what cost", "sheetcrawl sweep sweep.toml --dry-run"),
    (
        "Their records in one file, on all cores, and a table",
        "sheetcrawl sweep sweep.toml --export v.csv",
    ),
    ("What that file holds, as arrays over the fields", "sheetcrawl sweep sweep.sqlite --export v.nc"),
)
"""In this order."""

BEYOND = (
    ("the same answer in Python", "fem_check.predict(Sheet(), SineWave(), alpha=0.1)"),
    ("a scene file, read and written", "Scene.from_toml(path), scene.to_toml(path)"),
    ("effects of your own", "Scene(..., effects=[Bending(...), Ground(...), ...])"),
    ("many scenes, on many cores", "fem_check.sweep(scene, over={'growth.alpha': [...]})"),
    ("the best scene between bounds", "fem_check.optimise(scene, over={'growth.alpha': (0.1, 0.3)})"),
    ("the motion in time, step by step", "fem_check.simulate(scene)"),
    ("outlines at small strain", "fem_check.plane_stress_field(Outline(...), wave)"),
    ("waves c(x, y, t), turning, paths", "FieldWave(...), rigid_path(...)"),
)
"""Tasks beyond the command, and their calls in Python."""

OPTIMISED = (
    ("The best wave or scene: a file to start from, with comments", "sheetcrawl new optimise"),
    ("It, with its certificate, as a scene file", "sheetcrawl optimise optimise.toml --out best.toml"),
)
"""In this order."""

SPEED_HELP = f"""How fast the sheet crawls, how accurate that is, and what it cost.

Quantities may have units, as in "40 mm", "8 s", "12 %"; plain numbers are in units of the sheet.

  {FIRST[0]}
  {FILES[2][1]}
"""

NEW_HELP = f"""Write a scene file with comments, to be made your own. It never overwrites a file.

  {FILES[0][1]}
"""

CHECK_HELP = f"""Say what a scene file would simulate, how and at what cost, or all its mistakes.

Of a sweep, its scenes and their cost; of an optimisation, its limits and how the scene stands to them.

  {FILES[1][1]}
"""

SCHEMA_HELP = f"""Print the JSON Schema of scene files, by which editors know tables, keys and ranges.

  {FILES[3][1]}
"""

RUN_HELP = f"""Run a scene file to a folder: answer, motion as netCDF, pictures, film, report.html.

Ctrl-C keeps what a scene that is stepped through time has reached; --resume goes on from there.

  {RUNS[0][1]}
"""

SHOW_HELP = f"""Print the answer of a finished run again.

  {RUNS[1][1]}
"""

MOVIE_HELP = f"""Write a film of a finished run, .gif or .mp4, without running it again.

  {RUNS[2][1]}
"""

PLOT_HELP = f"""Draw pictures of a finished run, without running it again.

  {RUNS[3][1]}
"""

PARAVIEW_HELP = f"""Write the motion of a finished run for ParaView (.xdmf), without running it again.

  {RUNS[4][1]}
"""

SWEEP_HELP = f"""Answer many scenes that differ in some fields, and keep a record of each in one file.

What the file holds is not computed again: after Ctrl-C, a crash or a power cut the same command goes
on. Scenes that fail have a record with the reason. Needs the extra, but for --workers 1:
pip install 'sheetcrawl[sweep]'

  {SWEEPS[0][1]}
  {SWEEPS[1][1]}
  {SWEEPS[2][1]}
"""

OPTIMISE_HELP = f"""Find the best scene between bounds, and say why it is held to be the best.

Answers are kept in a file: after Ctrl-C or a crash the same command goes on. The exit status is 1 where
the certificate does not hold.

  {OPTIMISED[0][1]}
  {OPTIMISED[1][1]}
"""

EXPLORE = "sheetcrawl explore --port 8800 --no-browser"

EXPLORE_HELP = f"""A page with sliders in the browser: shape, friction, V(alpha) and cost, with errors.

What small strain answers is drawn at once, the nonlinear answer follows. The page is served to this
computer alone and needs no network; Ctrl-C ends. Needs the extra: pip install 'sheetcrawl[explorer]'

  {EXPLORE}
"""

EXAMPLES_HELP = "More examples, and the Python calls for tasks beyond this command."


def listed() -> list[str]:
    """The scenes of the gallery, each with what it is."""
    return [f"  {name:<{max(map(len, names()))}}  {title(name)}" for name in names()]


def welcome() -> str:
    """The welcome screen, shown without arguments."""
    pasted = "\n".join(f"  {line}" for line in FIRST)
    return f"""sheetcrawl {version("sheetcrawl")}
How fast a thin sheet crawls when a wave of growth runs through it, and how accurate that is

Examples to paste

{pasted}

Other commands

  sheetcrawl speed --help         all options: sheet, wave, growth, friction, tolerance, output
  sheetcrawl new --list           scene files with comments: bending, ground, outlines, weight, terrain
  sheetcrawl run scene.toml       all of a scene to a folder: pictures, film, report.html
  sheetcrawl check scene.toml     what a scene file says, by which level it is answered, at what cost
  sheetcrawl sweep sweep.toml     many scenes on many cores; sheetcrawl new sweep writes such a file
  sheetcrawl explore              a page with sliders, in the browser
  sheetcrawl examples             more examples, pictures and films; what to do in Python
  sheetcrawl --install-completion shell completion of commands and options
  sheetcrawl --version

In Python: from fem_check import predict; help(predict)"""


def examples() -> str:
    """Commands by purpose, and the Python calls for everything else."""
    lines = [
        f"{title}\n  {command}\n" for title, command in (*MORE, *FILES, *RUNS, *SWEEPS, *OPTIMISED)
    ]
    lines += ["Scene files to start from, for sheetcrawl new", *listed(), ""]
    width = max(len(title) for title, _ in BEYOND)
    lines.append("Beyond the command, in Python (help(name) shows an example of each)")
    lines += [f"  {title:<{width}}  {call}" for title, call in BEYOND]
    return "\n".join(lines)
