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


def figure(value):
    return f"{float(value):.6g}"


def place(value):
    return f"({int(value['x'])}, {int(value['y'])})"


def sized(rect):
    return f"{int(rect['width'])} x {int(rect['height'])} at {place(rect)}"


# One line for each of the other types; the members stand below it.
SENTENCES = {
    "Sphere": lambda v: f"radius {figure(v['radius'])} at {numbers(v['center'])}",
    "SliceRange": lambda v: f"{figure(v['begin'])} m to {figure(v['end'])} m, fading from {figure(v['blend_begin'])} m",
    "DepthRange": lambda v: f"{figure(v['lo'])} m to {figure(v['hi'])} m" if v["visible"] else "not visible",
    "LightBox": lambda v: f"{numbers(v['lo'], 'xy')} to {numbers(v['hi'], 'xy')} m,"
    f" depth {figure(v['depth_lo'])} to {figure(v['depth_hi'])} m",
    "TexelGrid": lambda v: f"{int(v['map_size'])} texels of {figure(v['texel_metres'])} m from {place(v)},"
    f" faults: {fault_words(v['faults'])}",
    "Region": lambda v: f"{numbers(v['lo'], 'xy')} to {numbers(v['hi'], 'xy')}",
    "ShadowPlane": lambda v: f"{numbers(v['normal'])} . p + {figure(v['offset'])} = 0",
    "Footprint": lambda v: f"{figure(v['major'])} x {figure(v['minor'])} eye pixels a texel",
    "Worth": lambda v: f"worst {figure(v['worst'])}, mean {figure(v['mean'])} eye pixels a texel over"
    f" {int(v['count'])} points, {int(v['unserved'])} without a map",
    "MapBias": lambda v: f"{figure(v['constant'])} + {figure(v['per_inverse_w'])} / w + {figure(v['slope_texels'])} slope",
    "LookUp": lambda v: "no map: lit" if int(v["first"]) < 0 else f"map {int(v['first'])}"
    + (f", {figure(v['blend'])} of {int(v['second'])}" if float(v["blend"]) > 0 else ""),
    "SoftShadow": lambda v: f"{figure(v['visibility'])} of the light"
    + (f", occluders at a gap of {figure(v['gap'])}" if v["blocked"] else ""),
    "CubeMaps": lambda v: f"{int(v['visible_count'])} of 6 faces visible, faults: {fault_words(v['faults'])}",
    "Clipmap": lambda v: f"{int(v['count'])} levels, faults: {fault_words(v['faults'])}",
    "CasterMaps": lambda v: f"{int(v['map_count'])} maps in {int(v['bundle_count'])} bundles",
    "ConvexBody": lambda v: f"{int(v['edge_count'])} edges",
    "IrregularBuffer": lambda v: f"{int(v['counts']['nodes'])} nodes in {int(v['counts']['lists'])} lists,"
    f" faults: {fault_words(v['faults'])}",
    "Tile": lambda v: f"{int(v['size'])} texels at {place(v)} of {int(v['atlas_width'])} x {int(v['atlas_height'])}",
    "TexelRect": sized,
    "PixelRect": sized,
    "Page": lambda v: "none" if int(v["level"]) < 0 else f"{place(v)} of level {int(v['level'])}",
    "Scroll": lambda v: f"by {place(v)}, {int(v['fresh']['count'])} strips fresh" if v["kept"] else "nothing kept",
}


def printer_of(sentence):
    return type("Sentence", (Summary,), {"to_string": lambda self: sentence(self.value)})


printers = gdb.printing.RegexpCollectionPrettyPrinter("shadowmath")
for kind in (Faults, ClipSpace, Aabb, ShadowMap, Light, ViewVolume, Splits, Cascades):
    printers.add_printer(kind.__name__, f"^shadowmath::v0::{kind.__name__}(<.*>)?$", kind)
for name, sentence in SENTENCES.items():
    printers.add_printer(name, f"^shadowmath::v0::{name}(<.*>)?$", printer_of(sentence))
printers.add_printer("Matrix", r"^glm::mat<4, 4, .*>$", Matrix)
printers.add_printer("Vector", r"^glm::vec<[234], .*>$", Vector)
gdb.printing.register_pretty_printer(None, printers, replace=True)
