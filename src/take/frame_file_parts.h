#pragma once
// Parts of frame files that only some frames have, and what all parts are made with. For frame_file.cpp.
#include <fmt/format.h>

#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "take/array_file.h"
#include "take/frame.h"

namespace windfall::take {

[[noreturn]] inline void damaged_frame(const std::string& file_name, const std::string& what) {
    throw InputError(fmt::format("{}: {}; make the take again", file_name, what));
}

// The numbers of vectors one after the other.
template <class Scalar, class Vectors>
std::vector<Scalar> flat(const Vectors& vectors) {
    std::vector<Scalar> numbers;
    numbers.reserve(vectors.size() * 3);
    for (const auto& v : vectors) numbers.insert(numbers.end(), v.begin(), v.end());
    return numbers;
}

template <class Vector, class Scalar>
std::vector<Vector> vectors3(const std::vector<Scalar>& numbers) {
    std::vector<Vector> vectors(numbers.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = Vector(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
    return vectors;
}

// JSON has no NaN; it is written as null.
inline double number_or_nan(const nlohmann::json& json) {
    return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// The description of the maps, in the meta data. A frame without maps says nothing of them, as all did
/// before there were any.
void add_maps(ArrayFile& file, const Frame& frame);
void read_map_descriptions(const ArrayFile& file, Frame& frame, const std::string& file_name);

/// Curves, which are whole in the file; likewise. std::logic_error when their lists do not fit each other.
void add_curves(ArrayFile& file, const Frame& frame);
void read_curves(const ArrayFile& file, Frame& frame, const std::string& file_name);

}  // namespace windfall::take
