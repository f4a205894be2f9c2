"""Messages about wrong arguments of classes and functions: which one is wrong, and what is allowed."""
import difflib
import functools
import inspect
import numbers
import re
import sys

from . import _core

# of pybind11's signatures
_KINDS = {"str": ("a string", str), "float": ("a number", numbers.Real), "int": ("a whole number", numbers.Integral),
          "bool": ("True or False", (bool, numbers.Integral)), "function": ("a function", None), "dict": ("a dict", dict)}
# functions of _core that functions written in Python call, by the names of these
_PUBLIC = {"lattice_weights": "weights", "node_weights": "weights", "node_weights_in_space": "space.weights",
           "check_arrays": "check", "check_in_space": "space.check", "matrix_arrays": "matrix",
           "matrix_in_space": "space.matrix", "solve_in_space": "space.solve", "moduli_json": "moduli",
           "moduli_arrays": "moduli_of_weights", "grade_arrays": "grade", "grade_files": "grade",
           "certified_names": "certified_problems", "certify_json": "certify", "study_json": "a study"}
# earlier names of arguments, which are still accepted
_ALIASES = {"check": {"box": "boxes", "meant": "rule"}, "weights": {"box": "boxes"}}
_HINTS = {("Kernel", "E"): "for Young's modulus E give bulk_modulus = 2/3 E in plane strain, 5/8 E in plane stress",
          ("space.Kernel", "E"): "for Young's modulus E give bulk_modulus = 2/3 E"}


class _Parameter:
    def __init__(self, name, annotation, default, is_keyword):
        self.name, self.annotation, self.default, self.is_keyword = name, annotation, default, is_keyword

    def __str__(self):
        return self.name + ("" if self.default is None else f"={self.default}")

    def wanted(self):
        """In words; empty: anything, which the function checks itself."""
        if self.annotation in _KINDS:
            return _KINDS[self.annotation][0]
        optional = re.fullmatch(r"Optional\[(\w+)\]", self.annotation)
        if optional and optional[1] in _KINDS:
            return _KINDS[optional[1]][0] + " or None"
        if self.annotation.startswith("plumbline."):
            return "a plumbline." + self.annotation.rsplit(".", 1)[1].replace("Space", "space.")
        if self.annotation.startswith(("numpy.ndarray", "List[")):
            return "an array of numbers" if "Rule" not in self.annotation else "a list of plumbline.Rule"
        return ""

    def takes(self, value):
        """False: surely not; True: perhaps."""
        optional = re.fullmatch(r"Optional\[(\w+)\]", self.annotation)
        if optional and value is None:
            return True
        kind = optional[1] if optional else self.annotation
        if kind == "function":
            return callable(value)
        if kind in _KINDS:
            return isinstance(value, _KINDS[kind][1])
        if kind.startswith("plumbline._core."):
            known = getattr(_core, kind.rsplit(".", 1)[1], None)
            return known is None or isinstance(value, known)
        if kind.startswith(("numpy.ndarray", "List[")):
            return not (value is None or isinstance(value, (str, bool)))
        return True


def _split(text):
    """At commas outside of brackets and quotes."""
    parts, depth, quote = [""], 0, ""
    for c in text:
        if quote:
            quote = "" if c == quote else quote
        elif c in "'\"":
            quote = c
        depth += (c in "[(") - (c in "])") if not quote else 0
        if c == "," and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts if part.strip()]


def _signatures(documentation):
    """The lists of parameters that pybind11 writes into the documentation, one for each overload."""
    result = []
    for line in (documentation or "").splitlines():
        found = re.match(r"(?:\d+\. )?\w+\((.*)\) -> ", line)
        if not found:
            continue
        parameters, is_keyword = [], False
        for part in _split(found[1]):
            if part == "*":
                is_keyword = True
                continue
            name, _, rest = part.partition(":")
            annotation, _, default = rest.partition(" = ")
            if name != "self":
                parameters.append(_Parameter(name, annotation.strip(), default or None, is_keyword))
        result.append(parameters)
    return result


def _fault(name, parameters, args, kwargs):
    """What is wrong with the arguments; empty: nothing that is seen."""
    known = [one.name for one in parameters]
    allowed = f"give {name}({', '.join(map(str, parameters))})"
    for given in kwargs:
        if given not in known:
            similar = difflib.get_close_matches(given, known, 1)
            hint = _HINTS.get((name, given), f"did you mean {similar[0]}?" if similar else "")
            return f"{name} has no argument {given}; {allowed}" + ("; " + hint if hint else "")
    by_place = [one for one in parameters if not one.is_keyword]
    if len(args) > len(by_place):
        by_name = [one.name for one in parameters if one.is_keyword]
        return (f"{name} takes at most {len(by_place)} positional arguments, but {len(args)} are given; {allowed}" +
                (f", with {', '.join(by_name)} by name" if by_name else ""))
    values = dict(zip((one.name for one in by_place), args))
    for given in kwargs:
        if given in values:
            return f"{name}: the argument {given} is given twice, by position and by name; {allowed}"
    values.update(kwargs)
    for one in parameters:
        if one.default is None and one.name not in values:
            return f"{name}: the argument {one.name} is missing; {allowed}"
    for one in parameters:
        if one.name in values and not one.takes(values[one.name]):
            value = repr(values[one.name])
            return (f"{name}: {one.name} = {value[:60] + '...' if len(value) > 60 else value} is not "
                    f"{one.wanted()}; give {one.name} as {one.wanted()}")
    return ""


def _explained(name, documentation, args, kwargs):
    signatures = _signatures(documentation)
    faults = [_fault(name, parameters, args, kwargs) for parameters in signatures]
    if faults and all(faults):
        return faults[0]
    wanted = "; or ".join(", ".join(str(one) + (f" ({one.wanted()})" if one.wanted() else "") for one in parameters)
                          for parameters in signatures)
    given = ", ".join([repr(one)[:60] for one in args] + [f"{key}={value!r}"[:60] for key, value in kwargs.items()])
    return f"{name}({given}): an argument has the wrong type or is out of range; give {wanted or 'no argument'}"


def _compiled(function, name, qualified, is_method=False):
    """A function of _core whose TypeError about its arguments is explained; pickle finds it as qualified."""
    @functools.wraps(function)
    def call(*args, **kwargs):
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            if "incompatible" not in str(error) or "arguments" not in str(error):
                raise
            message = _explained(name, function.__doc__, args[1:] if is_method else args, kwargs)
        raise TypeError(message)
    call.__module__, call.__qualname__ = _core.__name__, qualified
    return call


def _python(function):
    """A function written in Python whose arguments are checked by their names."""
    signature = inspect.signature(function)
    parameters = [_Parameter(one.name, "", None if one.default is one.empty else repr(one.default),
                             one.kind is one.KEYWORD_ONLY) for one in signature.parameters.values()]
    aliases = _ALIASES.get(function.__name__, {})
    is_plain = all(one.kind in (one.POSITIONAL_OR_KEYWORD, one.KEYWORD_ONLY) for one in signature.parameters.values())

    @functools.wraps(function)
    def call(*args, **kwargs):
        kwargs = {aliases.get(key, key) if aliases.get(key) not in kwargs else key: value
                  for key, value in kwargs.items()}
        message = ""
        try:
            signature.bind(*args, **kwargs)
        except TypeError as error:
            message = (is_plain and _fault(function.__name__, parameters, args, kwargs)) or str(error)
        if message:
            raise TypeError(message)
        return function(*args, **kwargs)
    return call


def _not_constructed(name):
    def refuse(self, *args, **kwargs):
        raise TypeError(f"{name} has no constructor: functions return it, for example solve() a Solution")
    return refuse


def explain_core():
    """Once, before anything takes a function of _core by its name."""
    for name, one in list(vars(_core).items()):
        if inspect.isbuiltin(one):
            setattr(_core, name, _compiled(one, _PUBLIC.get(name, name), name))
        elif inspect.isclass(one) and not issubclass(one, Exception):
            public = name.replace("Space", "space.")
            if str(one.__init__.__doc__).startswith("Initialize self."):
                setattr(one, "__init__", _not_constructed(public))
            for key, member in list(vars(one).items()):
                label = public if key == "__init__" else f"{public}.{key}" if key != "__call__" else f"a {public}"
                if isinstance(member, staticmethod):
                    setattr(one, key, staticmethod(_compiled(member.__func__, label, f"{name}.{key}")))
                elif (key in ("__init__", "__call__") or not key.startswith("_")) and callable(member):
                    setattr(one, key, _compiled(member, label, f"{name}.{key}", is_method=True))


def explain_python(names, module):
    """The public functions of a module that are written in Python; also where pickle looks, in their own module."""
    for name in names:
        function = module.get(name)
        if inspect.isfunction(function) and not hasattr(function, "__wrapped__"):
            module[name] = _python(function)
            defined = sys.modules.get(function.__module__)
            if getattr(defined, function.__name__, None) is function:
                setattr(defined, function.__name__, module[name])
