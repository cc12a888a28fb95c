#include "picture/stage.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "picture/rotten_surface.h"
#include "picture/studio.h"

namespace windfall::picture {
namespace {

Eigen::Matrix3f pose_matrix(Pose pose) {
    if (pose == Pose::Standing) return Eigen::Matrix3f::Identity();
    // the axis towards +x, then turned a little out of the picture plane, as things lie when they are put
    // down
    const auto oblique = Eigen::AngleAxisf(0.02F * std::numbers::pi_v<float>, Vec3f::UnitY());
    const auto lie = Eigen::AngleAxisf(-0.5F * std::numbers::pi_v<float>, Vec3f::UnitZ());
    return (oblique * lie).toRotationMatrix();
}

void check_faces(const take::TakeMesh& mesh) {
    const auto count = static_cast<std::int32_t>(mesh.rest.positions.size());
    for (const auto& face : mesh.rest.faces)
        for (int k = 0; k < geometry::corner_count(face); ++k)
            if (const auto v = face[static_cast<std::size_t>(k)]; v < 0 || v >= count)
                throw InputError(
                    fmt::format("mesh \"{}\": a face names vertex {} of {}", mesh.name, v, count));
}

const take::FrameMesh& moved_mesh(const take::Frame& frame, const std::string& name) {
    for (const auto& mesh : frame.meshes)
        if (mesh.name == name) return mesh;
    throw InputError(fmt::format("frame {} has no mesh \"{}\"", frame.index, name));
}

/// The sphere about points, from the middle of the box about them.
struct Ball {
    Vec3f centre;
    float lowest = 0;
    double radius = 0;
};

Ball ball_about(const std::vector<Vec3f>& points) {
    Vec3f low = Vec3f::Constant(1e30F), high = -low;
    for (const Vec3f& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    if (low.x() > high.x()) throw InputError("the take has no surface to show");
    const Vec3f centre = (low + high) / 2;
    float radius = 0;
    for (const Vec3f& p : points) radius = std::max(radius, (p - centre).norm());
    if (!(radius > 0) || !std::isfinite(radius)) throw InputError("the surface of the take has no size");
    return {centre, low.y(), static_cast<double>(radius)};
}

}  // namespace

bool is_wood(const std::vector<take::TakeMesh>& meshes) {
    return std::any_of(meshes.begin(), meshes.end(),
                       [](const auto& mesh) { return !mesh.materials.empty(); });
}

Stage::Stage(const std::vector<take::TakeMesh>& meshes, const StageSettings& settings,
             std::span<const take::Frame> framed_by)
    : m_settings(settings) {
    for (const auto& mesh : meshes) check_faces(mesh);
    if (is_wood(meshes))
        frame_wood(meshes, framed_by);
    else
        frame_fruit(meshes, framed_by);
    if (m_wood.empty() && m_fruit.empty()) throw InputError("the take has no surface to show");
}

void Stage::frame_fruit(const std::vector<take::TakeMesh>& meshes, std::span<const take::Frame> framed_by) {
    m_pose = pose_matrix(m_settings.look.pose);
    std::vector<const take::TakeMesh*> fruit;
    for (const auto& mesh : meshes) {
        if (mesh.rest.faces.empty() || is_hidden(mesh)) continue;
        if (is_furniture(mesh))
            m_furniture.push_back(mesh);
        else
            fruit.push_back(&mesh);
    }
    const bool alone = fruit.size() == 1 && m_furniture.empty();
    std::vector<Vec3f> points;
    if (alone || framed_by.empty()) {
        for (const auto& mesh : meshes)
            for (const auto& p : mesh.rest.positions) points.emplace_back(m_pose * p.cast<float>());
    } else {
        for (const auto& mesh : framed_by.front().meshes)
            for (const auto& p : mesh.positions) points.emplace_back(m_pose * p);
    }
    const Ball whole = ball_about(points);
    m_radius = whole.radius;
    m_centre = Vec3f(whole.centre.x(), whole.centre.y() - whole.lowest, whole.centre.z());
    for (const take::TakeMesh* mesh : fruit) {
        points.clear();
        for (const auto& p : mesh->rest.positions) points.emplace_back(m_pose * p.cast<float>());
        m_fruit.emplace_back(*mesh, alone ? m_radius : ball_about(points).radius, m_radius,
                             m_settings.picture_size);
    }
    // A fruit that rots collapses and spreads in front of where the fresh one stood.
    if (alone && !framed_by.empty() && !framed_by.front().maps.empty()) {
        m_centre.y() -= 0.1F * m_radius;
        m_radius *= 1.12F;
    }
}

void Stage::frame_wood(const std::vector<take::TakeMesh>& meshes, std::span<const take::Frame> framed_by) {
    take::Frame rest;
    for (const auto& mesh : meshes) {
        if (mesh.rest.faces.empty()) continue;
        m_wood.push_back(mesh);
        if (mesh.materials.empty()) {  // one smooth material among others with many
            m_wood.back().materials = {{mesh.name, false}};
            m_wood.back().face_materials.assign(mesh.rest.faces.size(), 0);
        }
        take::FrameMesh fresh{mesh.name, {}, {}};
        for (const auto& p : mesh.rest.positions) fresh.positions.emplace_back(p.cast<float>());
        rest.meshes.push_back(std::move(fresh));
    }
    if (framed_by.empty()) framed_by = std::span<const take::Frame>(&rest, 1);
    m_whole = wood_region(View::Whole, m_wood, framed_by);
    m_break = wood_region(View::Break, m_wood, framed_by);
}

Scene Stage::fruit_scene(const take::Frame& frame) const {
    const auto found = frame.scalars.find("shrinkage");
    const double dryness = found == frame.scalars.end() || !(m_settings.final_shrinkage > 0)
                               ? 0
                               : found->second / m_settings.final_shrinkage;
    Scene scene;
    float lowest = 1e30F;
    for (const FruitSurface& surface : m_fruit) {
        const auto& moved = moved_mesh(frame, surface.name());
        if (m_settings.colouring != Colouring::Material)
            scene.meshes.push_back(
                surface.diagram_mesh(moved, m_settings.colouring, m_settings.colour_range, m_pose));
        else if (auto texture = texture_of(frame, surface.name()))
            scene.meshes.push_back(surface.textured_mesh(moved, m_settings.look, m_pose, std::move(texture)));
        else
            scene.meshes.push_back(surface.scene_mesh(moved, m_settings.look, m_pose, dryness));
    }
    for (const auto& mesh : m_furniture)
        scene.meshes.push_back(furniture_mesh(mesh, moved_mesh(frame, mesh.name), m_pose));
    if (m_settings.colouring == Colouring::Material) scene.hair = hair_of(frame, m_pose);
    for (const SceneMesh& mesh : scene.meshes)
        for (const Vec3f& p : mesh.positions) lowest = std::min(lowest, p.y());
    for (SceneMesh& mesh : scene.meshes)
        for (Vec3f& p : mesh.positions) p.y() -= lowest;
    for (SceneHair& hair : scene.hair)
        for (Vec3f& p : hair.points) p.y() -= lowest;
    return scene;
}

Scene Stage::wood_scene(const take::Frame& frame) const {
    Scene scene;
    for (const auto& mesh : m_wood) {
        const auto& moved = moved_mesh(frame, mesh.name);
        scene.meshes.push_back(
            m_settings.colouring == Colouring::Material
                ? wood_mesh(mesh, moved)
                : wood_diagram(mesh, moved, m_settings.colouring, m_settings.colour_range));
    }
    return scene;
}

Scene Stage::scene_of(const take::Frame& frame) const {
    Scene scene = m_wood.empty() ? fruit_scene(frame) : wood_scene(frame);
    aim(scene, m_settings.azimuth_deg, m_settings.elevation_deg, m_settings.view, Framing::OneSide);
    return scene;
}

void Stage::aim(Scene& scene, double azimuth_deg, double elevation_deg, View view, Framing framing) const {
    const Camera camera = m_wood.empty() ? frame_sphere(m_centre, m_radius, azimuth_deg, elevation_deg)
                                         : frame_region(view == View::Whole ? m_whole : m_break, azimuth_deg,
                                                        elevation_deg, framing);
    if (m_settings.colouring != Colouring::Material)
        set_diagram(scene, camera);
    else if (m_wood.empty())
        set_studio(scene, camera);
    else
        set_wood_studio(scene, camera);
    if (!m_wood.empty()) scene.floor.height = m_whole.centre.y() - m_whole.half_height;
}

}  // namespace windfall::picture
