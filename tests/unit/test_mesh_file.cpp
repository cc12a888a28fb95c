#include "meshfile/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "meshfile/triangulate.h"
#include "support/mesh_checks.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/test_trees.h"

namespace windfall::meshfile {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class MeshFile : public ::testing::Test {
  protected:
    fs::path file(const std::string& name, const std::string& text) const {
        std::ofstream(m_folder.path() / name, std::ios::binary) << text;
        return m_folder.path() / name;
    }
    fs::path path(const std::string& name) const { return m_folder.path() / name; }
    std::string text(const std::string& name) const {
        std::ifstream stream(m_folder.path() / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    void write(const std::vector<NamedMesh>& meshes, const std::string& name) const {
        for (const OutputFile& output : encode(meshes, m_folder.path() / name)) {
            std::ofstream stream(output.path, std::ios::binary);
            for (const std::byte b : output.bytes) stream.put(static_cast<char>(b));
        }
    }
    std::string error_of(const std::string& name, const std::string& content) const {
        const fs::path where = file(name, content);
        return message_of([&] { read(where); });
    }
    TemporaryFolder m_folder;
};

/// Everything but names of attributes' owners: places, faces, values.
void expect_same(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.corners, b.corners);
    EXPECT_EQ(a.face_starts, b.face_starts);
    ASSERT_EQ(a.attributes.size(), b.attributes.size());
    for (std::size_t f = 0; f < a.face_count(); ++f)
        EXPECT_EQ(test::content_of_face(a, f), test::content_of_face(b, f)) << f;
}

constexpr const char* kObj =
    "# by hand\r\nmtllib wood.mtl\no trunk\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.1 0.2000000001 3\n"
    "vt 0 0\nvt 1 0\nvt 0.123456 1\nvn 0 0 1\ng side\nusemtl dark bark\ns 1\n"
    "f 1/1/1 2/2/1 3/3/1 4/1/1\no top\nusemtl leaf\ns off\nf -5 -4 \\\n 5\nl 1 2\n";

TEST_F(MeshFile, ObjIsReadAsItStands) {
    file("wood.mtl",
         "newmtl dark bark\nKd 0.1 0.1 0.1\nmap_Kd textures/my bark.png\nmap_Bump -bm 0.5 b.png\n");
    const Mesh mesh = read(file("a.obj", kObj));
    EXPECT_EQ(mesh.positions.size(), 5U);
    EXPECT_EQ(mesh.positions[4], Vec3(0.1, 0.2000000001, 3));
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 3, 0, 1, 4));
    EXPECT_THAT(mesh.face_starts, ElementsAre(0, 4, 7));
    ASSERT_EQ(mesh.materials.size(), 2U);
    EXPECT_EQ(mesh.materials[0].name, "dark bark");
    EXPECT_EQ(mesh.faces[1].material, 1);
    EXPECT_EQ(mesh.faces[0].smoothing, 1U);
    EXPECT_EQ(mesh.groups[0].object, "trunk");
    EXPECT_EQ(mesh.groups[0].name, "side");
    EXPECT_EQ(mesh.groups[1].object, "top");
    EXPECT_THAT(mesh.attributes[0].corner_entries, ElementsAre(0, 1, 2, 0, -1, -1, -1));
    EXPECT_THAT(mesh.warnings, ElementsAre(HasSubstr("\"l\"")));
}

TEST_F(MeshFile, ObjComesBackWithMaterialsAndTexturesFound) {
    file("wood.mtl",
         "newmtl dark bark\nKd 0.1 0.1 0.1\nmap_Kd textures/my bark.png\nmap_Bump -bm 0.5 b.png\n");
    const Mesh mesh = read(file("a.obj", kObj));
    write({{"tree", &mesh}}, "b.obj");
    expect_same(mesh, read(path("b.obj")));
    EXPECT_THAT(text("b.mtl"), HasSubstr("map_Kd textures/my bark.png\n"));
    fs::create_directory(path("out"));
    write({{"tree", &mesh}}, "out/c.obj");
    expect_same(mesh, read(path("out/c.obj")));
    EXPECT_THAT(text("out/c.mtl"), HasSubstr("map_Kd ../textures/my bark.png\n"));
    EXPECT_THAT(text("out/c.mtl"), HasSubstr("map_Bump -bm 0.5 ../b.png\n"));
}

TEST_F(MeshFile, SecondMeshOfAnObjIsAnObjectOfItsOwn) {
    const Mesh mesh = read(file("a.obj", kObj));
    write({{"tree", &mesh}, {"fallen_piece", &mesh, Vec3(0, 0, 10)}}, "two.obj");
    const Mesh two = read(path("two.obj"));
    EXPECT_EQ(two.positions.size(), 10U);
    EXPECT_EQ(two.positions[5], Vec3(0, 0, 10));
    EXPECT_EQ(two.corners[7], 5);
    EXPECT_EQ(two.groups.back().object, "fallen_piece");
    EXPECT_EQ(two.attributes[0].corner_entries[7], 3);
}

TEST_F(MeshFile, PlyKeepsAllPropertiesInTheirTypes) {
    const std::string header =
        "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty double x\nproperty double y\n"
        "property double z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nproperty int age\nelement face 2\n"
        "property list uchar uint vertex_index\nproperty list uchar float texcoord\nproperty short kind\n"
        "element edge 1\nproperty int a\nend_header\n";
    const std::string body =
        "0 0 0 0 0 1 10 20 30 -7\n1 0 0.1 0 0 1 10 20 255 8\n1 1 0 0 0 1 0 0 0 9\n0 1 0 0 0 1 1 2 3 100000\n"
        "4 0 1 2 3 8 0 0 1 0 1 1 0 1 -5\n3 0 1 2 0 6\n7\n";
    const Mesh mesh = read(file("a.ply", header + body));
    EXPECT_EQ(mesh.positions[1].z(), 0.1);
    ASSERT_EQ(mesh.attributes.size(), 4U);
    EXPECT_EQ(mesh.attributes[0].role, Role::Normal);
    EXPECT_EQ(mesh.attributes[1].role, Role::Colour);
    EXPECT_EQ(mesh.attributes[2].name, "age");
    EXPECT_EQ(mesh.attributes[3].role, Role::TextureCoordinate);
    EXPECT_EQ(mesh.attributes[3].corner_entries[4], -1);
    EXPECT_THAT(mesh.face_columns[0].values, ElementsAre(-5, 6));
    EXPECT_THAT(mesh.warnings, ElementsAre(HasSubstr("edge")));

    write({{"tree", &mesh}}, "b.ply");
    EXPECT_THAT(text("b.ply"), HasSubstr("property double x"));
    EXPECT_THAT(text("b.ply"), HasSubstr("property uchar red"));
    EXPECT_THAT(text("b.ply"), HasSubstr("property short kind"));
    EXPECT_THAT(text("b.ply"), HasSubstr("1 0 0.1 0 0 1 10 20 255 8\n"));
    expect_same(mesh, read(path("b.ply")));

    Mesh homeless = mesh;  // of no file: then numbers are floats, in binary
    homeless.source = nullptr;
    write({{"tree", &homeless}}, "c.ply");
    EXPECT_THAT(text("c.ply"), HasSubstr("binary_little_endian"));
    EXPECT_EQ(read(path("c.ply")).corners, mesh.corners);
    EXPECT_EQ(read(path("c.ply")).positions[1].z(), static_cast<double>(0.1F));
}

TEST_F(MeshFile, PlyOfEitherByteOrder) {
    std::string header =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    const auto number = [](auto value, bool big) {
        std::string bytes(sizeof value, '\0');
        std::memcpy(bytes.data(), &value, sizeof value);
        if (big) std::reverse(bytes.begin(), bytes.end());
        return bytes;
    };
    for (const bool big : {false, true}) {
        std::string content =
            std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + header;
        for (const float x : {0.F, 0.F, 0.F, 1.5F, 0.F, 0.F, 0.F, -2.F, 0.F}) content += number(x, big);
        content += '\3';
        for (const std::int32_t v : {0, 1, 2}) content += number(v, big);
        const Mesh mesh = read(file("a.ply", content));
        EXPECT_EQ(mesh.positions[1].x(), 1.5);
        EXPECT_EQ(mesh.positions[2].y(), -2);
        EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2));
        write({{"tree", &mesh}}, "b.ply");
        EXPECT_EQ(text("b.ply"), content);
        EXPECT_THAT(error_of("cut.ply", content.substr(0, content.size() - 3)), HasSubstr("ends too early"));
    }
}

TEST_F(MeshFile, PlyTellsNewPartsInAPropertyAndWritesAFileEach) {
    Mesh mesh = read(
        file("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 "
             "2\n"));
    mesh.materials.push_back({"fibres"});
    write({{"tree", &mesh}, {"fallen_piece", &mesh, Vec3(1, 0, 0)}}, "out.ply");
    EXPECT_THAT(text("out.ply"), HasSubstr("comment part 1 fibres"));
    EXPECT_THAT(text("out.ply"), HasSubstr("property uchar part"));
    EXPECT_EQ(read(path("out_fallen_piece.ply")).positions[0], Vec3(1, 0, 0));
}

class GltfFile : public MeshFile {
  protected:
    /// A tube as glTF with its JSON changed by `change`.
    template <class Change>
    Mesh changed(const Change& change) const {
        test::Tube tube;
        tube.centre = [](double t) { return Vec3(0, t, 0); };
        tube.half_axes = [](double) { return geometry::Vec2(0.1, 0.1); };
        const Mesh mesh = test::as_mesh(test::tube_tree(tube), true);
        write({{"tree", &mesh}}, "tube.gltf");
        nlohmann::json json = nlohmann::json::parse(text("tube.gltf"));
        change(json);
        return read(file("changed.gltf", json.dump()));
    }
};

TEST_F(GltfFile, ComesBackInBothForms) {
    const Mesh mesh = changed([](nlohmann::json&) {});
    for (const char* name : {"b.gltf", "b.glb"}) {
        write({{"tree", &mesh}}, name);
        const Mesh again = read(path(name));
        expect_same(mesh, again);
        EXPECT_EQ(again.materials[0].name, "bark");
    }
}

TEST_F(GltfFile, NodesPlaceAndMirrorTheirMeshes) {
    const Mesh mesh = changed([](nlohmann::json& json) {
        json["nodes"][0]["scale"] = {-2, 2, 2};
        json["nodes"].push_back({{"name", "root"}, {"translation", {5, 0, 0}}, {"children", {0}}});
        json["scenes"][0]["nodes"] = {1};
    });
    const std::vector<Vec3> world = mesh.world_positions();
    EXPECT_NEAR(world[0].x(), 5 - 2 * mesh.positions[0].x(), 1e-12);
    EXPECT_TRUE(mesh.groups[0].mirrored());
    EXPECT_GT(test::volume(mesh), 0);
    EXPECT_EQ(test::bad_edges(mesh), 0U);
    write({{"tree", &mesh}, {"fallen_piece", &mesh, Vec3(0, 0, 3)}}, "b.glb");
    const Mesh two = read(path("b.glb"));
    ASSERT_EQ(two.positions.size(), 2 * mesh.positions.size());
    EXPECT_EQ(two.positions[0], mesh.positions[0]);
    EXPECT_EQ(two.world_positions()[0], world[0]);
    EXPECT_NEAR((two.world_positions()[mesh.positions.size()] - world[0] - Vec3(0, 0, 3)).norm(), 0, 1e-12);
}

TEST_F(GltfFile, TexturesExtensionsAndSharedMeshesStay) {
    const Mesh mesh = changed([](nlohmann::json& json) {
        json["images"] = {{{"uri", "textures/bark%20dark.png"}},
                          {{"uri", "data:image/png;base64,iVBORw0KGgo="}, {"name", "inside"}}};
        json["textures"] = {{{"source", 0}}, {{"source", 1}}};
        json["extensionsUsed"] = {"KHR_materials_clearcoat"};
        json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 1}, {"texCoord", 0}};
        json["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = 0.25;
        json["nodes"].push_back({{"name", "twin"}, {"mesh", 0}, {"translation", {3, 0, 0}}});
        json["scenes"][0]["nodes"].push_back(1);
    });
    EXPECT_EQ(mesh.groups.size(), 4U);
    fs::create_directory(path("out"));
    write({{"tree", &mesh}}, "out/b.gltf");
    const auto json = nlohmann::json::parse(text("out/b.gltf"));
    EXPECT_EQ(json["images"][0]["uri"], "../textures/bark%20dark.png");
    EXPECT_EQ(json["images"][1]["name"], "inside");
    const auto& view = json["bufferViews"][json["images"][1]["bufferView"].get<std::size_t>()];
    EXPECT_EQ(view["byteLength"], 8);
    EXPECT_EQ(json["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"], 0.25);
    EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 1);
    EXPECT_EQ(json["meshes"].size(), 1U);  // both nodes show one
    EXPECT_EQ(json["nodes"][1]["mesh"], json["nodes"][0]["mesh"]);
}

TEST_F(GltfFile, WhatCannotBeKeptIsRefusedWithTheRemedy) {
    const auto error = [&](const auto& change) { return message_of([&] { changed(change); }); };
    EXPECT_THAT(error([](nlohmann::json& j) { j["extensionsUsed"] = {"KHR_draco_mesh_compression"}; }),
                HasSubstr("Draco"));
    EXPECT_THAT(error([](nlohmann::json& j) {
                    j["skins"] = {{{"joints", {0}}}};
                    j["nodes"][0]["skin"] = 0;
                }),
                HasSubstr("armature"));
    EXPECT_THAT(error([](nlohmann::json& j) {
                    j["nodes"][0]["scale"] = {1, 0, 1};
                }),
                HasSubstr("scaled to nothing"));
    EXPECT_THAT(error([](nlohmann::json& j) { j["accessors"][0]["count"] = 100000; }),
                HasSubstr("beyond its buffer"));
    EXPECT_THAT(error([](nlohmann::json& j) { j["nodes"][0]["children"] = {0}; }),
                HasSubstr("do not form a tree"));
    EXPECT_THAT(error([](nlohmann::json& j) { j["nodes"][0].erase("mesh"); }), HasSubstr("no faces"));
}

/// The first primitive's accessor of this attribute.
nlohmann::json& accessor_of(nlohmann::json& json, const std::string& attribute) {
    return json["accessors"][json["meshes"][0]["primitives"][0]["attributes"][attribute].get<std::size_t>()];
}

TEST_F(GltfFile, IndicesAreWholeNumbersOfVertices) {
    const auto error = [&](const std::vector<float>& numbers, int type) {
        return message_of([&] {
            changed([&](nlohmann::json& j) {
                // Their bytes stand in the positions; only the type says what they are.
                const std::size_t positions = j["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
                nlohmann::json accessor = j["accessors"][positions];
                std::string uri = "data:application/octet-stream;base64,";
                std::vector<unsigned char> bytes(4 * numbers.size());
                std::memcpy(bytes.data(), numbers.data(), bytes.size());
                static constexpr const char* kDigits =
                    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
                for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
                    const unsigned three = bytes[i] << 16U | bytes[i + 1] << 8U | bytes[i + 2];
                    for (const unsigned shift : {18U, 12U, 6U, 0U}) uri += kDigits[three >> shift & 63U];
                }
                j["buffers"].push_back({{"uri", uri}, {"byteLength", bytes.size()}});
                j["bufferViews"].push_back(
                    {{"buffer", j["buffers"].size() - 1}, {"byteLength", bytes.size()}});
                j["accessors"].push_back({{"bufferView", j["bufferViews"].size() - 1},
                                          {"componentType", type},
                                          {"count", numbers.size()},
                                          {"type", "SCALAR"}});
                j["meshes"][0]["primitives"][0]["indices"] = j["accessors"].size() - 1;
            });
        });
    };
    EXPECT_THAT(error({0, 1, 2}, 5126), HasSubstr("whole numbers"));
    EXPECT_THAT(error({-1e9F, std::numeric_limits<float>::quiet_NaN(), -2}, 5126),
                HasSubstr("whole numbers"));
    EXPECT_THAT(error({-1, -1, -1}, 5122), HasSubstr("whole numbers"));
    EXPECT_THAT(error({-1, -1, -1}, 5125), HasSubstr("points to no vertex"));
    EXPECT_EQ(error({0, 0, 0}, 5125), "no error");
}

TEST_F(GltfFile, AttributesHaveTheWidthOfTheirKind) {
    const auto error = [&](const char* attribute, const char* type) {
        return message_of(
            [&] { changed([&](nlohmann::json& j) { accessor_of(j, attribute)["type"] = type; }); });
    };
    EXPECT_THAT(error("POSITION", "SCALAR"), HasSubstr("POSITION has 1 number a vertex instead of 3"));
    EXPECT_THAT(error("NORMAL", "SCALAR"), HasSubstr("NORMAL has 1 number"));
    EXPECT_THAT(error("TEXCOORD_0", "SCALAR"), HasSubstr("TEXCOORD_0 has 1 number"));
    EXPECT_THAT(message_of([&] {
                    changed([&](nlohmann::json& j) {
                        auto& attributes = j["meshes"][0]["primitives"][0]["attributes"];
                        attributes["TANGENT"] = attributes["POSITION"];
                    });
                }),
                HasSubstr("TANGENT has 3 numbers a vertex instead of 4"));
}

TEST_F(GltfFile, NoMemoryOnTheWordOfACount) {
    EXPECT_THAT(message_of([&] {
                    changed([&](nlohmann::json& j) {
                        accessor_of(j, "POSITION").erase("bufferView");
                        accessor_of(j, "POSITION")["count"] = std::int64_t{1} << 31U;
                    });
                }),
                HasSubstr("2147483648 elements is too long"));
}

TEST_F(MeshFile, PlyFamiliesAreOfSingleNumbers) {
    const std::string body =
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 1 2 1 9 3\n1 0 0 1 2 1 9 3\n0 1 0 1 2 1 9 3\n3 0 1 2\n";
    const Mesh mesh =
        read(file("a.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                  "property float z\nproperty float nx\nproperty float ny\nproperty list uchar float nz\n"
                  "property float last\n" +
                      body));
    ASSERT_EQ(mesh.attributes.size(), 3U);
    EXPECT_EQ(mesh.attributes[0].components, 1);
    EXPECT_THAT(mesh.attributes[2].values, ElementsAre(3, 3, 3));
    EXPECT_THAT(mesh.warnings, ElementsAre(HasSubstr("\"nz\"")));
    EXPECT_THAT(error_of("b.ply",
                         "ply\nformat ascii 1.0\nelement vertex 3\nproperty list uchar float x\n"
                         "property float y\nproperty float z\n" +
                             body),
                HasSubstr("no property x"));
}

TEST_F(MeshFile, PlyHasVerticesAndFacesOnce) {
    const std::string vertices =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float age\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string three = "0 0 0 5\n1 0 0 6\n0 1 0 7\n", one = "3 0 1 2\n";
    const auto error = [&](const std::string& elements, const std::string& body) {
        return error_of("a.ply", "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body);
    };
    EXPECT_EQ(error(vertices + faces, three + one), "no error");
    EXPECT_THAT(error(vertices + vertices + faces, three + three + one), HasSubstr("second element"));
    EXPECT_THAT(error(vertices + faces + faces, three + one + one), HasSubstr("second element"));
}

TEST_F(MeshFile, CheckComparesAttributesWithTheMesh) {
    const Mesh good = read(file("a.obj", kObj));
    const auto complaint = [&](const auto& change) {
        Mesh mesh = good;
        change(mesh);
        return message_of([&] { check(mesh, "tree"); });
    };
    EXPECT_EQ(complaint([](Mesh&) {}), "no error");
    EXPECT_THAT(complaint([](Mesh& m) {
                    m.attributes.push_back({"age", Role::Other, 2, std::vector<double>(8), false, {}});
                }),
                HasSubstr("4 entries for 5 vertices"));
    EXPECT_THAT(complaint([](Mesh& m) { m.attributes[0].corner_entries.pop_back(); }),
                HasSubstr("6 entries for 7 corners"));
    EXPECT_THAT(complaint([](Mesh& m) { m.attributes[0].corner_entries[2] = 3; }), HasSubstr("entry 3 of 3"));
    EXPECT_THAT(complaint([](Mesh& m) {
                    m.face_columns.push_back({"kind", {1}});
                }),
                HasSubstr("1 entries for 2 faces"));
}

TEST_F(MeshFile, MaterialsOutsideOfTheFolderStayAReference) {
    fs::create_directory(path("in"));
    fs::create_directory(path("in/deep"));
    file("secret.mtl", "newmtl secret\n");
    file("in/deep/wood.mtl", "newmtl dark bark\n");
    const std::string outside = path("secret.mtl").string();
    const std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl secret\nf 1 2 3\n";
    for (const std::string& library : {std::string("../secret.mtl"), outside}) {
        const Mesh mesh = read(file("in/a.obj", "mtllib deep/wood.mtl\nmtllib " + library + "\n" + faces));
        EXPECT_THAT(mesh.warnings, ElementsAre(HasSubstr("outside of the tree's folder")));
        write({{"tree", &mesh}}, "in/deep/b.obj");
        EXPECT_THAT(text("in/deep/b.mtl"), AllOf(HasSubstr("dark bark"), Not(HasSubstr("secret"))));
        EXPECT_THAT(text("in/deep/b.obj"),
                    HasSubstr("mtllib " + (library == outside ? outside : "../../secret.mtl") + "\n"));
    }
    fs::create_symlink("../secret.mtl", path("in/link.mtl"));
    EXPECT_THAT(read(file("in/a.obj", "mtllib link.mtl\n" + faces)).warnings,
                ElementsAre(HasSubstr("outside of the tree's folder")));
}

TEST_F(MeshFile, BadFilesAreToldWithNameLineAndRemedy) {
    EXPECT_THAT(message_of([&] { read(path("missing.obj")); }), HasSubstr("no such file"));
    EXPECT_THAT(error_of("a.fbx", "x"), HasSubstr(".obj, .ply, .gltf or .glb"));
    EXPECT_THAT(error_of("empty.obj", ""), HasSubstr("empty"));
    EXPECT_THAT(error_of("points.obj", "v 0 0 0\n"), HasSubstr("no faces"));
    EXPECT_THAT(error_of("nan.obj", "v 0 0 0\nv 0 nan 0\n"),
                HasSubstr("nan.obj:2: \"nan\" is not a finite number"));
    EXPECT_THAT(error_of("word.obj", "v 0 0 x\n"), HasSubstr("word.obj:1: \"x\" is not a number"));
    EXPECT_THAT(error_of("far.obj", "v 0 0 0\nf 1 2 3\n"),
                HasSubstr("far.obj:2: the face points to vertex 2"));
    EXPECT_THAT(error_of("two.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), HasSubstr("three corners"));
    EXPECT_THAT(error_of("a.ply", "plx\n"), HasSubstr("no PLY file"));
    EXPECT_THAT(
        error_of("b.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
                 "property float z\nend_header\n"),
        HasSubstr("cannot be 4000000000"));
    EXPECT_THAT(
        error_of("c.ply",
                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n3 0 1 2\n"),
        HasSubstr("c.ply:11: a face points to vertex 1"));
    EXPECT_THAT(
        error_of("d.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n0 0 inf\n0 0 1\n3 0 1 2\n"),
        HasSubstr("vertex 1 is not a finite number"));
    EXPECT_THAT(error_of("a.glb", "glTF but not really"), HasSubstr("no glTF file"));
    EXPECT_THAT(error_of("a.gltf", "{\"asset\": {\"version\": \"2.0\"}"), HasSubstr("no glTF file"));
    const Mesh mesh = read(file("a.obj", kObj));
    EXPECT_THAT(message_of([&] {
                    encode(std::vector<NamedMesh>{{"tree", &mesh}}, "a.ply");
                }),
                HasSubstr("format"));
}

TEST(Triangulated, ConcavePolygonsKeepTheirShape) {
    Mesh mesh;  // an arrow head, then a pentagon with a notch
    mesh.positions = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0},   {0.5, 1, 0}, {5, 0, 0},
                      {7, 0, 0}, {7, 2, 0}, {6, 0.5, 0}, {5, 2, 0}};
    mesh.corners = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    mesh.face_starts = {0, 4, 9};
    mesh.faces = {{}, {}};
    mesh.groups = {{}};
    const std::vector<double> areas{1.5, 2.5};
    for (std::size_t f = 0; f < 2; ++f) {
        double area = 0;
        for (const auto& triangle : triangulated(mesh, f)) {
            const Vec3 &a = mesh.positions[static_cast<std::size_t>(mesh.corners[triangle[0]])],
                       &b = mesh.positions[static_cast<std::size_t>(mesh.corners[triangle[1]])],
                       &c = mesh.positions[static_cast<std::size_t>(mesh.corners[triangle[2]])];
            const double part = 0.5 * (b - a).cross(c - a).z();
            EXPECT_GT(part, 0);
            area += part;
        }
        EXPECT_NEAR(area, areas[f], 1e-12);
    }
}

}  // namespace
}  // namespace windfall::meshfile
