#include "drying/slow_motion.h"

#include "core/parallel.h"

namespace windfall::drying {

AlignedArray<double> slow_motion(const geometry::SlowField& slow, const ColumnOrder& order,
                                 std::size_t layers, const AlignedArray<double>& from,
                                 const AlignedArray<double>& to) {
    const std::vector<std::int32_t>& vertex = order.vertex_of_solver;
    AlignedArray<double> result(to.size());
    parallel_for_each(layers, [&](std::size_t k) {
        const auto index = [layers, k](std::size_t c, std::size_t i) { return (3 * c + i) * layers + k; };
        std::vector<geometry::Vec3> motion(vertex.size());
        for (std::size_t c = 0; c < motion.size(); ++c)
            for (std::size_t i = 0; i < 3; ++i)
                motion[vertex[c]][static_cast<int>(i)] = to[index(c, i)] - from[index(c, i)];
        motion = slow.project(motion);
        for (std::size_t c = 0; c < motion.size(); ++c)
            for (std::size_t i = 0; i < 3; ++i) result[index(c, i)] = motion[vertex[c]][static_cast<int>(i)];
    });
    return result;
}

}  // namespace windfall::drying
