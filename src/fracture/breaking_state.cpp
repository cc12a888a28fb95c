// The state of a breaking branch as bytes, and back.
#include <cstring>

#include "fracture/breaking_motion.h"

namespace windfall::fracture {

namespace {

constexpr std::uint64_t kVersion = 1;

/// Appends values as they lie in memory.
class StateWriter {
  public:
    template <class T>
    void put(const T& value) {
        put_bytes(&value, sizeof(T));
    }
    void put(const Point& p) { put_bytes(p.data(), 4 * sizeof(double)); }
    template <class T>
    void put_all(const std::vector<T>& values) {
        put(static_cast<std::uint64_t>(values.size()));
        for (const T& value : values) put(value);
    }
    std::vector<std::byte> bytes;

  private:
    void put_bytes(const void* data, std::size_t count) {
        const auto* from = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), from, from + count);
    }
};

[[noreturn]] void refuse_state() {
    throw InputError(
        "the take's checkpoint does not fit this program or this recipe: run again with --force to begin "
        "anew");
}

/// Reads them again, in the same order.
class StateReader {
  public:
    explicit StateReader(std::span<const std::byte> bytes) : m_bytes(bytes) {}
    template <class T>
    void get(T& value) {
        get_bytes(&value, sizeof(T));
    }
    void get(Point& p) { get_bytes(p.data(), 4 * sizeof(double)); }
    template <class T>
    void get_all(std::vector<T>& values) {
        std::uint64_t count = 0;
        get(count);
        if (count != values.size()) refuse_state();
        for (T& value : values) get(value);
    }
    bool at_end() const { return m_bytes.empty(); }

  private:
    void get_bytes(void* data, std::size_t count) {
        if (m_bytes.size() < count) refuse_state();
        std::memcpy(data, m_bytes.data(), count);
        m_bytes = m_bytes.subspan(count);
    }
    std::span<const std::byte> m_bytes;
};

/// Calls visit(member) for every number of a fibre's state.
template <class State, class Visit>
void visit_fibre(State& state, const Visit& visit) {
    for (std::size_t half = 0; half < 2; ++half) {
        for (auto& p : state.position[half]) visit(p);
        for (auto& v : state.velocity[half]) visit(v);
        for (auto& c : state.clear[half]) visit(c);
        visit(state.freed[half]);
    }
    visit(state.torn_at);
}

}  // namespace

std::vector<std::byte> BranchBreaking::save() const {
    StateWriter out;
    out.put(kVersion);
    out.put(m_lattice.step);
    out.put(m_frame);
    out.put(m_steps_done);
    out.put(m_still);
    out.put(m_load.moment);
    out.put_all(m_particles.position);
    out.put_all(m_particles.velocity);
    out.put_all(m_bonds.slip);
    out.put_all(m_bonds.torn_at);
    out.put_all(m_contact.clear);
    out.put(static_cast<std::uint64_t>(m_fibres.states.size()));
    for (const FibreState& state : m_fibres.states)
        visit_fibre(state, [&out](const auto& value) { out.put(value); });
    return std::move(out.bytes);
}

void BranchBreaking::restore(std::span<const std::byte> bytes) {
    StateReader in(bytes);
    std::uint64_t version = 0, fibres = 0;
    double step = 0;
    in.get(version);
    in.get(step);
    if (version != kVersion || step != m_lattice.step) refuse_state();
    in.get(m_frame);
    in.get(m_steps_done);
    in.get(m_still);
    in.get(m_load.moment);
    in.get_all(m_particles.position);
    in.get_all(m_particles.velocity);
    in.get_all(m_bonds.slip);
    in.get_all(m_bonds.torn_at);
    in.get_all(m_contact.clear);
    in.get(fibres);
    if (fibres != m_fibres.states.size()) refuse_state();
    for (FibreState& state : m_fibres.states) visit_fibre(state, [&in](auto& value) { in.get(value); });
    if (!in.at_end()) refuse_state();
    m_bonds.recount();
}

}  // namespace windfall::fracture
