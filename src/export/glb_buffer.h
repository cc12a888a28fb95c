#pragma once
// The one buffer of a GLB file. For the files of this folder that write GLB.
#include <tiny_gltf.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "core/error.h"

namespace windfall::export_ {

/// Grows the buffer of a model; every accessor has a view of its own. The model must outlive it.
class BufferBuilder {
  public:
    explicit BufferBuilder(tinygltf::Model& model) : m_model(model) { m_model.buffers.emplace_back(); }

    /// `target`: TINYGLTF_TARGET_*, or 0 for data that is neither vertices nor indices.
    template <class T>
    int add_view(const std::vector<T>& numbers, int target) {
        auto& data = m_model.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = data.size();
        view.byteLength = numbers.size() * sizeof(T);
        view.target = target;
        // tinygltf writes offsets as int, so a larger buffer would come out wrong.
        if (view.byteOffset + view.byteLength > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw InputError(
                "the animation does not fit into one GLB file (2 GiB); export single frames with --frame, or "
                "the "
                "sequence as obj or ply");
        data.resize(data.size() + view.byteLength);
        std::memcpy(data.data() + view.byteOffset, numbers.data(), view.byteLength);
        m_model.bufferViews.push_back(std::move(view));
        return static_cast<int>(m_model.bufferViews.size()) - 1;
    }

    int add_accessor(int view, int component_type, int type, std::size_t count) {
        tinygltf::Accessor accessor;
        accessor.bufferView = view;
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = count;
        m_model.accessors.push_back(std::move(accessor));
        return static_cast<int>(m_model.accessors.size()) - 1;
    }

    int add_floats(const std::vector<float>& numbers, int type, int target) {
        const int width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
        return add_accessor(add_view(numbers, target), TINYGLTF_COMPONENT_TYPE_FLOAT, type,
                            numbers.size() / static_cast<std::size_t>(width));
    }

    tinygltf::Accessor& accessor(int index) { return m_model.accessors[static_cast<std::size_t>(index)]; }

  private:
    tinygltf::Model& m_model;
};

/// The smallest and largest number of each component, which glTF asks for where positions are.
void set_bounds(tinygltf::Accessor& accessor, const std::vector<float>& numbers, std::size_t width);

/// Displacements of a morph target, three floats a vertex; as a list of those that are not zero where that is
/// shorter. Returns the accessor.
int add_displacements(BufferBuilder& buffer, const std::vector<float>& numbers);

}  // namespace windfall::export_
