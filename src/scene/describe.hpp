#pragma once
/// The settings of a scene, one function per struct and one line per value.
#include "scene/describer.hpp"
#include "scene/names.hpp"

namespace ejecta {

void describe(Describer& d, Body& body);
void describe(Describer& d, Numerics& numerics);
void describe(Describer& d, Boundary& boundary);
void describe(Describer& d, InSitu& insitu);
void describe(Describer& d, FragmentSettings& fragments);
void describe(Describer& d, OutputSettings& output);

/// All sections of a scene but [materials]. The scene must already have what it has of other sections; `sections` tells
/// what they are for.
void describe(Describer& d, Scene& scene, const std::vector<SceneSection>& sections = {});

}  // namespace ejecta
