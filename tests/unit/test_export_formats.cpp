#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>

#include <cstring>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "export/glb.h"
#include "export/obj.h"
#include "export/ply.h"
#include "export/seam_split.h"
#include "support/sample_take.h"

namespace windfall::export_ {
namespace {

using geometry::Vec2;
using geometry::Vec3;

MeshToExport sample(bool with_uvs) {
    const auto fresh = sample_mesh();
    MeshToExport mesh;
    mesh.name = "skin";
    mesh.positions = fresh.rest.positions;
    mesh.positions[3] *= 1.25;
    mesh.normals = geometry::vertex_normals(mesh.positions, fresh.rest.faces);
    mesh.faces = fresh.rest.faces;
    if (with_uvs) mesh.corner_uvs = fresh.rest.corner_uvs;
    mesh.attributes = fresh.attributes;
    mesh.attributes.push_back({"depth (m)", 1, {0, 1, 2, 3, 4, 5, 6, 7}});
    mesh.attributes.push_back({"x", 1, {7, 6, 5, 4, 3, 2, 1, 0}});
    return mesh;
}

// ---- OBJ ----

struct ParsedObj {
    std::vector<Vec3> v, vn;
    std::vector<Vec2> vt;
    struct Corner {
        int v = 0, vt = 0, vn = 0;
    };
    std::vector<std::vector<Corner>> f;
};

ParsedObj parse_obj(const std::string& text) {
    ParsedObj obj;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string tag;
        words >> tag;
        if (tag == "v" || tag == "vn") {
            Vec3 p;
            words >> p.x() >> p.y() >> p.z();
            (tag == "v" ? obj.v : obj.vn).push_back(p);
        } else if (tag == "vt") {
            Vec2 p;
            words >> p.x() >> p.y();
            obj.vt.push_back(p);
        } else if (tag == "f") {
            obj.f.emplace_back();
            for (std::string word; words >> word;) {
                ParsedObj::Corner corner;
                if (std::sscanf(word.c_str(), "%d/%d/%d", &corner.v, &corner.vt, &corner.vn) != 3 &&
                    std::sscanf(word.c_str(), "%d//%d", &corner.v, &corner.vn) != 2)
                    ADD_FAILURE() << word;
                obj.f.back().push_back(corner);
            }
        }
    }
    return obj;
}

void expect_obj_matches(const MeshToExport& mesh) {
    const ParsedObj obj = parse_obj(obj_text({&mesh, 1}));
    ASSERT_EQ(obj.v.size(), mesh.positions.size());
    ASSERT_EQ(obj.vn.size(), mesh.normals.size());
    for (std::size_t i = 0; i < obj.v.size(); ++i) {
        EXPECT_EQ(obj.v[i].cast<float>(), mesh.positions[i].cast<float>());
        EXPECT_EQ(obj.vn[i].cast<float>(), mesh.normals[i].cast<float>());
    }
    ASSERT_EQ(obj.f.size(), mesh.faces.size());
    for (std::size_t f = 0; f < obj.f.size(); ++f) {
        ASSERT_EQ(static_cast<int>(obj.f[f].size()), geometry::corner_count(mesh.faces[f]));
        for (std::size_t c = 0; c < obj.f[f].size(); ++c) {
            const auto& corner = obj.f[f][c];
            EXPECT_EQ(corner.v, mesh.faces[f][c] + 1);
            EXPECT_EQ(corner.vn, corner.v);
            if (mesh.corner_uvs.empty())
                EXPECT_EQ(corner.vt, 0);
            else
                EXPECT_EQ(obj.vt.at(static_cast<std::size_t>(corner.vt) - 1), mesh.corner_uvs[f][c]);
        }
    }
}

TEST(ExportObj, ReadsBackWithTextureCorners) {
    expect_obj_matches(sample(true));
    // Seven charts side by side share the corners of their common edges: eight columns, two rows.
    EXPECT_EQ(parse_obj(obj_text(std::vector{sample(true)})).vt.size(), 16u);
}

TEST(ExportObj, ReadsBackWithoutTexture) { expect_obj_matches(sample(false)); }

// ---- PLY ----

struct ParsedPly {
    std::vector<std::string> properties;
    std::vector<std::vector<float>> vertices;
    std::vector<std::vector<std::int32_t>> faces;
    std::vector<std::vector<float>> face_uvs;
};

ParsedPly parse_ply(const std::vector<std::byte>& bytes) {
    ParsedPly ply;
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string end = "end_header\n";
    std::size_t at = text.find(end) + end.size();
    std::istringstream lines(text.substr(0, at));
    std::size_t vertex_count = 0, face_count = 0;
    bool has_uvs = false;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string tag, type, name;
        words >> tag >> type >> name;
        if (tag == "element") (type == "vertex" ? vertex_count : face_count) = std::stoul(name);
        if (tag == "property" && type == "float") ply.properties.push_back(name);
        if (line == "property list uchar float texcoord") has_uvs = true;
    }
    const auto take = [&](void* target, std::size_t size) {
        ASSERT_LE(at + size, text.size());
        std::memcpy(target, text.data() + at, size);
        at += size;
    };
    for (std::size_t v = 0; v < vertex_count; ++v) {
        ply.vertices.emplace_back(ply.properties.size());
        take(ply.vertices.back().data(), ply.properties.size() * sizeof(float));
    }
    for (std::size_t f = 0; f < face_count; ++f) {
        std::uint8_t count = 0;
        take(&count, 1);
        ply.faces.emplace_back(count);
        take(ply.faces.back().data(), count * sizeof(std::int32_t));
        if (!has_uvs) continue;
        take(&count, 1);
        ply.face_uvs.emplace_back(count);
        take(ply.face_uvs.back().data(), count * sizeof(float));
    }
    EXPECT_EQ(at, text.size());
    return ply;
}

TEST(ExportPly, ReadsBackWithAttributes) {
    for (const bool with_uvs : {false, true}) {
        const MeshToExport mesh = sample(with_uvs);
        const ParsedPly ply = parse_ply(ply_bytes({&mesh, 1}));
        EXPECT_THAT(ply.properties, testing::ElementsAre("x", "y", "z", "nx", "ny", "nz", "direction_x",
                                                         "direction_y", "direction_z", "depth__m_", "x_"));
        ASSERT_EQ(ply.vertices.size(), mesh.positions.size());
        for (std::size_t v = 0; v < ply.vertices.size(); ++v) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto axis = static_cast<Eigen::Index>(k);
                EXPECT_EQ(ply.vertices[v][k], static_cast<float>(mesh.positions[v][axis]));
                EXPECT_EQ(ply.vertices[v][3 + k], static_cast<float>(mesh.normals[v][axis]));
                EXPECT_EQ(ply.vertices[v][6 + k], mesh.attributes[0].values[3 * v + k]);
            }
            EXPECT_EQ(ply.vertices[v][9], static_cast<float>(v));
            EXPECT_EQ(ply.vertices[v][10], 7.0f - static_cast<float>(v));
        }
        ASSERT_EQ(ply.faces.size(), mesh.faces.size());
        for (std::size_t f = 0; f < ply.faces.size(); ++f) {
            ASSERT_EQ(static_cast<int>(ply.faces[f].size()), geometry::corner_count(mesh.faces[f]));
            for (std::size_t c = 0; c < ply.faces[f].size(); ++c)
                EXPECT_EQ(ply.faces[f][c], mesh.faces[f][c]);
        }
        ASSERT_EQ(ply.face_uvs.size(), with_uvs ? mesh.faces.size() : 0u);
        for (std::size_t f = 0; f < ply.face_uvs.size(); ++f)
            for (std::size_t k = 0; k < ply.face_uvs[f].size(); ++k)
                EXPECT_EQ(ply.face_uvs[f][k],
                          static_cast<float>(mesh.corner_uvs[f][k / 2][static_cast<Eigen::Index>(k % 2)]));
    }
}

// ---- seams ----

TEST(SeamSplit, DoublesOnlyWhereTextureCoordinatesDiffer) {
    // Two quadrilaterals side by side: joined in the texture, and torn apart.
    const std::vector<geometry::Face> faces = {{0, 1, 4, 3}, {1, 2, 5, 4}};
    const auto uv = [](double u, double v) { return Vec2(u, v); };
    std::vector<std::array<Vec2, 4>> uvs = {{uv(0, 0), uv(1, 0), uv(1, 1), uv(0, 1)},
                                            {uv(1, 0), uv(2, 0), uv(2, 1), uv(1, 1)}};
    EXPECT_EQ(split_at_seams(6, faces, uvs).source.size(), 6u);
    for (auto& corner : uvs[1]) corner.x() += 5;
    const SeamSplit torn = split_at_seams(6, faces, uvs);
    EXPECT_EQ(torn.source.size(), 8u);
    ASSERT_EQ(torn.indices.size(), 12u);
    for (std::size_t k = 0; k < 12; ++k) {
        constexpr std::array<std::array<int, 6>, 2> kCorners = {{{0, 1, 2, 0, 2, 3}, {0, 1, 2, 0, 2, 3}}};
        const std::size_t f = k / 6;
        const auto c = static_cast<std::size_t>(kCorners[f][k % 6]);
        EXPECT_EQ(torn.source[torn.indices[k]], faces[f][c]);
        EXPECT_EQ(torn.uvs[torn.indices[k]], uvs[f][c]);
    }
    EXPECT_EQ(split_at_seams(6, faces, {}).source.size(), 6u);
}

// ---- GLB ----

tinygltf::Model loaded(const std::vector<std::byte>& bytes) {
    tinygltf::Model model;
    std::string error, warning;
    const bool ok = tinygltf::TinyGLTF().LoadBinaryFromMemory(
        &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
        static_cast<unsigned>(bytes.size()));
    EXPECT_TRUE(ok) << error;
    EXPECT_EQ(warning, "");
    return model;
}

std::vector<std::byte> still_bytes(const MeshToExport& mesh) {
    return glb_bytes(std::vector{MeshToAnimate{mesh, {}}});
}

// The numbers of an accessor, dense or sparse.
std::vector<float> floats(const tinygltf::Model& model, int index) {
    const auto& accessor = model.accessors.at(static_cast<std::size_t>(index));
    EXPECT_EQ(accessor.componentType, TINYGLTF_COMPONENT_TYPE_FLOAT);
    const auto width =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    std::vector<float> numbers(accessor.count * width);
    const auto data_of = [&](int view) {
        return model.buffers[0].data.data() + model.bufferViews.at(static_cast<std::size_t>(view)).byteOffset;
    };
    if (accessor.bufferView >= 0)
        std::memcpy(numbers.data(), data_of(accessor.bufferView), numbers.size() * sizeof(float));
    if (accessor.sparse.isSparse)
        for (std::size_t i = 0; i < static_cast<std::size_t>(accessor.sparse.count); ++i) {
            std::uint32_t at = 0;
            std::memcpy(&at, data_of(accessor.sparse.indices.bufferView) + 4 * i, 4);
            std::memcpy(numbers.data() + width * at,
                        data_of(accessor.sparse.values.bufferView) + 4 * width * i, 4 * width);
        }
    return numbers;
}

std::vector<std::uint32_t> indices(const tinygltf::Model& model) {
    const auto& accessor =
        model.accessors.at(static_cast<std::size_t>(model.meshes[0].primitives[0].indices));
    const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    std::vector<std::uint32_t> numbers(accessor.count);
    std::memcpy(numbers.data(), model.buffers[0].data.data() + view.byteOffset, 4 * accessor.count);
    return numbers;
}

TEST(ExportGlb, StaticMeshReadsBack) {
    MeshToExport mesh = sample(true);
    mesh.materials[0].base_colour = {0.5, 0.25, 0.125};
    const auto model = loaded(still_bytes(mesh));
    ASSERT_EQ(model.meshes.size(), 1u);
    const auto& primitive = model.meshes[0].primitives.at(0);
    EXPECT_TRUE(primitive.targets.empty());
    EXPECT_TRUE(model.animations.empty());
    EXPECT_EQ(model.materials[0].pbrMetallicRoughness.baseColorFactor,
              (std::vector<double>{0.5, 0.25, 0.125, 1}));

    const auto split = split_at_seams(mesh.positions.size(), mesh.faces, mesh.corner_uvs);
    ASSERT_GT(split.source.size(), mesh.positions.size());
    const auto index = indices(model);
    EXPECT_EQ(index, split.indices);
    EXPECT_EQ(index.size(), 3u * (5 * 2 + 2));

    const auto positions = floats(model, primitive.attributes.at("POSITION"));
    const auto uvs = floats(model, primitive.attributes.at("TEXCOORD_0"));
    const auto depth = floats(model, primitive.attributes.at("_DEPTH__M_"));
    const auto direction = floats(model, primitive.attributes.at("_DIRECTION"));
    ASSERT_EQ(positions.size(), 3 * split.source.size());
    ASSERT_EQ(direction.size(), positions.size());
    for (std::size_t i = 0; i < split.source.size(); ++i) {
        const auto v = static_cast<std::size_t>(split.source[i]);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(positions[3 * i + k],
                      static_cast<float>(mesh.positions[v][static_cast<Eigen::Index>(k)]));
        EXPECT_EQ(uvs[2 * i], static_cast<float>(split.uvs[i].x()));
        EXPECT_EQ(uvs[2 * i + 1], static_cast<float>(1 - split.uvs[i].y()));
        EXPECT_EQ(depth[i], static_cast<float>(v));
        EXPECT_EQ(direction[3 * i + 1], mesh.attributes[0].values[3 * v + 1]);
    }
    const auto& accessor = model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))];
    EXPECT_EQ(accessor.minValues, (std::vector<double>{-0.5, -0.5, -0.625}));
    EXPECT_EQ(accessor.maxValues, (std::vector<double>{0.625, 0.625, 0.5}));
}

TEST(ExportGlb, TheMeshKeepsItsOrientation) {
    const MeshToExport mesh = sample(true);
    const auto model = loaded(still_bytes(mesh));
    const auto positions = floats(model, model.meshes[0].primitives[0].attributes.at("POSITION"));
    const auto index = indices(model);
    double six_volumes = 0;
    for (std::size_t t = 0; t < index.size(); t += 3) {
        std::array<Vec3, 3> p;
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = Vec3(positions[3 * index[t + c]], positions[3 * index[t + c] + 1],
                        positions[3 * index[t + c] + 2]);
        six_volumes += p[0].dot(p[1].cross(p[2]));
    }
    EXPECT_NEAR(six_volumes / 6, geometry::enclosed_volume(mesh.positions, mesh.faces), 1e-6);
    EXPECT_GT(six_volumes, 0);
}

TEST(ExportGlb, AnimationShowsOneFrameAfterTheOther) {
    const MeshToExport mesh = sample(true);
    std::vector<MorphShape> later(2);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Eigen::Vector3f p = mesh.positions[v].cast<float>(), n = mesh.normals[v].cast<float>();
        later[0].positions.emplace_back(0.5f * p);
        later[0].normals.push_back(n);
        later[1].positions.emplace_back(v == 2 ? Eigen::Vector3f(9, 8, 7) : p);  // one vertex moves
        later[1].normals.push_back(v == 2 ? Eigen::Vector3f(0, 0, 1) : n);
    }
    const auto model = loaded(glb_bytes(std::vector{MeshToAnimate{mesh, later}}, 25));
    const auto& primitive = model.meshes[0].primitives[0];
    ASSERT_EQ(primitive.targets.size(), 2u);
    EXPECT_EQ(model.meshes[0].weights, (std::vector<double>{0, 0}));
    EXPECT_EQ(model.meshes[0].extras.Get("targetNames").Get(1).Get<std::string>(), "frame_0002");

    const auto accessor_of = [&](std::size_t target) {
        return model.accessors[static_cast<std::size_t>(primitive.targets[target].at("POSITION"))];
    };
    EXPECT_FALSE(accessor_of(0).sparse.isSparse);
    EXPECT_TRUE(accessor_of(1).sparse.isSparse);
    const auto base = floats(model, primitive.attributes.at("POSITION"));
    const auto source = split_at_seams(mesh.positions.size(), mesh.faces, mesh.corner_uvs).source;
    for (std::size_t t = 0; t < 2; ++t) {
        const auto moved = floats(model, primitive.targets[t].at("POSITION"));
        ASSERT_EQ(moved.size(), base.size());
        for (std::size_t i = 0; i < base.size(); ++i) {
            const auto v = static_cast<std::size_t>(source[i / 3]);
            EXPECT_FLOAT_EQ(base[i] + moved[i], later[t].positions[v][static_cast<Eigen::Index>(i % 3)]);
            EXPECT_LE(accessor_of(t).minValues[i % 3], moved[i]);
            EXPECT_GE(accessor_of(t).maxValues[i % 3], moved[i]);
        }
    }
    ASSERT_EQ(model.animations.size(), 1u);
    const auto& animation = model.animations[0];
    EXPECT_EQ(animation.channels[0].target_path, "weights");
    EXPECT_THAT(floats(model, animation.samplers[0].input), testing::ElementsAre(0.0f, 1 / 25.0f, 2 / 25.0f));
    EXPECT_THAT(floats(model, animation.samplers[0].output), testing::ElementsAre(0, 0, 1, 0, 0, 1));
    const auto& times = model.accessors[static_cast<std::size_t>(animation.samplers[0].input)];
    EXPECT_EQ(times.maxValues.at(0), static_cast<double>(2 / 25.0f));
}

TEST(ExportGlb, AFrameThatIsTheFirstGivesAnAnimationAllTheSame) {
    const MeshToExport mesh = sample(false);
    MorphShape still;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        still.positions.emplace_back(mesh.positions[v].cast<float>());
        still.normals.emplace_back(mesh.normals[v].cast<float>());
    }
    const auto model = loaded(glb_bytes(std::vector{MeshToAnimate{mesh, {still}}}));
    const auto moved = floats(model, model.meshes[0].primitives[0].targets[0].at("POSITION"));
    EXPECT_THAT(moved, testing::Each(0.0f));
    EXPECT_EQ(moved.size(), 24u);
}

TEST(ExportGlb, AttributesWithManyComponentsAreTakenApart) {
    MeshToExport mesh = sample(false);
    mesh.attributes = {{"stretch", 9, std::vector<float>(72, 0.5f)},
                       {"pair", 2, std::vector<float>(16, 2.0f)}};
    const auto model = loaded(still_bytes(mesh));
    const auto& attributes = model.meshes[0].primitives[0].attributes;
    EXPECT_TRUE(attributes.contains("_STRETCH_0") && attributes.contains("_STRETCH_8"));
    EXPECT_EQ(floats(model, attributes.at("_PAIR")).size(), 16u);
}

}  // namespace
}  // namespace windfall::export_
