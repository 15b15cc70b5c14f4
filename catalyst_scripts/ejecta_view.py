"""What the pipelines of a run share: settings, units, fixed colour maps, and a view that fills its frame.

A pipeline makes one View, puts particles, surfaces or what ParaView can show into it, and calls View.save(info) in
catalyst_execute. Everything that could flicker (camera, colour ranges, units, image size) comes from the run's settings.
Lengths are metres, all numbers SI; only what is written on an image is scaled to a readable unit.

Spheres and surfaces are drawn by Ejecta's own painter (the module ejecta_paint, which the program brings), and so are
bands, axes, bars and legends of all views; the rest by ParaView.
"""
import functools
import json
import math
import os

import ejecta_paint
import numpy
from paraview.simple import (CreateRenderView, GetColorTransferFunction, PVTrivialProducer, Show,
                             _DisableFirstRenderCameraReset)
from vtkmodules.util.numpy_support import vtk_to_numpy

INK = [0.13, 0.13, 0.15]
PAPER = [1.0, 1.0, 1.0]
NUMBER = "fragment_number"  # 0 is dust

_read = functools.lru_cache(1)(json.loads)
_ranges = {}


def settings():
    """The run's settings and, from the first frame on, how its fields are shown, as the simulation publishes them."""
    return _read(os.environ["EJECTA_FRAME"])


def channel(name):
    """The source of a channel: particles, slice, ellipsoids, fragments, or another of settings()["channels"].

    To be called where the script begins: only channels that have a source by then are made for the first frame.
    """
    known = settings()["channels"]
    if name not in known:
        raise ValueError(f"channel '{name}' unknown; this run has {', '.join(known)}")
    return PVTrivialProducer(registrationName=name)


def data_of(source):
    """The channel's VTK data set itself: asking ParaView about it would compute the range of every array each time."""
    data = source.GetClientSideObject().GetOutputDataObject(0)
    return data.GetPartition(0) if data is not None and data.IsA("vtkPartitionedDataSet") else data


def has_data(source):
    data = data_of(source)
    return data is not None and data.GetNumberOfPoints() > 0


def fields(source):
    """Names of the point arrays of a channel."""
    arrays = data_of(source).GetPointData()
    return [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())]


def array(source, name):
    """An array of a channel as numpy's, without a copy."""
    return vtk_to_numpy(data_of(source).GetPointData().GetArray(name))


def column(source, name):
    """The same, but of vectors their magnitude."""
    values = array(source, name)
    return values if values.ndim == 1 else numpy.sqrt((values.astype(float) ** 2).sum(axis=1))


# ---- units ----------------------------------------------------------------------------------------------------------

def readable_unit(unit, largest):
    """The unit to print numbers up to `largest` [unit] in, and what to multiply them by."""
    if unit in ("", "1"):
        return "", 1.0
    if unit.startswith("kg") or largest <= 0 or not math.isfinite(largest):
        return unit, 1.0
    if unit == "m" and 0.01 <= largest < 1:
        return "cm", 100.0
    for size, prefix in settings()["prefixes"]:
        if largest >= size * 0.9999:
            return prefix + unit, 1.0 / size
    return unit, 1.0


def style(field):
    """How the run shows a field: unit, label, range [SI] or None, name of the colour map, where it becomes logarithmic."""
    known = settings()["fields"]
    if field not in known:
        raise ValueError(f"field '{field}' unknown; this run has {', '.join(known)}")
    return known[field]


def label(field):
    return style(field)["label"]


# ---- colour ---------------------------------------------------------------------------------------------------------

def colour_range(field, source):
    """The run's fixed range. Where nothing is known of it: that of the first frame in which the field has one, kept
    from then on."""
    if field in _ranges:
        return _ranges[field]
    given = style(field)["range"]
    if given is None:
        values = column(source, field)
        values = values[numpy.isfinite(values)]
        if not values.size or values.min() == values.max():
            return 0.0, 1.0
        given = values.min(), values.max()
    _ranges[field] = tuple(map(float, given))
    return _ranges[field]


def colour_scale(field, source):
    """The colours of a field over its fixed range: the ones of all pictures."""
    known = style(field)
    return ejecta_paint.ColourScale(known["map"], *colour_range(field, source), known["linear_to"])


def colour_map(field, source):
    """The same as ParaView's lookup table."""
    table = GetColorTransferFunction(field)
    table.AutomaticRescaleRangeMode = "Never"
    table.ColorSpace = "RGB"
    table.RGBPoints = colour_scale(field, source).points()
    table.NanColor = PAPER
    table.ScalarRangeInitialized = 1
    table.VectorMode = "Magnitude"
    return table


# ---- geometry -------------------------------------------------------------------------------------------------------

def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def _axis(direction):
    """Number of the axis of coordinates that a unit vector points along; None if there is none."""
    along = [i for i in range(3) if direction[i] > 1 - 1e-9]
    return along[0] if along else None


def places_of(source):
    """Three single-precision numbers a particle."""
    return numpy.stack([column(source, "position_" + axis) for axis in "xyz"], axis=1, dtype=numpy.float32, casting="same_kind")


def radii_of(source):
    """Of drawn particles: those that fill the room there is."""
    s = settings()
    if "smoothing_length" in fields(source):
        return (s["radius_per_smoothing_length"] * column(source, "smoothing_length")).astype(numpy.float32)
    return numpy.full(data_of(source).GetNumberOfPoints(), s["particle_radius"], numpy.float32)


# ---- views ----------------------------------------------------------------------------------------------------------

class View:
    """A picture of the run's size with one pane: a band with title and time above, a colour bar or a legend beside it.

    `subtitle` says what is shown. The scene is seen along parallel lines.
    """

    def __init__(self, name, subtitle, legend_width=0):
        self.name, self.subtitle, self.legend_width = name, subtitle, legend_width
        self.size = settings()["image_size"]
        self.solids = {}  # arguments of draw_solids
        self.bar = self.entries = self._paraview = self._particles = None

    # -- camera --

    def look_at_scene(self):
        """The run's fixed camera: obliquely from above in 3D (z up, x to the right), from the front in the plane."""
        s = settings()
        if s["dimension"] == 2:
            return self.look(s["view_center"], s["view_width"], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], s["view_height"])
        turn, tilt = math.radians(18), math.radians(22)
        direction = [-math.sin(turn) * math.cos(tilt), math.cos(turn) * math.cos(tilt), -math.sin(tilt)]
        return self.look(s["view_center"], s["view_width"], direction, [0.0, 0.0, 1.0], s["view_height"])

    def look(self, centre, width, direction, up, height=None):
        """Looks along `direction` at `centre`; `width` and `height` [m] (default: width) are seen at least."""
        self.centre, self.direction = centre, _unit(direction)
        self.right = _unit(_cross(self.direction, up))
        self.up = _cross(self.right, self.direction)
        x, y = (sum(c * e for c, e in zip(centre, edge)) for edge in (self.right, self.up))
        w, h = 0.5 * width, 0.5 * (height or width)
        self.layout = ejecta_paint.Layout(*self.size, 1, [x - w, y - h, x + w, y + h], legend_width=self.legend_width)
        return self

    # -- what is seen --

    def balls(self, places, radii, rgb):
        """Shaded spheres, in the plane discs, of this frame; colours 0xRRGGBB."""
        self.solids.update(flat=settings()["dimension"] == 2, places=places, radii=radii, rgb=rgb)

    def spheres(self, source, field, behind=None):
        """Particles as spheres of their own size coloured by a field, in every frame from now on; `behind`: only those
        with y above it."""
        self._particles = source, field, behind
        self.colour_bar(field, source)

    def _show_particles(self, source, field, behind):
        keep = slice(None) if behind is None else column(source, "position_y") >= behind
        rgb = colour_scale(field, source).colours(column(source, field)[keep])
        if field.startswith("damage") and "body" in fields(source):  # what cannot break has the colour of its body
            colours = numpy.array([0 if b["breaks"] else ejecta_paint.body_colour(i)
                                   for i, b in enumerate(settings()["bodies"])], numpy.uint32)
            own = colours[column(source, "body")[keep]]
            rgb = numpy.where(own != 0, own, rgb)
        self.balls(places_of(source)[keep], radii_of(source)[keep], rgb)
        self.colour_bar(field, source)

    def surface(self, points, normals, rgb, triangles):
        """Triangles with normals and colours at their corners."""
        self.solids.update(points=points, normals=normals, point_rgb=rgb, triangles=triangles)

    def plate(self, rgb, filling, corner, across, upwards):
        """A picture in space, the face of a cut: colours of its pixels, and how full of matter they are, which ends at
        one half; centre of the lower left pixel, and from a pixel to the next."""
        self.solids.update(plate=rgb, filling=filling, corner=corner, across=across, upwards=upwards)

    def polygons(self, points, field, source):
        """Flat polygons of equally many corners, (n, corners, 3), coloured by a field of as many values."""
        n, corners, _ = points.shape
        fan = numpy.array([(0, k, k + 1) for k in range(1, corners - 1)])
        triangles = (corners * numpy.arange(n)[:, None, None] + fan).reshape(-1, 3)
        rgb = colour_scale(field, source).colours(column(source, field))
        self.surface(points.reshape(-1, 3), numpy.zeros((n * corners, 3)), numpy.repeat(rgb, corners), triangles)
        self.solids["flat"] = True
        self.colour_bar(field, source)

    def lines(self, points, width=1.5):
        """Dark lines of equally many points, (n, points, 3), with a light rim, `width` in thousandths of the picture's
        height, added to the polygons."""
        starts, ends = points[:, :-1].reshape(-1, 3), points[:, 1:].reshape(-1, 3)
        eye = -numpy.array(self.direction)
        across = numpy.cross(ends - starts, eye)
        length = numpy.linalg.norm(across, axis=1, keepdims=True)
        across = numpy.where(length > 0, across / numpy.where(length > 0, length, 1), 0)
        half = 0.5e-3 * width * self.layout.pixel * self.size[1]
        for rim, colour, lift in ((2.2, 0xFFFFFF, 0.0), (1.0, 0x212126, half)):
            along = numpy.cross(eye, across) * half * rim  # ends overlap: corners have no gaps
            a, b, side = starts - along + lift * eye, ends + along + lift * eye, across * half * rim
            corners = numpy.stack([a - side, b - side, b + side, a + side], axis=1).reshape(-1, 3)
            first = len(self.solids["point_rgb"]) + 4 * numpy.arange(len(starts))[:, None, None]
            triangles = (first + numpy.array([(0, 1, 2), (0, 2, 3)])).reshape(-1, 3)
            more = dict(points=corners, normals=numpy.zeros_like(corners), triangles=triangles,
                        point_rgb=numpy.full(len(corners), colour, numpy.uint32))
            self.solids.update({name: numpy.concatenate([self.solids[name], values]) for name, values in more.items()})

    def show(self, source, representation, **properties):
        """Anything else, drawn by ParaView."""
        display = Show(source, self.paraview)
        display.SetRepresentationType(representation)
        for name, value in properties.items():
            setattr(display, name, value)
        return display

    @property
    def paraview(self):
        """ParaView's render view, with the camera of this one."""
        if self._paraview is None:
            _DisableFirstRenderCameraReset()
            self._paraview = v = CreateRenderView()
            v.ViewSize = [2 * pixels for pixels in self.layout.pane_size]  # two by two are averaged
            v.UseColorPaletteForBackground = 0
            v.BackgroundColorMode = "Single Color"
            v.Background = PAPER
            v.OrientationAxesVisibility = 0
            v.CenterAxesVisibility = 0
            v.CameraParallelProjection = 1
            v.LODThreshold = 1e9
            height = self.layout.pixel * self.layout.pane_size[1]
            v.CameraFocalPoint = self.centre
            v.CameraPosition = [c - 10 * height * d for c, d in zip(self.centre, self.direction)]
            v.CameraViewUp = self.up
            v.CenterOfRotation = self.centre
            v.CameraParallelScale = 0.5 * height
        return self._paraview

    # -- what is written beside it --

    def colour_bar(self, field, source):
        """A colour bar under `field [unit]` beside the pane."""
        self.bar = colour_scale(field, source), label(field), style(field)["unit"]

    def legend(self, heading, entries):
        """A list of (colour, words) beside the pane."""
        self.entries = heading, entries

    # -- the picture --

    def save(self, info):
        """Draws the view and writes images/<name>_<step>.png."""
        s = settings()
        if self._particles:
            self._show_particles(*self._particles)
        sheet = ejecta_paint.Sheet(self.layout, s["scene_title"], self.subtitle, info.time, s["time_end"] or 0.0)
        if self._paraview is not None:
            sheet.put(0, self._captured(info))
        elif self.solids:
            camera = ejecta_paint.Camera(self.centre, self.right, self.up, self.layout.pixel)
            sheet.put(0, ejecta_paint.draw_solids(camera, self.layout.pane_size, **self.solids))
        axes = _axis(self.right), _axis(self.up)
        if None in axes:
            sheet.scale_bar(0, "seen obliquely, z upwards" if s["dimension"] == 3 else "")
        else:
            sheet.axes(0, ["xyz"[axis] for axis in axes])
        if self.bar:
            sheet.colour_bar(0, *self.bar)
        if self.entries:
            sheet.legend(0, *self.entries)
        sheet.save(path_of(self.name, info))

    def _captured(self, info):
        self._paraview.ViewTime = info.time
        image = self._paraview.SMProxy.CaptureWindow(1)
        width, height, _ = image.GetDimensions()
        parts = vtk_to_numpy(image.GetPointData().GetScalars()).astype(numpy.uint32).reshape(height, width, -1)[::-1]
        image.UnRegister(None)  # CaptureWindow hands its image over: nobody else would ever release it
        return parts[..., 0] << 16 | parts[..., 1] << 8 | parts[..., 2]


def path_of(name, info):
    """Where the picture of a view goes."""
    return os.path.join(settings()["run_folder"], "images", f"{name}_{info.timestep:06d}.png")
