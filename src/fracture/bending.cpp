#include "fracture/bending.h"

#include <cmath>
#include <numbers>

namespace windfall::fracture {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Integrals of 1, y and y^2 over the part of the unit disc below the line at y.
struct SegmentIntegrals {
    double area, first, second;

    static SegmentIntegrals below(double y) {
        const double half = std::sqrt(std::max(0.0, 1 - y * y));  // of the chord
        const double area = y * half + std::asin(y) + std::numbers::pi / 2;
        return {area, -2.0 / 3 * half * half * half, area / 4 - y * half * half * half / 2};
    }
};

/// Normal force and moment of the section whose outermost fibre bears `ratio` and whose neutral axis is
/// given.
struct Balance {
    double force, moment, yield_line, curvature;

    static Balance at(double neutral_axis, double ratio) {
        const double curvature = ratio / (1 - neutral_axis);
        const double yield_line = std::max(-1.0, neutral_axis - 1 / curvature);
        const auto all = SegmentIntegrals::below(1);
        const auto crushed = SegmentIntegrals::below(yield_line);
        const double area = all.area - crushed.area;
        const double first = all.first - crushed.first;
        const double second = all.second - crushed.second;
        return {curvature * (first - neutral_axis * area) - crushed.area,
                curvature * (second - neutral_axis * first) - crushed.first, yield_line, curvature};
    }
};

double wrapped_deg(double angle) {
    const double turned = std::fmod(angle, 360.0);
    return turned < 0 ? turned + 360 : turned;
}

double crushed_amplitude(Moisture moisture) { return moisture == Moisture::Wet ? 0.25 : 0.1; }

}  // namespace

double strength_ratio(Moisture moisture) { return moisture == Moisture::Wet ? 4.0 : 2.5; }

SectionAtBreak section_at_break(double strength_ratio) {
    double neutral_axis = 0;
    if (strength_ratio > 1) {
        // The force falls from positive at the centre to -(compression strength) (area) at the rim.
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i) {
            neutral_axis = (low + high) / 2;
            (Balance::at(neutral_axis, strength_ratio).force > 0 ? low : high) = neutral_axis;
        }
    }
    const Balance balance = Balance::at(neutral_axis, strength_ratio);
    return {neutral_axis, balance.yield_line, balance.curvature, balance.moment};
}

BendingBreak bending_break(const FractureParameters& parameters) {
    const double ratio = strength_ratio(parameters.species.moisture);
    const SectionAtBreak section = section_at_break(ratio);
    BendingBreak result;
    result.tension_deg = wrapped_deg(parameters.load.direction_deg + 180);
    result.neutral_axis = section.neutral_axis;
    result.ductile = parameters.ductile;
    result.ductile.angle_deg = result.tension_deg;
    result.ductile.width_deg = 2 * std::acos(section.neutral_axis) / kDegree;
    result.ductile.depth = 1 - section.neutral_axis;

    const double torque = parameters.load.twist * section.moment;
    const double shear = torque / (std::numbers::pi / 2);  // J of the unit circle
    result.tilt_deg = 0.5 * std::atan(2 * std::abs(shear) / ratio) / kDegree;
    result.tilt_direction_deg = wrapped_deg(result.tension_deg + (parameters.load.twist > 0 ? -90 : 90));
    return result;
}

FractureParameters with_load(const FractureParameters& parameters) {
    FractureParameters result = parameters;
    if (parameters.load.source != LoadSource::Bending) return result;
    const BendingBreak bending = bending_break(parameters);
    result.ductile = bending.ductile;
    result.fracture.tilt_deg = bending.tilt_deg;
    result.fracture.tilt_direction_deg = bending.tilt_direction_deg;
    result.bundles.compression =
        std::min(parameters.bundles.compression, crushed_amplitude(parameters.species.moisture));
    return result;
}

TensionField tension_field(const FractureParameters& parameters) {
    const FractureParameters loaded = with_load(parameters);
    TensionField field;
    const double angle = loaded.ductile.angle_deg * kDegree;
    field.cos_a = static_cast<float>(std::cos(angle));
    field.sin_a = static_cast<float>(std::sin(angle));
    field.compression = static_cast<float>(loaded.bundles.compression);
    if (parameters.load.source == LoadSource::Bending) {
        constexpr double kHalfWidth = 0.3;  // as by hand
        const double axis = bending_break(parameters).neutral_axis;
        field.low = static_cast<float>(axis - kHalfWidth);
        field.high = static_cast<float>(axis + kHalfWidth);
    }
    return field;
}

}  // namespace windfall::fracture
