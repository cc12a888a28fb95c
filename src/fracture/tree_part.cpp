#include "fracture/tree_part.h"

#include <Eigen/Geometry>
#include <map>

#include "fracture/tree_bark.h"
#include "fracture/tree_wood_faces.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;
using meshfile::FaceAppender;
using meshfile::Mesh;
using meshfile::NewCorner;

class PartMaker {
  public:
    PartMaker(const TreePartPlan& plan, TreeSide side)
        : m_plan(plan),
          m_side(side),
          m_loop(side == TreeSide::Tree ? plan.cut.lower : plan.cut.upper),
          m_bark(plan.mesh, plan.surface) {
        sort_faces();
        m_part = meshfile::part_of(plan.mesh, m_keep, kept_corners());
    }

    Mesh make(const BranchBark& bark, const FittedWood& wood) {
        FaceAppender appender(m_part, m_plan.mesh);
        const WoodFaces wood_faces(m_plan, wood, group_at_cut(), m_part.mesh);
        m_values.assign(m_part.mesh.values_per_corner(), meshfile::kAbsent);
        for (const BarkVertex& vertex : bark.vertices)
            m_places.push_back(appender.add_place(vertex.position));
        for (std::size_t i = 0; i < m_loop.points.size(); ++i)
            m_point_on[{m_loop.points[i].low, m_loop.points[i].high}] = i;
        for (const std::size_t t : m_cut_triangles) add_remainder(t, appender);
        for (const BarkFace& face : bark.faces) add_bark(face, bark, appender);
        // The edge's vertices are shared by bark and wood.
        std::vector<std::int32_t> wood_places(wood.places.size(), -1);
        for (std::size_t i = 0; i < bark.edge.size(); ++i)
            wood_places[static_cast<std::size_t>(bark.edge[i])] = m_places[m_loop.points.size() + i];
        wood_faces.add(appender, wood_places);
        return std::move(m_part.mesh);
    }

  private:
    std::int32_t group_at_cut() const { return m_bark.face_of(m_loop.points[0].triangle).group; }

    TreeSide side_of(std::int32_t welded) const { return m_plan.cut.sides[static_cast<std::size_t>(welded)]; }

    /// Faces that lie on this side as a whole, and the triangles of those that do so in part.
    void sort_faces() {
        const Mesh& mesh = m_plan.mesh;
        m_keep.assign(mesh.face_count(), true);
        for (std::size_t f = 0; f < mesh.face_count(); ++f)
            for (std::size_t c = mesh.face_starts[f]; c < mesh.face_starts[f + 1]; ++c)
                if (side_of(m_plan.surface.welded[static_cast<std::size_t>(mesh.corners[c])]) != m_side)
                    m_keep[f] = false;
        const auto& triangles = m_plan.surface.triangles;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (m_keep[static_cast<std::size_t>(triangles[t].face)]) continue;
            bool has_vertex = false;
            for (const std::int32_t v : triangles[t].vertices)
                has_vertex = has_vertex || side_of(v) == m_side;
            if (has_vertex) m_cut_triangles.push_back(t);
        }
    }

    bool is_kept(std::size_t t, std::size_t k) const {
        return side_of(m_plan.surface.triangles[t].vertices[k]) == m_side;
    }

    std::vector<std::size_t> kept_corners() const {
        std::vector<std::size_t> corners;
        for (const std::size_t t : m_cut_triangles)
            for (std::size_t k = 0; k < 3; ++k)
                if (is_kept(t, k)) corners.push_back(m_plan.surface.triangles[t].corners[k]);
        return corners;
    }

    /// What is left of a triangle on this side of the loop.
    void add_remainder(std::size_t t, FaceAppender& appender) {
        const TreeTriangle& triangle = m_plan.surface.triangles[t];
        std::vector<NewCorner> corners;
        std::array<std::vector<double>, 2> values{m_values, m_values};
        std::size_t cuts = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (is_kept(t, k))
                corners.push_back({static_cast<std::ptrdiff_t>(triangle.corners[k]), -1, nullptr});
            if (is_kept(t, k) == is_kept(t, next)) continue;
            const std::int32_t a = triangle.vertices[k], b = triangle.vertices[next];
            const std::size_t point = m_point_on.at({std::min(a, b), std::max(a, b)});
            const SectionPoint& p = m_loop.points[point];
            Vec3 weights = Vec3::Zero();
            weights[static_cast<int>(k)] = a < b ? 1 - p.share : p.share;
            weights[static_cast<int>(next)] = a < b ? p.share : 1 - p.share;
            m_bark.read(static_cast<std::int32_t>(t), weights, values[cuts].data());
            corners.push_back({-1, m_places[point], values[cuts++].data()});
        }
        appender.add_face(m_bark.face_of(static_cast<std::int32_t>(t)), corners, triangle.face);
    }

    void add_bark(const BarkFace& face, const BranchBark& bark, FaceAppender& appender) {
        std::array<std::vector<double>, 4> values;
        std::vector<NewCorner> corners;
        for (std::size_t k = 0; k < 4; ++k) {
            if (face.corners[k] == geometry::kNoVertex) continue;
            const BarkVertex& vertex = bark.vertices[static_cast<std::size_t>(face.corners[k])];
            values[k] = m_values;
            m_bark.read_in_chart(face.triangle, vertex.position, vertex.places, values[k].data());
            corners.push_back({-1, m_places[static_cast<std::size_t>(face.corners[k])], values[k].data()});
        }
        appender.add_face(m_bark.face_of(face.triangle), corners,
                          m_plan.surface.triangles[static_cast<std::size_t>(face.triangle)].face);
    }

    const TreePartPlan& m_plan;
    TreeSide m_side;
    const Section& m_loop;
    TreeBark m_bark;
    std::vector<bool> m_keep;
    std::vector<std::size_t> m_cut_triangles;
    meshfile::MeshPart m_part;
    std::vector<std::int32_t> m_places;                                       // of the bark's vertices
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> m_point_on;  // of the loop, by edge
    std::vector<double> m_values;
};

}  // namespace

Mesh tree_part(const TreePartPlan& plan, TreeSide side, const BranchBark& bark, const FittedWood& wood) {
    return PartMaker(plan, side).make(bark, wood);
}

}  // namespace windfall::fracture
