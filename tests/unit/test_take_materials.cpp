#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/message_of.h"
#include "support/sample_take.h"
#include "take/frame_file.h"

namespace windfall::take {
namespace {

using testing::HasSubstr;

TakeMesh two_materials() {
    TakeMesh mesh = sample_mesh();
    mesh.materials = {{"bark", false}, {"fibres", true}};
    mesh.face_materials = {0, 0, 1, 1, 1, 0, 1};
    return mesh;
}

NamedArray& array_of(ArrayFile& file, const std::string& name) {
    for (auto& array : file.arrays)
        if (array.name == name) return array;
    throw std::logic_error("no array " + name);
}

TEST(TakeMaterials, ComeBackAsTheyWereWritten) {
    const auto bytes = encode_array_file(to_array_file(two_materials()));
    const TakeMesh mesh = mesh_from(decode_array_file(bytes, "f"), "f");
    ASSERT_EQ(mesh.materials.size(), 2U);
    EXPECT_EQ(mesh.materials[0].name, "bark");
    EXPECT_FALSE(mesh.materials[0].hard);
    EXPECT_EQ(mesh.materials[1].name, "fibres");
    EXPECT_TRUE(mesh.materials[1].hard);
    EXPECT_EQ(mesh.face_materials, two_materials().face_materials);
}

TEST(TakeMaterials, AMeshWithoutThemIsWrittenAsBeforeThereWereAny) {
    const ArrayFile file = to_array_file(sample_mesh());
    EXPECT_FALSE(file.meta.contains("materials"));
    EXPECT_EQ(file.find("face_materials"), nullptr);
    const TakeMesh mesh = mesh_from(file, "f");
    EXPECT_TRUE(mesh.materials.empty() && mesh.face_materials.empty());
}

TEST(TakeMaterials, ThoseThatDoNotFitAreRefusedBothWays) {
    TakeMesh mesh = two_materials();
    mesh.face_materials.pop_back();
    EXPECT_THROW(to_array_file(mesh), std::logic_error);
    mesh.face_materials = {0, 0, 1, 2, 1, 0, 1};
    EXPECT_THROW(to_array_file(mesh), std::logic_error);
    mesh.materials.clear();
    EXPECT_THROW(to_array_file(mesh), std::logic_error);

    ArrayFile file = to_array_file(two_materials());
    std::get<std::vector<std::uint8_t>>(array_of(file, "face_materials").data)[3] = 2;
    EXPECT_THAT(message_of([&] { mesh_from(file, "stub.wfa"); }),
                testing::AllOf(HasSubstr("stub.wfa"), HasSubstr("material 2 of 2")));
    file = to_array_file(two_materials());
    file.arrays.pop_back();
    EXPECT_THAT(message_of([&] { mesh_from(file, "f"); }), HasSubstr("face_materials"));
    file = to_array_file(two_materials());
    file.meta["materials"][0].erase("hard");
    EXPECT_THROW(mesh_from(file, "f"), InputError);
}

}  // namespace
}  // namespace windfall::take
