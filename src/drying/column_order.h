#pragma once
// In which order columns and quads are gone through, so that many threads give the same bits as one.
//
// The surface is cut into patches of about 8 x 8 columns, and patches are coloured so that two of one colour
// share no neighbour. Sweeps go colour by colour; patches of one colour may run at the same time, since none
// reads or writes what another writes. Patches depend on the mesh alone, never on the number of threads.
#include <array>
#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "drying/kernels/kernels.h"
#include "geometry/brick_surface.h"

namespace windfall::drying {

/// Ranges of consecutive indices, colour by colour.
using Schedule = std::vector<std::vector<Range>>;

struct ColumnOrder {
    std::vector<std::int32_t> solver_of_vertex;  ///< solver index of a vertex of the brick
    std::vector<std::int32_t> vertex_of_solver;
    Schedule columns;

    std::vector<std::array<std::int32_t, 4>> quads;       ///< in solver order, corners as solver columns
    std::vector<std::int32_t> brick_quad;                 ///< quad of the brick, by solver order
    std::vector<std::array<std::int32_t, 6>> pair_entry;  ///< see KernelTable::assemble
    Schedule quad_ranges;

    // Lower triangle of the column graph and its transpose; see MatrixArrays and UpperArrays.
    std::vector<std::int32_t> lower_begin, lower_column;
    std::vector<std::int32_t> upper_begin, upper_column, upper_entry;

    std::int32_t column_count() const { return static_cast<std::int32_t>(vertex_of_solver.size()); }
};

ColumnOrder make_column_order(const geometry::BrickSurface& brick);

/// Calls body(i) for every range i of one colour, from several threads where that pays.
template <class Body>
void for_ranges(const std::vector<Range>& ranges, const Body& body);
/// Calls body(range) for every range, colour by colour; `for_schedule_reversed`: last colour first.
template <class Body>
void for_schedule(const Schedule& schedule, const Body& body);
template <class Body>
void for_schedule_reversed(const Schedule& schedule, const Body& body);
/// The same as `for_schedule`; returns the sum of what body(range) returns, in the schedule's order.
template <class Body>
double schedule_sum(const Schedule& schedule, const Body& body);

// ---- implementation of the templates ----

template <class Body>
void for_ranges(const std::vector<Range>& ranges, const Body& body) {
    // With fewer columns than this a colour is done before a second thread would have woken up.
    constexpr std::int32_t kSerial = 128;
    std::int32_t size = 0;
    for (const Range& range : ranges) size += range.end - range.begin;
    if (size < kSerial) {
        for (std::size_t i = 0; i < ranges.size(); ++i) body(i);
    } else {
        parallel_for_each(ranges.size(), body);
    }
}

template <class Body>
void for_schedule(const Schedule& schedule, const Body& body) {
    for (const auto& ranges : schedule) for_ranges(ranges, [&](std::size_t i) { body(ranges[i]); });
}

template <class Body>
void for_schedule_reversed(const Schedule& schedule, const Body& body) {
    for (std::size_t colour = schedule.size(); colour-- > 0;) {
        const std::vector<Range>& ranges = schedule[colour];
        for_ranges(ranges, [&](std::size_t i) { body(ranges[i]); });
    }
}

template <class Body>
double schedule_sum(const Schedule& schedule, const Body& body) {
    double sum = 0;
    std::vector<double> parts;
    for (const auto& ranges : schedule) {
        parts.resize(ranges.size());
        for_ranges(ranges, [&](std::size_t i) { parts[i] = body(ranges[i]); });
        for (const double part : parts) sum += part;
    }
    return sum;
}

}  // namespace windfall::drying
