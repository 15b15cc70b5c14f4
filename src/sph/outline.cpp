/// Stages and columns in words.
#include <fmt/format.h>

#include <algorithm>

#include "sph/stages.hpp"

namespace ejecta {

namespace {

std::string names(const std::vector<Field>& fields) {
  std::string text;
  for (Field f : fields) text += (text.empty() ? "" : ", ") + std::string(info(f).name);
  return text.empty() ? "-" : text;
}

}  // namespace

template <int Dim>
std::string Sph<Dim>::outline() const {
  std::string text = "stages\n";
  for (const Stage<Dim>& stage : stages)
    text += fmt::format("  {:<18} reads  {}\n  {:<18} writes {}\n", stage.name, names(stage.reads), "",
                        names(stage.writes));
  text += "time step\n";
  for (const Criterion<Dim>& criterion : criteria) text += fmt::format("  {}\n", criterion.name);
  text += "columns\n";
  for (const Field field : particles.fields()) {
    const FieldInfo& f = info(field);
    text += fmt::format("  {:<18} {:>2} x [{}]{:>{}} {}\n", f.name, components(f.shape, Dim), f.unit, "",
                        9 - static_cast<int>(std::min<std::size_t>(9, f.unit.size())), f.doc);
  }
  return text;
}

template std::string Sph<2>::outline() const;
template std::string Sph<3>::outline() const;

}  // namespace ejecta
