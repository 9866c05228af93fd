"""Content of functions and classes: compiled code, constants, defaults, closures and global values.

A function of an installed package is identified by its name. For any other function everything that its
result can depend on is followed: the names read by its code, and recursively what those read. Functions
with further dependences (internal state, files, names created at run time) are refused.
"""

import builtins
import dis
import functools
import types
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from linear_theory.common.errors import Unidentifiable
from linear_theory.identity.content_writer import Writer
from linear_theory.identity.library import OUTSIDE_NAMES, is_by_name, is_library, is_outside, qualified

AT_RUN_TIME = {
    *("__import__", "breakpoint", "compile", "eval", "exec", "getattr", "globals", "input"),
    *("locals", "open", "setattr", "vars"),
}
"""Built-in functions by which code reads or changes things that its names do not reveal."""

READS = ("LOAD_GLOBAL", "LOAD_NAME", "LOAD_FROM_DICT_OR_GLOBALS")
WRITES = ("STORE_GLOBAL", "DELETE_GLOBAL")

GENERATED = {
    *("__init__", "__repr__", "__eq__", "__hash__", "__lt__", "__le__", "__gt__", "__ge__"),
    *("__setattr__", "__delattr__", "__replace__"),
}
"""Methods that dataclasses generate from their fields."""

_DESCRIPTORS = (types.MemberDescriptorType, types.GetSetDescriptorType)


def add(writer: Writer, value: Any, where: str) -> bool:
    """Write the content of a function, method, class or module; False for anything else."""
    if isinstance(value, np.ufunc):
        _add_ufunc(writer, value, where)
    elif isinstance(value, functools.partial):
        writer.each("partial", (value.func, value.args, value.keywords), where)
    elif isinstance(value, types.MethodType):
        writer.each("method", (value.__func__, value.__self__), where)
    elif isinstance(value, types.BuiltinFunctionType | types.BuiltinMethodType):
        _add_builtin(writer, value, where)
    elif callable(value) and is_by_name(value):
        _check_outside(value.__module__, where)
        writer.emit("library", qualified(value))
    elif isinstance(value, types.FunctionType):
        _add_function(writer, value, where)
    elif isinstance(value, type):
        _add_class(writer, value, where)
    elif isinstance(value, types.ModuleType):
        _add_module(writer, value, set(), where)
    elif isinstance(value, types.CodeType):
        _add_code(writer, value, where)
    elif isinstance(value, property):
        writer.each("property", (value.fget, value.fset, value.fdel), where)
    elif isinstance(value, staticmethod | classmethod):
        writer.each(type(value).__name__, (value.__func__,), where)
    elif isinstance(value, functools.cached_property):
        writer.each("cached property", (value.func,), where)
    elif callable(value) and hasattr(value, "cache_info") and hasattr(value, "__wrapped__"):
        writer.each("cached", (value.__wrapped__,), where)
    else:
        return False
    return True


def _add_function(writer: Writer, value: types.FunctionType, where: str) -> None:
    if not writer.first(value):
        return
    where, typed = f"{where}: {value.__name__}", writer.typed
    writer.typed = True
    writer.emit("function")
    code = value.__code__
    _add_code(writer, code, where)
    writer.add(value.__defaults__, f"{where}, defaults")
    writer.add(value.__kwdefaults__, f"{where}, defaults")
    writer.named("attributes", value.__dict__, where)
    for name, cell in zip(code.co_freevars, value.__closure__ or (), strict=True):
        writer.emit("closure", name)
        writer.add(_inside(cell), f"{where}, {name}")
    names = set().union(*(part.co_names for part in _codes(code)))
    for name in sorted(_names_read(code, where)):
        _add_global(writer, value, name, names, f"{where}, global {name}")
    writer.typed = typed


def _inside(cell: types.CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # an empty cell
        return NotImplemented


def _add_code(writer: Writer, code: types.CodeType, where: str) -> None:
    """All parts of a code object that determine its behaviour, without its name and place in a file."""
    writer.emit("code", code.co_code)
    counts = code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount, code.co_flags
    writer.each("counts", counts, where)
    writer.emit("exceptions", code.co_exceptiontable)
    for names in (code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars):
        writer.each("names", names, where)
    writer.each("constants", code.co_consts, f"{where}, constants")


def _codes(code: types.CodeType) -> Iterator[types.CodeType]:
    """A code object and those of the functions inside it."""
    yield code
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _codes(constant)


def _names_read(code: types.CodeType, where: str) -> set[str]:
    """Global names read by a code object. Refuses stateful code and imports that cannot be followed."""
    found: set[str] = set()
    for part in _codes(code):
        steps = list(dis.get_instructions(part))
        for k, step in enumerate(steps):
            if step.opname in READS:
                found.add(step.argval)
            elif step.opname in WRITES:
                raise _refusal(where, f"it assigns to the global name {step.argval}")
            elif step.opname in ("STORE_DEREF", "DELETE_DEREF") and step.argval in code.co_freevars:
                raise _refusal(where, f"it assigns to {step.argval}, a variable outside of it")
            elif step.opname == "IMPORT_NAME":
                _check_import(step.argval, steps[k - 2].argval, where)
    return found


def _check_import(module: str, level: object, where: str) -> None:
    if level or not is_library(module):
        raise _refusal(where, f"it imports {module or 'a module'} when it is called")
    _check_outside(module, where)


def _add_global(
    writer: Writer, function: types.FunctionType, name: str, names: set[str], where: str
) -> None:
    writer.emit("global", name)
    if name in function.__globals__:
        value = function.__globals__[name]
    else:
        if name in AT_RUN_TIME:
            raise _refusal(where, "its behaviour cannot be determined from its code")
        value = getattr(builtins, name, NotImplemented)
    if isinstance(value, types.ModuleType):
        _add_module(writer, value, names, where)
    else:
        writer.add(value, where)


def _add_module(writer: Writer, module: types.ModuleType, names: set[str], where: str) -> None:
    """A library by its name; another module by all members whose names the code reads."""
    writer.emit("module", module.__name__)
    _check_outside(module.__name__, where)
    if is_library(module.__name__):
        outside = sorted(names & OUTSIDE_NAMES & vars(module).keys())
        if outside:
            raise _refusal(where, f"{module.__name__}.{outside[0]} reads data outside the code")
        return
    if not writer.first(module):
        return
    for name in sorted(names & vars(module).keys()):
        writer.emit("name", name)
        value = getattr(module, name)
        if isinstance(value, types.ModuleType):
            _add_module(writer, value, names, f"{where}.{name}")
        else:
            writer.add(value, f"{where}.{name}")


def _add_class(writer: Writer, value: type, where: str) -> None:
    """A class outside libraries: its bases and all members that it defines."""
    if not writer.first(value):
        return
    writer.emit("class", value.__qualname__)
    writer.each("bases", value.__bases__, where)
    if not is_library(type(value).__module__):
        writer.add(type(value), where)
    own = {name: v for name, v in vars(value).items() if _counts(value, name, v)}
    writer.named("members", own, f"{where}: {value.__name__}")
    if is_dataclass(value):
        described = [(f.name, f.default, f.default_factory, f.init, f.kw_only) for f in fields(value)]
        writer.add(described, f"{where}: {value.__name__}")


def _counts(owner: type, name: str, value: object) -> bool:
    """Whether a member of a class can have an effect (attributes set by Python itself have none)."""
    if isinstance(value, types.FunctionType):
        made = value.__code__.co_filename == "<string>" or value.__module__ == "dataclasses"
        return not (made and name in GENERATED and is_dataclass(owner))
    special = name.startswith("__") and name.endswith("__")
    methods = isinstance(value, staticmethod | classmethod | property)
    return (methods or not special) and name != "_abc_impl" and not isinstance(value, _DESCRIPTORS)


def _add_builtin(writer: Writer, value: Any, where: str) -> None:
    owner = value.__self__
    if owner is None or isinstance(owner, types.ModuleType):
        _check_outside(value.__module__, where)
        writer.emit("library", qualified(value))
    else:
        writer.emit("builtin method", value.__name__)
        writer.add(owner, where)


def _add_ufunc(writer: Writer, value: np.ufunc, where: str) -> None:
    """A ufunc by name, from the module of numpy or scipy that contains it."""
    import scipy.special

    for module in (np, scipy.special):
        if getattr(module, value.__name__, None) is value:
            writer.emit("library", f"{module.__name__}.{value.__name__}")
            return
    raise _refusal(f"{where} ({value.__name__})", "it is a ufunc of an unknown module")


def _check_outside(module: str | None, where: str) -> None:
    if is_outside(module):
        raise _refusal(where, f"{module} reads data outside the code")


def _refusal(where: str, reason: str) -> Unidentifiable:
    return Unidentifiable(f"{where}: cannot be identified by its content: {reason}")
