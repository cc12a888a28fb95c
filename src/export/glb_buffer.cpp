#include "export/glb_buffer.h"

#include <algorithm>
#include <cstddef>

namespace windfall::export_ {

void set_bounds(tinygltf::Accessor& accessor, const std::vector<float>& numbers, std::size_t width) {
    accessor.minValues.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(width));
    accessor.maxValues = accessor.minValues;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        accessor.minValues[i % width] = std::min<double>(accessor.minValues[i % width], numbers[i]);
        accessor.maxValues[i % width] = std::max<double>(accessor.maxValues[i % width], numbers[i]);
    }
}

int add_displacements(BufferBuilder& buffer, const std::vector<float>& numbers) {
    std::vector<std::uint32_t> moved;
    const std::size_t count = numbers.size() / 3;
    for (std::size_t i = 0; i < count; ++i)
        if (numbers[3 * i] != 0 || numbers[3 * i + 1] != 0 || numbers[3 * i + 2] != 0)
            moved.push_back(static_cast<std::uint32_t>(i));
    constexpr std::size_t kVectorBytes = 3 * sizeof(float);
    int index = -1;
    if (moved.size() * (kVectorBytes + sizeof(std::uint32_t)) >= count * kVectorBytes) {
        index = buffer.add_floats(numbers, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    } else {
        if (moved.empty()) moved.push_back(0);  // glTF has no empty list
        std::vector<float> values;
        for (const auto i : moved)
            values.insert(values.end(), numbers.begin() + 3 * std::ptrdiff_t{i},
                          numbers.begin() + 3 * std::ptrdiff_t{i} + 3);
        index = buffer.add_accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, count);
        auto& sparse = buffer.accessor(index).sparse;
        sparse.isSparse = true;
        sparse.count = static_cast<int>(moved.size());
        sparse.indices.byteOffset = sparse.values.byteOffset = 0;  // tinygltf leaves them undefined
        sparse.indices.bufferView = buffer.add_view(moved, 0);
        sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        sparse.values.bufferView = buffer.add_view(values, 0);
    }
    set_bounds(buffer.accessor(index), numbers, 3);
    return index;
}

}  // namespace windfall::export_
