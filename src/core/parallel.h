#pragma once
// Parallel loops whose results do not depend on the number of threads: every block of work is cut by the
// problem, never by the machine, and sums are taken block by block in a fixed order.
#include <cstddef>
#include <functional>
#include <memory>

namespace windfall {

/// Limits how many threads the loops below use while it lives (0: as many as the machine has).
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Control;
    std::unique_ptr<Control> m_control;
};

/// Calls body(i) for i in [0, count), in any order, from several threads.
void parallel_for_each(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls body(begin, end) for consecutive blocks of `block` of [0, count), in any order, from several
/// threads.
void parallel_blocks(std::size_t count, std::size_t block,
                     const std::function<void(std::size_t, std::size_t)>& body);

/// Sum of body(begin, end) over consecutive blocks of `block` of [0, count); the blocks are added in order.
double parallel_sum(std::size_t count, std::size_t block,
                    const std::function<double(std::size_t, std::size_t)>& body);

}  // namespace windfall
