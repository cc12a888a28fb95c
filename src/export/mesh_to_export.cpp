#include "export/mesh_to_export.h"

#include <algorithm>
#include <cmath>

namespace windfall::export_ {

std::vector<bool> MeshToExport::used_materials() const {
    std::vector<bool> used(materials.size(), false);
    for (std::size_t f = 0; f < faces.size(); ++f) used[material_of(f)] = true;
    return used;
}

bool MeshToExport::has_hard_faces() const {
    return std::any_of(materials.begin(), materials.end(),
                       [](const auto& material) { return material.hard; });
}

const take::Attribute* MeshToExport::colour() const {
    for (const auto& attribute : attributes)
        if (attribute.name == "colour" && attribute.components == 3) return &attribute;
    return nullptr;
}

std::vector<std::string> component_names(const take::Attribute& attribute) {
    std::string plain = attribute.name;
    std::replace_if(
        plain.begin(), plain.end(),
        [](char c) {
            return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_');
        },
        '_');
    if (attribute.components == 1) return {plain};
    std::vector<std::string> names;
    for (int k = 0; k < attribute.components; ++k)
        names.push_back(plain + "_" +
                        (attribute.components <= 4 ? std::string(1, "xyzw"[k]) : std::to_string(k)));
    return names;
}

double srgb_from_linear(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

}  // namespace windfall::export_
