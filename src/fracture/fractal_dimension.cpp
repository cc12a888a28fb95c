#include "fracture/fractal_dimension.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace windfall::fracture {

namespace {

constexpr float kUncovered = -std::numeric_limits<float>::infinity();
constexpr int kSamples = 4;  // intervals between the heights along an edge of a cube

/// Twice the area of the triangle (a, b, p) in the plan, positive when they turn counter-clockwise.
float turn(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float x, float y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

/// Raises the nodes below a triangle to it.
void raise_to(const Triangle& t, double half_width, HeightGrid& grid) {
    const float area = turn(t[0], t[1], t[2].x(), t[2].y());
    if (area == 0) return;  // upright: its edges belong to its neighbours
    const auto node = [&](float coordinate) { return (coordinate + half_width) / grid.spacing; };
    const auto [left, right] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
    const auto [front, back] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
    const int first_column = static_cast<int>(std::max(0.0, std::ceil(node(left) - 1e-4)));
    const int last_column = static_cast<int>(std::min<double>(grid.side, std::floor(node(right) + 1e-4)));
    const int first_row = static_cast<int>(std::max(0.0, std::ceil(node(front) - 1e-4)));
    const int last_row = static_cast<int>(std::min<double>(grid.side, std::floor(node(back) + 1e-4)));
    for (int row = first_row; row <= last_row; ++row)
        for (int column = first_column; column <= last_column; ++column) {
            const auto x = static_cast<float>(column * grid.spacing - half_width);
            const auto y = static_cast<float>(row * grid.spacing - half_width);
            const float weights[3] = {turn(t[1], t[2], x, y) / area, turn(t[2], t[0], x, y) / area,
                                      turn(t[0], t[1], x, y) / area};
            if (std::min({weights[0], weights[1], weights[2]}) < -1e-4F) continue;
            float& height = grid.heights[static_cast<std::size_t>(row) * (grid.side + 1) + column];
            height = std::max(height, weights[0] * t[0].z() + weights[1] * t[1].z() + weights[2] * t[2].z());
        }
}

/// Where columns begin along an edge: side by side, and the same shifted by 1 .. stride - 1 nodes, so that
/// every node is in some of them.
std::vector<int> column_places(int side, int stride) {
    const int cube = kSamples * stride;
    std::vector<int> places;
    for (int shift = 0; shift < stride; ++shift)
        for (int place = shift; place + cube <= side; place += cube) places.push_back(place);
    return places;
}

/// What the heights span over kSamples * stride intervals from a node on.
float span_at(const HeightGrid& grid, int column, int row, int stride) {
    float lowest = grid.at(column, row), highest = lowest;
    for (int r = 0; r <= kSamples; ++r)
        for (int c = 0; c <= kSamples; ++c) {
            const float height = grid.at(column + c * stride, row + r * stride);
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
    return highest - lowest;
}

/// Cubes with kSamples * stride intervals along an edge that meet the surface, per area.
double cubes_met(const HeightGrid& grid, int stride) {
    const double edge = kSamples * stride * grid.spacing;
    const std::vector<int> places = column_places(grid.side, stride);
    double spans = 0;
    for (const int row : places)
        for (const int column : places) spans += span_at(grid, column, row, stride);
    const double columns = static_cast<double>(places.size()) * static_cast<double>(places.size());
    return (spans / columns / edge + 1) / (edge * edge);
}

}  // namespace

HeightGrid height_grid(const std::vector<Triangle>& triangles, double half_width, int side) {
    HeightGrid grid;
    grid.side = side;
    grid.spacing = 2 * half_width / side;
    grid.heights.assign(static_cast<std::size_t>(side + 1) * static_cast<std::size_t>(side + 1), kUncovered);
    for (const Triangle& triangle : triangles) raise_to(triangle, half_width, grid);
    const auto covered = std::find_if(grid.heights.begin(), grid.heights.end(),
                                      [](float height) { return height != kUncovered; });
    if (covered == grid.heights.end())
        throw std::invalid_argument("no triangle lies over the square of the heights");
    float last = *covered;
    for (float& height : grid.heights) last = height = height == kUncovered ? last : height;
    return grid;
}

double box_counting_dimension(const HeightGrid& grid) {
    const int largest_stride = grid.side / 8 / kSamples;
    if (largest_stride < 2) throw std::invalid_argument("too few heights for a box-counting dimension");
    double count = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (int stride = 1; stride <= largest_stride; stride *= 2) {
        const double x = -std::log(stride * grid.spacing), y = std::log(cubes_met(grid, stride));
        count += 1;
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
    }
    return (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
}

}  // namespace windfall::fracture
