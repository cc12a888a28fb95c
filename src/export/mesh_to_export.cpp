#include "export/mesh_to_export.h"

#include <algorithm>

namespace windfall::export_ {

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

}  // namespace windfall::export_
