#include "drying/calculix_deck.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <sstream>

#include "core/error.h"
#include "drying/element.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

/// Data lines below each keyword line, in order.
std::multimap<std::string, std::vector<std::string>> blocks(const std::string& deck) {
    std::multimap<std::string, std::vector<std::string>> result;
    std::vector<std::string>* current = nullptr;
    std::istringstream stream(deck);
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("**")) continue;
        if (line.starts_with("*"))
            current = &result.emplace(line, std::vector<std::string>())->second;
        else
            current->push_back(line);
    }
    return result;
}

std::vector<double> numbers(const std::string& line) {
    std::vector<double> result;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) result.push_back(std::stod(field));
    return result;
}

const std::vector<std::string>& lines(const std::multimap<std::string, std::vector<std::string>>& deck,
                                      const std::string& keyword) {
    EXPECT_EQ(deck.count(keyword), 1U) << keyword;
    static const std::vector<std::string> kNone;
    const auto found = deck.find(keyword);
    return found == deck.end() ? kNone : found->second;
}

class CalculixDeck : public testing::Test {
  protected:
    CalculixDeck() : m_mesh(test::small_sphere(4, 8)) {
        m_parameters.drying.shrinkage = 0.05;
        m_parameters.drying.skin_fraction = 0.2;
        m_parameters.material.bulk_ratio = 200;
        m_parameters.material.gamma = 10;
    }
    geometry::LayeredMesh m_mesh;
    DryingParameters m_parameters;
};

TEST_F(CalculixDeck, NodesAreTheMeshes) {
    const auto deck = blocks(calculix_deck(m_mesh, m_parameters));
    const auto& nodes = lines(deck, "*NODE, NSET=ALL");
    ASSERT_EQ(nodes.size(), m_mesh.columns() * 9);
    for (std::size_t v = 0; v < m_mesh.columns(); ++v)
        for (int level = 0; level <= m_mesh.layers; ++level) {
            const int id = calculix_node(m_mesh, v, level);
            const auto row = numbers(nodes[static_cast<std::size_t>(id - 1)]);
            ASSERT_EQ(row.size(), 4U);
            EXPECT_EQ(row[0], id);
            EXPECT_LT((geometry::Vec3(row[1], row[2], row[3]) - m_mesh.node(v, level)).norm(), 1e-12);
        }
}

TEST_F(CalculixDeck, ElementsFillTheBodyWithPositiveVolume) {
    const auto deck = blocks(calculix_deck(m_mesh, m_parameters));
    const auto& flesh = lines(deck, "*ELEMENT, TYPE=C3D8, ELSET=FLESH");
    const auto& skin = lines(deck, "*ELEMENT, TYPE=C3D8, ELSET=SKIN");
    EXPECT_EQ(flesh.size(), m_mesh.brick.quads.size() * 6);
    EXPECT_EQ(skin.size(), m_mesh.brick.quads.size() * 2);
    const auto& nodes = lines(deck, "*NODE, NSET=ALL");
    const auto position = [&](double id) {
        const auto row = numbers(nodes[static_cast<std::size_t>(id) - 1]);
        return Eigen::Vector3d(row[1], row[2], row[3]);
    };
    double volume = 0;
    std::map<int, int> uses;
    for (const auto* set : {&flesh, &skin})
        for (const std::string& line : *set) {
            const auto row = numbers(line);
            ASSERT_EQ(row.size(), 9U);
            ++uses[static_cast<int>(row[0])];
            HexNodes corners;
            for (std::size_t a = 0; a < 8; ++a) corners[a] = position(row[a + 1]);
            // The order of C3D8: nodes 1, 2, 3, 4 turn from the first face's axis towards nodes 5 to 8.
            const double triple =
                (corners[1] - corners[0]).cross(corners[3] - corners[0]).dot(corners[4] - corners[0]);
            EXPECT_GT(triple, 0);
            volume += hexahedron_volume(corners);
        }
    double expected = 0;
    for (std::size_t q = 0; q < m_mesh.brick.quads.size(); ++q)
        for (int k = 0; k < m_mesh.layers; ++k) expected += hexahedron_volume(element_nodes(m_mesh, q, k));
    EXPECT_NEAR(volume, expected, 1e-9);
    EXPECT_EQ(uses.size(), m_mesh.brick.quads.size() * 8);
    EXPECT_EQ(uses.begin()->first, 1);
    EXPECT_EQ(uses.rbegin()->first, static_cast<int>(uses.size()));
}

TEST_F(CalculixDeck, StoneIsFixedAndTheSkinPrinted) {
    const auto deck = blocks(calculix_deck(m_mesh, m_parameters));
    const auto& stone = lines(deck, "*NSET, NSET=STONE");
    const auto& skin = lines(deck, "*NSET, NSET=SKIN_SURFACE");
    ASSERT_EQ(stone.size(), m_mesh.columns());
    ASSERT_EQ(skin.size(), m_mesh.columns());
    for (std::size_t v = 0; v < m_mesh.columns(); ++v) {
        EXPECT_EQ(std::stoi(stone[v]), calculix_node(m_mesh, v, 0));
        EXPECT_EQ(std::stoi(skin[v]), calculix_node(m_mesh, v, m_mesh.layers));
    }
    EXPECT_EQ(lines(deck, "*BOUNDARY"), std::vector<std::string>{"STONE,1,3"});
    EXPECT_EQ(deck.count("*STEP, NLGEOM, INC=100000"), 1U);
}

TEST_F(CalculixDeck, LawAndShrinkageAreTheRecipes) {
    const std::string text = calculix_deck(m_mesh, m_parameters);
    const auto deck = blocks(text);
    const auto law = deck.equal_range("*HYPERELASTIC, NEO HOOKE");
    ASSERT_EQ(std::distance(law.first, law.second), 2);
    const auto flesh = numbers(law.first->second.front());
    const auto skin = numbers(std::next(law.first)->second.front());
    EXPECT_NEAR(flesh[0], 1, 1e-12);  // C10 of the flesh is the unit of stress
    EXPECT_NEAR(skin[0], 10, 1e-11);
    // mu = 2 C10; the bulk modulus about the fresh state is kappa + 2/3 mu.
    EXPECT_NEAR(2 / flesh[1], 400 + 4.0 / 3, 1e-8);
    EXPECT_NEAR(2 / skin[1], 4000 + 40.0 / 3, 1e-7);
    const auto expansion = deck.equal_range("*EXPANSION, ZERO=0.");
    ASSERT_EQ(std::distance(expansion.first, expansion.second), 2);
    EXPECT_NEAR(numbers(expansion.first->second.front())[0], -0.05, 1e-14);
    EXPECT_NEAR(numbers(std::next(expansion.first)->second.front())[0], -0.01, 1e-14);
    EXPECT_LT(text.find("MATERIAL=FLESH"), text.find("MATERIAL=SKIN"));
}

TEST_F(CalculixDeck, AnisotropicDryingIsRefused) {
    m_parameters.drying.meridional = 0.5;
    try {
        calculix_deck(m_mesh, m_parameters);
        FAIL() << "anisotropic drying was accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("isotropic"));
        EXPECT_THAT(error.what(), testing::HasSubstr("drying.meridional"));
    }
}

TEST_F(CalculixDeck, FibresAreRefused) {
    m_parameters.fibres.direction = FibreDirection::Radial;
    try {
        calculix_deck(m_mesh, m_parameters);
        FAIL() << "fibres were accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("fibres.direction"));
    }
    m_parameters.fibres.stiffness = 0;
    EXPECT_NO_THROW(calculix_deck(m_mesh, m_parameters));
}

}  // namespace
}  // namespace windfall::drying
