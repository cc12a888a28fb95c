// Exports of takes with several meshes and materials: broken branches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

#include "export/export_take.h"
#include "export/mesh_to_export.h"
#include "support/synthetic_branch.h"
#include "support/temporary_folder.h"
#include "take/take_writer.h"
#include "take/whole_file.h"

namespace windfall::export_ {
namespace {

using geometry::Vec3;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kUnit_m = 0.05;

/// A stub and a sawn log that stands beside it; the log rises from frame to frame.
class ExportWood : public testing::Test {
  protected:
    void write(int frames) {
        m_meshes = {mesh_of("stub", 1, 0), mesh_of("piece", 0, 3)};
        take::TakeInfo info;
        info.process = "fracture";
        info.name = "branch";
        info.unit_length_m = kUnit_m;
        info.parameters = info.look = nlohmann::json::object();
        auto writer = take::TakeWriter::create(m_folder.path() / "take", info, true);
        for (const auto& mesh : m_meshes) writer.add_mesh(mesh);
        for (int i = 0; i < frames; ++i) {
            auto frame = test::wood_frame(m_meshes, i);
            for (auto& p : frame.meshes[1].positions) p.y() += 0.5F * static_cast<float>(i);
            writer.add_frame(frame);
        }
    }
    std::vector<std::string> exported(ExportOptions options) const {
        options.output = m_folder.path() / "out";
        std::vector<std::string> names;
        for (const auto& path : export_take(take::TakeReader(m_folder.path() / "take"), options, {}))
            names.push_back(path.filename().string());
        return names;
    }
    std::string text(const std::string& name) const {
        return take::read_whole_text(m_folder.path() / "out" / name, 1U << 26U);
    }
    /// Outward normal of a face of a mesh of the take, at rest.
    Vec3 face_normal(std::size_t mesh, std::size_t f) const {
        const auto& rest = m_meshes[mesh].rest;
        const auto at = [&](std::size_t k) {
            return rest.positions[static_cast<std::size_t>(rest.faces[f][k])];
        };
        const std::size_t last = geometry::corner_count(rest.faces[f]) == 3 ? 2 : 3;
        return (at(2) - at(0)).cross(at(last) - at(1)).normalized();
    }

    std::vector<take::TakeMesh> m_meshes;
    TemporaryFolder m_folder;

  private:
    static take::TakeMesh mesh_of(const std::string& name, float step, double x) {
        const auto branch = test::synthetic_branch({.step = step});
        std::vector<fracture::Vector3f> colours;
        for (std::size_t v = 0; v < branch.vertex_count(); ++v)
            colours.emplace_back(0.2F + 0.1F * static_cast<float>(branch.tissue[v]), 0.3F,
                                 0.001F * static_cast<float>(v % 100));
        auto mesh = test::wood_take_mesh(name, branch, colours);
        for (auto& p : mesh.rest.positions) p.x() += x;
        return mesh;
    }
};

// ---- names of files ----

TEST_F(ExportWood, AllMeshesAreInOneFile) {
    write(1);
    EXPECT_THAT(exported({.format = ExportFormat::Obj}), ElementsAre("branch.mtl", "branch_0000.obj"));
    EXPECT_THAT(exported({.format = ExportFormat::Ply}), ElementsAre("branch_0000.ply"));
    EXPECT_THAT(exported({.format = ExportFormat::Glb}), ElementsAre("branch.glb"));
}

TEST_F(ExportWood, ASequenceHasOneFileOfMaterials) {
    write(2);
    EXPECT_THAT(exported({.format = ExportFormat::Obj}),
                ElementsAre("branch.mtl", "branch_0000.obj", "branch_0001.obj"));
    EXPECT_THROW(exported({.format = ExportFormat::Obj, .frame = 0}), InputError);  // the .mtl is there
}

// ---- OBJ ----

TEST_F(ExportWood, ObjReadsBackWithObjectsMaterialsAndNormals) {
    write(1);
    exported({.format = ExportFormat::Obj});
    std::istringstream lines(text("branch_0000.obj"));
    std::vector<Vec3> positions, normals;
    std::size_t uvs = 0, mesh = 0, hard_faces = 0;
    std::string material;
    std::vector<std::string> objects;
    std::map<std::string, std::size_t> faces_of;
    std::size_t first_vertex = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string tag;
        words >> tag;
        if (tag == "o") {
            mesh = objects.size();
            first_vertex = positions.size();
            objects.emplace_back();
            words >> objects.back();
        } else if (tag == "v" || tag == "vn") {
            Vec3 p;
            words >> p.x() >> p.y() >> p.z();
            (tag == "v" ? positions : normals).push_back(p);
        } else if (tag == "vt") {
            ++uvs;
        } else if (tag == "usemtl") {
            words >> material;
        } else if (tag == "s") {
            EXPECT_EQ(line, material == "bark" || material == "end_grain" ? "s 1" : "s off");
        } else if (tag == "f") {
            ++faces_of[objects[mesh] + " " + material];
            std::vector<Vec3> corners;
            for (std::string word; words >> word;) {
                std::size_t v = 0, t = 0, n = 0;
                ASSERT_EQ(std::sscanf(word.c_str(), "%zu/%zu/%zu", &v, &t, &n), 3);
                ASSERT_TRUE(v > first_vertex && v <= positions.size() && t <= uvs && n <= normals.size());
                corners.push_back(positions[v - 1]);
                const Vec3 in_take = positions[v - 1] / kUnit_m;
                EXPECT_LT((in_take - m_meshes[mesh].rest.positions[v - 1 - first_vertex]).norm(), 1e-5);
                if (material == "fibres" && corners.size() == 4) {
                    const Vec3 own = (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
                    EXPECT_LT((normals[n - 1] - own).norm(), 1e-4);
                    ++hard_faces;
                }
                if (material == "bark" && mesh == 1) {
                    EXPECT_NEAR(normals[n - 1].y(), 0, 1e-6);  // a log's side
                }
            }
        }
    }
    EXPECT_THAT(objects, ElementsAre("stub", "piece"));
    EXPECT_GT(hard_faces, 20U);
    EXPECT_EQ(faces_of["stub bark"], 24U * 6);
    EXPECT_EQ(faces_of["piece end_grain"], 2U * 7 * 24);
    EXPECT_EQ(faces_of.count("piece fibres"), 0U);
}

TEST_F(ExportWood, MtlHasTheMeanColourOfEachMaterialInUse) {
    write(1);
    exported({.format = ExportFormat::Obj});
    EXPECT_THAT(text("branch_0000.obj"), HasSubstr("mtllib branch.mtl\n"));
    const std::string mtl = text("branch.mtl");
    EXPECT_THAT(mtl, testing::AllOf(HasSubstr("newmtl bark\nKd "), HasSubstr("newmtl fibres\nKd "),
                                    HasSubstr("newmtl end_grain\nKd ")));
    EXPECT_THAT(mtl, testing::Not(HasSubstr("newmtl crack")));
    double red = 0, green = 0;
    ASSERT_EQ(std::sscanf(mtl.c_str() + mtl.find("newmtl bark"), "newmtl bark\nKd %lf %lf", &red, &green), 2);
    EXPECT_NEAR(red, 0.6, 0.01);  // tissue 4
    EXPECT_NEAR(green, 0.3, 1e-4);
}

// ---- PLY ----

TEST_F(ExportWood, PlyHasColoursAttributesAndTheMaterialOfEachFace) {
    write(1);
    exported({.format = ExportFormat::Ply});
    const std::string file = text("branch_0000.ply");
    const std::string head = file.substr(0, file.find("end_header\n") + 11);
    EXPECT_THAT(head,
                testing::AllOf(HasSubstr("comment material 0 bark\n"), HasSubstr("comment mesh 1 piece\n"),
                               HasSubstr("property uchar blue\nproperty float tissue\nproperty float "
                                         "height\nproperty float thorn\nelement face"),
                               HasSubstr("property int material\nproperty int mesh\n")));
    const char* at = file.data() + head.size();
    const auto take_number = [&](auto& number) {
        std::memcpy(&number, at, sizeof number);
        at += sizeof number;
    };
    for (const auto& mesh : m_meshes)
        for (std::size_t v = 0; v < mesh.rest.positions.size(); ++v) {
            std::array<float, 6> place{};
            std::array<std::uint8_t, 3> colour{};
            std::array<float, 3> attributes{};
            take_number(place);
            take_number(colour);
            take_number(attributes);
            ASSERT_NEAR(place[0], kUnit_m * mesh.rest.positions[v].x(), 1e-6);
            ASSERT_NEAR(linear_from_srgb(colour[0] / 255.0), mesh.find("colour")->values[3 * v], 0.006);
            ASSERT_EQ(attributes[0], mesh.find("tissue")->values[v]);
            ASSERT_EQ(attributes[1], mesh.find("height")->values[v]);
        }
    std::int32_t first = 0;
    for (std::size_t m = 0; m < m_meshes.size(); ++m) {
        for (std::size_t f = 0; f < m_meshes[m].rest.faces.size(); ++f) {
            std::uint8_t corners = 0, numbers = 0;
            take_number(corners);
            ASSERT_EQ(corners, geometry::corner_count(m_meshes[m].rest.faces[f]));
            for (std::size_t c = 0; c < corners; ++c) {
                std::int32_t v = 0;
                take_number(v);
                ASSERT_EQ(v, first + m_meshes[m].rest.faces[f][c]);
            }
            take_number(numbers);
            at += numbers * sizeof(float);
            std::int32_t material = -1, mesh = -1;
            take_number(material);
            take_number(mesh);
            ASSERT_EQ(material, m_meshes[m].face_materials[f]);
            ASSERT_EQ(mesh, static_cast<std::int32_t>(m));
        }
        first += static_cast<std::int32_t>(m_meshes[m].rest.positions.size());
    }
    EXPECT_EQ(at, file.data() + file.size());
}

// ---- GLB ----

tinygltf::Model load(const std::string& file) {
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &error, &warning,
                                                          reinterpret_cast<const unsigned char*>(file.data()),
                                                          static_cast<unsigned>(file.size())))
        << error;
    return model;
}

std::vector<float> numbers_of(const tinygltf::Model& model, int index) {
    const auto& accessor = model.accessors.at(static_cast<std::size_t>(index));
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    const auto width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    std::vector<float> numbers(accessor.count * static_cast<std::size_t>(width));
    std::memcpy(numbers.data(), model.buffers[0].data.data() + view.byteOffset,
                numbers.size() * sizeof(float));
    return numbers;
}

const std::string& material_name(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    return model.materials.at(static_cast<std::size_t>(primitive.material)).name;
}

TEST_F(ExportWood, GlbHasANodeForEachMeshAndAPrimitiveForEachMaterial) {
    write(1);
    exported({.format = ExportFormat::Glb});
    const auto model = load(text("branch.glb"));
    ASSERT_EQ(model.nodes.size(), 2U);
    EXPECT_EQ(model.nodes[0].name, "stub");
    EXPECT_EQ(model.nodes[1].name, "piece");
    EXPECT_THAT(model.scenes[0].nodes, ElementsAre(0, 1));
    std::vector<std::string> names;
    for (const auto& primitive : model.meshes[0].primitives) names.push_back(material_name(model, primitive));
    EXPECT_THAT(names, ElementsAre("bark", "end_grain", "fibres", "inner_bark"));
    EXPECT_EQ(model.meshes[1].primitives.size(), 3U);
    EXPECT_TRUE(model.animations.empty());
    EXPECT_EQ(model.materials.size(), 4U);  // each name once, and only those in use
}

TEST_F(ExportWood, GlbColoursTimesBaseColourAreTheTakes) {
    write(1);
    exported({.format = ExportFormat::Glb});
    const auto model = load(text("branch.glb"));
    std::set<std::array<int, 3>> wanted, found;
    const auto rounded = [](double r, double g, double b) {
        return std::array{static_cast<int>(std::lround(1e4 * r)), static_cast<int>(std::lround(1e4 * g)),
                          static_cast<int>(std::lround(1e4 * b))};
    };
    for (const auto& mesh : m_meshes)
        for (std::size_t v = 0; v < mesh.rest.positions.size(); ++v) {
            const float* c = mesh.find("colour")->values.data() + 3 * v;
            wanted.insert(rounded(c[0], c[1], c[2]));
        }
    for (const auto& mesh : model.meshes)
        for (const auto& primitive : mesh.primitives) {
            for (const char* name : {"_TISSUE", "_HEIGHT", "_THORN", "TEXCOORD_0", "NORMAL"})
                EXPECT_TRUE(primitive.attributes.contains(name)) << name;
            EXPECT_FALSE(primitive.attributes.contains("_COLOUR"));
            const auto& base = model.materials[static_cast<std::size_t>(primitive.material)]
                                   .pbrMetallicRoughness.baseColorFactor;
            const auto colours = numbers_of(model, primitive.attributes.at("COLOR_0"));
            for (std::size_t i = 0; i < colours.size(); i += 3) {
                ASSERT_LE(std::max({colours[i], colours[i + 1], colours[i + 2]}), 1);
                found.insert(
                    rounded(base[0] * colours[i], base[1] * colours[i + 1], base[2] * colours[i + 2]));
            }
        }
    EXPECT_EQ(found, wanted);
}

TEST_F(ExportWood, GlbFibresHaveTheNormalsOfTheirFacesAndBarkIsSmooth) {
    write(1);
    exported({.format = ExportFormat::Glb});
    const auto model = load(text("branch.glb"));
    const auto vectors = [&](const tinygltf::Primitive& primitive, const char* name) {
        const auto numbers = numbers_of(model, primitive.attributes.at(name));
        std::vector<Vec3> result;
        for (std::size_t i = 0; i < numbers.size(); i += 3)
            result.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
        return result;
    };
    const auto& bark = model.meshes[0].primitives[0];
    EXPECT_EQ(vectors(bark, "POSITION").size(), 24U * 7);
    const auto& fibres = model.meshes[0].primitives[2];
    const auto normals = vectors(fibres, "NORMAL");
    std::size_t corner = 0, faces = 0;
    for (std::size_t f = 0; f < m_meshes[0].rest.faces.size(); ++f) {
        if (m_meshes[0].materials[m_meshes[0].face_materials[f]].name != "fibres") continue;
        for (int c = 0; c < geometry::corner_count(m_meshes[0].rest.faces[f]); ++c)
            ASSERT_LT((normals.at(corner++) - face_normal(0, f)).norm(), 1e-5);
        ++faces;
    }
    EXPECT_EQ(corner, normals.size());
    EXPECT_EQ(faces, 7U * 24);
}

TEST_F(ExportWood, GlbAnimationMovesAllMeshesAndLeavesFlatFacesToTheStandard) {
    write(3);
    exported({.format = ExportFormat::Glb});
    const auto model = load(text("branch.glb"));
    ASSERT_EQ(model.animations.size(), 1U);
    ASSERT_EQ(model.animations[0].channels.size(), 2U);
    EXPECT_EQ(model.animations[0].channels[1].target_node, 1);
    for (const auto& mesh : model.meshes)
        for (const auto& primitive : mesh.primitives) {
            const std::string& name = material_name(model, primitive);
            const bool smooth = name == "bark" || name == "end_grain";
            EXPECT_EQ(primitive.attributes.contains("NORMAL"), smooth) << name;
            ASSERT_EQ(primitive.targets.size(), 2U);
            EXPECT_EQ(primitive.targets[1].contains("NORMAL"), smooth) << name;
            EXPECT_TRUE(primitive.attributes.contains("_TISSUE"));  // constant, so it holds in every frame
        }
    const auto& moved =
        model.accessors[static_cast<std::size_t>(model.meshes[1].primitives[0].targets[1].at("POSITION"))];
    EXPECT_NEAR(moved.maxValues[1], kUnit_m, 1e-6);
    EXPECT_NEAR(moved.minValues[1], kUnit_m, 1e-6);
    const auto& still =
        model.accessors[static_cast<std::size_t>(model.meshes[0].primitives[0].targets[1].at("POSITION"))];
    EXPECT_TRUE(still.sparse.isSparse);
    EXPECT_EQ(still.maxValues[1], 0);
}

}  // namespace
}  // namespace windfall::export_
