#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "meshfile/gltf_source.h"
#include "meshfile/mesh_file.h"

namespace windfall::meshfile {
namespace {

using tinygltf::Accessor;
using tinygltf::Model;

template <class T>
const T& element_of(const std::vector<T>& list, int index, const char* what) {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        throw std::out_of_range(fmt::format("there is no {} {}", what, index));
    return list[static_cast<std::size_t>(index)];
}

const unsigned char* range_of(const Model& model, int view_index, std::size_t offset, std::size_t bytes) {
    const auto& view = element_of(model.bufferViews, view_index, "buffer view");
    const auto& data = element_of(model.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset ||
        offset > view.byteLength || bytes > view.byteLength - offset)
        throw std::out_of_range("an accessor reaches beyond its buffer");
    return data.data() + view.byteOffset + offset;
}

std::size_t component_bytes(int type) {
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    if (size <= 0) throw std::out_of_range("an accessor of unknown type");
    return static_cast<std::size_t>(size);
}

template <class T>
T read_as(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

double component(const unsigned char* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read_as<std::int8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read_as<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read_as<std::int16_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read_as<std::uint16_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read_as<std::uint32_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return read_as<float>(bytes);
        default:
            throw std::out_of_range("an accessor of unknown type");
    }
}

/// What a normalized integer stands for (glTF 2.0, 3.6.2.2).
double normalized(double value, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return std::max(value / 127, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return value / 255;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return std::max(value / 32767, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return value / 65535;
        default:
            return value;
    }
}

void fill_sparse(const Model& model, const Accessor& accessor, std::size_t width,
                 std::vector<unsigned char>& bytes) {
    const auto& sparse = accessor.sparse;
    if (!sparse.isSparse || sparse.count <= 0) return;
    const auto count = static_cast<std::size_t>(sparse.count);
    const std::size_t index_bytes = component_bytes(sparse.indices.componentType);
    const unsigned char* indices =
        range_of(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                 count * index_bytes);
    const unsigned char* values = range_of(model, sparse.values.bufferView,
                                           static_cast<std::size_t>(sparse.values.byteOffset), count * width);
    for (std::size_t i = 0; i < count; ++i) {
        const double index = component(indices + i * index_bytes, sparse.indices.componentType);
        if (!(index >= 0 && index < static_cast<double>(accessor.count)))
            throw std::out_of_range("a sparse accessor reaches beyond its end");
        const auto at = static_cast<std::size_t>(index);
        std::memcpy(bytes.data() + at * width, values + i * width, width);
    }
}

}  // namespace

int component_count(const Accessor& accessor) {
    const int count = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (count <= 0) throw std::out_of_range("an accessor of unknown type");
    return count;
}

std::vector<unsigned char> accessor_bytes(const Model& model, int index) {
    const Accessor& accessor = element_of(model.accessors, index, "accessor");
    const std::size_t width =
        component_bytes(accessor.componentType) * static_cast<std::size_t>(component_count(accessor));
    // Without a buffer view nothing but its own word says how long an accessor is.
    if (accessor.count > kMaxCorners)
        throw std::out_of_range(fmt::format("an accessor of {} elements is too long", accessor.count));
    std::vector<unsigned char> bytes(accessor.count * width, 0);
    if (accessor.bufferView >= 0 && accessor.count > 0) {
        const auto& view = element_of(model.bufferViews, accessor.bufferView, "buffer view");
        const std::size_t stride = view.byteStride > 0 ? view.byteStride : width;
        const unsigned char* data =
            range_of(model, accessor.bufferView, accessor.byteOffset, (accessor.count - 1) * stride + width);
        for (std::size_t i = 0; i < accessor.count; ++i)
            std::memcpy(bytes.data() + i * width, data + i * stride, width);
    }
    fill_sparse(model, accessor, width, bytes);
    return bytes;
}

std::vector<std::uint32_t> accessor_indices(const Model& model, int index, std::size_t count) {
    const Accessor& accessor = element_of(model.accessors, index, "accessor");
    // glTF 2.0, 3.7.2.1: numbers without sign.
    if (accessor.type != TINYGLTF_TYPE_SCALAR ||
        (accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
         accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
        throw std::out_of_range("its indices are no whole numbers without sign");
    std::vector<std::uint32_t> indices;
    for (const double value : accessor_values(model, index)) {
        if (!(value >= 0 && value < static_cast<double>(count)))
            throw std::out_of_range("an index points to no vertex");
        indices.push_back(static_cast<std::uint32_t>(value));
    }
    return indices;
}

std::vector<double> accessor_values(const Model& model, int index) {
    const std::vector<unsigned char> bytes = accessor_bytes(model, index);
    const Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    const std::size_t width = component_bytes(accessor.componentType);
    std::vector<double> values(bytes.size() / width);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = component(bytes.data() + i * width, accessor.componentType);
        // To the precision that it is written with again.
        if (accessor.normalized)
            values[i] = static_cast<float>(normalized(values[i], accessor.componentType));
    }
    return values;
}

std::vector<unsigned char> view_bytes(const Model& model, int index) {
    const auto& view = element_of(model.bufferViews, index, "buffer view");
    const unsigned char* data = range_of(model, index, 0, view.byteLength);
    return {data, data + view.byteLength};
}

}  // namespace windfall::meshfile
