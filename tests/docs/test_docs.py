"""Every public name says what it takes, what it raises and how it is used; the examples are run."""

import ast
import builtins
import doctest

import pytest

import fem_check
import linear_theory

PARTS = {"Bending", "DeadLoad", "Friction", "Gravity", "Ground", "Inertia", "Material", "Membrane"}
"""Of a Scene, shown in its example."""

LAWS = {
    **dict.fromkeys(("Exp", "Linear", "Metric"), "GrowthLaw"),
    **dict.fromkeys(("Coulomb", "Tanh", "Viscous"), "FrictionLaw"),
}
"""Laws, shown in the example of their base class."""

PUBLIC = {
    name: getattr(package, name)
    for package in (linear_theory, fem_check)
    for name in package.__all__
    if name not in {*PARTS, *LAWS}
}
CONSTANTS = {"LAPLACE_LIMIT", "__version__"}
RESULTS = {  # what the user does not make, and the function that makes it in the example
    "AirySeries": "airy_series",
    "BeyondReachWarning": "crawl_speed",
    "CostGradient": "cost_gradient",
    "CrawlSpeed": "crawl_speed",
    "Estimate": "crawl_speed",
    "NotConvergedError": "ritz_field",
    "PlaneStressField": "plane_stress_field",
    "PowerGradient": "power_gradient",
    "Prediction": "predict",
    "RitzField": "ritz_field",
    "SecondOrder": "second_order",
    "SpeedGradient": "speed_gradient",
    "SheetcrawlError": "NotConvergedError",
    "Trajectory": "simulate",
    "ViscousRegimeWarning": "line_balance",
}


def examples(name: str) -> list[doctest.Example]:
    # not inspect.getdoc: a docstring inherited from a base class does not count
    return doctest.DocTestParser().get_examples(PUBLIC[name].__doc__ or "")


def test_constants_are_the_names_without_docstring():
    assert {name for name, value in PUBLIC.items() if not callable(value)} == CONSTANTS


@pytest.mark.parametrize("name", sorted(PUBLIC.keys() - CONSTANTS))
def test_has_an_example_that_uses_it_and_prints(name):
    found = examples(name)
    assert any(example.want for example in found)
    assert not any(example.options.get(doctest.SKIP) for example in found)
    assert RESULTS.get(name, name) in {node.id for node in _nodes(name) if isinstance(node, ast.Name)}


@pytest.mark.parametrize("name", sorted(PUBLIC.keys() - CONSTANTS))
def test_example_brings_all_it_needs(name):
    # pytest runs examples among the names of their module; a reader has only what is imported
    known = set(dir(builtins))
    for node in _nodes(name):
        if isinstance(node, ast.Import | ast.ImportFrom):
            known |= {alias.asname or alias.name for alias in node.names}
        elif isinstance(node, ast.arg):
            known.add(node.arg)
        elif isinstance(node, ast.ExceptHandler | ast.ClassDef) and node.name:
            known.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            known.add(node.id)
    assert {node.id for node in _nodes(name) if isinstance(node, ast.Name)} <= known


@pytest.mark.parametrize("name", sorted(PUBLIC.keys() - CONSTANTS))
def test_example_imports_public_names(name):
    modules = {node.module for node in _nodes(name) if isinstance(node, ast.ImportFrom)}
    assert modules <= {"linear_theory", "fem_check"}


@pytest.mark.parametrize("name", sorted(PARTS))
def test_parts_of_a_scene_are_named_by_it(name):
    assert getattr(fem_check, name).__doc__
    assert name in PUBLIC["Scene"].__doc__


@pytest.mark.parametrize("name", sorted(LAWS))
def test_laws_are_named_by_their_base(name):
    assert getattr(linear_theory, name).__doc__
    assert name in {node.id for node in _nodes(LAWS[name]) if isinstance(node, ast.Name)}


@pytest.mark.parametrize("name", sorted(PUBLIC.keys() - CONSTANTS - RESULTS.keys()))
def test_names_what_it_raises(name):
    assert "Raises ValueError" in PUBLIC[name].__doc__


def test_examples_are_collected(pytestconfig):
    assert pytestconfig.getoption("doctestmodules")
    assert {"linear_theory", "fem_check"} <= set(pytestconfig.getini("testpaths"))


def _nodes(name: str) -> list[ast.AST]:
    """Of the syntax trees of its example."""
    return [node for example in examples(name) for node in ast.walk(ast.parse(example.source))]
