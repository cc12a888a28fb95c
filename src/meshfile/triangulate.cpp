#include "meshfile/triangulate.h"

namespace windfall::meshfile {
namespace {

using Triangle = std::array<std::size_t, 3>;

class EarClipper {
  public:
    EarClipper(const Mesh& mesh, std::size_t begin, std::size_t end) : m_mesh(mesh) {
        for (std::size_t c = begin; c < end; ++c) m_left.push_back(c);
        m_area = Vec3::Zero();
        for (std::size_t k = 0; k < m_left.size(); ++k)
            m_area += at(m_left[k]).cross(at(m_left[(k + 1) % m_left.size()]));
    }

    std::vector<Triangle> clip() {
        std::vector<Triangle> triangles;
        while (m_left.size() > 3) {
            std::size_t ear = 0;
            while (ear < m_left.size() && !is_ear(ear)) ++ear;
            if (ear == m_left.size()) ear = 1;  // none: go on as a fan
            triangles.push_back(corner_triangle(ear));
            m_left.erase(m_left.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        triangles.push_back({m_left[0], m_left[1], m_left[2]});
        return triangles;
    }

  private:
    const Vec3& at(std::size_t corner) const {
        return m_mesh.positions[static_cast<std::size_t>(m_mesh.corners[corner])];
    }

    Triangle corner_triangle(std::size_t k) const {
        const std::size_t n = m_left.size();
        return {m_left[(k + n - 1) % n], m_left[k], m_left[(k + 1) % n]};
    }

    double turn(const Vec3& a, const Vec3& b, const Vec3& c) const {
        return (b - a).cross(c - a).dot(m_area);
    }

    bool is_ear(std::size_t k) const {
        const Triangle t = corner_triangle(k);
        const Vec3 &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
        if (turn(a, b, c) <= 0) return false;
        for (const std::size_t other : m_left) {
            if (other == t[0] || other == t[1] || other == t[2]) continue;
            const Vec3& p = at(other);
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    const Mesh& m_mesh;
    std::vector<std::size_t> m_left;
    Vec3 m_area;
};

}  // namespace

std::vector<Triangle> triangulated(const Mesh& mesh, std::size_t face) {
    const std::size_t begin = mesh.face_starts[face];
    if (mesh.corner_count(face) == 3) return {{begin, begin + 1, begin + 2}};
    return EarClipper(mesh, begin, mesh.face_starts[face + 1]).clip();
}

}  // namespace windfall::meshfile
