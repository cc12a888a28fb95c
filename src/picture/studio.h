#pragma once
#include "picture/scene.h"

namespace windfall::picture {

/// Soft key light from the upper left of the camera, a weaker one from behind on the right, sky all around, a
/// bright backdrop.
void set_studio(Scene& scene, const Camera& camera);

/// The same with a key light that grazes more and a darker backdrop, before which pale wood stands out.
void set_wood_studio(Scene& scene, const Camera& camera);

/// Even light on white, in which a colour keeps its meaning.
void set_diagram(Scene& scene, const Camera& camera);

}  // namespace windfall::picture
