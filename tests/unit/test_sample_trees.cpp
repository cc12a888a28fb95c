// The trees in share/trees, which docs/trees.md breaks, are what tests/support/test_trees.h makes.
#include <gtest/gtest.h>

#include "meshfile/mesh_file.h"
#include "support/test_trees.h"

namespace windfall {
namespace {

void expect_file(const std::string& name, const test::TestTree& tree) {
    const std::filesystem::path path = std::filesystem::path(WINDFALL_SOURCE_DIR) / "share" / "trees" / name;
    const bool by_groups = path.extension() == ".glb";
    const meshfile::Mesh made = test::as_mesh(tree, by_groups);
    const meshfile::Mesh read = meshfile::read(path);
    // A file of glTF has one primitive after the other.
    std::vector<geometry::Vec3> expected;
    for (std::size_t g = 0; g < made.groups.size(); ++g)
        for (std::size_t v = 0; v < made.positions.size(); ++v)
            if (!by_groups || made.vertex_groups[v] == static_cast<std::int32_t>(g))
                expected.push_back(made.positions[v]);
    ASSERT_EQ(read.positions.size(), expected.size());
    for (std::size_t v = 0; v < expected.size(); ++v)
        EXPECT_LT((read.positions[v] - expected[v]).norm(), 1e-5) << v;
    EXPECT_EQ(read.materials.size(), made.materials.size());
}

TEST(SampleTrees, AreThoseOfTheGenerator) {
    expect_file("forked-tree.glb", test::sample_forked_tree());
    expect_file("bent-branch.obj", test::sample_bent_branch());
}

}  // namespace
}  // namespace windfall
