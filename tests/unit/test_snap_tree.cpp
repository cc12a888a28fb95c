#include "recipe/snap_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "meshfile/mesh_file.h"
#include "support/mesh_checks.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/test_trees.h"

namespace windfall::recipe {
namespace {

namespace fs = std::filesystem;
using geometry::Vec2;
using geometry::Vec3;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class SnapTree : public ::testing::Test {
  protected:
    SnapTree() {
        m_recipe.process = "fracture";
        m_recipe.fracture.branch.rings = 8;
        m_recipe.fracture.branch.sectors = 24;
        m_recipe.fracture.branch.layers = 8;
        m_recipe.fracture.output.piece = fracture::PiecePlace::Above;
        m_recipe.fracture.fracture.gap = 1;
    }

    /// A tube as a file of this ending.
    fs::path tube(const std::string& ending) const {
        test::Tube tube;
        tube.centre = [](double t) { return Vec3(0, 2 * t, 0.1 * t * t); };
        tube.half_axes = [](double) { return Vec2(0.1, 0.08); };
        const meshfile::Mesh mesh =
            test::as_mesh(test::tube_tree(tube), ending == ".glb" || ending == ".gltf");
        fs::path path = m_folder.path() / ("tube" + ending);
        for (const auto& file : meshfile::encode(std::vector<meshfile::NamedMesh>{{"tree", &mesh}}, path)) {
            std::ofstream stream(file.path, std::ios::binary);
            for (const std::byte b : file.bytes) stream.put(static_cast<char>(b));
        }
        return path;
    }

    SnapTreeOptions options_for(const fs::path& tree) const {
        SnapTreeOptions options;
        options.tree = tree;
        options.at = {0.1, 1, 0};
        options.output = m_folder.path() / ("broken" + tree.extension().string());
        return options;
    }

    TemporaryFolder m_folder;
    Recipe m_recipe;
};

TEST_F(SnapTree, WritesTreeAndPieceInTheFormatTheyCameIn) {
    for (const std::string ending : {".obj", ".glb", ".gltf", ".ply"}) {
        const SnapTreeOptions options = options_for(tube(ending));
        const SnappedTree snapped = snap_tree(m_recipe, options, {});
        EXPECT_EQ(snapped.files.size(), ending == ".obj" || ending == ".ply" ? 2U : 1U);
        for (const fs::path& file : snapped.files) EXPECT_TRUE(fs::exists(file)) << file;
        EXPECT_NEAR(snapped.branch.radius, 0.09, 0.01);
        const meshfile::Mesh whole = meshfile::read(options.tree), broken = meshfile::read(options.output);
        double volume = test::volume(broken);
        EXPECT_EQ(test::bad_edges(broken), 0U) << ending;
        if (ending == ".ply") {
            const meshfile::Mesh piece = meshfile::read(m_folder.path() / "broken_fallen_piece.ply");
            EXPECT_EQ(test::bad_edges(piece), 0U);
            volume += test::volume(piece);
        }
        EXPECT_NEAR(volume, test::volume(whole), 3e-3 * volume) << ending;
        EXPECT_GT(test::faces_taken_over(whole, broken).size(), 50U) << ending;
    }
}

TEST_F(SnapTree, OverwritesOnlyWhenAsked) {
    SnapTreeOptions options = options_for(tube(".obj"));
    snap_tree(m_recipe, options, {});
    EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), HasSubstr("already"));
    options.overwrite = true;
    EXPECT_NO_THROW(snap_tree(m_recipe, options, {}));
}

TEST_F(SnapTree, RefusesOtherFormatsAndProcesses) {
    SnapTreeOptions options = options_for(tube(".obj"));
    options.output.replace_extension(".ply");
    EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), HasSubstr("ends in .obj"));
    EXPECT_THAT(message_of([&] { snap_tree(Recipe{}, options, {}); }), HasSubstr("drying"));
    options.dry_run = true;
    EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), HasSubstr("ends in .obj"));
    options.output.replace_extension(".obj");
    EXPECT_TRUE(snap_tree(m_recipe, options, {}).files.empty());
    EXPECT_FALSE(fs::exists(options.output));
}

TEST_F(SnapTree, NeverReplacesTheTreeItself) {
    SnapTreeOptions options = options_for(tube(".obj"));
    options.overwrite = true;
    options.output = options.tree.parent_path() / "." / options.tree.filename();
    EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), HasSubstr("the tree itself"));
}

TEST_F(SnapTree, TellsBeforeTheWorkThatNothingCanBeWritten) {
    SnapTreeOptions options = options_for(tube(".obj"));
    options.at = {100, 100, 100};  // would be told next
    options.output = options.tree / "under_a_file" / "broken.obj";
    for (const bool dry_run : {false, true}) {
        options.dry_run = dry_run;
        EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), HasSubstr("is a file"));
    }
    options.output = m_folder.path() / "new" / "broken.obj";
    EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), Not(HasSubstr("folder")));
    EXPECT_FALSE(fs::exists(m_folder.path() / "new"));
}

TEST_F(SnapTree, TellsOfPointsFarAwayAndOfFolders) {
    SnapTreeOptions options = options_for(tube(".obj"));
    options.at = {1e300, 0, 0};
    EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), HasSubstr("far off the tree"));
    options.tree = m_folder.path() / "folder.obj";
    fs::create_directory(options.tree);
    EXPECT_THAT(message_of([&] { snap_tree(m_recipe, options, {}); }), HasSubstr("is a folder"));
}

TEST_F(SnapTree, WarnsAsForABranchWithoutATree) {
    m_recipe.fracture.bundles.radial = {0.03};
    m_recipe.fracture.bundles.angular = {0.035};
    m_recipe.fracture.bundles.amplitude = {0.1};
    m_recipe.fracture.bundles.slope = {1};
    SnapTreeOptions options = options_for(tube(".obj"));
    options.dry_run = true;
    EXPECT_THAT(snap_tree(m_recipe, options, {}).warnings, Contains(HasSubstr("bundles.angular")));
}

}  // namespace
}  // namespace windfall::recipe
