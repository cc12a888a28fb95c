#include "drying/artist_skin.h"

#include <fmt/format.h>

#include "drying/frame_maker.h"

namespace windfall::drying {

namespace {

geometry::SurfaceTransfer transfer_of(const ArtistFruit& fruit, const geometry::LayeredMesh& mesh) {
    const std::vector<geometry::Vec3> vertices = fruit.vertices();
    std::vector<Eigen::Vector3f> skin;
    skin.reserve(mesh.columns());
    for (const geometry::Vec3& p : mesh.level_positions(mesh.layers)) skin.emplace_back(p.cast<float>());
    return {vertices, geometry::vertex_normals(vertices, fruit.mesh().faces), skin, mesh.brick.quads};
}

}  // namespace

ArtistSkin::ArtistSkin(const ArtistFruit& fruit, const geometry::LayeredMesh& mesh)
    : m_fruit(fruit), m_transfer(transfer_of(fruit, mesh)) {}

take::TakeMesh ArtistSkin::take_mesh() const {
    take::TakeMesh result;
    result.name = kSkinMesh;
    result.rest.positions = m_fruit.vertices();
    result.rest.faces = m_fruit.mesh().faces;
    result.rest.corner_uvs = m_fruit.mesh().corner_uvs;
    return result;
}

void ArtistSkin::carry(take::Frame& frame) const {
    for (take::FrameMesh& mesh : frame.meshes) {
        if (mesh.name != kSkinMesh) continue;
        mesh.positions = m_transfer.moved(mesh.positions);
        for (take::Attribute& attribute : mesh.attributes)
            attribute.values = m_transfer.carried(attribute.values);
    }
}

std::vector<std::string> check_resolution(const ArtistFruit& fruit, double wave_length) {
    constexpr double kFewestPerWave = 5;
    const geometry::SurfaceMesh& mesh = fruit.mesh();
    double sum = 0;
    double count = 0;
    for (const geometry::Face& face : mesh.faces) {
        const int corners = geometry::corner_count(face);
        for (int c = 0; c < corners; ++c) {
            sum += (mesh.positions[face[(c + 1) % corners]] - mesh.positions[face[c]]).norm();
            count += 1;
        }
    }
    const double edges_per_wave = wave_length * fruit.r1() * count / sum;
    if (edges_per_wave >= kFewestPerWave) return {};
    return {fmt::format(
        "fruit.mesh has only {:.1f} edges to a wrinkle of the expected wave length: subdivide it, or "
        "set fruit.uvs = \"atlas\" for a skin that shows all of them",
        edges_per_wave)};
}

}  // namespace windfall::drying
