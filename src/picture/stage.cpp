#include "picture/stage.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "picture/skin_colour.h"

namespace windfall::picture {
namespace {

/// More quadrilaterals than this no picture needs, and memory would begin to count.
constexpr std::size_t kMostQuads = 2'000'000;
/// Facets of this many pixels are not seen.
constexpr double kFacetPixels = 3.6;
constexpr double kFramingMargin = 1.12;

Eigen::Matrix3f pose_matrix(Pose pose) {
    if (pose == Pose::Standing) return Eigen::Matrix3f::Identity();
    // the axis towards +x, then turned a little out of the picture plane, as things lie when they are put
    // down
    const auto oblique = Eigen::AngleAxisf(0.02F * std::numbers::pi_v<float>, Vec3f::UnitY());
    const auto lie = Eigen::AngleAxisf(-0.5F * std::numbers::pi_v<float>, Vec3f::UnitZ());
    return (oblique * lie).toRotationMatrix();
}

int levels_for(const take::TakeMesh& mesh, double radius, int picture_size) {
    double sum = 0;
    std::size_t count = 0;
    for (const auto& face : mesh.rest.faces) {
        const auto a = static_cast<std::size_t>(face[0]), b = static_cast<std::size_t>(face[1]);
        sum += (mesh.rest.positions[b] - mesh.rest.positions[a]).norm();
        ++count;
    }
    const double pixels = sum / static_cast<double>(count) * picture_size / (2 * kFramingMargin * radius);
    int levels = std::clamp(static_cast<int>(std::ceil(std::log2(pixels / kFacetPixels))), 1, 4);
    while (levels > 1 && (mesh.rest.faces.size() << 2 * static_cast<unsigned>(levels)) > kMostQuads) --levels;
    return levels;
}

void check_faces(const take::TakeMesh& mesh) {
    const auto count = static_cast<std::int32_t>(mesh.rest.positions.size());
    for (const auto& face : mesh.rest.faces)
        for (int k = 0; k < geometry::corner_count(face); ++k)
            if (const auto v = face[static_cast<std::size_t>(k)]; v < 0 || v >= count)
                throw InputError(
                    fmt::format("mesh \"{}\": a face names vertex {} of {}", mesh.name, v, count));
}

/// Soft key light from the upper left, a weaker one from behind on the right, sky all around.
void set_studio(Scene& scene, const Camera& camera) {
    const auto from = [&](double azimuth_deg, double elevation_deg) {
        const double a = (camera.azimuth_deg + azimuth_deg) * std::numbers::pi / 180;
        const double e = elevation_deg * std::numbers::pi / 180;
        return Vec3f(static_cast<float>(std::cos(e) * std::sin(a)), static_cast<float>(std::sin(e)),
                     static_cast<float>(std::cos(e) * std::cos(a)));
    };
    scene.lights = {{from(-48, 46), 14, Vec3f(2.9F, 2.75F, 2.5F)},
                    {from(140, 30), 11, Vec3f(0.75F, 0.8F, 0.9F)}};
    scene.sky = {Vec3f(0.55F, 0.57F, 0.61F), Vec3f(0.38F, 0.38F, 0.39F), Vec3f(0.25F, 0.24F, 0.23F)};
    scene.floor.albedo = Vec3f::Constant(0.55F);
    scene.backdrop_top = Vec3f(0.60F, 0.60F, 0.61F);
    scene.backdrop_bottom = Vec3f(0.80F, 0.79F, 0.78F);
    scene.camera = camera;
}

/// Even light on white, in which a colour keeps its meaning.
void set_diagram(Scene& scene, const Camera& camera) {
    set_studio(scene, camera);
    for (DistantLight& light : scene.lights) {
        light.irradiance = Vec3f::Constant(0.24F * light.irradiance.y());
        light.angular_radius_deg = 25;
    }
    scene.sky = {Vec3f::Constant(0.85F), Vec3f::Constant(0.78F), Vec3f::Constant(0.6F)};
    scene.floor.albedo = Vec3f::Constant(0.7F);
    scene.backdrop_top = scene.backdrop_bottom = Vec3f::Ones();
}

}  // namespace

std::vector<double> shown_values(Colouring colouring, const take::TakeMesh& mesh,
                                 const take::FrameMesh& moved) {
    std::vector<double> values;
    if (colouring == Colouring::Curvature) {
        std::vector<geometry::Vec3> positions(moved.positions.size());
        for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = moved.positions[v].cast<double>();
        values = mean_curvature(positions, mesh.rest.faces);
    } else if (colouring == Colouring::Depth) {
        const auto* depth = moved.find("depth");
        if (depth == nullptr || depth->values.size() != moved.positions.size())
            throw InputError(fmt::format("mesh \"{}\" has no depth at its vertices; choose another colouring",
                                         moved.name));
        for (const float d : depth->values) values.push_back(-static_cast<double>(d));
    }
    return values;
}

Stage::Stage(const std::vector<take::TakeMesh>& meshes, const StageSettings& settings)
    : m_settings(settings) {
    m_pose = pose_matrix(settings.look.pose);
    Vec3f low = Vec3f::Constant(1e30F), high = -low;
    for (const auto& mesh : meshes)
        for (const auto& p : mesh.rest.positions) {
            const Vec3f posed = m_pose * p.cast<float>();
            low = low.cwiseMin(posed);
            high = high.cwiseMax(posed);
        }
    if (low.x() > high.x()) throw InputError("the take has no surface to show");
    m_centre = (low + high) / 2;
    float radius = 0;
    for (const auto& mesh : meshes)
        for (const auto& p : mesh.rest.positions)
            radius = std::max(radius, (m_pose * p.cast<float>() - m_centre).norm());
    if (!(radius > 0) || !std::isfinite(radius)) throw InputError("the surface of the take has no size");
    m_radius = static_cast<double>(radius);
    m_centre = Vec3f(m_centre.x(), m_centre.y() - low.y(), m_centre.z());
    for (const auto& mesh : meshes) {
        if (mesh.rest.faces.empty()) continue;
        check_faces(mesh);
        m_parts.push_back({mesh, Refinement(mesh.rest.faces, mesh.rest.positions.size(),
                                            levels_for(mesh, m_radius, settings.picture_size))});
    }
    if (m_parts.empty()) throw InputError("the take has no surface to show");
}

SceneMesh Stage::mesh_of(const Part& part, const take::FrameMesh& moved, double dryness) const {
    const take::TakeMesh& mesh = part.mesh;
    const std::size_t count = mesh.rest.positions.size();
    if (moved.positions.size() != count)
        throw InputError(fmt::format("mesh \"{}\" has {} vertices in the frame and {} in the take", mesh.name,
                                     moved.positions.size(), count));
    const auto* depth = moved.find("depth");
    if (depth != nullptr && depth->values.size() != count) depth = nullptr;
    const std::vector<double> shown = shown_values(m_settings.colouring, mesh, moved);

    // channels: position, fresh position, depth or the value that is shown
    Channels coarse(static_cast<Eigen::Index>(count), 7);
    for (std::size_t v = 0; v < count; ++v) {
        const auto row = static_cast<Eigen::Index>(v);
        coarse.block<1, 3>(row, 0) = (m_pose * moved.positions[v]).transpose();
        coarse.block<1, 3>(row, 3) = mesh.rest.positions[v].cast<float>().transpose();
        coarse(row, 6) = !shown.empty()     ? static_cast<float>(shown[v])
                         : depth != nullptr ? depth->values[v]
                                            : 0.0F;
    }
    if (!coarse.allFinite())
        throw InputError(fmt::format("mesh \"{}\" has positions that are no numbers", mesh.name));
    const Channels fine = part.refinement.apply(coarse);

    SceneMesh result;
    result.quads = part.refinement.quads();
    const auto radius = static_cast<float>(m_radius);
    std::vector<SkinPoint> skin(static_cast<std::size_t>(fine.rows()));
    for (Eigen::Index row = 0; row < fine.rows(); ++row) {
        result.positions.emplace_back(fine.block<1, 3>(row, 0).transpose());
        skin[static_cast<std::size_t>(row)] = {fine.block<1, 3>(row, 3).transpose() / radius,
                                               fine(row, 6) / radius};
    }
    result.normals = smooth_normals(result.positions, result.quads);
    if (m_settings.colouring == Colouring::Material) {
        const Look& look = m_settings.look;
        result.albedo = skin_colours(look, skin, dryness);
        roughen_normals(look, skin, dryness, result.normals);
        result.finish.roughness = static_cast<float>(look.roughness);
        result.finish.gloss = static_cast<float>(look.gloss);
        for (int c = 0; c < 3; ++c)
            result.finish.scatter[c] =
                static_cast<float>(look.softness * look.softness_colour[static_cast<std::size_t>(c)]) *
                radius;
    } else {
        for (Eigen::Index row = 0; row < fine.rows(); ++row) {
            const auto colour =
                diverging_colour(static_cast<double>(fine(row, 6)) / m_settings.false_colour_scale);
            result.albedo.emplace_back(colour[0], colour[1], colour[2]);
        }
        result.finish.gloss = 0;
    }
    return result;
}

Scene Stage::scene_of(const take::Frame& frame) const {
    Scene scene;
    const auto found = frame.scalars.find("shrinkage");
    const double dryness = found == frame.scalars.end() || !(m_settings.final_shrinkage > 0)
                               ? 0
                               : found->second / m_settings.final_shrinkage;
    float lowest = 1e30F;
    for (const Part& part : m_parts) {
        const auto moved = std::find_if(frame.meshes.begin(), frame.meshes.end(),
                                        [&](const auto& m) { return m.name == part.mesh.name; });
        if (moved == frame.meshes.end())
            throw InputError(fmt::format("frame {} has no mesh \"{}\"", frame.index, part.mesh.name));
        scene.meshes.push_back(mesh_of(part, *moved, dryness));
        for (const Vec3f& p : scene.meshes.back().positions) lowest = std::min(lowest, p.y());
    }
    for (SceneMesh& mesh : scene.meshes)
        for (Vec3f& p : mesh.positions) p.y() -= lowest;
    aim(scene, m_settings.azimuth_deg);
    return scene;
}

void Stage::aim(Scene& scene, double azimuth_deg) const {
    const Camera camera =
        frame_sphere(m_centre, m_radius, azimuth_deg, m_settings.elevation_deg, kFramingMargin);
    if (m_settings.colouring == Colouring::Material)
        set_studio(scene, camera);
    else
        set_diagram(scene, camera);
}

}  // namespace windfall::picture
