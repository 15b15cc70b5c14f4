/// render/ for the pipelines: catalyst_scripts/ejecta_view.py draws with it. Arrays are numpy's, without a copy where
/// their type is right; colours are 0xRRGGBB in unsigned 32-bit numbers.
#include "insitu/paint_module.hpp"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <stdexcept>

#include "render/sheet.hpp"
#include "render/solids.hpp"

namespace py = pybind11;

namespace ejecta {
namespace {

constexpr int as_is = py::array::c_style | py::array::forcecast;
template <class T>
using Array = py::array_t<T, as_is>;

template <class T>
std::span<const T> span_of(const Array<T>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

Raster raster_of(const Array<std::uint32_t>& rgb) {
  if (rgb.ndim() != 2) throw std::invalid_argument("expected a picture of rows and columns");
  Raster raster(static_cast<int>(rgb.shape(1)), static_cast<int>(rgb.shape(0)), 0);
  std::copy_n(rgb.data(), rgb.size(), raster.rgb.begin());
  return raster;
}

Array<std::uint32_t> array_of(const Raster& raster) {
  return Array<std::uint32_t>({raster.height, raster.width}, raster.rgb.data());
}

void check_sizes(const Solids& s) {
  const auto expect = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  expect(s.spheres.places.size() == 3 * s.spheres.radii.size() && s.spheres.rgb.size() == s.spheres.radii.size(),
         "spheres: expected three numbers, a radius and a colour each");
  expect(s.surface.places.size() == 3 * s.surface.rgb.size() && s.surface.normals.size() == s.surface.places.size(),
         "surface: expected three numbers, a normal and a colour a point");
  for (const std::int32_t corner : s.surface.triangles)
    expect(corner >= 0 && static_cast<std::size_t>(corner) < s.surface.rgb.size(),
           "surface: a corner that is no point");
  expect(s.surface.triangles.size() % 3 == 0, "surface: expected three corners a triangle");
  expect(s.plate.rgb.size() == static_cast<std::size_t>(s.plate.width) * static_cast<std::size_t>(s.plate.height),
         "plate: expected a colour a pixel");
  expect(s.plate.filling.empty() || s.plate.filling.size() == s.plate.rgb.size(), "plate: expected a filling a pixel");
}

void define(py::module_& m) {
  py::class_<ColourScale>(m, "ColourScale")
      .def(py::init([](const std::string& map, double low, double high, double linear_to) {
             if (!(low < high)) throw std::invalid_argument("expected a range that grows");
             return colour_scale(colour_map_named(map), low, high, linear_to);
           }),
           py::arg("map"), py::arg("low"), py::arg("high"), py::arg("linear_to") = 0.0)
      .def_readonly("low", &ColourScale::min)
      .def_readonly("high", &ColourScale::max)
      .def("points",
           [](const ColourScale& scale) {
             std::vector<double> points;
             for (std::size_t k = 0; k < scale.values.size(); ++k) {
               const Colour& c = scale.colours[k];
               points.insert(points.end(), {scale.values[k], c.red, c.green, c.blue});
             }
             return points;
           })
      .def(
          "colours",
          [](const ColourScale& scale, const Array<double>& values, std::uint32_t nothing) {
            const std::vector<std::uint32_t> rgb = coloured(span_of(values), scale, nothing);
            return Array<std::uint32_t>(std::vector<py::ssize_t>(values.shape(), values.shape() + values.ndim()),
                                        rgb.data());
          },
          py::arg("values"), py::arg("nothing") = 0xFFFFFFu);

  py::class_<Layout>(m, "Layout")
      .def(py::init([](int width, int height, int panes, std::array<double, 4> wanted, bool nothing_beyond,
                       double legend_width) {
             const Window window{{wanted[0], wanted[1]}, {wanted[2], wanted[3]}};
             return Layout(width, height, panes, window, nothing_beyond ? window : Layout::everywhere(), legend_width);
           }),
           py::arg("width"), py::arg("height"), py::arg("panes"), py::arg("wanted"), py::arg("nothing_beyond") = false,
           py::arg("legend_width") = 0.0)
      .def_property_readonly(
          "pane_size",
          [](const Layout& l) {
            return std::array{static_cast<int>(l.panes[0].width), static_cast<int>(l.panes[0].height)};
          })
      .def_property_readonly("pixel", &Layout::pixel)
      .def_property_readonly("window", [](const Layout& l) {
        return std::array{l.window.low[0], l.window.low[1], l.window.high[0], l.window.high[1]};
      });

  py::class_<Sheet>(m, "Sheet")
      .def(py::init(
          [](const Layout& layout, const std::string& title, const std::string& subtitle, double time, double end) {
            return Sheet(layout, {title, subtitle, time, end});
          }))
      .def("put", [](Sheet& sheet, int pane, const Array<std::uint32_t>& rgb) { sheet.put(pane, raster_of(rgb)); })
      .def("title", &Sheet::title)
      .def("axes", &Sheet::axes)
      .def("scale_bar", &Sheet::scale_bar)
      .def("colour_bar",
           [](Sheet& sheet, int pane, const ColourScale& scale, const std::string& label, const std::string& unit) {
             sheet.title(pane, heading_of(label, scale, unit));
             sheet.colour_bar(pane, scale, unit);
           })
      .def("legend",
           [](Sheet& sheet, int pane, const std::string& heading,
              const std::vector<std::pair<std::uint32_t, std::string>>& entries) {
             std::vector<Sheet::Entry> list;
             for (const auto& [rgb, words] : entries) list.push_back({unpacked(rgb), words});
             sheet.legend(pane, heading, list);
           })
      .def("save", [](const Sheet& sheet, const std::string& file) { sheet.save(file); });

  py::class_<Camera>(m, "Camera")
      .def(py::init([](const Vec<3>& centre, const Vec<3>& right, const Vec<3>& up, double pixel) {
        return Camera{centre, right, up, pixel};
      }));

  m.def(
      "draw_solids",
      [](const Camera& camera, std::array<int, 2> size, bool flat, const Array<float>& places,
         const Array<float>& radii, const Array<std::uint32_t>& rgb, const Array<float>& points,
         const Array<float>& normals, const Array<std::uint32_t>& point_rgb, const Array<std::int32_t>& triangles,
         const Vec<3>& corner, const Vec<3>& across, const Vec<3>& upwards, const Array<std::uint32_t>& plate,
         const Array<float>& filling) {
        Solids solids{{span_of(places), span_of(radii), span_of(rgb)},
                      {span_of(points), span_of(normals), span_of(point_rgb), span_of(triangles)},
                      {},
                      flat};
        if (plate.ndim() == 2)
          solids.plate = {corner,
                          across,
                          upwards,
                          static_cast<int>(plate.shape(1)),
                          static_cast<int>(plate.shape(0)),
                          span_of(plate),
                          span_of(filling)};
        check_sizes(solids);
        return array_of(draw_solids(solids, camera, size[0], size[1], 0xFFFFFFu));
      },
      py::arg("camera"), py::arg("size"), py::arg("flat") = false, py::arg("places") = Array<float>(),
      py::arg("radii") = Array<float>(), py::arg("rgb") = Array<std::uint32_t>(), py::arg("points") = Array<float>(),
      py::arg("normals") = Array<float>(), py::arg("point_rgb") = Array<std::uint32_t>(),
      py::arg("triangles") = Array<std::int32_t>(), py::arg("corner") = Vec<3>(0, 0, 0),
      py::arg("across") = Vec<3>(1, 0, 0), py::arg("upwards") = Vec<3>(0, 0, 1),
      py::arg("plate") = Array<std::uint32_t>(), py::arg("filling") = Array<float>());
  m.def("rank_colour", [](int rank) { return packed(rank_colour(rank)); });
  m.def("body_colour", [](int body) { return packed(body_colour(body)); });
  m.attr("NOTHING") = Plate::nothing;
}

extern "C" PyObject* make_paint_module() {
  static py::module_::module_def definition;
  auto m = py::module_::create_extension_module("ejecta_paint", "Ejecta's own painter.", &definition);
  try {
    define(m);
    return m.release().ptr();
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_ImportError, error.what());
    return nullptr;
  }
}

}  // namespace

void offer_paint_module() {
  if (!Py_IsInitialized()) PyImport_AppendInittab("ejecta_paint", make_paint_module);
}

}  // namespace ejecta
