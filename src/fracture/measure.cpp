#include "fracture/measure.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "fracture/branch_mesh.h"
#include "fracture/fractal_dimension.h"
#include "fracture/species.h"

namespace windfall::fracture {

namespace {

using geometry::Face;
using nlohmann::json;

constexpr const char* kTissueNames[] = {"pith", "heartwood", "sapwood", "phloem"};

const take::TakeMesh* mesh_named(const take::TakeReader& take, const std::string& name) {
    for (const take::TakeMesh& mesh : take.meshes())
        if (mesh.name == name) return &mesh;
    return nullptr;
}

/// The parameters that the take was made with; defaults where an older program did not know the key.
FractureParameters parameters_of(const take::TakeReader& take) {
    FractureParameters parameters;
    for (const auto& entry : fracture_parameters().entries()) {
        const auto found = take.info().parameters.find(entry.info.key);
        if (found == take.info().parameters.end()) continue;
        entry.set(parameters, std::visit(
                                  [&](const auto& value) {
                                      return ParameterValue(found->get<std::decay_t<decltype(value)>>());
                                  },
                                  entry.info.default_value));
    }
    return parameters;
}

const std::vector<float>& values_of(const take::TakeMesh& mesh, const std::string& attribute) {
    const take::Attribute* found = mesh.find(attribute);
    if (found == nullptr)
        throw InputError(fmt::format("the mesh \"{}\" has no attribute \"{}\"; make the take again",
                                     mesh.name, attribute));
    return found->values;
}

struct SurfaceFace {
    Face corners;
    Tissue tissue = Tissue::Pith;
};

/// The faces of the broken (or sawn) surface: neither bark, nor thorns, nor what lies below `least_height`.
std::vector<SurfaceFace> surface_faces(const take::TakeMesh& mesh, double least_height) {
    const std::vector<float>&height = values_of(mesh, "height"), &tissue = values_of(mesh, "tissue");
    std::vector<SurfaceFace> faces;
    for (std::size_t f = 0; f < mesh.face_materials.size(); ++f) {
        const std::string& material = mesh.materials[mesh.face_materials[f]].name;
        const auto is = [&](Part part) { return material == part_names()[static_cast<std::size_t>(part)]; };
        if (is(Part::Bark) || is(Part::Thorns)) continue;
        SurfaceFace face{mesh.rest.faces[f], Tissue::Bark};
        float lowest = std::numeric_limits<float>::max();
        for (int c = 0; c < geometry::corner_count(face.corners); ++c) {
            const auto v = static_cast<std::size_t>(face.corners[c]);
            lowest = std::min(lowest, height[v]);
            face.tissue = std::min(face.tissue, static_cast<Tissue>(std::clamp(tissue[v], 0.0F, 4.0F)));
        }
        // All of bark: the rim between the torn edge and the bark below.
        if (lowest < least_height || face.tissue == Tissue::Bark) continue;
        if (is(Part::InnerBark)) face.tissue = Tissue::Phloem;
        faces.push_back(face);
    }
    return faces;
}

double area_of(const take::TakeMesh& mesh, const Face& face) {
    const auto corner = [&](int c) { return mesh.rest.positions[static_cast<std::size_t>(face[c])]; };
    const bool triangle = face[3] == geometry::kNoVertex;
    return 0.5 *
           (corner(2) - corner(0)).cross(triangle ? corner(2) - corner(1) : corner(3) - corner(1)).norm();
}

/// Over the cross-section of the branch made straight; the third coordinate is the height along it.
class StraightBranch {
  public:
    StraightBranch(const take::TakeMesh& mesh, const BranchParameters& branch)
        : m_mesh(mesh),
          m_height(values_of(mesh, "height")),
          m_curvature(branch.bend_deg * std::numbers::pi / 180 / (branch.length + branch.piece_length)) {}

    std::vector<Triangle> triangles(const std::vector<SurfaceFace>& faces) const {
        std::vector<Triangle> result;
        for (const auto& [f, tissue] : faces) {
            result.push_back({at(f[0]), at(f[1]), at(f[2])});
            if (f[3] != geometry::kNoVertex) result.push_back({at(f[0]), at(f[2]), at(f[3])});
        }
        return result;
    }

  private:
    Eigen::Vector3f at(std::int32_t vertex) const {
        const geometry::Vec3& p = m_mesh.rest.positions[static_cast<std::size_t>(vertex)];
        // The axis is an arc that leaves the break upright and bends towards +x (placing.cpp).
        const double x =
            m_curvature == 0
                ? p.x()
                : 1 / m_curvature - std::copysign(std::hypot(1 / m_curvature - p.x(), p.y()), m_curvature);
        return Eigen::Vector3d(x, -p.z(), m_height[static_cast<std::size_t>(vertex)]).cast<float>();
    }

    const take::TakeMesh& m_mesh;
    const std::vector<float>& m_height;
    double m_curvature;
};

void measure_surface(const take::TakeMesh& stub, const FractureParameters& parameters, double lowest,
                     json& result) {
    // The cut at the stub's far end lies branch.length below the break.
    const std::vector<SurfaceFace> faces = surface_faces(stub, lowest - 0.5 * parameters.branch.length);
    if (faces.empty()) throw InputError("the stub has no broken surface; make the take again");
    double areas[std::size(kTissueNames)] = {};
    double sum = 0;
    for (const SurfaceFace& face : faces) {
        const double area = area_of(stub, face.corners);
        areas[static_cast<std::size_t>(face.tissue)] += area;
        sum += area;
    }
    for (std::size_t t = 0; t < std::size(kTissueNames); ++t)
        result[std::string("area_") + kTissueNames[t]] = areas[t];
    result["area"] = sum;
    result["area_over_section"] = sum / std::numbers::pi;
    if (parameters.fracture.end == EndKind::Cut) return;
    constexpr int kIntervals = 256;
    const double half_width =
        0.66 * (1 - parameters.branch.outline);  // the square's corners stay in the wood
    result["fractal_dimension"] = box_counting_dimension(
        height_grid(StraightBranch(stub, parameters.branch).triangles(faces), half_width, kIntervals));
}

json measure_frame(const take::TakeReader& take, const take::Frame& frame) {
    json result = {{"frame", frame.index}, {"time", frame.time}};
    for (const auto& [name, value] : frame.scalars) result[name] = value;
    for (const take::FrameMesh& moved : frame.meshes) {
        const take::TakeMesh* mesh = mesh_named(take, moved.name);
        if (mesh == nullptr) continue;
        std::vector<geometry::Vec3> positions;
        positions.reserve(moved.positions.size());
        for (const auto& p : moved.positions) positions.emplace_back(p.cast<double>());
        result[moved.name + "_volume"] = geometry::enclosed_volume(positions, mesh->rest.faces);
    }
    return result;
}

}  // namespace

json measure(const take::TakeReader& take) {
    const take::TakeMesh* stub = mesh_named(take, "stub");
    if (stub == nullptr || take.frame_count() == 0)
        throw InputError(fmt::format("the take {} has no frames yet", take.folder().string()));
    const FractureParameters parameters = parameters_of(take);
    json result;
    result["name"] = take.info().name;
    result["frames"] = json::array();
    for (int i = 0; i < take.frame_count(); ++i)
        result["frames"].push_back(measure_frame(take, take.frame(i)));
    // What is known only while the branch is made.
    const json summary = take.summary();
    const auto copy = [&](const char* key) {
        result[key] = summary.contains(key) ? summary.at(key) : json();
    };
    if (parameters.fracture.end == EndKind::Broken) {
        for (const char* key : {"mean_height", "lowest", "highest", "stub_thorns", "piece_thorns"}) copy(key);
        std::vector<std::string> warnings;
        result["law_height"] = asked_mean_height(parameters, &warnings);
        if (!warnings.empty()) result["law_warning"] = warnings.front();
        result["strands"] = parameters.fringe.strands;
    }
    const json cracks = summary.value("cracks", json::object());
    for (const char* key : {"asked", "opened", "shortened", "dropped", "narrowed"})
        result[std::string("cracks_") + key] = cracks.value(key, json());
    measure_surface(*stub, parameters, summary.value("lowest", 0.0), result);
    return result;
}

}  // namespace windfall::fracture
