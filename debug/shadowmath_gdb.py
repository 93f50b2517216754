# SPDX-License-Identifier: MIT
"""Shadow maps in words, for gdb:  (gdb) source debug/shadowmath_gdb.py

The natvis twin, for Visual Studio, is shadowmath.natvis.
"""
import gdb
import gdb.printing


def numbers(vector, names="xyz"):
    return "(" + ", ".join(f"{float(vector[name]):.6g}" for name in names) + ")"


def word(enumerator):
    return str(enumerator).split("::")[-1]


def fault_words(faults):
    """The names of the bits, from the enumeration itself: nothing to keep in step."""
    bits = int(faults["bits"])
    if bits == 0:
        return "none"
    names = {field.enumval: field.name.split("::")[-1] for field in gdb.lookup_type("shadowmath::v0::Fault").fields()}
    return " | ".join(names.get(1 << i, f"bit {i}") for i in range(32) if bits >> i & 1)


class Summary:
    """One line in words, and the members below it."""

    def __init__(self, value):
        self.value = value

    def children(self):
        for field in self.value.type.fields():
            yield field.name, self.value[field.name]


class Faults:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return fault_words(self.value)


class ClipSpace:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        clip = self.value
        return f"depth {word(clip['depth'])}, ndc y {word(clip['ndc_y'])}, texture v {word(clip['texture_v'])}"


class Aabb:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        lo, hi = self.value["lo"], self.value["hi"]
        if any(float(lo[axis]) > float(hi[axis]) for axis in "xyz"):
            return "empty"
        return f"{numbers(lo)} to {numbers(hi)}"


class ShadowMap(Summary):
    def to_string(self):
        seen = "visible" if self.value["visible"] else "not visible"
        return f"{seen}, faults: {fault_words(self.value['faults'])}"


class Light(Summary):
    def to_string(self):
        light = self.value
        return f"{word(light['kind'])} along {numbers(light['direction'])}, faults: {fault_words(light['faults'])}"


class ViewVolume(Summary):
    def to_string(self):
        view = self.value
        return f"{word(view['kind'])}, {float(view['z_near']):.6g} m to {float(view['z_far']):.6g} m"


class Splits:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        count = int(self.value["count"])
        planes = [f"{float(self.value['plane'][i]):.6g}" for i in range(count + 1)] if count else []
        return f"{count} splits at {{{', '.join(planes)}}} m, faults: {fault_words(self.value['faults'])}"


class Cascades:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return f"{int(self.value['count'])} cascades, faults: {fault_words(self.value['faults'])}"

    def children(self):
        for i in range(int(self.value["count"])):
            yield f"[{i}]", self.value["at"][i]


class Matrix:
    """By rows, as formulas are written; GLM stores columns."""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        columns = self.value["value"]
        rows = (" ".join(f"{float(columns[i][axis]):10.6g}" for i in range(4)) for axis in "xyzw")
        return "\n" + "\n".join(f"  [{row}]" for row in rows)


class Vector:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return numbers(self.value, "xyzw"[: int(self.value.type.strip_typedefs().template_argument(0))])


printers = gdb.printing.RegexpCollectionPrettyPrinter("shadowmath")
for kind in (Faults, ClipSpace):
    printers.add_printer(kind.__name__, f"^shadowmath::v0::{kind.__name__}$", kind)
for kind in (Aabb, ShadowMap, Light, ViewVolume, Splits, Cascades):
    printers.add_printer(kind.__name__, f"^shadowmath::v0::{kind.__name__}<.*>$", kind)
printers.add_printer("Matrix", r"^glm::mat<4, 4, .*>$", Matrix)
printers.add_printer("Vector", r"^glm::vec<[234], .*>$", Vector)
gdb.printing.register_pretty_printer(None, printers, replace=True)
