#include "drying/checkpoint.h"

#include <cstring>
#include <nlohmann/json.hpp>

namespace windfall::drying {

namespace {

constexpr int kVersion = 4;

// Layout: length of the head (8 bytes), the head as CBOR (which keeps doubles to the bit), the displacements,
// the plastic set.
nlohmann::json to_json(const StepRecord& r) {
    return {r.parameter,      r.shrinkage,         r.depth_rms,
            r.elastic_energy, r.viscous_work,      r.smallest_volume_ratio,
            r.newton_steps,   r.linear_iterations, r.failures,
            r.contacts};
}

StepRecord step_record_from(const nlohmann::json& r) {
    const auto number = [&r](std::size_t i) { return r.at(i).get<double>(); };
    const auto count = [&r](std::size_t i) { return r.at(i).get<int>(); };
    return {number(0), number(1), number(2), number(3), number(4),
            number(5), count(6),  count(7),  count(8),  count(9)};
}

nlohmann::json head_of(const Checkpoint& checkpoint) {
    nlohmann::json history = nlohmann::json::array();
    for (const StepRecord& record : checkpoint.path.history) history.push_back(to_json(record));
    return {{"version", kVersion},
            {"parameter", checkpoint.path.course.parameter},
            {"shrinkage", checkpoint.path.course.shrinkage},
            {"course", checkpoint.path.course.values},
            {"next_step", checkpoint.path.next_step},
            {"past_steps", checkpoint.path.past_steps},
            {"displacements", checkpoint.path.displacements.size()},
            {"set", checkpoint.path.set.size()},
            {"history", history},
            {"pending", to_json(checkpoint.path.pending)},
            {"frames_done", checkpoint.frames_done},
            {"elapsed_s", checkpoint.elapsed_s}};
}

Checkpoint from_head(const nlohmann::json& head) {
    Checkpoint checkpoint;
    checkpoint.path.course.parameter = head.at("parameter").get<double>();
    checkpoint.path.course.shrinkage = head.at("shrinkage").get<double>();
    checkpoint.path.course.values = head.at("course").get<std::vector<double>>();
    checkpoint.path.next_step = head.at("next_step").get<double>();
    checkpoint.path.past_steps = head.at("past_steps").get<std::vector<double>>();
    for (const auto& record : head.at("history")) checkpoint.path.history.push_back(step_record_from(record));
    checkpoint.path.pending = step_record_from(head.at("pending"));
    checkpoint.frames_done = head.at("frames_done").get<int>();
    checkpoint.elapsed_s = head.at("elapsed_s").get<double>();
    return checkpoint;
}

[[noreturn]] void refuse() {
    throw InputError(
        "the take's checkpoint does not fit this program or this recipe: run again with --force to begin "
        "anew");
}

}  // namespace

std::vector<std::byte> to_bytes(const Checkpoint& checkpoint) {
    const std::vector<std::uint8_t> head = nlohmann::json::to_cbor(head_of(checkpoint));
    std::size_t size = sizeof(std::uint64_t) + head.size();
    for (const auto& displacement : checkpoint.path.displacements)
        size += displacement.size() * sizeof(double);
    size += checkpoint.path.set.size() * sizeof(double);
    std::vector<std::byte> bytes(size);
    std::byte* out = bytes.data();
    const auto put = [&out](const void* data, std::size_t count) {
        std::memcpy(out, data, count);
        out += count;
    };
    const std::uint64_t length = head.size();
    put(&length, sizeof(length));
    put(head.data(), head.size());
    for (const auto& displacement : checkpoint.path.displacements)
        put(displacement.data(), displacement.size() * sizeof(double));
    if (!checkpoint.path.set.empty())
        put(checkpoint.path.set.data(), checkpoint.path.set.size() * sizeof(double));
    return bytes;
}

Checkpoint checkpoint_from(std::span<const std::byte> bytes, std::size_t vector_size,
                           std::size_t course_size) {
    std::uint64_t length = 0;
    if (bytes.size() < sizeof(length)) refuse();
    std::memcpy(&length, bytes.data(), sizeof(length));
    bytes = bytes.subspan(sizeof(length));
    if (length > bytes.size()) refuse();
    try {
        const auto* begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
        const auto head = nlohmann::json::from_cbor(begin, begin + length);
        bytes = bytes.subspan(length);
        if (head.at("version") != kVersion) refuse();
        Checkpoint checkpoint = from_head(head);
        const auto count = head.at("displacements").get<std::size_t>();
        const std::size_t vector_bytes = vector_size * sizeof(double);
        const auto set_count = head.at("set").get<std::size_t>();
        // 6 numbers an element; there are fewer elements than nodes.
        if (count < 1 || count > 3 || set_count > 2 * vector_size ||
            bytes.size() != count * vector_bytes + set_count * sizeof(double) ||
            checkpoint.path.past_steps.size() + 1 != count ||
            checkpoint.path.course.values.size() != course_size || checkpoint.frames_done < 0)
            refuse();
        for (std::size_t i = 0; i < count; ++i) {
            AlignedArray<double> displacement(vector_size);
            std::memcpy(displacement.data(), bytes.data() + i * vector_bytes, vector_bytes);
            checkpoint.path.displacements.push_back(std::move(displacement));
        }
        checkpoint.path.set.resize(set_count);
        if (set_count > 0)
            std::memcpy(checkpoint.path.set.data(), bytes.data() + count * vector_bytes,
                        set_count * sizeof(double));
        return checkpoint;
    } catch (const nlohmann::json::exception&) {
        refuse();
    }
}

}  // namespace windfall::drying
